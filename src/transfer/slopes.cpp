#include "transfer/slopes.h"

#include <algorithm>

namespace remodel {

Neighbours::Neighbours(const PatchSide& side) : side_(side), start_(side.points.size() + 1, 0) {
  for (const PatchSide::Triangle& t : side.triangles)
    for (const std::uint32_t v : t.corners) ++start_[v + 1];
  for (std::size_t v = 1; v < start_.size(); ++v) start_[v] += start_[v - 1];
  of_vertex_.resize(start_.back());
  std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
  for (std::uint32_t t = 0; t < side.triangles.size(); ++t)
    for (const std::uint32_t v : side.triangles[t].corners) of_vertex_[next[v]++] = t;
}

const std::vector<std::uint32_t>& Neighbours::around(std::uint32_t triangle) const {
  found_.clear();
  for (const std::uint32_t v : side_.triangles[triangle].corners)
    for (std::uint32_t i = start_[v]; i < start_[v + 1]; ++i)
      if (of_vertex_[i] != triangle) found_.push_back(of_vertex_[i]);
  std::sort(found_.begin(), found_.end());
  found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
  return found_;
}

std::vector<Point> slope_weights(const PatchSide& side, std::uint32_t triangle,
                                 const std::vector<std::uint32_t>& around) {
  const Point here = centroid_of(side.corners(triangle));
  std::vector<Point> weights;
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (const std::uint32_t t : around) {
    const Point d = centroid_of(side.corners(t)) - here;
    weights.push_back((1.0 / dot(d, d)) * d);  // nearer ones count for more
    xx += d.x * weights.back().x, xy += d.x * weights.back().y, yy += d.y * weights.back().y;
  }
  // The matrix has the trace of as many as there are neighbours; its determinant is 0 where they are in line.
  const double determinant = xx * yy - xy * xy;
  if (!(determinant > 1e-12 * (xx + yy) * (xx + yy))) return std::vector<Point>(around.size());
  for (Point& w : weights) w = {(yy * w.x - xy * w.y) / determinant, (xx * w.y - xy * w.x) / determinant};
  return weights;
}

}  // namespace remodel
