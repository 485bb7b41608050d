#include "triangulation/spokes.h"

#include <algorithm>
#include <cmath>

namespace remodel {

namespace {

REMODEL_VECTOR_CLONES
void compute_rows(Point p, const Point* __restrict edges, std::size_t vectors, double* __restrict x,
                  double* __restrict y, double* __restrict inside, double* __restrict outside,
                  double* __restrict shortest, double* __restrict length) {
  for (std::size_t k = 0; k < vectors * vector_lanes; ++k) {
    const Point e1 = edges[k], e2 = edges[k + 1];
    const double l1 = dot(e1, e1), l2 = dot(e2, e2);
    const Circle circle = certified_circle(p, e1, e2, l1, l2);
    x[k] = circle.centre.x;
    y[k] = circle.centre.y;
    inside[k] = circle.inside;
    outside[k] = circle.outside;
    shortest[k] = std::min(std::min(l1, l2), squared_distance(e1, e2));
    length[k] = std::sqrt(l1);
  }
}

}  // namespace

void Spokes::compute() {
  for (std::size_t k = size_; k < edges_.size(); ++k) edges_[k] = edges_[k - size_];
  double* rows[row_count];
  for (std::size_t r = 0; r < row_count; ++r) rows[r] = rows_.begin() + r * stride_;
  compute_rows(centre_, edges_.begin(), stride_ / vector_lanes, rows[x_row], rows[y_row], rows[inside_row],
               rows[outside_row], rows[shortest_row], rows[length_row]);
}

}  // namespace remodel
