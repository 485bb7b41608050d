#pragma once

// The displacement of a mesh's interior that goes with one of its walls: smooth, linear, local. It is what a
// step of Strategy::morph moves vertices by, and the derivative of that step at fixed connectivity.
//
//   const InteriorDisplacement field(mesh, moving);
//   std::vector<Point> moved = field.jvp(walls);             // walls first, the interior along with them
//   std::vector<Point> by_walls = field.vjp(by_points);      // transposed: derivatives by all points in
//
// The field is the inverse-distance mean of E. Luke, E. Collins, E. Blades, "A fast mesh deformation method
// using explicit interpolation", J. Comput. Phys. 231, 2012, in complex numbers, of edges instead of nodes:
//
//   u(x) = f(x) sum_e w_e (u_e + a_e (x - m_e)) / sum_e w_e,    w_e = L_e / |x - e|^4
//
// over all boundary edges e with midpoint m_e, length L_e and distance |x - e|; u_e is the midpoint's
// displacement, a_e the difference of the ends' displacements over their difference: where a wall turns or is
// scaled, what lies at it turns and is scaled likewise, so that angles stay. Departures from the paper: a_e
// is not reduced to a rotation, which keeps the field linear; edges far away are taken together, in a binary
// tree over each loop. The factor f = max(0, 1 - (d / R)^3)^2, with pi / (2 d^3) the sum of w_e over the
// walls that move, is zero beyond about R from them. Walls that stay are edges with u = a = 0.

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "remodel/frozen_mesh.h"
#include "remodel/mesh.h"
#include "remodel/point.h"

namespace remodel {

class InteriorDisplacement {
 public:
  // At the places that the mesh has now, or if it is held at those of its reference, by which steps of
  // Strategy::reference move it: then jvp() of what MeshDerivative::jvp() says of the walls is the derivative
  // of the whole mesh, and MeshDerivative::vjp() of vjp() its transpose. The mesh need not live on. `moving`:
  // the loops of its domain that move, by index. Throws Error (argument) for an index that there is not.
  InteriorDisplacement(const Mesh& mesh, std::span<const std::size_t> moving);
  // The mesh may be any, with layers on its walls too, whose cells then go along: not as they are made for
  // another design (LayeredMeshDerivative has that), but as meshes of other programs are warped. `moving` are
  // the names of boundaries that move; points that they share with others move with them. Throws Error
  // (argument) for a name that there is not.
  InteriorDisplacement(const FrozenMesh& mesh, std::span<const std::string> moving);
  ~InteriorDisplacement();
  InteriorDisplacement(InteriorDisplacement&&) noexcept;
  InteriorDisplacement& operator=(InteriorDisplacement&&) noexcept;

  std::size_t points() const;  // of the frozen mesh
  // One displacement for each point of the frozen mesh. `walls` has as many: the displacements of boundary
  // points stay as they are (those of walls that do not move have to be zero), those of others are not read.
  // Throws Error (argument) for another size, as vjp() does.
  std::vector<Point> jvp(std::span<const Point> walls) const;
  // The transpose of jvp(), zero at points of the interior.
  std::vector<Point> vjp(std::span<const Point> by_points) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace remodel
