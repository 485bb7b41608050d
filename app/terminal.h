#pragma once

// The terminal that the program prints to.

#include <cstddef>
#include <string>

namespace remodel::app {

// Characters in a line of the terminal behind the descriptor; `otherwise` where there is none.
std::size_t terminal_columns(int descriptor, std::size_t otherwise);

// Replaces the status line on standard error, a terminal, and cuts it to the terminal's width: a longer one
// would wrap, and each redrawing leave a line behind. The cursor stays at its beginning, where the "^C" of an
// interrupt is overwritten by the next one.
void draw_status_line(const std::string& text);

}  // namespace remodel::app
