// Where the chord of an outline lies.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "airfoil_rows.h"
#include "remodel/domain.h"

namespace remodel {
namespace {

// The trailing edge straight behind the foremost point, up to the digits of files, in chords.
constexpr double straight_behind = 1e-5;
// How much nearer to the trailing edge the ends of the nose's arc are, the middle of which is the nose.
constexpr double arc_depth = 1e-6;
constexpr int nose_samples = 32;  // a side of the polygon

// The foremost of all points, the middle one of a flat nose.
std::size_t foremost(const AirfoilRowList& rows) {
  const auto by_x = [](const AirfoilRow& a, const AirfoilRow& b) { return a.point.x < b.point.x; };
  const auto first = std::min_element(rows.begin(), rows.end(), by_x);
  auto last = first;
  while (last + 1 != rows.end() && (last + 1)->point.x == first->point.x) ++last;
  return static_cast<std::size_t>((first - rows.begin() + (last - rows.begin())) / 2);
}

// The distance from the trailing edge along a smooth curve through the points.
class NoseArc {
 public:
  NoseArc(const AirfoilRowList& rows, Point tail) : tail_(tail), spline_(spline_of(rows)), shape_(spline_) {
    double largest = 0.0;
    for (const AirfoilRow& row : rows) largest = std::max(largest, distance(row.point, tail));
    for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
      const double d = std::max(distance(rows[i].point, tail), distance(rows[i + 1].point, tail));
      if (d < 0.95 * largest) continue;
      const double from = spline_.knots[i], step = (spline_.knots[i + 1] - from) / nose_samples;
      for (int k = 0; k <= nose_samples; ++k) parameters_.push_back(from + k * step);
    }
  }

  // The middle of what is farthest, within the depth of the arc: the same for a curve and its mirror image,
  // also where that has two farthest points.
  double nose() const {
    double peak = parameters_.front();
    for (const double t : parameters_)
      if (at(t) > at(peak)) peak = t;
    peak = refined(peak);
    const double least = at(peak) * (1.0 - arc_depth);
    double first = peak, last = peak;
    for (const double t : parameters_) {
      if (at(t) < least) continue;
      first = std::min(first, t);
      last = std::max(last, t);
    }
    return 0.5 * (end_of_arc(first, least, -1.0) + end_of_arc(last, least, 1.0));
  }
  Point point(double t) const { return point_at(shape_, t); }
  const std::vector<double>& knots() const { return spline_.knots; }

 private:
  static Spline spline_of(const AirfoilRowList& rows) {
    std::vector<Point> points;
    for (const AirfoilRow& row : rows) points.push_back(row.point);
    return spline_through(std::move(points), SplineEnds::corner);
  }
  double at(double t) const { return distance(point(t), tail_); }
  double step_at(double t) const {
    const auto next = std::upper_bound(spline_.knots.begin() + 1, spline_.knots.end() - 1, t);
    return std::max(*next - *(next - 1),
                    next == spline_.knots.begin() + 1 ? 0.0 : *(next - 1) - *(next - 2)) /
           nose_samples;
  }
  // Of the largest sample, the largest value beside it.
  double refined(double t) const {
    double low = std::max(0.0, t - step_at(t)), high = std::min(1.0, t + step_at(t));
    for (int i = 0; i < 60; ++i) {
      const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
      (at(a) < at(b) ? low : high) = at(a) < at(b) ? a : b;
    }
    return at(0.5 * (low + high)) > at(t) ? 0.5 * (low + high) : t;
  }
  // Where the distance falls below the least, from a place where it does not.
  double end_of_arc(double inside, double least, double sign) const {
    double outside = inside;
    while (at(outside) >= least && outside > 0.0 && outside < 1.0)
      outside = std::clamp(outside + sign * step_at(outside), 0.0, 1.0);
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (inside + outside);
      (at(middle) >= least ? inside : outside) = middle;
    }
    return inside;
  }

  Point tail_;
  Spline spline_;
  Shape shape_;
  std::vector<double> parameters_;
};

AirfoilNose on_point(const AirfoilRowList& rows, std::size_t index) {
  AirfoilNose nose{.frame = {}, .before = index, .after = index};
  nose.frame.nose = rows[index].point;
  return nose;
}

}  // namespace

AirfoilNose foremost_nose(const AirfoilRowList& rows) {
  const Point tail = 0.5 * (rows.front().point + rows.back().point);
  AirfoilNose nose = on_point(rows, foremost(rows));
  nose.frame.chord = tail.x - nose.frame.nose.x;
  nose.frame.shear = (tail.y - nose.frame.nose.y) / nose.frame.chord;
  return nose;
}

AirfoilNose nose_of(const AirfoilRowList& rows) {
  AirfoilNose drawn = foremost_nose(rows);
  if (drawn.frame.chord > 0.0 && std::abs(drawn.frame.shear) <= straight_behind) return drawn;
  const Point tail = 0.5 * (rows.front().point + rows.back().point);
  const NoseArc arc(rows, tail);
  const double t = arc.nose();
  const auto& knots = arc.knots();
  const auto next = std::upper_bound(knots.begin() + 1, knots.end() - 1, t);
  const std::size_t after = static_cast<std::size_t>(next - knots.begin());
  AirfoilNose nose{.frame = {}, .before = after - 1, .after = after};
  nose.frame.nose = arc.point(t);
  const double size = distance(nose.frame.nose, tail);
  for (const std::size_t i : {after - 1, after})
    if (distance(rows[i].point, nose.frame.nose) <= 1e-9 * size) nose = on_point(rows, i);
  nose.frame.chord = distance(nose.frame.nose, tail);
  nose.frame.axis = (1.0 / nose.frame.chord) * (tail - nose.frame.nose);
  return nose;
}

Point in_frame(const AirfoilFrame& frame, Point p) {
  const Point q = p - frame.nose;
  const double x = dot(frame.axis, q) / frame.chord;
  return {x, cross(frame.axis, q) / frame.chord - x * frame.shear};
}

double AirfoilFrame::incidence_deg() const {
  const double degrees = -std::atan2(axis.y, axis.x) * (180.0 / std::numbers::pi);
  return std::round(degrees * 1e9) * 1e-9;  // the same number whatever the C library's last bits
}

}  // namespace remodel
