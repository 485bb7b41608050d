#include "aero/stations_derivative.h"

#include "remodel/frozen_mesh.h"

namespace remodel {

// Of the points of a mesh the derivative by the domain is known.
MeshDerivative derivative_of_stations(const Domain& domain, std::span<const BoundaryStation> stations) {
  FrozenMesh mesh;
  for (const BoundaryStation& station : stations) {
    mesh.points.push_back(domain.at(station));
    mesh.curve.push_back(static_cast<std::int32_t>(station.curve));
    mesh.parameter.push_back(station.t);
  }
  return MeshDerivative(mesh, domain);
}

std::vector<double> derivative_by_numbers(const Domain& domain, std::span<const BoundaryStation> stations,
                                          std::span<const Point> by_points) {
  return derivative_of_stations(domain, stations).vjp(by_points);
}

}  // namespace remodel
