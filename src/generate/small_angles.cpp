#include "generate/small_angles.h"

#include <algorithm>
#include <cmath>

namespace remodel {

namespace {

// The angle at b of the path a, b, c on its left side is below 60 degrees.
bool sharp_on_left(Point a, Point b, Point c) {
  const Point in = a - b, out = c - b;
  return cross(out, in) > 0.0 && dot(out, in) > 0.5 * std::sqrt(dot(in, in) * dot(out, out));
}

}  // namespace

SmallAngles::SmallAngles(const MeshData& mesh) : mesh_(mesh) {
  for (std::size_t loop = 0; loop < mesh.loop_heads.size(); ++loop) {
    const bool left = mesh.domain_on_left[loop];
    std::uint32_t k = mesh.loop_heads[loop];
    do {
      const Point p = mesh.point(mesh.at(k).previous), q = mesh.point(k), r = mesh.point(mesh.at(k).next);
      if (left ? sharp_on_left(p, q, r) : sharp_on_left(r, q, p)) corners_.push_back(mesh.at(k).vertex);
      k = mesh.at(k).next;
    } while (k != mesh.loop_heads[loop]);
  }
  std::sort(corners_.begin(), corners_.end());
}

bool SmallAngles::is_corner(VertexId v) const {
  return std::binary_search(corners_.begin(), corners_.end(), v);
}

bool SmallAngles::seditious(VertexId a, VertexId b) const {
  if (corners_.empty()) return false;
  const std::uint32_t ka = mesh_.triangulation[a].boundary, kb = mesh_.triangulation[b].boundary;
  if (ka == no_index || kb == no_index) return false;
  const auto corner_within = [&](std::uint32_t from,
                                 std::uint32_t to) {  // the one non-Steiner vertex between
    std::uint32_t k = mesh_.at(from).steiner ? mesh_.non_steiner_after(from) : mesh_.at(from).next;
    return is_corner(mesh_.at(k).vertex) &&
           (mesh_.at(to).steiner ? mesh_.non_steiner_before(to) == k : mesh_.at(to).previous == k);
  };
  const bool forward = corner_within(ka, kb);
  if (!forward && !corner_within(kb, ka)) return false;
  const std::uint32_t first = forward ? ka : kb;
  const Point corner =
      mesh_.point(mesh_.at(first).steiner ? mesh_.non_steiner_after(first) : mesh_.at(first).next);
  const double da = squared_distance(corner, mesh_.point(ka)), db = squared_distance(corner, mesh_.point(kb));
  return std::abs(da - db) <=
         1e-6 * (da + db);  // shells are hit to rounding; the next shell is four times away
}

double SmallAngles::shell_fraction(double length) {
  int exponent = 0;
  std::frexp(length * (2.0 / 3.0),
             &exponent);  // the power of two between a third and two thirds of the length
  return std::ldexp(0.5, exponent) / length;
}

}  // namespace remodel
