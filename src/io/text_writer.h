#pragma once

// Appends numbers to a text, quickly and exactly: the shortest digits that read back as the same value.

#include <charconv>
#include <concepts>
#include <string>
#include <string_view>
#include <utility>

namespace remodel::io {

class TextWriter {
 public:
  TextWriter& operator<<(std::string_view text) {
    text_.append(text);
    return *this;
  }
  TextWriter& operator<<(char character) {
    text_.push_back(character);
    return *this;
  }
  TextWriter& operator<<(double number) { return append(number); }
  template <std::integral Integer>
  TextWriter& operator<<(Integer number) {
    return append(number);
  }

  std::string take() { return std::move(text_); }

 private:
  template <class Number>
  TextWriter& append(Number number) {
    char digits[32];  // the longest: -2.2250738585072014e-308 has 24
    const auto end = std::to_chars(digits, digits + sizeof digits, number).ptr;
    text_.append(digits, end);
    return *this;
  }

  std::string text_;
};

}  // namespace remodel::io
