#pragma once

// The bad triangles while refinement runs: the class of badness of each slot, 0 for good, swept from the
// worst class down in the order of slots. No entries to go stale and none to push; and slots in order, unlike
// a queue's first in first out, are close to each other in the mesh, since neighbours are made together.
//
// A pass visits what is at least as bad as the worst triangle was when the pass began. Over the classes lie
// two levels of maxima, each of 64 below, so that a few bad triangles in a large mesh are found without a
// look at the others. A maximum may be too large, never too small: it is lowered when a pass leaves what it
// stands for.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <vector>

#include "remodel/ids.h"

namespace remodel {

class BadTriangles {
 public:
  static constexpr std::uint8_t classes = 127;

  // The class of a triangle whose squared radius may be at most `bound`: 0 if it is, otherwise from the
  // ratio, four classes an octave. The bits of a positive double, as an integer, are nearly a logarithm of
  // it, exact at powers of two and never off by more than 0.09 octaves: that saves the division.
  static std::uint8_t class_of(double squared_radius, double bound) {
    const auto ratio = std::bit_cast<std::uint64_t>(squared_radius) - std::bit_cast<std::uint64_t>(bound);
    const std::uint64_t c = std::min<std::uint64_t>((ratio >> 50) + 1, classes);
    return static_cast<std::uint8_t>(c & (std::uint64_t{0} - std::uint64_t{!(squared_radius <= bound)}));
  }

  void set(TriangleId t, std::uint8_t badness) {
    if (t.index >= levels_[0].size()) grow(0, std::max<std::size_t>(2 * levels_[0].size(), t.index));
    std::size_t i = t.index;
    levels_[0][i] = badness;
    for (std::size_t level = 1; level < levels_.size() && badness > levels_[level][i /= 64]; ++level)
      levels_[level][i] = badness;
  }

  // Takes the next triangle of the pass, or the first of a new pass; none if no triangle is bad.
  TriangleId take() {
    for (;;) {
      if (threshold_ != 0) at_ = next(0, at_);
      if (threshold_ != 0 && at_ < levels_[0].size()) {
        levels_[0][at_] = 0;
        return TriangleId{static_cast<std::uint32_t>(at_++)};
      }
      const std::vector<std::uint8_t>& top = levels_.back();
      threshold_ = top.empty() ? std::uint8_t{0} : *std::max_element(top.begin(), top.end());
      at_ = 0;
      if (threshold_ == 0) return {};
    }
  }

 private:
  static constexpr std::size_t block = 64;

  // Room for at least `size` values of a level. Maxima grow first: whichever allocation fails, each value has
  // one above it.
  [[gnu::noinline]] void grow(std::size_t level, std::size_t size) {
    if (level == levels_.size()) return;
    const std::size_t blocks = size / block + 1;
    grow(level + 1, blocks);
    levels_[level].resize(blocks * block);
  }

  // The largest value of a block. The loop is vectorised, unlike std::max_element().
  static std::uint8_t largest(const std::uint8_t* values) {
    std::uint8_t result = 0;
    for (std::size_t i = 0; i < block; ++i) result = std::max(result, values[i]);
    return result;
  }

  // The first value of the pass in [from, end) of a level; end, a multiple of 8, if there is none. Eight
  // bytes at a time: as no value is above 127, adding 128 - threshold sets the top bit of exactly those bytes
  // that are at least the threshold.
  std::size_t scan(const std::vector<std::uint8_t>& level, std::size_t from, std::size_t end) const {
    static_assert(std::endian::native == std::endian::little);
    constexpr std::uint64_t ones = 0x0101010101010101;
    const std::uint64_t bias = (128U - threshold_) * ones;
    std::uint64_t mask = ~std::uint64_t{0} << (from % 8 * 8);
    for (std::size_t i = from / 8 * 8; i < end; i += 8) {
      std::uint64_t word;
      std::memcpy(&word, level.data() + i, 8);
      const std::uint64_t hits = (word + bias) & (128 * ones) & mask;
      if (hits != 0) return i + static_cast<std::size_t>(std::countr_zero(hits)) / 8;
      mask = ~std::uint64_t{0};
    }
    return end;
  }

  // The first value of the pass from here on; the level's size or more if there is none.
  std::size_t next(std::size_t level, std::size_t from) {
    const std::vector<std::uint8_t>& values = levels_[level];
    if (level + 1 == levels_.size()) return scan(values, from, values.size());
    while (from < values.size()) {
      const std::size_t end = from / block * block + block;
      from = scan(values, from, end);
      if (from < end) return from;
      levels_[level + 1][end / block - 1] = largest(values.data() + end - block);
      from = next(level + 1, end / block) * block;
    }
    return values.size();
  }

  std::array<std::vector<std::uint8_t>, 3> levels_;  // the classes, then maxima
  std::size_t at_ = 0;                               // where the pass is
  std::uint8_t threshold_ = 0;                       // the pass's class; 0: none has begun
};

}  // namespace remodel
