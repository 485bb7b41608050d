#include "transfer/intersection.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "remodel/predicates.h"

namespace remodel {

namespace {

// The side of an edge that each corner of another triangle lies on: side[i][j] of corner i and edge j, from
// corner j to the next.
using Sides3 = std::array<std::array<int, 3>, 3>;

constexpr std::size_t following(std::size_t i) {
  return i == 2 ? 0 : i + 1;
}

// The ends of an edge, which most neighbours share, are on it: no exact arithmetic has to find that out.
int side_of(Point a, Point b, Point p) {
  return p == a || p == b ? 0 : orient2d(a, b, p);
}

// False, and nothing said of the sides, where an edge has all corners beyond it.
bool find_sides(const Corners& corners, const Corners& edges, Sides3& side) {
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t i = 0; i < 3; ++i) side[i][j] = side_of(edges[j], edges[following(j)], corners[i]);
    if (side[0][j] <= 0 && side[1][j] <= 0 && side[2][j] <= 0) return false;
  }
  return true;
}

bool within(const std::array<int, 3>& side) {
  return side[0] >= 0 && side[1] >= 0 && side[2] >= 0;
}

// Where two edges cross that are known to do so.
Point crossing(Point a, Point b, Point c, Point d) {
  const double before = cross(d - c, a - c), after = cross(d - c, b - c);
  const double part = before / (before - after);
  return a + (std::isfinite(part) ? std::clamp(part, 0.0, 1.0) : 0.5) * (b - a);
}

// Grows with the angle of a direction, from 0 to 4.
double turn_of(Point p) {
  const double size = std::abs(p.x) + std::abs(p.y);
  if (size == 0.0) return 0.0;
  const double t = p.y / size;
  return p.x < 0.0 ? 2.0 - t : p.y < 0.0 ? 4.0 + t : t;
}

// Corners of a convex polygon in any order. At most 12: corners of both triangles and crossings.
class Polygon {
 public:
  void add(Point p) { corners_[size_++] = p; }

  Intersection measure() {
    if (size_ < 3) return {};
    const Point origin = corners_[0];
    Point middle;
    for (std::size_t i = 0; i < size_; ++i) {
      corners_[i] = corners_[i] - origin;
      middle = middle + (1.0 / static_cast<double>(size_)) * corners_[i];
    }
    std::array<std::pair<double, std::size_t>, most> order;
    for (std::size_t i = 0; i < size_; ++i) order[i] = {turn_of(corners_[i] - middle), i};
    std::sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(size_));
    double twice = 0.0;
    Point moment;
    for (std::size_t i = 0; i < size_; ++i) {
      const Point a = corners_[order[i].second] - middle;
      const Point b = corners_[order[i + 1 == size_ ? 0 : i + 1].second] - middle;
      const double piece = cross(a, b);
      twice += piece;
      moment = moment + piece * (a + b);
    }
    if (!(twice > 0.0)) return {};
    return {0.5 * twice, origin + middle + (1.0 / (3.0 * twice)) * moment};
  }

 private:
  static constexpr std::size_t most = 15;
  std::array<Point, most> corners_;
  std::size_t size_ = 0;
};

}  // namespace

Intersection intersect(const Corners& a, const Corners& b) {
  Sides3 of_a, of_b;
  if (!find_sides(a, b, of_a) || !find_sides(b, a, of_b)) return {};
  Polygon polygon;
  for (std::size_t i = 0; i < 3; ++i) {
    if (within(of_a[i])) polygon.add(a[i]);
    if (within(of_b[i])) polygon.add(b[i]);
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t k = following(i), l = following(j);
      if (of_a[i][j] * of_a[k][j] < 0 && of_b[j][i] * of_b[l][i] < 0)
        polygon.add(crossing(a[i], a[k], b[j], b[l]));
    }
  }
  return polygon.measure();
}

Point nearest_on_edges(const Corners& t, Point p) {
  Point best = t[0];
  for (std::size_t i = 0; i < 3; ++i) {
    const Point a = t[i], along = t[following(i)] - a;
    const double length = dot(along, along);
    const Point q = length > 0.0 ? a + std::clamp(dot(p - a, along) / length, 0.0, 1.0) * along : a;
    if (squared_distance(p, q) < squared_distance(p, best)) best = q;
  }
  return best;
}

}  // namespace remodel
