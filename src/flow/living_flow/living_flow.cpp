// The solver that outlives its mesh.
//
// It has four parts. LastFlow is the state, by the keys of vertices; KeptFactors are factors of an earlier
// matrix, by keys too, and what using them has cost beyond new ones; the Ladder looks for the next flow by
// both, cheapest first; Gradients solve transposed systems with the same factors.

#include <utility>

#include "base/stopwatch.h"
#include "flow/living_flow/gradients.h"
#include "flow/living_flow/ladder.h"
#include "flow/search/coarse_start.h"
#include "flow/solution.h"

namespace remodel {

struct KeptFlow::Flow {
  flow::LastFlow last;
};

struct LivingFlow::Impl {
  explicit Impl(const FlowOptions& given) : options(given) {}

  FlowOptions options;
  flow::LastFlow last = {};
  flow::KeptFactors kept = {};
  flow::WholeMatrix matrix = {};
  flow::Ladder ladder{options, kept, matrix};
  flow::Gradients gradients{options, kept, matrix};

  FlowResult solve(const FrozenMesh& frozen, const Mesh* living, const FlowConditions& conditions);

 private:
  std::shared_ptr<const flow::FlowMesh> mesh_of(const FrozenMesh& frozen, const flow::Keys& keys,
                                                const FlowConditions& conditions) const;
};

LivingFlow::LivingFlow(const FlowOptions& options) : impl_(std::make_unique<Impl>(options)) {}
LivingFlow::~LivingFlow() = default;
LivingFlow::LivingFlow(LivingFlow&&) noexcept = default;
LivingFlow& LivingFlow::operator=(LivingFlow&&) noexcept = default;

FlowResult LivingFlow::solve(const Mesh& mesh, const FlowConditions& conditions) {
  return impl_->solve(mesh.freeze(), &mesh, conditions);
}

FlowResult LivingFlow::solve(const FrozenMesh& mesh, const FlowConditions& conditions) {
  return impl_->solve(mesh, nullptr, conditions);
}

FlowGradients LivingFlow::gradients(const std::vector<FlowFunctional>& functions,
                                    const WantedGradients& wanted) {
  return impl_->gradients.of(impl_->last, functions, wanted);
}

void LivingFlow::forget() {
  impl_ = std::make_unique<Impl>(impl_->options);
}

KeptFlow LivingFlow::keep() const {
  KeptFlow kept;
  if (impl_->last.found()) kept.flow_ = std::make_shared<const KeptFlow::Flow>(KeptFlow::Flow{impl_->last});
  return kept;
}

void LivingFlow::go_on_from(const KeptFlow& kept) {
  if (!kept.empty()) impl_->last = kept.flow_->last;
}

// The last one's with vertices elsewhere, where connectivity is the same.
std::shared_ptr<const flow::FlowMesh> LivingFlow::Impl::mesh_of(const FrozenMesh& frozen,
                                                                const flow::Keys& keys,
                                                                const FlowConditions& conditions) const {
  if (!last.found() || last.mesh->cells() != flow::FlowMesh::cells_of(frozen) || last.keys != keys)
    return std::make_shared<flow::FlowMesh>(flow::dual_of(frozen, conditions, options, "mesh"));
  auto moved = std::make_shared<flow::FlowMesh>(*last.mesh);
  moved->move(frozen.points);
  moved->require_cells("mesh");
  flow::require_ways(*moved, conditions, options, "mesh");
  return moved;
}

FlowResult LivingFlow::Impl::solve(const FrozenMesh& frozen, const Mesh* living,
                                   const FlowConditions& conditions) {
  flow::require_euler(options);
  const Stopwatch watch;
  flow::require_possible(conditions, options);
  flow::Keys keys = flow::keys_of(frozen);
  const std::shared_ptr<const flow::FlowMesh> mesh = mesh_of(frozen, keys, conditions);
  const flow::FlowSystem system(*mesh, flow::stream_of(conditions, options, *mesh));
  const flow::Measure measure(system);
  flow::LadderTask task{.measure = measure,
                        .keys = keys,
                        .conditions = conditions,
                        .living = living,
                        .from_last = last.found(),
                        .state = {}};
  if (last.found()) task.state = last.carried(*mesh, keys, system.stream());
  ladder.climb(task);
  FlowResult result = flow::result_of(system, task.state, task.record, task.start);
  flow::add_coarse(task.spent, result);
  result.corrected_vertices = task.corrected;
  // Asked to stop during its last step: whoever asked does not know this flow, gradients() must not have it.
  if (result.converged() && options.observer != nullptr && options.observer->cancelled())
    result.status = FlowStatus::interrupted, result.reason = "interrupted";
  // A flow that was not found is not carried on: the last one that was found is.
  if (result.converged())
    last = {.mesh = mesh, .keys = std::move(keys), .state = std::move(task.state), .stream = system.stream()};
  result.seconds = watch.seconds();
  return result;
}

}  // namespace remodel
