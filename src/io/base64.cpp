#include "io/base64.h"

#include <cstdint>

namespace remodel::io {

namespace {

constexpr int padding = 64;
constexpr int blank = 65;
constexpr int no_digit = 66;

int value_of(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+') return 62;
  if (c == '/') return 63;
  if (c == '=') return padding;
  return c == ' ' || c == '\n' || c == '\r' || c == '\t' ? blank : no_digit;
}

}  // namespace

std::optional<std::string> decode_base64(std::string_view text, std::size_t most) {
  std::string bytes;
  std::uint32_t group = 0;
  int characters = 0;
  int padded = 0;
  for (const char c : text) {
    if (bytes.size() >= most) break;
    const int value = value_of(c);
    if (value == blank) continue;
    if (value == no_digit) break;
    if (value == padding) ++padded;
    group = group << 6 | static_cast<std::uint32_t>(value & 63);
    if (++characters < 4) continue;
    for (int k = 0; k < 3 - padded; ++k) bytes += static_cast<char>(group >> (16 - 8 * k) & 0xff);
    group = 0;
    characters = padded = 0;
  }
  if (characters != 0 || bytes.size() > most + 2) return std::nullopt;
  if (bytes.size() > most) bytes.resize(most);
  return bytes;
}

}  // namespace remodel::io
