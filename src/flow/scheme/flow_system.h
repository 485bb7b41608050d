#pragma once

// The steady Euler equations on a median dual: residual, exact Jacobian, forces. Unknowns are density,
// velocity and pressure at each vertex, and two numbers more, which augmented the system: the lift
// coefficient that the vortex in the far field belongs to, and the angle of attack.
//
// The scheme: Roe's flux between dual cells, of values reconstructed along each edge (gas.h:
// half_step) from gradients that are the area-weighted means of those of the triangles around a vertex, and
// moved towards the mean of fluxes linearised at the vertices (linearised_above). Weak boundary conditions,
// with weights 5/6 and 1/6 of an edge's ends: the pressure's flux at walls (H. Nishikawa, J. Comput. Phys.
// 281 (2015), section 3), Roe's flux against the stream far away.

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "flow/physics/euler.h"
#include "flow/scheme/flow_mesh.h"

namespace remodel::flow {

// Weights of a boundary edge's ends in the state of the half that belongs to the first, and in the middle of
// that half.
inline constexpr double near_weight = 5.0 / 6.0, far_weight = 1.0 / 6.0;
inline constexpr double near_place = 0.75, far_place = 0.25;
// A reconstructed density or pressure keeps away from vacuum: below `bent_part` of the vertex's it is bent
// towards `least_part` of it, by a hyperbola that leaves the derivative continuous.
inline constexpr double bent_part = 0.3, least_part = 0.1;
inline constexpr std::size_t positive[] = {0, 3};  // density and pressure among the unknowns of a vertex
struct Bent {
  double value;
  double slope = 1.0, own = 1.0;  // by the step of the reconstruction, by the vertex's value
};
inline Bent bent(double reconstructed, double vertex) {
  if (!(reconstructed < bent_part * vertex)) return {reconstructed};
  constexpr double s = bent_part - least_part;
  const double part = reconstructed / vertex, ratio = s / (s + bent_part - part);
  const double to = least_part + s * ratio, slope = ratio * ratio;
  return {to * vertex, slope, to - slope * (part - 1.0)};
}

inline Unknowns<double> weighted(const Unknowns<double>& here, const Unknowns<double>& there) {
  Unknowns<double> mean;
  for (std::size_t k = 0; k < 4; ++k) mean[k] = near_weight * here[k] + far_weight * there[k];
  return mean;
}

// The ends of an edge as reconstruction sees them: inner, or one on a wall and one beside it. The gradient at
// a wall is one-sided, off by one order, and the entropy that it makes stays on the wall. Between a wall and
// the inside the upwind difference at the wall is therefore extrapolated, 2 * central - the one at the other
// end, so that both ends' values meet. Such edges cross the flow and are not limited: limited there, lift
// loses more by the clipped suction peak than it gains.
enum class EdgeEnd { inner, wall, beside_wall };
inline EdgeEnd end_of(const FlowMesh& mesh, std::uint32_t here, std::uint32_t there) {
  if (mesh.on_wall(here) == mesh.on_wall(there)) return EdgeEnd::inner;
  return mesh.on_wall(here) ? EdgeEnd::wall : EdgeEnd::beside_wall;
}
// Whose gradient the upwind difference is of.
inline std::uint32_t gradient_source(EdgeEnd end, std::uint32_t here, std::uint32_t there) {
  return end == EdgeEnd::wall ? there : here;
}
// From the value at the end to that at the middle, and what linear extrapolation is more.
template <class T>
struct Step {
  T step, more;
};
template <class T, class E>
Step<T> reconstruction_step(EdgeEnd end, const T& upwind, const T& central, const E& epsilon) {
  const T s = end == EdgeEnd::inner ? slope_limiter<T, E>(upwind, central, epsilon) : T(1.0);
  const T own = end == EdgeEnd::wall ? 2.0 * central - upwind : upwind;
  return {half_step<T>(s, own, central), more_of_step<T>(s, own, central)};
}
// The weight of an end's linearised flux: the gradient at a wall is none to linearise with.
inline double linear_weight(EdgeEnd end) {
  return end == EdgeEnd::inner ? 0.5 : end == EdgeEnd::wall ? 0.0 : 1.0;
}

// The pressure on the half of a wall's edge at `here`, i: exact to second order where pressure is linear and
// the curvature even. The half turns away from the edge (wall_bulge.h) with the pressure of its middle.
inline Point wall_force(const BoundaryEdge& edge, std::size_t i, double here, double there) {
  return (near_place * here + far_place * there) * edge.half[i] +
         (near_weight - near_place) * 0.5 * (here - there) * edge.normal;
}
// Its derivatives by both pressures.
inline std::array<Point, 2> wall_force_slopes(const BoundaryEdge& edge, std::size_t i) {
  const Point by_difference = (near_weight - near_place) * 0.5 * edge.normal;
  return {near_place * edge.half[i] + by_difference, far_place * edge.half[i] - by_difference};
}

struct State {
  std::vector<Unknowns<double>> q;           // per vertex
  std::array<double, 2> augmented = {0, 0};  // lift coefficient of the vortex; angle of attack, radians
};

// An inlet, or an outlet: what is given at it, in the solver's units.
struct Opening {
  std::string name;
  bool is_inlet = true;
  double total_pressure = 0.0, total_sound_square = 0.0;  // of an inlet
  double pressure = 0.0;                                  // of an outlet
};

struct Stream {
  double mach = 0.0;
  double alpha = 0.0;               // radians; the first guess where lift is given
  std::optional<double> lift = {};  // the lift coefficient that alpha is to be found for
  Point reference = {0.25, 0.0};    // the vortex, and the point that moments are about
  // What lift and moment are made with in here, and what the limiter compares edges with: the extent of the
  // walls. Flows do not depend on what coefficients are reported with, `reference_length`.
  double length = 1.0;
  double reference_length = 1.0;
  bool vortex = true;
  double limiter = 30.0;               // K: slopes of less than (K h / length)^(3/2) are not limited
  std::vector<Opening> openings = {};  // in the order of the mesh's
  // Instead of the stream: the state at points of the far field, for flows with known solutions.
  std::function<Unknowns<double>(Point)> prescribed = nullptr;
  // What is added to mass, momentum and energy in each dual cell, for flows made to order; empty: nothing.
  std::vector<std::array<double, 4>> source = {};
  // The part of each step of the reconstruction that is taken: 1 is the scheme, 0 the one of first order,
  // less than 1 a stage on the way to a flow. Slopes by the shape (euler_adjoint.cpp) are those of 1.
  double slopes = 1.0;
};

// What the coefficients that are reported are, over those of FlowSystem: a length over another.
inline double reported_length(const Stream& stream) {
  return stream.length / stream.reference_length;
}

struct Coefficients {
  double lift = 0.0, drag = 0.0, moment = 0.0;
};

// Derivatives by the vertices' coordinates and by the Mach number of the stream.
struct ShapeSlope {
  std::vector<Point> points;
  double mach = 0.0;
  double length = 0.0;  // of residuals, by the stream's, which the limiter has
};
// The same, with those by the vertices' pressures and by the angle of attack.
struct ForceSlope {
  ShapeSlope shape;
  std::vector<double> pressure;
  double alpha = 0.0;  // a radian
};

using Block = std::array<double, 16>;  // row-major; rows are equations, columns unknowns

// Rows of a block matrix: the vertices in `rows`, each with the vertices of its two rings and itself.
struct BlockRows {
  std::vector<std::uint32_t> rows;
  std::vector<std::uint32_t> start;   // rows.size() + 1
  std::vector<std::uint32_t> column;  // ascending in each row
  std::vector<Block> block;
};

class FlowSystem {
 public:
  FlowSystem(const FlowMesh& mesh, const Stream& stream) : mesh_(mesh), stream_(stream) {}

  const FlowMesh& mesh() const { return mesh_; }
  const Stream& stream() const { return stream_; }
  State uniform() const;

  // The flux out of each dual cell. It is not finite where a state is none.
  void residual(const State& state, std::vector<std::array<double, 4>>& out) const;
  // The equations of the augmented: lift of the state minus that of the vortex; alpha, or lift, minus the
  // given one.
  std::array<double, 2> augmented_residual(const State& state) const;

  // All vertices, or some, ascending.
  BlockRows pattern() const;
  BlockRows pattern(std::vector<std::uint32_t> rows) const;
  // Derivatives of the residuals of these rows by the unknowns of vertices.
  void jacobian(const State& state, BlockRows& matrix) const;
  // Derivatives of all residuals by the two unknowns of the augmented.
  std::array<std::vector<std::array<double, 4>>, 2> augmented_columns(const State& state) const;
  // Derivatives of the augmented's equations by the unknowns of vertices (by pressures on walls, that is) and
  // by its own.
  struct AugmentedRows {
    struct Entry {
      std::uint32_t vertex;
      double value;  // of the first equation, by the vertex's pressure
    };
    std::vector<Entry> lift;
    std::array<std::array<double, 2>, 2> corner;
  };
  AugmentedRows augmented_rows(const State& state) const;

  // Sum over dual faces of |speed| + sound, times length: what a time step is bounded by.
  std::vector<double> wave_speeds(const State& state) const;

  // With the stream's length.
  Coefficients coefficients(const State& state) const;
  Coefficients coefficients(const State& state, std::int32_t body) const;  // the part of one wall

  std::vector<double> mass_flows(const State& state) const;  // into the domain, through each opening

  // What follows is in euler_adjoint.cpp.
  // The derivative, at this state, of the sum over vertices of weight times residual, for each row of
  // weights: fluxes are differentiated once.
  std::vector<ShapeSlope> residual_slopes(const State& state,
                                          std::span<const std::vector<std::array<double, 4>>> weights) const;
  // The derivative of the sum of coefficients, each times its weight.
  ForceSlope force_slope(const State& state, const Coefficients& weight) const;

 private:
  struct Face;
  struct Linear;
  static Linear linearised(const Face& face, const Unknowns<double>& qa, const Unknowns<double>& qb,
                           Point normal);
  std::array<double, 4> difference(const State& state, std::size_t vertex, Point d) const;
  Face face(const State& state, const DualEdge& edge) const;
  double epsilon(Point d) const;
  Unknowns<double> far_state(const State& state, Point p) const;
  // Out of the domain through `half` of an edge that is no wall, `inside` being the state at it.
  template <class T>
  std::array<T, 4> open_flux(const BoundaryEdge& edge, const Unknowns<T>& inside, const State& state,
                             Point p) const;
  void add_boundary(const State& state, std::vector<std::array<double, 4>>& out) const;
  void add_boundary_blocks(const State& state, BlockRows& matrix,
                           std::span<const std::uint32_t> row_of) const;
  std::vector<Point> add_boundary_slopes(const State& state, const std::vector<std::array<double, 4>>& weight,
                                         ShapeSlope& result) const;
  template <class Visit>
  void for_each_wall_half(Visit visit) const;

  const FlowMesh& mesh_;
  Stream stream_;
};

}  // namespace remodel::flow
