#pragma once

// FNV-1a, 64 bits (G. Fowler, L. C. Noll, K.-P. Vo): tells damage, not forgery.

#include <bit>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

namespace remodel {

class Checksum {
 public:
  void add(std::string_view bytes) {
    for (const char byte : bytes) add_byte(static_cast<unsigned char>(byte));
  }
  void add(std::uint64_t value) {
    for (int shift = 0; shift < 64; shift += 8) add_byte(static_cast<unsigned char>(value >> shift));
  }
  // Both zeros are one: SQLite does not keep the sign of a zero.
  void add(double value) { add(std::bit_cast<std::uint64_t>(value + 0.0)); }

  std::string text() const {
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash_));
    return digits;
  }

 private:
  void add_byte(unsigned char byte) { hash_ = (hash_ ^ byte) * 0x100000001b3U; }
  std::uint64_t hash_ = 0xcbf29ce484222325U;
};

}  // namespace remodel
