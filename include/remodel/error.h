#pragma once

#include <stdexcept>
#include <string>

namespace remodel {

// The kind of bad input that an Error reports. Reached limits are part of results, and our own bugs are
// assertions: neither is an Error.
enum class ErrorCode {
  argument,  // an option or parameter is out of its range
  file,      // a file cannot be opened, read or written
  format,    // a file's content is not what its format asks for
  geometry,  // a shape that no mesh can have: it crosses or touches itself, is degenerate
};

// Bad input. what() is one line: where (file, line or argument), what was found, what was expected.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& where, const std::string& problem)
      : std::runtime_error(where + ": " + problem), code_(code) {}
  ErrorCode code() const { return code_; }

 private:
  ErrorCode code_;
};

}  // namespace remodel
