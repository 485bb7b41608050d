#include "step/lanes.h"

#include <algorithm>

#include "geometry/vector_clones.h"

namespace remodel {

namespace {

REMODEL_VECTOR_CLONES
void judge_rows(Lanes::Rows& r, QualityBounds bounds) {
  for (std::size_t i = 0; i < Lanes::count; ++i) {
    const Point a{r.ax[i], r.ay[i]}, b{r.bx[i], r.by[i]}, c{r.cx[i], r.cy[i]};
    const Point e1 = b - a, e2 = c - a;
    const double l1 = dot(e1, e1), l2 = dot(e2, e2);
    const Circle circle = certified_circle(a, e1, e2, l1, l2);
    const double shortest = std::min(std::min(l1, l2), squared_distance(b, c));
    const double largest = largest_squared_radius(shortest, r.scales[i], bounds);
    r.centre_x[i] = circle.centre.x;
    r.centre_y[i] = circle.centre.y;
    r.inside[i] = circle.inside;
    r.outside[i] = circle.outside;
    r.spare[i] = largest - circle.squared_radius();
  }
}

}  // namespace

void Lanes::judge(const QualityBounds& bounds) {
  judge_rows(rows_, bounds);
}

}  // namespace remodel
