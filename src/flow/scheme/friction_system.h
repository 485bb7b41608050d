#pragma once

// A steady flow with friction, as equations: N = 4 unknowns a vertex for laminar flow, 5 with the turbulence
// model, and the augmented two of flow_system.h. Walls are strong: the rows of momentum at their vertices say
// that the gas stands still, and the momentum that they leave unbalanced is the force on the wall. Where
// walls have a temperature the rows of energy say that the gas there has it, and what they leave unbalanced
// is heat.

#include <array>
#include <span>
#include <vector>

#include "flow/scheme/block_system.h"
#include "flow/scheme/boundary_inputs.h"
#include "flow/scheme/friction_terms.h"

namespace remodel::flow {

// Forces on a wall's vertices, as coefficients.
struct WallForces {
  double lift = 0.0, drag = 0.0, moment = 0.0;
  double pressure_drag = 0.0;  // part of drag
};

template <std::size_t N>
class FrictionSystem final : public BlockSystem<N> {
 public:
  FrictionSystem(const FrictionMesh& mesh, const Stream& stream, const Viscosity& viscosity)
      : mesh_(mesh),
        dual_(mesh.dual()),
        stream_(stream),
        terms_{.viscosity = viscosity,
               .mach = stream.mach,
               .slopes = stream.slopes,
               .working_slopes = stream.working_slopes,
               .limiter = stream.limiter,
               .extent = stream.length} {
    // At rest on walls the stream's Mach number is the measure. Without any dissipation of the waves of
    // pressure searches do not converge; with a tenth of this they stall at 1e-5 around NACA 0012.
    terms_.fix.mach_squared = stream.mach * stream.mach;
  }

  const FlowMesh& mesh() const override { return dual_; }
  const FrictionMesh& friction_mesh() const { return mesh_; }
  const Stream& stream() const override { return stream_; }
  const FrictionTerms& terms() const { return terms_; }

  // Undisturbed flow that slows down towards walls within `thickness`, at constant total enthalpy.
  BlockState<N> start(double thickness) const;
  static constexpr double start_thickness = 0.01;  // in reference lengths
  BlockState<N> undisturbed() const override { return start(start_thickness * stream_.reference_length); }

  // The flux out of each dual cell. It is the residual once make_walls_strong() has replaced rows of walls.
  void unbalanced(const BlockState<N>& state, BlockVector<N>& out) const;
  void make_walls_strong(const BlockState<N>& state, BlockVector<N>& unbalanced) const;
  void residuals(const BlockState<N>& state, BlockVector<N>& of_vertices,
                 Augmented& augmented) const override;

  // The vertices that a row depends on: all of them, or those of the first-order scheme, one ring.
  enum class Order { first, whole };
  using BlockSystem<N>::pattern;
  BlockMatrix<N> pattern(std::vector<std::uint32_t> rows) const override {
    return pattern(rows, Order::whole);
  }
  BlockMatrix<N> pattern(std::vector<std::uint32_t> rows, Order order) const;
  void jacobian(const BlockState<N>& state, BlockMatrix<N>& matrix) const override;
  // Derivatives of all rows by the unknowns: of the whole scheme, and of that of first order.
  struct Jacobian {
    BlockMatrix<N> whole, first;
    BlockAugmentedRows<N> rows;  // of the augmented equations of the whole scheme
  };
  void jacobian(const BlockState<N>& state, Jacobian& result) const;
  std::array<BlockVector<N>, augmented_count> augmented_columns(const BlockState<N>& state) const override;
  BlockAugmentedRows<N> augmented_rows(const BlockState<N>& state) const override;

  // As FlowSystem's.
  std::vector<double> wave_speeds(const BlockState<N>& state) const;
  // Density, momentum, energy and density times the working variable; derivatives by the unknowns.
  static std::array<double, N> conserved_at(const std::array<double, N>& q);
  static SquareBlock<N> conserved_slope(const std::array<double, N>& q);

  // The derivative, at this state, of the sum over vertices of weight times *unbalanced* flux, for each row
  // of weights: by places, and by Mach and Reynolds number at fixed unknowns.
  std::vector<ShapeSlope> slopes_of_unbalanced(const BlockState<N>& state,
                                               std::span<const BlockVector<N>> weights) const;
  // A sum of coefficients, and what it follows.
  struct ForceSlope {
    BlockIncrement<N> by_unknowns;
    ShapeSlope shape;       // at fixed unknowns and fixed unbalanced flux
    BlockVector<N> weight;  // derivatives by the unbalanced flux
  };
  // The weighted sum of the coefficients of all walls (pressure_drag: weighted too).
  ForceSlope force_slope(const BlockState<N>& state, const WallForces& weight) const;

  // What enters by this patch.
  double mass_flow(const BlockState<N>& state, std::uint32_t patch) const;
  // patch: of this wall, no_index: of all.
  WallForces forces(const BlockState<N>& state, const BlockVector<N>& unbalanced,
                    std::uint32_t patch = no_index) const;
  // Whether the row says that the wall stands still, how warm it is, or what an image's unknowns are.
  bool is_replaced(std::size_t v, std::size_t k) const {
    return (mesh_.sticks(v) && is_strong(k)) || dual_.is_image(v);
  }
  // The force of friction on the vertex, by its unbalanced momentum: what it receives less the pressure.
  Point friction_force(const BlockVector<N>& unbalanced, std::size_t v) const {
    return {-unbalanced[v][1], -unbalanced[v][2]};
  }
  // The heat that the wall takes from the gas at the vertex, likewise.
  double heat(const BlockVector<N>& unbalanced, std::size_t v) const { return -unbalanced[v][3]; }

 private:
  using Row = std::array<double, N>;
  template <class T>
  BoundaryInputs<T> boundary_inputs(const BlockState<N>& state, const BoundaryEdge& edge,
                                    std::size_t half) const;
  Row step(const BlockVector<N>& q, std::size_t e, std::size_t side) const;
  template <class Visit>
  void for_each_dependence(Order order, Visit visit) const;
  // A matrix that is made, and which of its rows a vertex has: no_index, none.
  struct Rows {
    BlockMatrix<N>& matrix;
    Order order;
    std::vector<std::uint32_t> of;
  };
  // A face's flux, by reconstructed values of both sides and, for V = 2 N + 2, its normal; these values by
  // the unknown at both ends, the upwind difference, limited_part() and the limiter's width; and
  // limited_part() by the unknowns of both ends.
  template <std::size_t V>
  struct FaceDual {
    std::array<Dual<V>, N> flux;
    std::array<Dual<5>, N> reconstructed[2];
    Dual<2 * unknown_count> limited;
  };
  template <std::size_t V>
  FaceDual<V> face_dual(const BlockState<N>& state, std::size_t e, Order order) const;
  Rows rows_of_vertices(BlockMatrix<N>& matrix, Order order) const;
  // Derivatives of fluxes, before walls are strong.
  void add_fluxes(const BlockState<N>& state, std::span<Rows> all) const;
  void add_face_blocks(const BlockState<N>& state, Rows& rows) const;
  void add_triangle_blocks(const BlockState<N>& state, std::span<Rows> all) const;
  void add_source_blocks(const BlockState<N>& state, std::span<Rows> all) const;
  void add_boundary_blocks(const BlockState<N>& state, std::span<Rows> all) const;
  void make_walls_strong(BlockMatrix<N>& matrix) const;
  BlockMatrix<N> raw_rows_of_walls(const BlockState<N>& state) const;  // before walls are strong
  void add_face_slopes(const BlockState<N>& state, std::span<const BlockVector<N>> weights,
                       std::span<FlowMesh::Slopes> slopes, std::span<ShapeSlope> results) const;
  struct SourceSlope {
    double share = 0.0, turning = 0.0, distance = 0.0;
  };
  std::vector<SourceSlope> source_slopes(const BlockState<N>& state) const;
  void add_triangle_slopes(const BlockState<N>& state, std::span<const BlockVector<N>> weights,
                           std::span<ShapeSlope> results) const;
  void add_boundary_slopes(const BlockState<N>& state, const BlockVector<N>& weight, FlowMesh::Slopes& slopes,
                           ShapeSlope& result) const;
  void add_stream_slopes(const BlockState<N>& state, std::span<const BlockVector<N>> weights,
                         std::span<ShapeSlope> results) const;
  // raw: of raw_rows_of_walls().
  BlockAugmentedRows<N> augmented_rows(const BlockState<N>& state, const BlockMatrix<N>& raw) const;
  std::array<Row, 3> triangle_states(const BlockVector<N>& q, const CornerTriangle& triangle) const {
    return {q[triangle.corner[0]], q[triangle.corner[1]], q[triangle.corner[2]]};
  }
  std::array<bool, 3> turbulent_corners(const CornerTriangle& triangle) const {
    const auto& corner = triangle.corner;
    return {has_turbulence(corner[0]), has_turbulence(corner[1]), has_turbulence(corner[2])};
  }
  WallPlace<double> wall_place(std::size_t v) const { return {mesh_.distances()[v], mesh_.is_laminar(v)}; }
  bool has_turbulence(std::size_t v) const { return mesh_.distances()[v] > 0.0 && !dual_.is_image(v); }
  // The mean over what belongs to the vertex.
  double vorticity(const BlockVector<N>& q, std::size_t v) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < dual_.ring(v).size(); ++k) {
      const Row& there = q[dual_.ring(v)[k].vertex];
      const Point weight = mesh_.mean_gradient(v)[k];
      sum += weight.x * (there[2] - q[v][2]) - weight.y * (there[1] - q[v][1]);
    }
    return sum;
  }
  // Whether the k-th row of a wall's vertex is replaced: of energy by the wall's temperature, the others by
  // "this unknown is 0".
  bool is_strong(std::size_t k) const {
    return k == 1 || k == 2 || k == 4 || (k == 3 && stream_.wall_temperature);
  }
  // The derivative of such a row by the unknown z of its own vertex; all others are 0.
  double strong_slope(std::size_t k, std::size_t z) const {
    if (k == 3 && z == 0) return -*stream_.wall_temperature / gas_gamma;
    return k == z ? 1.0 : 0.0;
  }

  const FrictionMesh& mesh_;
  const FlowMesh& dual_;
  Stream stream_;
  FrictionTerms terms_;
};

template <std::size_t N>
template <class T>
BoundaryInputs<T> FrictionSystem<N>::boundary_inputs(const BlockState<N>& state, const BoundaryEdge& edge,
                                                     std::size_t half) const {
  const auto gas = [&](std::uint32_t v) { return FrictionTerms::gas(state.q[v]); };
  return boundary_inputs_of<T>(dual_, stream_, state.augmented, edge, half, gas);
}

}  // namespace remodel::flow
