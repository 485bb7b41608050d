#include "layer/ball.h"

#include <algorithm>
#include <utility>

namespace remodel {

WallBalls::WallBalls(std::vector<Point> samples) : samples_(std::move(samples)) {
  std::sort(samples_.begin(), samples_.end(), [](Point a, Point b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
}

double WallBalls::radius(Point p, Point n, double most) const {
  const double reach = 2.0 * most;
  const auto is_before = [](Point q, double x) { return q.x < x; };
  auto q = std::lower_bound(samples_.begin(), samples_.end(), p.x - reach, is_before);
  double least = most;
  for (; q != samples_.end() && q->x <= p.x + reach; ++q) {
    const double ahead = dot(*q - p, n);
    const double squared = squared_distance(p, *q);
    if (squared < 2.0 * least * ahead) least = squared / (2.0 * ahead);
  }
  return least;
}

}  // namespace remodel
