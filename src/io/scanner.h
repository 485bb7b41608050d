#pragma once

// The tokeniser that every text format shares: words between blanks, with the line they are on, and errors
// that name FILE:LINE, what was found and what was expected.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace remodel::io {

// Coordinates must stay below this: the in-circle determinant multiplies four of them.
inline constexpr double largest_coordinate = 1e60;

// A word for an error message: control characters escaped, long ones cut.
std::string in_quotes(std::string_view word);

class Scanner {
 public:
  // comment: the character that starts a comment up to the end of its line; none if '\0'.
  Scanner(std::string_view text, std::string file, char comment = '\0', std::size_t first_line = 1)
      : text_(text), file_(std::move(file)), comment_(comment), line_(first_line) {}

  bool at_end();  // nothing but blanks and comments is left
  char peek();    // the first character of the next word, '\0' at the end

  // The next word; fails at the end of the text, naming what was expected.
  std::string_view word(std::string_view expected);
  // The word before '=', which is taken too.
  std::string_view keyword();
  // What is left of the line, without blanks around it and without a comment.
  std::string_view rest_of_line();
  void skip_line() { rest_of_line(); }

  double real(std::string_view expected);
  double coordinate();  // finite and not absurdly large
  template <class Integer = std::int64_t>  // or std::uint64_t
  Integer integer(std::string_view expected);
  std::uint32_t index(std::string_view expected);  // 0 to 2^32 - 2
  // A number of items that follow, each at least two bytes: bounded by what is left of the text, so that a
  // wrong header cannot ask for gigabytes.
  std::size_t count(std::string_view expected);

  // Binary data among the text. From then on places are named by their byte.
  void begin_binary();  // takes the rest of the line, its end included
  std::string_view bytes(std::size_t count, std::string_view expected);
  // Everything up to the end of the next place where `end` stands.
  void skip_past(std::string_view end);
  // What has been read since, as it stands; comments too.
  std::size_t position() const { return position_; }
  std::string_view text_from(std::size_t position) const {
    return text_.substr(position, position_ - position);
  }
  std::size_t bytes_left() const { return text_.size() - position_; }

  std::size_t line() const { return line_; }  // of the last word
  std::string place() const {
    return binary_ ? file_ + ": byte " + std::to_string(position_) : file_ + ":" + std::to_string(line_);
  }
  [[noreturn]] void fail(const std::string& problem) const;
  [[noreturn]] void fail_found(std::string_view found, std::string_view expected) const;

 private:
  void skip_blanks();

  std::string_view text_;
  std::string file_;
  char comment_;
  std::size_t position_ = 0;
  std::size_t line_;
  bool binary_ = false;
};

}  // namespace remodel::io
