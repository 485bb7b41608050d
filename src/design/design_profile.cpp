#include "design/design_profile.h"

#include <algorithm>
#include <utility>

namespace remodel {

DesignProfile::DesignProfile(std::vector<Point> outline) : points(std::move(outline)) {
  const std::size_t n = points.size();
  squared_scales.resize(n);
  for (std::size_t i = 0; i < n; ++i)
    squared_scales[i] = std::min(squared_distance(points[i], points[(i + 1) % n]),
                                 squared_distance(points[i], points[(i + n - 1) % n]));
}

double squared_displacement(const DesignProfile& from, const DesignProfile& to) {
  double largest = 0.0;
  for (std::size_t i = 0; i < from.points.size(); ++i)
    largest = std::max(largest, squared_distance(from.points[i], to.points[i]) / from.squared_scales[i]);
  return largest;
}

}  // namespace remodel
