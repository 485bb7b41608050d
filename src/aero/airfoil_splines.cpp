// Airfoils of a domain as splines, whose points a deformation can move.

#include <algorithm>

#include "remodel/deformation.h"

namespace remodel {
namespace {

// Through the stations, and through points between them where these are few.
Curve spline_of(const Curve& curve) {
  constexpr std::size_t least_points = 200;
  const auto& airfoil = std::get<CstAirfoil>(curve.shape);
  const std::size_t stations = curve.parameters.size(), pieces = (least_points + stations - 1) / stations;
  std::vector<Point> points;
  for (std::size_t i = 0; i < stations; ++i) {
    const double from = curve.parameters[i], to = i + 1 < stations ? curve.parameters[i + 1] : 1.0;
    for (std::size_t k = 0; k < pieces; ++k)
      points.push_back(airfoil.at(from + (to - from) * static_cast<double>(k) / static_cast<double>(pieces)));
  }
  points.push_back(airfoil.at(1.0));
  const Spline spline = spline_through(std::move(points), SplineEnds::corner);
  std::vector<double> parameters;
  for (std::size_t i = 0; i < stations; ++i) parameters.push_back(spline.knots[i * pieces]);
  return {.name = curve.name, .shape = spline, .parameters = Parameters{std::move(parameters)}};
}

}  // namespace

bool splines_for_airfoils(Domain& domain, const std::string& name) {
  bool any = false;
  for (Loop& loop : domain.loops)
    for (Curve& curve : loop.curves)
      if (curve.name == name && std::holds_alternative<CstAirfoil>(curve.shape))
        curve = spline_of(curve), any = true;
  return any;
}

}  // namespace remodel
