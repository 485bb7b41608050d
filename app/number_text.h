#pragma once

#include <string>

namespace remodel::app {

// A number with up to six significant digits, without trailing zeros ("0.05", "25", "1e-12").
std::string short_text(double number);

}  // namespace remodel::app
