#pragma once

// Points that are found again by what lies near: a grid of cells as wide as the tolerance, by their numbers.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "remodel/point.h"

namespace remodel {

class NearPoints {
 public:
  struct Found {
    std::size_t id;
    double distance;
  };

  // tolerance: positive, and no coordinate is 1e16 times as large.
  explicit NearPoints(double tolerance) : tolerance_(tolerance) {}

  void add(Point p, std::size_t id) { cells_[key(cell(p.x), cell(p.y))].push_back({p, id}); }

  // The nearest point within the tolerance that is wanted, of several the one that was added first.
  template <class Wanted>
  std::optional<Found> nearest(Point p, Wanted&& wanted) const {
    std::optional<Found> best;
    for (std::int64_t x = cell(p.x) - 1; x <= cell(p.x) + 1; ++x)
      for (std::int64_t y = cell(p.y) - 1; y <= cell(p.y) + 1; ++y) {
        const auto entries = cells_.find(key(x, y));
        if (entries == cells_.end()) continue;
        for (const Entry& entry : entries->second) {
          const double distance = std::sqrt(squared_distance(entry.place, p));
          if (!(distance <= tolerance_) || !wanted(entry.id)) continue;
          if (!best || distance < best->distance || (distance == best->distance && entry.id < best->id))
            best = Found{entry.id, distance};
        }
      }
    return best;
  }

 private:
  struct Entry {
    Point place;
    std::size_t id;
  };
  std::int64_t cell(double coordinate) const {
    return static_cast<std::int64_t>(std::floor(coordinate / tolerance_));
  }
  // Cells that share a key by chance are told apart by the distance.
  static std::uint64_t key(std::int64_t x, std::int64_t y) {
    return static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15U + static_cast<std::uint64_t>(y);
  }

  double tolerance_;
  std::unordered_map<std::uint64_t, std::vector<Entry>> cells_;
};

}  // namespace remodel
