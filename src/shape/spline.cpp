#include <algorithm>
#include <cmath>

#include "remodel/domain.h"
#include "remodel/error.h"
#include "shape/shape_derivative.h"

namespace remodel {
namespace {

// A symmetric tridiagonal system, diagonally dominant: no pivoting. sub[i] couples rows i and i + 1.
void solve_tridiagonal(const std::vector<double>& sub, std::vector<double> diagonal,
                       std::vector<Point>& right) {
  const std::size_t n = right.size();
  for (std::size_t i = 1; i < n; ++i) {
    const double factor = sub[i - 1] / diagonal[i - 1];
    diagonal[i] -= factor * sub[i - 1];
    right[i] = right[i] - factor * right[i - 1];
  }
  for (std::size_t i = n; i-- > 0;) {
    if (i + 1 < n) right[i] = right[i] - sub[i] * right[i + 1];
    right[i] = (1.0 / diagonal[i]) * right[i];
  }
}

// The same with a coupling `corner` of the first and the last row (Sherman and Morrison).
void solve_cyclic(const std::vector<double>& sub, std::vector<double> diagonal, double corner,
                  std::vector<Point>& right) {
  const std::size_t n = right.size();
  const double gamma = -diagonal.front(), last_over = corner / gamma;
  diagonal.front() -= gamma;
  diagonal.back() -= corner * last_over;
  std::vector<Point> update(n);
  update.front().x = gamma;
  update.back().x = corner;
  solve_tridiagonal(sub, diagonal, right);
  solve_tridiagonal(sub, diagonal, update);
  const double scale = 1.0 / (1.0 + update.front().x + last_over * update.back().x);
  const Point along = scale * (right.front() + last_over * right.back());
  for (std::size_t i = 0; i < n; ++i) right[i] = right[i] - update[i].x * along;
}

// The piece before point i of n; of a closed spline the last before the first.
std::size_t row_before(std::size_t i, std::size_t n) {
  return i == 0 ? n - 2 : i - 1;
}

// Second derivatives for the right-hand sides of rows 0 (closed) or 1 (natural ends) to n - 2.
void solve_second(const std::vector<double>& h, bool closed, std::vector<Point> right,
                  std::vector<Point>& second) {
  const std::size_t n = h.size() + 1, first = closed ? 0 : 1;
  std::vector<double> diagonal, sub;
  for (std::size_t i = first; i + 1 < n; ++i) {
    diagonal.push_back(2.0 * (h[row_before(i, n)] + h[i]));
    sub.push_back(h[i]);
  }
  if (closed)
    solve_cyclic(sub, diagonal, h[n - 2], right);
  else
    solve_tridiagonal(sub, diagonal, right);
  std::copy(right.begin(), right.end(), second.begin() + static_cast<std::ptrdiff_t>(first));
  if (closed) second.back() = second.front();
}

void require_points(const std::vector<Point>& points) {
  const bool closed = points.size() > 1 && points.front() == points.back();
  const auto refuse = [](const std::string& problem) { throw Error(ErrorCode::argument, "spline", problem); };
  if (points.size() < 2 || (closed && points.size() < 4))
    refuse("found " + std::to_string(points.size()) +
           " points, expected at least 2, or 4 where it is closed");
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!std::isfinite(points[i].x) || !std::isfinite(points[i].y))
      refuse("point " + std::to_string(i) + " is not finite");
    if (i > 0 && points[i] == points[i - 1])
      refuse("found point " + std::to_string(i) + " twice in a row, expected different points");
  }
}

// Lengths of the polygon up to each point, over the whole.
std::vector<double> chord_knots(const std::vector<Point>& points) {
  std::vector<double> knots{0.0};
  for (std::size_t i = 1; i < points.size(); ++i)
    knots.push_back(knots.back() + std::sqrt(squared_distance(points[i - 1], points[i])));
  const double length = knots.back();
  for (double& knot : knots) knot /= length;
  knots.back() = 1.0;
  return knots;
}

}  // namespace

// The second derivatives M satisfy, with h the knot distances and s the slopes of the polygon's sides,
// h[i-1] M[i-1] + 2 (h[i-1] + h[i]) M[i] + h[i] M[i+1] = 6 (s[i] - s[i-1]).
Spline spline_through(std::vector<Point> points, SplineEnds ends) {
  require_points(points);
  Spline spline{.points = std::move(points), .knots = {}, .second = {}};
  const bool meets = spline.points.front() == spline.points.back();
  spline.corner = meets && ends == SplineEnds::corner;
  spline.knots = chord_knots(spline.points);
  const std::size_t n = spline.points.size();
  std::vector<double> h;
  std::vector<Point> slope;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    h.push_back(spline.knots[i + 1] - spline.knots[i]);
    slope.push_back((1.0 / h[i]) * (spline.points[i + 1] - spline.points[i]));
  }
  spline.second.assign(n, {});
  const bool closed = meets && !spline.corner;
  const std::size_t first = closed ? 0 : 1;  // rows first ... n - 2
  if (n - 1 <= first) return spline;
  std::vector<Point> right;
  for (std::size_t i = first; i + 1 < n; ++i) right.push_back(6.0 * (slope[i] - slope[row_before(i, n)]));
  solve_second(h, closed, std::move(right), spline.second);
  return spline;
}

// The system of spline_through(), differentiated: A dM = dr - dA M.
SplineTangent spline_tangent(const Spline& spline, std::span<const Point> direction) {
  const std::vector<Point>& points = spline.points;
  const std::vector<Point>& m = spline.second;
  const std::size_t n = points.size();
  SplineTangent tangent{.knots = std::vector<double>(n, 0.0), .second = std::vector<Point>(n)};
  double whole = 0.0;
  for (std::size_t i = 1; i < n; ++i) {
    const Point side = points[i] - points[i - 1];
    const double length = std::sqrt(dot(side, side));
    whole += length;
    tangent.knots[i] = tangent.knots[i - 1] + dot(side, direction[i] - direction[i - 1]) / length;
  }
  const double longer = tangent.knots.back();
  for (std::size_t i = 0; i < n; ++i)
    tangent.knots[i] = (tangent.knots[i] - spline.knots[i] * longer) / whole;
  tangent.knots.back() = 0.0;

  std::vector<double> h, dh;
  std::vector<Point> dslope;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    h.push_back(spline.knots[i + 1] - spline.knots[i]);
    dh.push_back(tangent.knots[i + 1] - tangent.knots[i]);
    const Point slope = (1.0 / h[i]) * (points[i + 1] - points[i]);
    dslope.push_back((1.0 / h[i]) * (direction[i + 1] - direction[i] - dh[i] * slope));
  }
  const bool closed = points.front() == points.back() && !spline.corner;
  const std::size_t first = closed ? 0 : 1;
  if (n - 1 <= first) return tangent;
  std::vector<Point> right;
  for (std::size_t i = first; i + 1 < n; ++i) {
    const std::size_t before = row_before(i, n);
    right.push_back(6.0 * (dslope[i] - dslope[before]) - dh[before] * m[before] -
                    2.0 * (dh[before] + dh[i]) * m[i] - dh[i] * m[i + 1]);
  }
  solve_second(h, closed, std::move(right), tangent.second);
  return tangent;
}

}  // namespace remodel
