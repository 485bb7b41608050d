#include "flow/search/coarse_start.h"

#include <algorithm>
#include <optional>

#include "flow/solution.h"
#include "remodel/error.h"
#include "remodel/generate.h"

namespace remodel::flow {

namespace {

// How far a coarse flow is followed: the fine mesh's is another one, off by more than this.
constexpr double coarse_tolerance = 1e-5;
// How an interpolated flow is gone on from: by shorter time steps where the residual rises, unless it has to
// rise because the angle is looked for too.
Pace pace_from_coarser(const Stream& stream) {
  constexpr double with_lift = 50.0, at_angle = 20.0;
  if (stream.lift) return {.cfl = with_lift, .patience = usual_patience};
  return {.cfl = at_angle, .patience = usual_patience, .most = at_angle};
}

// Meshes of at least this many vertices begin on a coarser one. Shocks are what that is for: without them it
// gains little, and around several elements it may lead to another flow, of less lift.
std::size_t least_vertices(double mach) {
  constexpr double mach_of_shocks = 0.6;
  constexpr std::size_t with_shocks = 1500, without = 4000;
  return mach < mach_of_shocks ? without : with_shocks;
}

// Every second station of every curve. Nothing where chains may end on a station that would be gone.
std::optional<Domain> coarsened(const Domain& domain) {
  Domain coarse = domain;
  for (Loop& loop : coarse.loops) {
    if (loop.open) return std::nullopt;
    for (Curve& curve : loop.curves) {
      std::vector<double> kept;
      for (std::size_t i = 0; i < curve.parameters.size(); i += 2) kept.push_back(curve.parameters[i]);
      curve.parameters = std::move(kept);
    }
  }
  return coarse;
}

// The dual of a coarser mesh; nothing where there is none that is much coarser.
std::optional<FlowMesh> coarse_mesh(const Domain& domain, const QualityOptions& quality, std::size_t fine,
                                    const FlowConditions& conditions, const FlowOptions& options) {
  try {
    const GenerateResult made = generate(domain, quality, options.observer);
    if (made.stopped != Stopped::done) return std::nullopt;
    FlowMesh dual = dual_of(made.mesh.freeze(), conditions, options, "coarser mesh");
    if (2 * dual.size() > fine) return std::nullopt;
    return dual;
  } catch (const Error&) {
    return std::nullopt;  // walls that are close meet where stations are left out
  }
}

// To those of another search, or of a result.
template <class Counted>
void add_cost(const Search& of, Counted& to) {
  to.newton_steps += of.newton_steps;
  to.factorisations += of.factorisations;
  to.gmres_iterations += of.gmres_iterations;
  to.memory_mb = std::max(to.memory_mb, of.memory_mb);
}

std::optional<State> start_from_coarser(const Domain& domain, const QualityOptions& quality,
                                        const FlowMesh& fine, const FlowConditions& conditions,
                                        const FlowOptions& options, Search& spent) {
  if (fine.size() < least_vertices(conditions.mach)) return std::nullopt;
  const std::optional<Domain> coarse = coarsened(domain);
  if (!coarse) return std::nullopt;
  QualityOptions half = quality;
  half.gradation = 0.5 * quality.gradation;
  const std::optional<FlowMesh> dual = coarse_mesh(*coarse, half, fine.size(), conditions, options);
  if (!dual) return std::nullopt;
  const FlowSystem system(*dual, stream_of(conditions, options, *dual));
  const Measure measure(system);
  FlowOptions rough = options;
  rough.tolerance = std::max(options.tolerance, coarse_tolerance);
  State state;
  Search search;
  BlockRows matrix = system.pattern();
  Factors factors;
  find_flow_by_meshes(*coarse, half, system, measure, conditions, rough, matrix, factors, state, search,
                      spent);
  add_cost(search, spent);
  if (search.status != FlowStatus::converged) return std::nullopt;
  state.q = interpolated(*dual, state.q, fine.points());
  state.augmented[0] *= dual->extent().length / fine.extent().length;
  return state;
}

}  // namespace

void find_flow_by_meshes(const Domain& domain, const QualityOptions& quality, const FlowSystem& system,
                         const Measure& measure, const FlowConditions& conditions, const FlowOptions& options,
                         BlockRows& matrix, Factors& factors, State& state, Search& search, Search& spent) {
  if (auto coarse = start_from_coarser(domain, quality, system.mesh(), conditions, options, spent)) {
    state = std::move(*coarse);
    search.newton_steps = 0;
    find_flow(system, measure, pace_from_coarser(system.stream()), options, matrix, factors, state, search);
    find_flow_beside(system, measure, options, matrix, factors, state, search);
    if (search.status != FlowStatus::stalled && search.status != FlowStatus::step_limit) return;
    spent.newton_steps += search.newton_steps;  // in vain; find_flow_cold() counts anew
  }
  find_flow_cold(system, measure, options, matrix, factors, state, search);
}

void add_coarse(const Search& spent, FlowResult& result) {
  result.coarse_steps = spent.newton_steps;
  add_cost(spent, result);
}

}  // namespace remodel::flow
