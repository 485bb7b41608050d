#include "terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>

namespace remodel::app {

std::size_t terminal_columns(int descriptor, std::size_t otherwise) {
  winsize size{};
  if (isatty(descriptor) == 0 || ioctl(descriptor, TIOCGWINSZ, &size) != 0 || size.ws_col == 0)
    return otherwise;
  return size.ws_col;
}

void draw_status_line(const std::string& text) {
  const std::size_t columns = terminal_columns(STDERR_FILENO, 80);
  std::fprintf(stderr, "\r%s\033[K\r", text.substr(0, columns - 1).c_str());
  std::fflush(stderr);
}

}  // namespace remodel::app
