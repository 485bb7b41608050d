#include "remodel/error.h"

#include <algorithm>
#include <cstddef>

namespace remodel {

namespace {

bool continues(char c) {
  return (static_cast<unsigned char>(c) & 0xc0) == 0x80;
}

// The bytes of the character that begins here: 0 where it is no UTF-8, or a control character of the second
// kind (U+0080 to U+009F), which a terminal obeys too. Source: RFC 3629.
std::size_t character_at(std::string_view text) {
  const auto first = static_cast<unsigned char>(text[0]);
  if (first < 0x80) return first >= 0x20 && first != 0x7f ? 1 : 0;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if (!continues(text[i])) return 0;
  const auto second = static_cast<unsigned char>(text[1]);
  const bool overlong = (first == 0xe0 && second < 0xa0) || (first == 0xf0 && second < 0x90);
  const bool outside = (first == 0xed && second >= 0xa0) || (first == 0xf4 && second >= 0x90);
  const bool control = first == 0xc2 && second < 0xa0;
  return overlong || outside || control ? 0 : length;
}

void append_escaped(std::string& result, char c) {
  static constexpr char hex[] = "0123456789abcdef";
  const auto byte = static_cast<unsigned char>(c);
  if (c == '\t')
    result += "\\t";
  else if (c == '\n')
    result += "\\n";
  else if (c == '\r')
    result += "\\r";
  else
    result += {'\\', 'x', hex[byte >> 4], hex[byte & 15]};
}

std::string escaped(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = character_at(text);
    if (length == 0)
      append_escaped(result, text[0]);
    else
      result += text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result;
}

// Both ends of a text that is longer than it should be, cut between characters.
std::string shortened(const std::string& text, std::size_t most, std::size_t kept) {
  if (text.size() <= most) return text;
  std::size_t head = kept, tail = text.size() - kept;
  while (head > 0 && continues(text[head])) --head;
  while (tail < text.size() && continues(text[tail])) ++tail;
  return text.substr(0, head) + "..." + text.substr(tail);
}

}  // namespace

std::string one_line(std::string_view text) {
  constexpr std::size_t longest_word = 160, of_word = 40, longest = 800, of_all = 400;
  const std::string good = escaped(text);
  std::string result;
  for (std::size_t begin = 0; begin < good.size();) {
    const std::size_t end = std::min(good.find(' ', begin), good.size());
    result += shortened(good.substr(begin, end - begin), longest_word, of_word);
    if (end < good.size()) result += ' ';
    begin = end + 1;
  }
  return shortened(result, longest, of_all);
}

}  // namespace remodel
