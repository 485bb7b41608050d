#pragma once

// FNV-1a, 64 bits (G. Fowler, L. C. Noll, K.-P. Vo): tells damage, not forgery.

#include <bit>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

namespace remodel {

// Byte by byte, the lowest byte of a number first, whatever the machine.
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

  std::uint64_t value() const { return hash_; }
  std::string text() const {
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash_));
    return digits;
  }

 private:
  void add_byte(unsigned char byte) { hash_ = (hash_ ^ byte) * 0x100000001b3U; }
  std::uint64_t hash_ = 0xcbf29ce484222325U;
};

// Word by word, eight times as fast, with a shift that carries the high bits down. Each step is a bijection
// of the hash for a given word, and different words give different results: a single changed value cannot go
// unseen.
class WordChecksum {
 public:
  void add(std::uint64_t word) {
    hash_ = (hash_ ^ word) * 0x100000001b3U;
    hash_ ^= hash_ >> 32;
  }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(std::uint32_t value) { add(std::uint64_t{value}); }
  void add(std::int32_t value) { add(static_cast<std::uint64_t>(value)); }
  void add(const std::string& text) {
    add(std::uint64_t{text.size()});
    for (const char c : text) add(std::uint64_t{static_cast<unsigned char>(c)});
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325U;
};

}  // namespace remodel
