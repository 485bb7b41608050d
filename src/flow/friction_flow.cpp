#include "flow/friction_flow.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "base/stopwatch.h"
#include "flow/search/friction_search.h"
#include "flow/solution.h"

namespace remodel::flow {

namespace {

// The friction at a wall's vertices, which each have half of both edges there.
struct WallVertex {
  double length = 0.0;
  Point along;  // downstream
};
std::vector<WallVertex> wall_vertices_of(const FlowMesh& dual, Point stream) {
  std::vector<WallVertex> walls(dual.size());
  for (const BoundaryEdge& edge : dual.boundary()) {
    if (!dual.patch(edge).sticks()) continue;
    const Point d = dual.points()[edge.b] - dual.points()[edge.a];
    for (const std::uint32_t v : {edge.a, edge.b}) {
      walls[v].length += 0.5 * std::sqrt(dot(d, d));
      walls[v].along = walls[v].along + (dot(d, stream) < 0.0 ? -1.0 : 1.0) * d;
    }
  }
  for (WallVertex& wall : walls)
    if (const double size = std::sqrt(dot(wall.along, wall.along)); size > 0.0)
      wall.along = (1.0 / size) * wall.along;
  return walls;
}

template <std::size_t N>
FlowFriction friction_of(const FrictionSystem<N>& system, const FrictionState<N>& state,
                         const BlockVector<N>& unbalanced, double reynolds) {
  const FlowMesh& dual = system.mesh().dual();
  const Viscosity& viscosity = system.terms().viscosity;
  const double mach = system.stream().mach;
  FlowFriction friction;
  friction.reynolds = reynolds;
  friction.cf.assign(dual.size(), 0.0), friction.y_plus.assign(dual.size(), 0.0);
  const std::vector<WallVertex> walls =
      wall_vertices_of(dual, {std::cos(state.augmented[1]), std::sin(state.augmented[1])});
  for (std::uint32_t v = 0; v < dual.size(); ++v) {
    const Unknowns<double> q = FrictionTerms::gas(state.q[v]);
    const double molecular = viscosity.at(temperature(q));
    if constexpr (N == 5)
      friction.viscosity_ratio.push_back(SpalartAllmaras::turbulent_ratio(
          FrictionTerms::working_unit * viscosity.stream * q[0] * state.q[v][4] / molecular));
    if (!system.mesh().sticks(v) || walls[v].length == 0.0) continue;
    const double stress = dot(system.friction_force(unbalanced, v), walls[v].along) / walls[v].length;
    double height = std::numeric_limits<double>::infinity();
    for (const RingEntry& entry : dual.ring(v))
      if (!system.mesh().sticks(entry.vertex))
        height = std::min(height, system.mesh().distances()[entry.vertex]);
    friction.cf[v] = stress / (0.5 * mach * mach);
    if (std::isfinite(height))
      friction.y_plus[v] = std::sqrt(std::fabs(stress) * density(q)) * height / molecular;
    friction.y_plus_max = std::max(friction.y_plus_max, friction.y_plus[v]);
  }
  return friction;
}

// What has to be known about the cells at the wall.
std::vector<std::string> friction_warnings(const FrictionMesh& mesh, const FlowFriction& friction,
                                           FlowModel model, double largest_mach) {
  constexpr double wanted = 1.0, tolerated = 2.0;
  std::vector<std::string> warnings;
  if (model == FlowModel::sa && friction.y_plus_max > tolerated) {
    double height = std::numeric_limits<double>::infinity();
    for (const double d : mesh.distances())
      if (d > 0.0) height = std::min(height, d);
    char text[160];
    std::snprintf(
        text, sizeof text,
        "y+ of the cells at the wall is up to %.3g, expected about %.0f: cells that are %.2g high would do",
        friction.y_plus_max, wanted, height * wanted / friction.y_plus_max);
    warnings.push_back(text);
  }
  if (largest_mach > 1.0)
    warnings.push_back(
        "the flow is faster than sound in places: with friction this scheme has no limiter, and shocks are "
        "off");
  const auto is_quad = [](const Cell& cell) { return cell.corners() == 4; };
  if (std::none_of(mesh.dual().cells().begin(), mesh.dual().cells().end(), is_quad))
    warnings.push_back(
        "the mesh has no layer of quadrilaterals on its walls, which friction is not accurate without");
  return warnings;
}

template <std::size_t N>
FlowResult result_of(const FrictionSystem<N>& system, const FrictionState<N>& state,
                     const SearchRecord& record, FlowModel model, double reynolds) {
  FlowResult result;
  note_search(record, result);
  result.model = model;
  result.mach = system.stream().mach;
  result.alpha_deg = state.augmented[1] / one_degree;
  BlockVector<N> unbalanced;
  system.unbalanced(state, unbalanced);
  const double scale = reported_length(system.stream());
  const WallForces sum = system.forces(state, unbalanced);
  result.cl = scale * sum.lift, result.cd = scale * sum.drag, result.cm = scale * scale * sum.moment;
  const std::vector<Patch>& patches = system.mesh().dual().patches();
  for (std::uint32_t i = 0; i < patches.size(); ++i) {
    if (patches[i].open()) result.openings.push_back({patches[i].name, system.mass_flow(state, i)});
    if (!patches[i].solid()) continue;
    const WallForces part = system.forces(state, unbalanced, i);
    result.bodies.push_back(
        {patches[i].name, scale * part.lift, scale * part.drag, scale * scale * part.moment});
  }
  result.friction = friction_of(system, state, unbalanced, reynolds);
  result.friction->cd_pressure = scale * sum.pressure_drag;
  result.friction->cd_friction = scale * (sum.drag - sum.pressure_drag);
  for (const auto& q : state.q) {
    result.density.push_back(q[0]);
    result.velocity_x.push_back(q[1]), result.velocity_y.push_back(q[2]);
    result.pressure.push_back(q[3]);
  }
  if (result.converged())
    result.warnings = friction_warnings(system.mesh(), *result.friction, model, largest_mach(result));
  return result;
}

template <std::size_t N>
FlowResult found(const FrictionMesh& mesh, const Stream& stream, const Viscosity& viscosity,
                 const FlowConditions& conditions, const FlowOptions& options) {
  const FrictionSystem<N> system(mesh, stream, viscosity);
  SearchRecord record;
  FrictionSearch<N> search(system, options, record);
  FrictionState<N> state = system.start(FrictionPolicy::start_thickness * conditions.reference_length);
  search.run(state);
  return result_of(system, state, record, options.model, conditions.reynolds);
}

}  // namespace

FlowResult friction_flow(const FrozenMesh& mesh, const FlowConditions& conditions, const FlowOptions& options,
                         const std::string& source) {
  const Stopwatch watch;
  require_possible(conditions, options);
  const FlowMesh dual = dual_of(mesh, conditions, options, source);
  const FrictionMesh friction_mesh(dual);
  const Stream stream = stream_of(conditions, options, dual);
  const Viscosity viscosity = {.stream = conditions.mach * conditions.reference_length / conditions.reynolds,
                               .temperature = options.temperature_k};
  FlowResult result = options.model == FlowModel::sa
                          ? found<5>(friction_mesh, stream, viscosity, conditions, options)
                          : found<4>(friction_mesh, stream, viscosity, conditions, options);
  result.seconds = watch.seconds();
  return result;
}

}  // namespace remodel::flow
