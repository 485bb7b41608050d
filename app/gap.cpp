#include "gap.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "remodel/frozen_mesh.h"
#include "remodel/mesh_derivative.h"

namespace remodel::app {

namespace {

// A corner of one polygon, and the place on a side of the other that is nearest to it.
struct Nearest {
  double distance = std::numeric_limits<double>::infinity();
  std::size_t corner = 0, side = 0;  // the side begins at this corner of its polygon
  double along = 0.0;                // 0 to 1
  Point apart;                       // from the place to the corner
};

Nearest nearest(const std::vector<Point>& corners, const std::vector<Point>& sides) {
  Nearest best;
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t j = 0; j < sides.size(); ++j) {
      const Point from = sides[j], d = sides[(j + 1) % sides.size()] - from, to = corners[i] - from;
      const double along = std::clamp(dot(to, d) / dot(d, d), 0.0, 1.0);
      const Point apart = to - along * d;
      const double distance = std::sqrt(dot(apart, apart));
      if (distance < best.distance) best = {distance, i, j, along, apart};
    }
  return best;
}

}  // namespace

Gap gap_between(const Domain& domain, std::size_t loop, std::size_t other) {
  const std::vector<Point> first = domain.points(loop), second = domain.points(other);
  Nearest best = nearest(first, second);
  const Nearest reverse = nearest(second, first);
  if (reverse.distance < best.distance) {
    best = reverse;
    std::swap(loop, other);
  }
  // The three stations as the points of a mesh, of which the derivative by the domain is known.
  const std::vector<BoundaryStation> at = domain.stations(loop), along = domain.stations(other);
  FrozenMesh three;
  for (const BoundaryStation& station :
       {at[best.corner], along[best.side], along[(best.side + 1) % along.size()]}) {
    three.points.push_back(domain.at(station));
    three.curve.push_back(static_cast<std::int32_t>(station.curve));
    three.parameter.push_back(station.t);
  }
  const Point by_corner = (1.0 / best.distance) * best.apart;
  const Point by_points[] = {by_corner, (best.along - 1.0) * by_corner, -best.along * by_corner};
  return {best.distance, MeshDerivative(three, domain).vjp(by_points)};
}

}  // namespace remodel::app
