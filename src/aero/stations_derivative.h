#pragma once

// Derivatives of functions of a few stations of a domain.

#include <span>
#include <vector>

#include "remodel/domain.h"
#include "remodel/mesh_derivative.h"

namespace remodel {

// How these stations move with the numbers of the domain (coefficients_of(Domain)).
MeshDerivative derivative_of_stations(const Domain& domain, std::span<const BoundaryStation> stations);
// By the numbers of the domain (coefficients_of(Domain)), of those by the places of these stations.
std::vector<double> derivative_by_numbers(const Domain& domain, std::span<const BoundaryStation> stations,
                                          std::span<const Point> by_points);

}  // namespace remodel
