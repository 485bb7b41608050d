#pragma once

#include <algorithm>
#include <cstddef>

#include "mesh/mesh_data.h"

namespace remodel {

// Several triangles side by side: loops over the lanes compile to vector instructions.
class Lanes {
 public:
  static constexpr std::size_t count = 8;

  void load(std::size_t lane, const Vertex& a, const Vertex& b, const Vertex& c) {
    ax_[lane] = a.point.x, ay_[lane] = a.point.y;
    bx_[lane] = b.point.x, by_[lane] = b.point.y;
    cx_[lane] = c.point.x, cy_[lane] = c.point.y;
    scales_[lane] = a.length_scale + b.length_scale + c.length_scale;
  }
  // The same bits as certified_circle(a, b, c), and the same answer as is_good() for its radius.
  void judge(const QualityBounds& bounds) {
    for (std::size_t i = 0; i < count; ++i) {
      const Point a{ax_[i], ay_[i]}, b{bx_[i], by_[i]}, c{cx_[i], cy_[i]};
      const Point e1 = b - a, e2 = c - a;
      const double l1 = dot(e1, e1), l2 = dot(e2, e2);
      const Circle circle = certified_circle(a, e1, e2, l1, l2);
      const double shortest = std::min(std::min(l1, l2), squared_distance(b, c));
      const double largest = largest_squared_radius(shortest, scales_[i], bounds);
      centre_x_[i] = circle.centre.x, centre_y_[i] = circle.centre.y;
      inside_[i] = circle.inside, outside_[i] = circle.outside;
      spare_[i] = largest - circle.squared_radius();
    }
  }
  Circle circle(std::size_t lane) const {
    return {{centre_x_[lane], centre_y_[lane]}, inside_[lane], outside_[lane]};
  }
  bool good(std::size_t lane) const { return spare_[lane] >= 0.0; }  // uncertain ones: -infinity

 private:
  double ax_[count], ay_[count], bx_[count], by_[count], cx_[count], cy_[count], scales_[count];
  double centre_x_[count], centre_y_[count], inside_[count], outside_[count], spare_[count];
};

}  // namespace remodel
