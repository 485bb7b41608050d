#pragma once

// Boundary layers of flows with friction: thicknesses along walls, from the columns of quadrilaterals there
// (remodel/layers.h). The speed in a layer is that of its vorticity,
//
//   u(y) = integral of the vorticity from the wall to y,
//
// which is constant outside of the layer, also where the outer flow is not: at the nose and in gaps. P.
// Spalart and J. Watmuff, J. Fluid Mech. 249 (1993), section 2. The edge of the layer is where u has 99 % of
// that constant.

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "remodel/flow.h"
#include "remodel/frozen_mesh.h"

namespace remodel {

struct BoundaryLayerStation {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::string wall;          // the boundary's name
  std::uint32_t vertex = 0;  // of the frozen mesh
  double arc = 0.0;          // along the wall from its first station, in units of the mesh
  double cf = 0.0, y_plus = 0.0;
  double ch = none;  // FlowFriction::ch; none where no heat passes
  // Lengths are in units of the mesh. None (not a number) where the column of quadrilaterals ends within the
  // boundary layer (u changes by more than 0.5 % over its last tenth), or there is none.
  double edge_speed = none;  // over the stream's speed
  double thickness = none;   // to where u has 99 % of the edge's
  // Integrals over y of 1 - (rho u) / (rho u)_edge, and of (rho u) / (rho u)_edge (1 - u / u_edge), to the
  // edge.
  double displacement_thickness = none, momentum_thickness = none;
  double shape_factor = none;  // the first over the second
};

// The stations of all walls that gas sticks to, in the order in which the domain's boundaries have them: the
// domain is to their left. Throws Error (argument) where the flow has no friction or is not one of this mesh.
std::vector<BoundaryLayerStation> boundary_layer(const FrozenMesh& mesh, const FlowResult& flow);

// A row for each station, with a header: wall, x, y, arc, cp, cf, y_plus, edge_speed, thickness,
// displacement_thickness, momentum_thickness, shape_factor, ch. What is not a number is empty. Numbers read
// as the same doubles.
std::string boundary_layer_table(const FrozenMesh& mesh, const FlowResult& flow);

// A point of a profile, which is a column of cells from the wall on.
struct BoundaryLayerPoint {
  double height = 0.0;           // from the wall, in units of the mesh
  double speed = 0.0;            // along the wall, positive as at the column's end, over the stream's speed
  double density = 0.0;          // over the stream's
  double temperature = 0.0;      // likewise
  double viscosity_ratio = 0.0;  // of turbulence over the molecular one; 0 in laminar flow
  // The height and the speed in units of the wall's viscosity and friction: u+ = y+ next to the wall, and
  // log(y+) / 0.41 + 5 farther out in a turbulent layer without a gradient of pressure.
  double y_plus = 0.0, u_plus = BoundaryLayerStation::none;
};

struct BoundaryLayerProfile {
  std::string wall;                        // the boundary's name
  double place = 0.0;                      // that was asked for
  std::uint32_t vertex = 0;                // of the frozen mesh: the station
  std::vector<BoundaryLayerPoint> points;  // none where no quadrilaterals stand on the wall
};

// The profiles at the stations nearest to these places, 0 to 1, parts of each connected wall's extent along x
// from its foremost point on: one for each side of a wall that has a station there. Foremost and rearmost
// points are of no side: the stations next to them are taken. Throws as boundary_layer() does.
std::vector<BoundaryLayerProfile> boundary_layer_profiles(const FrozenMesh& mesh, const FlowResult& flow,
                                                          const std::vector<double>& places);

// Profiles of this mesh as a table: a row for each point, with a header: wall, place, x and y of the station,
// height, speed, density, temperature, viscosity_ratio, y_plus, u_plus. Numbers read as the same doubles.
std::string boundary_layer_profile_table(const FrozenMesh& mesh,
                                         const std::vector<BoundaryLayerProfile>& profiles);

}  // namespace remodel
