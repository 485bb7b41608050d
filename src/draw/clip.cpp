#include "draw/clip.h"

#include <algorithm>

namespace remodel::draw_detail {

namespace {

// Keeps the side where inside(p) >= 0; inside is linear.
template <class Inside>
std::vector<Point> cut(const std::vector<Point>& polygon, Inside inside) {
  std::vector<Point> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point a = polygon[i];
    const Point b = polygon[(i + 1) % polygon.size()];
    const double side_a = inside(a);
    const double side_b = inside(b);
    if (side_a >= 0) kept.push_back(a);
    if ((side_a >= 0) != (side_b >= 0)) kept.push_back(a + side_a / (side_a - side_b) * (b - a));
  }
  return kept;
}

}  // namespace

std::vector<Point> clip_polygon(std::vector<Point> polygon, const Box& box) {
  polygon = cut(polygon, [&](Point p) { return p.x - box.low.x; });
  polygon = cut(polygon, [&](Point p) { return box.high.x - p.x; });
  polygon = cut(polygon, [&](Point p) { return p.y - box.low.y; });
  return cut(polygon, [&](Point p) { return box.high.y - p.y; });
}

std::optional<std::pair<Point, Point>> clip_segment(Point a, Point b, const Box& box) {
  const Point step = b - a;
  double enter = 0.0;
  double leave = 1.0;
  // Along one axis the segment is inside while along * t <= room.
  const auto narrow = [&](double along, double room) {
    if (along < 0) enter = std::max(enter, room / along);
    if (along > 0) leave = std::min(leave, room / along);
    return along != 0 || room >= 0;
  };
  const bool possible = narrow(-step.x, a.x - box.low.x) && narrow(step.x, box.high.x - a.x) &&
                        narrow(-step.y, a.y - box.low.y) && narrow(step.y, box.high.y - a.y);
  if (!possible || enter > leave) return std::nullopt;
  return std::pair{a + enter * step, a + leave * step};
}

}  // namespace remodel::draw_detail
