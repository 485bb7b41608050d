#include "shape/shape_derivative.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "shape/turn.h"

namespace remodel {

namespace {

// The last point of a closed polygon is its first.
std::size_t free_points(const std::vector<Point>& points) {
  return points.size() > 1 && points.front() == points.back() ? points.size() - 1 : points.size();
}

std::vector<double> point_numbers(const std::vector<Point>& points) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < free_points(points); ++i)
    numbers.insert(numbers.end(), {points[i].x, points[i].y});
  return numbers;
}

std::vector<Point> points_of_numbers(std::span<const double> numbers, std::size_t size) {
  std::vector<Point> points;
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) points.push_back({numbers[i], numbers[i + 1]});
  if (points.size() < size) points.push_back(points.front());
  return points;
}

// The derivative of a point by one number.
struct Term {
  std::size_t number;
  Point slope;
};

// Curves of which a point depends on few numbers, or, as airfoils, on one row of them.
std::vector<Term> terms_at(const CstAirfoil& airfoil, double t) {
  const std::size_t n = airfoil.upper.size();
  std::vector<double> row(n);
  const CstStation station = cst_basis(t, airfoil.degree(), airfoil.e1, airfoil.e2, row);
  std::vector<Term> terms;
  for (std::size_t i = 0; i < n; ++i) terms.push_back({(station.upper ? 0 : n) + i, {0.0, row[i]}});
  terms.push_back({2 * n + (station.upper ? 0 : 1), {0.0, station.x}});
  return terms;
}

std::vector<Term> terms_at(const Line&, double t) {
  return {{0, {1.0 - t, 0.0}}, {1, {0.0, 1.0 - t}}, {2, {t, 0.0}}, {3, {0.0, t}}};
}

std::vector<Term> terms_at(const Polyline& line, double t) {
  const std::size_t pieces = line.points.size() - 1, free = free_points(line.points);
  const double along = t * static_cast<double>(pieces);
  const std::size_t i = std::min(static_cast<std::size_t>(along), pieces - 1);
  const std::size_t j = i + 1 < free ? i + 1 : 0;
  const double part = along - static_cast<double>(i);
  return {{2 * i, {1.0 - part, 0.0}},
          {2 * i + 1, {0.0, 1.0 - part}},
          {2 * j, {part, 0.0}},
          {2 * j + 1, {0.0, part}}};
}

std::vector<Term> terms_at(const Arc& arc, double t) {
  const Point out = direction((arc.start + arc.sweep * t) / (2.0 * M_PI));
  const Point along = {-arc.radius * out.y, arc.radius * out.x};
  return {{0, {1.0, 0.0}}, {1, {0.0, 1.0}}, {2, out}, {3, along}, {4, t * along}};
}

std::vector<Point> spline_jvp(const Spline& spline, std::span<const double> t,
                              std::span<const double> numbers) {
  const std::vector<Point> direction = points_of_numbers(numbers, spline.points.size());
  const SplineTangent tangent = spline_tangent(spline, direction);
  std::vector<Point> result;
  for (const double at : t) {
    const auto after = std::upper_bound(spline.knots.begin() + 1, spline.knots.end() - 1, at);
    const std::size_t j = static_cast<std::size_t>(after - spline.knots.begin()), i = j - 1;
    const double h = spline.knots[j] - spline.knots[i], dh = tangent.knots[j] - tangent.knots[i];
    const double a = (spline.knots[j] - at) / h, da = (tangent.knots[j] - a * dh) / h;
    const double b = (at - spline.knots[i]) / h, db = (-tangent.knots[i] - b * dh) / h;
    const double fa = (a * a * a - a) * h * h / 6.0, fb = (b * b * b - b) * h * h / 6.0;
    const double dfa = ((3.0 * a * a - 1.0) * da * h * h + 2.0 * (a * a * a - a) * h * dh) / 6.0;
    const double dfb = ((3.0 * b * b - 1.0) * db * h * h + 2.0 * (b * b * b - b) * h * dh) / 6.0;
    result.push_back(da * spline.points[i] + a * direction[i] + db * spline.points[j] + b * direction[j] +
                     dfa * spline.second[i] + fa * tangent.second[i] + dfb * spline.second[j] +
                     fb * tangent.second[j]);
  }
  return result;
}

}  // namespace

std::vector<double> numbers_of(const Shape& shape) {
  if (const auto* airfoil = std::get_if<CstAirfoil>(&shape)) {
    std::vector<double> numbers = airfoil->upper;
    numbers.insert(numbers.end(), airfoil->lower.begin(), airfoil->lower.end());
    numbers.insert(numbers.end(), {airfoil->te_upper, airfoil->te_lower});
    return numbers;
  }
  if (const auto* line = std::get_if<Line>(&shape))
    return {line->from.x, line->from.y, line->to.x, line->to.y};
  if (const auto* line = std::get_if<Polyline>(&shape)) return point_numbers(line->points);
  if (const auto* arc = std::get_if<Arc>(&shape))
    return {arc->centre.x, arc->centre.y, arc->radius, arc->start, arc->sweep};
  return point_numbers(std::get<Spline>(shape).points);
}

Shape with_numbers(const Shape& shape, std::span<const double> numbers) {
  if (const auto* old = std::get_if<CstAirfoil>(&shape)) {
    CstAirfoil airfoil = *old;
    const std::size_t n = airfoil.upper.size();
    std::copy_n(numbers.begin(), n, airfoil.upper.begin());
    std::copy_n(numbers.begin() + static_cast<std::ptrdiff_t>(n), n, airfoil.lower.begin());
    airfoil.te_upper = numbers[2 * n], airfoil.te_lower = numbers[2 * n + 1];
    return airfoil;
  }
  if (std::holds_alternative<Line>(shape)) return Line{{numbers[0], numbers[1]}, {numbers[2], numbers[3]}};
  if (const auto* line = std::get_if<Polyline>(&shape))
    return Polyline{points_of_numbers(numbers, line->points.size())};
  if (std::holds_alternative<Arc>(shape))
    return Arc{{numbers[0], numbers[1]}, numbers[2], numbers[3], numbers[4]};
  const Spline& spline = std::get<Spline>(shape);
  return spline_through(points_of_numbers(numbers, spline.points.size()),
                        spline.corner ? SplineEnds::corner : SplineEnds::smooth);
}

std::vector<Point> shape_jvp(const Shape& shape, std::span<const double> t,
                             std::span<const double> direction) {
  if (const auto* spline = std::get_if<Spline>(&shape)) return spline_jvp(*spline, t, direction);
  std::vector<Point> result;
  for (const double at : t) {
    Point sum = {};
    std::visit(
        [&](const auto& curve) {
          if constexpr (!std::is_same_v<std::decay_t<decltype(curve)>, Spline>)
            for (const Term& term : terms_at(curve, at)) sum = sum + direction[term.number] * term.slope;
        },
        shape);
    result.push_back(sum);
  }
  return result;
}

void shape_vjp(const Shape& shape, std::span<const double> t, std::span<const Point> by_points,
               std::span<double> by_numbers) {
  if (const auto* spline = std::get_if<Spline>(&shape)) {
    std::vector<double> unit(by_numbers.size(), 0.0);
    for (std::size_t i = 0; i < unit.size(); ++i) {
      unit[i] = 1.0;
      const std::vector<Point> moved = spline_jvp(*spline, t, unit);
      for (std::size_t k = 0; k < moved.size(); ++k) by_numbers[i] += dot(by_points[k], moved[k]);
      unit[i] = 0.0;
    }
    return;
  }
  for (std::size_t k = 0; k < t.size(); ++k)
    std::visit(
        [&](const auto& curve) {
          if constexpr (!std::is_same_v<std::decay_t<decltype(curve)>, Spline>)
            for (const Term& term : terms_at(curve, t[k]))
              by_numbers[term.number] += dot(by_points[k], term.slope);
        },
        shape);
}

}  // namespace remodel
