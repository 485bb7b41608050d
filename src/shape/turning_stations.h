#pragma once

#include <vector>

#include "remodel/airfoil.h"

namespace remodel {

// Parameters of an airfoil's curve, from 0 on, symmetric where the airfoil is: on each surface the same
// number of intervals, of whose density a share follows the turning of the surface and the rest is uniform in
// t, which is cosine spacing. Cosine spacing alone goes around a nose of 8 % thickness in 120 points by six
// edges, which is too few for a suction peak. Weights of curvature beside arc length are how panel codes
// place their nodes (M. Drela, XFOIL, 1989). points is even, share from 0 on and below 1.
std::vector<double> turning_stations(const CstAirfoil& airfoil, int points, double share);

}  // namespace remodel
