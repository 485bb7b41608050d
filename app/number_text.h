#pragma once

#include <string>

namespace remodel::app {

// For people: six significant digits, nothing superfluous ("0.05", "25", "1e-12").
std::string short_text(double number);

}  // namespace remodel::app
