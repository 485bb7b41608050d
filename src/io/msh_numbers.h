#pragma once

// The numbers of a .msh file's sections: words, or after begin_binary() little-endian values of fixed size.

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "io/scanner.h"

namespace remodel::io {

static_assert(std::endian::native == std::endian::little, "the binary data of .msh files is taken as it is");

class MshNumbers {
 public:
  explicit MshNumbers(Scanner& scan) : scan_(scan) {}

  // The rest of a section's first line is over, its data begin.
  void begin_binary() {
    binary_ = true;
    scan_.begin_binary();
  }

  // An int: the tag of an entity or a group, a type, in version 2 everything.
  std::int64_t integer(std::string_view expected) {
    return binary_ ? value<std::int32_t>(expected) : scan_.integer(expected);
  }
  // A size_t of version 4: the tag of a node or an element.
  std::int64_t tag(std::string_view expected) {
    if (!binary_) return scan_.integer(expected);
    const auto found = value<std::uint64_t>(expected);
    if (found > std::uint64_t{1} << 62) scan_.fail_found(std::to_string(found), expected);
    return static_cast<std::int64_t>(found);
  }
  // A size_t of version 4: a number of items that follow, each at least four bytes.
  std::size_t count(std::string_view expected) {
    if (!binary_) return scan_.count(expected);
    const auto found = value<std::uint64_t>(expected);
    const std::size_t most = scan_.bytes_left() / 4;
    if (found > most) {
      scan_.fail(std::to_string(found) + " found, " + std::string(expected) + " from 0 to " +
                 std::to_string(most) + " expected: what is left of the file holds no more");
    }
    return static_cast<std::size_t>(found);
  }
  double real(std::string_view expected) { return binary_ ? value<double>(expected) : scan_.real(expected); }
  double coordinate() {
    if (!binary_) return scan_.coordinate();
    const auto found = value<double>("a coordinate");
    if (!(std::abs(found) <= largest_coordinate)) {
      scan_.fail_found(std::to_string(found), "a finite coordinate, at most 1e60 in size,");
    }
    return found;
  }

 private:
  template <class Value>
  Value value(std::string_view expected) {
    Value result;
    std::memcpy(&result, scan_.bytes(sizeof result, expected).data(), sizeof result);
    return result;
  }

  Scanner& scan_;
  bool binary_ = false;
};

}  // namespace remodel::io
