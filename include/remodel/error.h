#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace remodel {

// The kind of bad input that an Error reports. Reached limits are part of results, and our own bugs are
// assertions: neither is an Error.
enum class ErrorCode {
  argument,  // an option or parameter is out of its range
  file,      // a file cannot be opened, read or written
  format,    // a file's content is not what its format asks for
  geometry,  // a shape that no mesh can have: it crosses or touches itself, is degenerate
};

// Foreign text as one line of a message, in valid UTF-8: control characters and bytes that are no UTF-8 are
// escaped (a tab is \t, a NUL \x00); a word of more than 160 bytes is its first and its last 40 with ... in
// between, a text of more than 800 its first and its last 400. What is shown is shown as it is.
std::string one_line(std::string_view text);

// Bad input. what() is one line: where (file, line or argument), what was found, what was expected.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& where, const std::string& problem)
      : std::runtime_error(one_line(where) + ": " + one_line(problem)), code_(code) {}
  ErrorCode code() const { return code_; }

 private:
  ErrorCode code_;
};

}  // namespace remodel
