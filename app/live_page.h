#pragma once

#include <string_view>

namespace remodel::app {

// The page of `remodel live`, whole; empty in a program that was built without emscripten.
std::string_view live_page();

}  // namespace remodel::app
