#include "flow/search/coarse_start.h"

#include <algorithm>
#include <optional>

#include "flow/solution.h"
#include "remodel/error.h"
#include "remodel/generate.h"

namespace remodel::flow {

namespace {

// The CFL number is bounded unless the residual has to rise because the angle is looked for too.
Pace pace_from_coarser(const Stream& stream) {
  if (stream.lift) return {.cfl = SearchPolicy::interpolated_cfl_with_lift};
  return {.cfl = SearchPolicy::interpolated_cfl, .most = SearchPolicy::interpolated_cfl};
}

// Every second station of every curve, counted from its end where its counterpart runs the other way. Nothing
// where chains may end on a station that would be gone.
std::optional<Domain> coarsened(const Domain& domain) {
  Domain coarse = domain;
  std::vector<bool> from_its_end(domain.curve_count(), false);
  for (const PeriodicCurve& pair : periodic_curves(domain)) from_its_end[pair.moved] = pair.reversed;
  std::size_t index = 0;
  for (Loop& loop : coarse.loops) {
    if (loop.open) return std::nullopt;
    for (Curve& curve : loop.curves) {
      const std::size_t n = curve.parameters.size();
      std::vector<double> kept = {0.0};
      for (std::size_t i = from_its_end[index++] && n % 2 != 0 ? 1 : 2; i < n; i += 2)
        kept.push_back(curve.parameters[i]);
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

// Adds the cost to that of another search, or of a result.
template <class Counted>
void add_cost(const SearchRecord& of, Counted& to) {
  to.newton_steps += of.newton_steps;
  to.factorisations += of.factorisations;
  to.gmres_iterations += of.gmres_iterations;
  to.memory_mb = std::max(to.memory_mb, of.memory_mb);
}

std::optional<State> start_from_coarser(const Domain& domain, const QualityOptions& quality,
                                        const FlowMesh& fine, const FlowConditions& conditions,
                                        const FlowOptions& options, SearchRecord& spent) {
  if (fine.size() < SearchPolicy::least_vertices(conditions.mach)) return std::nullopt;
  const std::optional<Domain> coarse = coarsened(domain);
  if (!coarse) return std::nullopt;
  QualityOptions half = quality;
  half.gradation = 0.5 * quality.gradation;
  const std::optional<FlowMesh> dual = coarse_mesh(*coarse, half, fine.size(), conditions, options);
  if (!dual) return std::nullopt;
  const FlowSystem system(*dual, stream_of(conditions, options, *dual));
  FlowOptions rough = options;
  rough.tolerance = std::max(options.tolerance, SearchPolicy::coarse_tolerance);
  State state;
  SearchRecord record;
  WholeMatrix matrix;
  Factors factors;
  NewtonSearch search(rough, matrix, factors, record);
  search_by_meshes(*coarse, half, Measure(system), conditions, search, state, spent);
  add_cost(record, spent);
  spent.newton_steps += record.in_vain;
  if (record.status != FlowStatus::converged) return std::nullopt;
  state.q = interpolated<unknown_count>(*dual, state.q, fine.points());
  state.augmented[0] *= dual->extent().length / fine.extent().length;
  return state;
}

}  // namespace

void search_by_meshes(const Domain& domain, const QualityOptions& quality, const Measure& measure,
                      const FlowConditions& conditions, NewtonSearch& search, State& state,
                      SearchRecord& spent) {
  const FlowSystem& system = measure.system();
  const bool shocks = conditions.mach >= SearchPolicy::mach_of_shocks;
  if (!shocks && search.from_potential_flow(measure, state)) return;
  if (auto coarse = start_from_coarser(domain, quality, system.mesh(), conditions, search.options(), spent)) {
    state = std::move(*coarse);
    SearchRecord& record = search.record();
    record.newton_steps = 0;
    record.origin = FlowOrigin::coarser_mesh;
    search.run(measure, pace_from_coarser(system.stream()), state);
    search.beside(measure, state);
    if (record.status != FlowStatus::stalled && record.status != FlowStatus::step_limit) return;
    record.in_vain += record.newton_steps;  // searches count anew
  }
  if (shocks && search.from_potential_flow(measure, state)) return;
  search.from_undisturbed_flow(measure, state);
}

void add_coarse(const SearchRecord& spent, FlowResult& result) {
  result.coarse_steps += spent.newton_steps;
  add_cost(spent, result);
}

}  // namespace remodel::flow
