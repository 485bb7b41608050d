#include "turning_stations.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "remodel/point.h"

namespace remodel {
namespace {

// Enough for the nose of a section of 1 % thickness.
constexpr int samples_per_interval = 64;

// 2 tan of half the angle between two edges, which is the angle for the small ones here, and needs no
// function of the C library.
double turning(Point before, Point at, Point after) {
  const Point a = at - before, b = after - at;
  const double dot = a.x * b.x + a.y * b.y, cross = a.x * b.y - a.y * b.x;
  const double both = std::sqrt((a.x * a.x + a.y * a.y) * (b.x * b.x + b.y * b.y)) + dot;
  return both > 0.0 ? 2.0 * std::abs(cross) / both : 0.0;
}

// The distances in t from the nose of `intervals` stations of a surface, from 0 up to 1/2.
std::vector<double> from_nose(const CstAirfoil& airfoil, bool upper, int intervals, double share) {
  const int count = samples_per_interval * intervals;
  std::vector<Point> points;  // the first one lies beyond the nose
  for (int i = -1; i <= count; ++i) {
    const double above = 0.5 - 0.5 * i / count;
    points.push_back(airfoil.at(upper ? above : 1.0 - above));
  }
  // An interval between samples has half the turning at each of its ends. Where the surface ends it has none.
  std::vector<double> sum{0.0};
  double last = turning(points[0], points[1], points[2]);
  for (std::size_t i = 2; i < points.size(); ++i) {
    const double next = i + 1 < points.size() ? turning(points[i - 1], points[i], points[i + 1]) : 0.0;
    sum.push_back(sum.back() + last + next);
    last = next;
  }

  const auto filled = [&](std::size_t i) {
    const double even = static_cast<double>(i) / count;
    return sum.back() > 0.0 ? (1.0 - share) * even + share * (sum[i] / sum.back()) : even;
  };
  std::vector<double> distances{0.0};
  std::size_t i = 0;
  for (int k = 1; k < intervals; ++k) {
    const double wanted = static_cast<double>(k) / intervals;
    while (filled(i + 1) < wanted) ++i;
    const double part = (wanted - filled(i)) / (filled(i + 1) - filled(i));
    distances.push_back(0.5 * (static_cast<double>(i) + part) / count);
  }
  distances.push_back(0.5);
  return distances;
}

}  // namespace

std::vector<double> turning_stations(const CstAirfoil& airfoil, int points, double share) {
  const int intervals = points / 2;
  std::vector<double> parameters;
  const std::vector<double> above = from_nose(airfoil, true, intervals, share);
  for (auto d = above.rbegin(); d != above.rend(); ++d) parameters.push_back(0.5 - *d);
  const std::vector<double> below = from_nose(airfoil, false, intervals, share);
  // As 1 - (1/2 - d): symmetric to the upper surface to the last bit.
  for (auto d = below.begin() + 1; d + 1 != below.end(); ++d) parameters.push_back(1.0 - (0.5 - *d));
  return parameters;
}

}  // namespace remodel
