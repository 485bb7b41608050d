#include "aero/stations_derivative.h"

#include "remodel/frozen_mesh.h"
#include "remodel/mesh_derivative.h"

namespace remodel {

// The stations are the points of a mesh, of which the derivative by the domain is known.
std::vector<double> derivative_by_numbers(const Domain& domain, std::span<const BoundaryStation> stations,
                                          std::span<const Point> by_points) {
  FrozenMesh mesh;
  for (const BoundaryStation& station : stations) {
    mesh.points.push_back(domain.at(station));
    mesh.curve.push_back(static_cast<std::int32_t>(station.curve));
    mesh.parameter.push_back(station.t);
  }
  return MeshDerivative(mesh, domain).vjp(by_points);
}

}  // namespace remodel
