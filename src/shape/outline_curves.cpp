// The curves of an outline that is taken as it is given.

#include <algorithm>
#include <cmath>

#include "remodel/domain.h"
#include "remodel/error.h"

namespace remodel {
namespace {

// An outline bends at a point by more than this where it has a corner: 40 degrees.
constexpr double cosine_of_corner = 0.766;
// Around the nose, where few points bend as much without a corner; in distances from the trailing edge.
constexpr double nose_part = 0.9;
constexpr int crossing_samples = 6;  // a piece, to see whether a curve crosses itself

// Points, each once.
using Polygon = std::vector<Point>;

std::size_t after(std::size_t i, const Polygon& points) {
  return i + 1 == points.size() ? 0 : i + 1;
}

bool bends(const Polygon& points, std::size_t i) {
  const Point before = points[i == 0 ? points.size() - 1 : i - 1];
  const Point a = points[i] - before, b = points[after(i, points)] - points[i];
  return dot(a, b) < cosine_of_corner * std::sqrt(dot(a, a) * dot(b, b));
}

// Where the outline bends sharply, but for the nose where that is taken for round.
std::vector<std::size_t> corners_of(const Polygon& points, bool round_nose) {
  double farthest = 0.0;
  for (const Point p : points) farthest = std::max(farthest, squared_distance(p, points.front()));
  std::vector<std::size_t> corners;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool nose = squared_distance(points[i], points.front()) > nose_part * nose_part * farthest;
    if (bends(points, i) && !(round_nose && nose)) corners.push_back(i);
  }
  return corners;
}

Curve spline_curve(std::vector<Point> points, SplineEnds ends, const std::string& name) {
  Spline spline = spline_through(std::move(points), ends);
  Parameters parameters{std::vector<double>(spline.knots.begin(), spline.knots.end() - 1)};
  return {.name = name, .shape = std::move(spline), .parameters = std::move(parameters)};
}

// Splines from corner to corner, lines where there is no point between them.
std::vector<Curve> splines_of(const Polygon& points, const std::vector<std::size_t>& corners,
                              const std::string& name) {
  if (corners.empty()) {
    std::vector<Point> closed = points;
    closed.push_back(points.front());
    return {spline_curve(std::move(closed), SplineEnds::smooth, name)};
  }
  std::vector<Curve> curves;
  for (std::size_t c = 0; c < corners.size(); ++c) {
    const std::size_t end = corners[c + 1 == corners.size() ? 0 : c + 1];
    std::vector<Point> run{points[corners[c]]};
    for (std::size_t i = after(corners[c], points); i != end; i = after(i, points)) run.push_back(points[i]);
    run.push_back(points[end]);
    if (run.size() == 2)
      curves.push_back({.name = name, .shape = Line{run[0], run[1]}, .parameters = {0.0}});
    else
      curves.push_back(spline_curve(std::move(run), SplineEnds::corner, name));
  }
  return curves;
}

// Whether the curves, and not their points alone, keep off each other.
bool is_simple(const std::vector<Curve>& curves) {
  std::vector<Point> points;
  for (const Curve& curve : curves) {
    for (std::size_t i = 0; i < curve.parameters.size(); ++i) {
      const double from = curve.parameters[i];
      const double to = i + 1 < curve.parameters.size() ? curve.parameters[i + 1] : 1.0;
      for (int k = 0; k < crossing_samples; ++k)
        points.push_back(point_at(curve.shape, from + (to - from) * k / crossing_samples));
    }
  }
  points.push_back(points.front());
  const Parameters parameters = Parameters::uniform(points.size() - 1);
  const Curve sampled{.name = "outline", .shape = Polyline{std::move(points)}, .parameters = parameters};
  try {
    validate({.loops = {{.role = LoopRole::outer, .curves = {sampled}}}});
  } catch (const Error&) {
    return false;
  }
  return true;
}

std::vector<Curve> polylines_of(std::vector<Point> points, const std::string& name) {
  const Line base{points.back(), points.front()};
  std::vector<Curve> curves{
      {.name = name, .shape = Line{}, .parameters = Parameters::uniform(points.size() - 1)}};
  curves.front().shape = Polyline{std::move(points)};
  if (!(base.from == base.to)) curves.push_back({.name = name, .shape = base, .parameters = {0.0}});
  return curves;
}

}  // namespace

std::vector<Curve> outline_of(const std::vector<Point>& points, OutlineCurve curve, const std::string& name) {
  if (curve == OutlineCurve::polyline) return polylines_of(points, name);
  Polygon polygon = points;
  if (polygon.front() == polygon.back()) polygon.pop_back();
  std::vector<Curve> curves = splines_of(polygon, corners_of(polygon, true), name);
  if (is_simple(curves)) return curves;
  return splines_of(polygon, corners_of(polygon, false), name);
}

}  // namespace remodel
