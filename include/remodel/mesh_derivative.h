#pragma once

// The derivative of a mesh by its design, at fixed connectivity. Boundary vertices keep their curve and
// parameter t. The interior does what the step does that the derivative is of:
//
//   step                                    interior   derivative
//   full adjustment (any strategy but       still      MeshDerivative(mesh)
//     reference, where the walls alone move)
//   Strategy::reference, while held         along      MeshDerivative(mesh, moving)
//
//   MeshDerivative derivative(mesh);
//   std::vector<double> gradient = derivative.vjp(flow.gradients().cd.points);   // by coefficients_of()

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "remodel/displacement.h"
#include "remodel/domain.h"
#include "remodel/error.h"
#include "remodel/mesh.h"
#include "remodel/remodel.h"

namespace remodel {

// The numbers that the points of a domain depend on at fixed parameters, loop by loop: of each of its curves,
// then of its placement (chord, rotation_deg, position.x, position.y). Of an airfoil: upper, lower, te_upper,
// te_lower. Of a line: from.x, from.y, to.x, to.y. Of a polyline or spline: x and y of each point, of a
// closed one without the last, which is the first. Of an arc: centre.x, centre.y, radius, start, sweep.
std::vector<double> coefficients_of(const Domain& domain);
// Their names: "airfoil.upper[0]", "flap.x".
std::vector<std::string> coefficient_names(const Domain& domain);
// True if `name` is that of a coefficient of a section's surface, upper or lower.
bool is_of_section(const std::string& name);
// The result is the same domain with other numbers. A closed spline's knots follow. Throws Error (argument)
// for another count than that of coefficients_of(), and as spline_through() does.
Domain with_coefficients(const Domain& domain, std::span<const double> coefficients);

class MeshDerivative {
 public:
  // At the design that the mesh has: by the coefficients of mesh.domain(), which may write loops that did not
  // move otherwise than the domain that was given (remodel()).
  explicit MeshDerivative(const Mesh& mesh);
  // The interior moves along with these loops of the domain, by their indices, as Strategy::reference moves
  // it (remodel/displacement.h): exact for the meshes of one reference. Throws Error (argument) for an index
  // that there is not.
  MeshDerivative(const Mesh& mesh, std::span<const std::size_t> moving);
  // This takes a mesh's frozen view and its domain. The interior is still.
  MeshDerivative(const FrozenMesh& frozen, const Domain& domain);

  std::size_t coefficients() const { return count_; }  // of coefficients_of()
  std::size_t points() const { return points_; }       // of the frozen mesh
  // How the points of the frozen mesh move with the coefficients in this direction. Throws Error (argument)
  // for another size, as vjp() does.
  std::vector<Point> jvp(std::span<const double> direction) const;
  // Transposed: derivatives by points to derivatives by coefficients.
  std::vector<double> vjp(std::span<const Point> by_points) const;

 private:
  struct Piece {  // the vertices on one curve
    std::size_t loop = 0;
    std::size_t first = 0;      // of the curve's coefficients
    std::size_t placement = 0;  // first of the loop's placement
    std::vector<double> t;
    std::vector<std::uint32_t> point;
  };
  std::vector<Point> walls_jvp(std::span<const double> direction) const;

  Domain domain_;
  std::vector<Piece> pieces_;
  std::size_t count_ = 0, points_ = 0;
  std::optional<InteriorDisplacement> interior_;  // none: still
};

// The mesh cannot follow to another design with the connectivity that it has.
class TopologyChanged : public Error {
 public:
  using Error::Error;
};
// A copy of the mesh at another design, its connectivity, ids and parameters the same: valid, Delaunay, of
// the quality promised; of a held mesh the morph of its reference, with the slack that it has. Throws
// TopologyChanged where there is no such mesh, and Error (geometry) as remodel() does.
Mesh mesh_at(const Mesh& mesh, const Domain& design);
// This goes the way of a strategy, as the table above has it. With Strategy::reference the interior moves
// along, whether the mesh is held or a reference itself. With any other one it stays where it is.
Mesh mesh_at(const Mesh& mesh, const Domain& design, Strategy strategy);

}  // namespace remodel
