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
    Domain anew = airfoils_domain({{.name = place.name, .airfoil = airfoil, .placement = place.placement}},
                                  discretisation_of(old));
    take_stations(anew.loops.front(), old);
    return anew;
  }
  *place.airfoil = airfoil;
  return domain;
}

bool generated_here(const StartMesh& start, const StartMeshOptions& options) {
  return !start.imported && !start.mesh.imported() && options.boundary.empty() && !options.points;
}

}  // namespace

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
