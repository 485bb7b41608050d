#include "new_airfoil.h"

#include <algorithm>

#include "remodel/error.h"
#include "remodel/import.h"

namespace remodel::app {
namespace {

bool closed_trailing_edge(const CstAirfoil& airfoil) {
  return airfoil.te_upper == airfoil.te_lower;
}

struct FoundAirfoil {
  CstAirfoil* airfoil = nullptr;
  std::string name = {};
  Placement placement = {};
};

FoundAirfoil find_airfoil(Domain& domain) {
  for (Loop& loop : domain.loops) {
    for (Curve& curve : loop.curves) {
      if (auto* airfoil = std::get_if<CstAirfoil>(&curve.shape)) return {airfoil, curve.name, loop.placement};
    }
  }
  return {};
}

// The domain of a generated mesh with another airfoil. If both trailing edges are closed, all other loops are
// kept; an open one is a curve of its own, so that the domain is built anew.
Domain generated_with_airfoil(const Domain& old, const CstAirfoil& airfoil, const std::string& file) {
  Domain domain = old;
  const FoundAirfoil place = find_airfoil(domain);
  if (place.airfoil == nullptr) {
    throw Error(
        ErrorCode::argument, file,
        "found a mesh without an airfoil of coefficients, expected one, or --boundary with the name of the "
        "loop to replace");
  }
  if (!closed_trailing_edge(*place.airfoil) || !closed_trailing_edge(airfoil)) {
    return airfoils_domain({{.name = place.name, .airfoil = airfoil, .placement = place.placement}},
                           discretisation_of(old));
  }
  *place.airfoil = airfoil;
  return domain;
}

bool generated_here(const StartMesh& start, const StartMeshOptions& options) {
  return !start.imported && !start.mesh.imported() && options.boundary.empty() && !options.points;
}

// Whether the same parameters are the same points: those of polylines and splines are counted by their
// points.
bool has_parameters_of(const Shape& a, const Shape& b) {
  if (a.index() != b.index()) return false;
  const auto count = [](const Shape& shape) {
    if (const auto* polyline = std::get_if<Polyline>(&shape)) return polyline->points.size();
    if (const auto* spline = std::get_if<Spline>(&shape)) return spline->points.size();
    return std::size_t{0};
  };
  return count(a) == count(b);
}

}  // namespace

AirfoilDomainOptions discretisation_of(const Domain& domain) {
  AirfoilDomainOptions options;
  for (std::size_t i = 0; i < domain.curve_count(); ++i) {
    const Curve& curve = domain.curve(i);
    const int points = static_cast<int>(curve.parameters.size());
    if (std::holds_alternative<CstAirfoil>(curve.shape)) options.points = points;
    if (const auto* circle = std::get_if<Arc>(&curve.shape)) {
      options.farfield_radius = circle->radius;
      options.farfield_centre = circle->centre;
      options.farfield_points = points;
    }
  }
  return options;
}

bool take_stations(Loop& loop, const Domain& before) {
  for (const Loop& old : before.loops) {
    const auto alike = [](const Curve& a, const Curve& b) {
      return a.name == b.name && has_parameters_of(a.shape, b.shape);
    };
    if (!std::equal(loop.curves.begin(), loop.curves.end(), old.curves.begin(), old.curves.end(), alike))
      continue;
    for (std::size_t c = 0; c < loop.curves.size(); ++c) loop.curves[c].parameters = old.curves[c].parameters;
    return true;
  }
  return false;
}

Domain with_new_airfoil(const StartMesh& start, const StartMeshOptions& options, const CstAirfoil& airfoil) {
  const Domain& old = start.mesh.domain();
  if (generated_here(start, options)) return generated_with_airfoil(old, airfoil, start.source);
  return with_airfoil(old, place_in(start, options), airfoil);
}

CstAirfoil present_airfoil(const StartMesh& start, const StartMeshOptions& options, int degree) {
  Domain domain = start.mesh.domain();
  if (generated_here(start, options))
    if (const CstAirfoil* own = find_airfoil(domain).airfoil) return *own;
  return fit_airfoil(domain, place_in(start, options), degree).airfoil;
}

}  // namespace remodel::app
