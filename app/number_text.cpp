#include "number_text.h"

#include <array>
#include <cstdio>

namespace remodel::app {

std::string short_text(double number) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", number);
  return text.data();
}

}  // namespace remodel::app
