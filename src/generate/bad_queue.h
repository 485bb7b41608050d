#pragma once

// Bad triangles, worst class first, first in first out within a class. A triangle's class is kept in its
// record: an entry whose triangle has another class by now is stale and skipped.

#include <bit>
#include <cstdint>
#include <vector>

#include "triangulation/triangulation.h"

namespace remodel {

class BadQueue {
 public:
  static constexpr int classes = 63;

  // The class of a badness above 1, from the exponent and the first two bits of the mantissa: 1 to 63.
  static std::uint8_t class_of(double badness) {
    const auto bits = std::bit_cast<std::uint64_t>(badness) >> 50;
    constexpr std::uint64_t one = std::bit_cast<std::uint64_t>(1.0) >> 50;
    return static_cast<std::uint8_t>(bits - one >= classes ? classes : bits - one + 1);
  }

  void push(Triangulation& triangulation, TriangleId t, double badness) {
    const std::uint8_t c = class_of(badness);
    if (triangulation[t].badness == c) return;  // already queued
    buckets_[c].entries.push_back(t);
    triangulation.set_badness(t, c);
    if (c > worst_) worst_ = c;
  }

  // The next triangle, no longer marked; none if the queue is empty.
  TriangleId pop(Triangulation& triangulation) {
    for (; worst_ > 0; --worst_) {
      Bucket& bucket = buckets_[worst_];
      while (bucket.first < bucket.entries.size()) {
        look_ahead(triangulation, bucket);
        const TriangleId t = bucket.entries[bucket.first++];
        if (triangulation[t].badness != worst_) continue;
        triangulation.set_badness(t, 0);
        return t;
      }
      bucket.entries.clear();
      bucket.first = 0;
    }
    return {};
  }

  // Unmarks what is still queued.
  void clear(Triangulation& triangulation) {
    for (Bucket& bucket : buckets_) {
      for (; bucket.first < bucket.entries.size(); ++bucket.first)
        triangulation.set_badness(bucket.entries[bucket.first], 0);
      bucket.entries.clear();
      bucket.first = 0;
    }
    worst_ = 0;
  }

 private:
  struct Bucket {
    std::vector<TriangleId> entries;
    std::size_t first = 0;
  };

  // First in first out jumps all over the mesh, which memory punishes: candidates are fetched before their
  // turn. Measured at 54,000 triangles: 5 % to 30 % of generation, depending on what else uses the memory.
  static void look_ahead(const Triangulation& triangulation, const Bucket& bucket) {
    const std::size_t left = bucket.entries.size() - bucket.first;
    if (left > 8) triangulation.prefetch(bucket.entries[bucket.first + 8]);
    if (left > 4 && triangulation[bucket.entries[bucket.first + 4]].alive())
      triangulation.prefetch_around(bucket.entries[bucket.first + 4]);
  }

  Bucket buckets_[classes + 1];
  std::uint8_t worst_ = 0;
};

}  // namespace remodel
