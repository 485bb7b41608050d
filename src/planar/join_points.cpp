#include "planar/join_points.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/near_points.h"
#include "geometry/place_text.h"

namespace remodel {

double extent_of(const std::vector<Point>& points) {
  if (points.empty()) return 0.0;
  Point low = points[0], high = points[0];
  for (const Point p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const double largest = std::max({std::abs(low.x), std::abs(low.y), std::abs(high.x), std::abs(high.y)});
  return std::max(std::sqrt(squared_distance(low, high)), largest);
}

std::vector<Point> joined_places(const std::vector<Point>& points, Joins& joins) {
  std::vector<Point> places = points;
  if (!(joins.tolerance > 0.0)) return places;
  NearPoints kept(joins.tolerance);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto near = kept.nearest(points[i], [](std::size_t) { return true; });
    if (!near) {
      kept.add(points[i], i);
    } else if (near->distance > 0.0) {
      if (joins.count++ == 0)
        joins.first = "point " + std::to_string(i) + " at " + exact_text(points[i]) + " with point " +
                      std::to_string(near->id) + " at " + exact_text(points[near->id]);
      joins.largest = std::max(joins.largest, near->distance);
      places[i] = points[near->id];
    }
  }
  return places;
}

}  // namespace remodel
