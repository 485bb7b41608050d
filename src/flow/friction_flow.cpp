#include "flow/friction_flow.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "base/stopwatch.h"
#include "flow/flow_warnings.h"
#include "flow/friction_warnings.h"
#include "flow/search/chord.h"
#include "flow/solution.h"

namespace remodel::flow {

namespace {

// The friction at a wall's vertices, which each have half of both edges there.
struct WallVertex {
  double length = 0.0;
  Point along;  // downstream
  Point chord;  // from its neighbour before along the wall to that after it
  int edges = 0;
};
std::vector<WallVertex> wall_vertices_of(const FlowMesh& dual, Point stream) {
  std::vector<WallVertex> walls(dual.size());
  for (const BoundaryEdge& edge : dual.boundary()) {
    if (!dual.patch(edge).sticks()) continue;
    const Point d = dual.points()[edge.b] - dual.points()[edge.a];
    for (const std::uint32_t v : {edge.a, edge.b}) {
      walls[v].length += 0.5 * std::sqrt(dot(d, d));
      walls[v].chord = walls[v].chord + d, ++walls[v].edges;
      walls[v].along = walls[v].along + (dot(d, stream) < 0.0 ? -1.0 : 1.0) * d;
    }
  }
  for (WallVertex& wall : walls) {
    // Where the wall turns by less than a right angle, as at a nose, it lies along its chord.
    if (wall.edges == 2 && dot(wall.chord, wall.chord) > 2.0 * wall.length * wall.length)
      wall.along = (dot(wall.chord, stream) < 0.0 ? -1.0 : 1.0) * wall.chord;
    if (const double size = std::sqrt(dot(wall.along, wall.along)); size > 0.0)
      wall.along = (1.0 / size) * wall.along;
  }
  return walls;
}

template <std::size_t N>
FlowFriction friction_of(const FrictionSystem<N>& system, const std::vector<WallVertex>& walls,
                         const BlockState<N>& state, const BlockVector<N>& unbalanced) {
  const FlowMesh& dual = system.mesh();
  const Viscosity& viscosity = system.terms().viscosity;
  const double mach = system.stream().mach;
  FlowFriction friction;
  friction.reynolds = mach * system.stream().reference_length / viscosity.stream;
  friction.transition = system.stream().transition;
  friction.wall_temperature = system.stream().wall_temperature;
  if (friction.wall_temperature) friction.ch.assign(dual.size(), 0.0);
  const double heat_scale = (gas_gamma - 1.0) / mach;  // over the stream's enthalpy, of a unit of length
  friction.cf.assign(dual.size(), 0.0), friction.y_plus.assign(dual.size(), 0.0);
  for (std::uint32_t v = 0; v < dual.size(); ++v) {
    const Unknowns<double> q = FrictionTerms::gas(state.q[v]);
    const double molecular = viscosity.at(temperature(q));
    if constexpr (N == 5) {
      friction.working.push_back(FrictionTerms::working_unit * state.q[v][4]);
      friction.viscosity_ratio.push_back(
          SpalartAllmaras::turbulent_ratio(friction.working.back() * viscosity.stream * q[0] / molecular));
    }
    if (!system.friction_mesh().sticks(v) || walls[v].length == 0.0) continue;
    const double stress = dot(system.friction_force(unbalanced, v), walls[v].along) / walls[v].length;
    double height = std::numeric_limits<double>::infinity();
    for (const RingEntry& entry : dual.ring(v))
      if (!system.friction_mesh().sticks(entry.vertex))
        height = std::min(height, system.friction_mesh().distances()[entry.vertex]);
    friction.cf[v] = stress / (0.5 * mach * mach);
    if (friction.wall_temperature) {
      const double heat = heat_scale * system.heat(unbalanced, v);
      friction.ch[v] = heat / walls[v].length;
      friction.heat += heat / system.stream().reference_length;
    }
    if (std::isfinite(height))
      friction.y_plus[v] = std::sqrt(std::fabs(stress) * density(q)) * height / molecular;
    friction.y_plus_max = std::max(friction.y_plus_max, friction.y_plus[v]);
  }
  return friction;
}

// What part of friction acts across the wall, where that does not turn. There is none at a wall without slip:
// it is pressure, of which the cells at the wall are too high to tell, as at a nose.
template <std::size_t N>
double part_across_walls(const FrictionSystem<N>& system, const std::vector<WallVertex>& walls,
                         const BlockVector<N>& unbalanced) {
  constexpr double least_cosine = 0.95;  // of half of what an edge turns by
  double across = 0.0, whole = 0.0;
  for (std::uint32_t v = 0; v < walls.size(); ++v) {
    const WallVertex& wall = walls[v];
    const double size = std::sqrt(dot(wall.chord, wall.chord));
    if (wall.edges < 2 || size <= least_cosine * 2.0 * wall.length)
      continue;  // ends at openings, and corners
    const Point force = system.friction_force(unbalanced, v);
    across += std::abs(cross(wall.chord, force)) / size;
    whole += std::sqrt(dot(force, force));
  }
  return whole > 0.0 ? across / whole : 0.0;
}

}  // namespace

template <std::size_t N>
FlowResult result_of(const FrictionSystem<N>& system, const BlockState<N>& state, const SearchRecord& record,
                     FlowStart start) {
  FlowResult result;
  note_search(record, result);
  result.start = start;
  result.model = N == 5 ? FlowModel::sa : FlowModel::laminar;
  result.mach = system.stream().mach;
  result.alpha_deg = state.augmented[1] / one_degree;
  BlockVector<N> unbalanced;
  system.unbalanced(state, unbalanced);
  const double scale = reported_length(system.stream());
  const WallForces sum = system.forces(state, unbalanced);
  result.cl = scale * sum.lift, result.cd = scale * sum.drag, result.cm = scale * scale * sum.moment;
  const std::vector<Patch>& patches = system.mesh().patches();
  const std::vector<WallVertex> walls =
      wall_vertices_of(system.mesh(), {std::cos(state.augmented[1]), std::sin(state.augmented[1])});
  result.friction = friction_of(system, walls, state, unbalanced);
  for (std::uint32_t i = 0; i < patches.size(); ++i) {
    if (!patches[i].solid()) continue;
    const WallForces part = system.forces(state, unbalanced, i);
    FlowBody body{patches[i].name, scale * part.lift, scale * part.drag, scale * scale * part.moment};
    body.cd_pressure = scale * part.pressure_drag;
    body.cd_friction = scale * (part.drag - part.pressure_drag);
    for (const BoundaryEdge& edge : system.mesh().boundary())
      if (edge.patch == i)
        for (const std::uint32_t v : {edge.a, edge.b})
          body.y_plus_max = std::max(body.y_plus_max, result.friction->y_plus[v]);
    result.bodies.push_back(std::move(body));
  }
  result.friction->cd_pressure = scale * sum.pressure_drag;
  result.friction->cd_friction = scale * (sum.drag - sum.pressure_drag);
  for (const auto& q : state.q) {
    result.density.push_back(q[0]);
    result.velocity_x.push_back(q[1]), result.velocity_y.push_back(q[2]);
    result.pressure.push_back(q[3]);
  }
  for (std::uint32_t i = 0; i < patches.size(); ++i)
    if (patches[i].open())
      result.openings.push_back(opening_of(system.mesh(), i, system.mass_flow(state, i), result));
  if (result.converged()) {
    result.warnings =
        friction_warnings({system.friction_mesh(), result, part_across_walls(system, walls, unbalanced)});
    add_stream_warnings(system.mesh(), system.stream(), result);
  } else if (const auto& at = result.friction->transition;
             at && std::max((*at)[0], (*at)[1]) > 0.0 &&
             (result.status == FlowStatus::stalled || result.status == FlowStatus::step_limit)) {
    result.reason += "; a given transition behind where the laminar layer separates may have no steady flow";
  }
  return result;
}

Viscosity viscosity_of(const FlowConditions& conditions, const FlowOptions& options) {
  return {.stream = conditions.mach * conditions.reference_length / conditions.reynolds,
          .temperature = options.temperature_k};
}

namespace {

template <std::size_t N>
FlowResult found(const FrozenMesh& frozen, const FlowConditions& conditions, const FlowOptions& options,
                 const std::string& source) {
  const FlowMesh mesh = dual_of(frozen, conditions, options, source);
  const FrictionMesh friction_mesh(mesh, conditions.transition);
  const FrictionSystem<N> system(friction_mesh, stream_of(conditions, options, mesh),
                                 viscosity_of(conditions, options));
  const BlockMeasure<N> measure(system);
  SearchRecord record;
  BlockState<N> state;
  FrictionSearch<N>(system, measure, options, record).cold(state);
  return result_of(system, state, record, FlowStart::cold);
}

}  // namespace

FlowResult friction_flow(const FrozenMesh& mesh, const FlowConditions& conditions, const FlowOptions& options,
                         const std::string& source) {
  const Stopwatch watch;
  require_possible(conditions, options);
  FlowResult result = options.model == FlowModel::sa ? found<5>(mesh, conditions, options, source)
                                                     : found<4>(mesh, conditions, options, source);
  result.seconds = watch.seconds();
  return result;
}

namespace {

template <std::size_t N>
FlowResult found_from(const FlowMesh& old, const FlowResult& known, const FlowMesh& mesh,
                      const FlowConditions& conditions, const FlowOptions& options) {
  const FrictionMesh friction_mesh(mesh, conditions.transition);
  const FrictionSystem<N> system(friction_mesh, stream_of(conditions, options, mesh),
                                 viscosity_of(conditions, options));
  const BlockMeasure<N> measure(system);
  BlockVector<N> q(old.size());
  for (std::size_t v = 0; v < q.size(); ++v) {
    q[v] = {known.density[v], known.velocity_x[v], known.velocity_y[v], known.pressure[v]};
    if constexpr (N == 5) q[v][4] = known.friction->working[v] / FrictionTerms::working_unit;
  }
  BlockState<N> state = {.q = interpolated<N>(old, q, mesh.points()),
                         .augmented = {known.cl / reported_length(system.stream()),
                                       conditions.cl ? known.alpha_deg * one_degree : system.stream().alpha}};
  SearchRecord record;
  FlowStart start = FlowStart::refactored;
  BlockWholeMatrix<N> matrix;
  BlockFactors<N> factors;
  BlockSearch<N> with_own(options, matrix, factors, record);
  FrictionSearch<N> search(system, measure, options, record);
  if (options.solver != FlowSolver::lu || steps_with_own_factors(measure, with_own, state) == ChordEnd::slow)
    search.near(state);
  if (begins_again(record, options)) {
    start = FlowStart::cold;
    search.cold(state);
  }
  return result_of(system, state, record, start);
}

}  // namespace

FlowResult friction_flow_from(const FrozenMesh& before, const FlowResult& known, const FrozenMesh& mesh,
                              const FlowConditions& conditions, const FlowOptions& options,
                              const std::string& source) {
  const Stopwatch watch;
  const FlowMesh old = dual_of(before, conditions, options, source),
                 dual = dual_of(mesh, conditions, options, source);
  require_known(known, old, options.model, source);
  FlowResult result = options.model == FlowModel::sa ? found_from<5>(old, known, dual, conditions, options)
                                                     : found_from<4>(old, known, dual, conditions, options);
  result.seconds = watch.seconds();
  return result;
}

template FlowResult result_of<4>(const FrictionSystem<4>&, const BlockState<4>&, const SearchRecord&,
                                 FlowStart);
template FlowResult result_of<5>(const FrictionSystem<5>&, const BlockState<5>&, const SearchRecord&,
                                 FlowStart);

}  // namespace remodel::flow
