// A living flow: a solver that outlives its mesh. A design changes little from one to the next, and so do the
// flow, its matrix and the factors of that. What is expensive in a flow is to find the neighbourhood in which
// Newton's method converges, and to factor. Both are carried from design to design.
//
// Four parts. LastFlow is the state, by keys of vertices. KeptFactors are the factors of an earlier matrix,
// by keys too, and what using them has cost beyond new ones. The Ladder looks for the next flow by both,
// cheapest first. Gradients solve transposed systems with the same factors (adjoint.h).
//
// solve(mesh, conditions):
//
//   1. The dual mesh. With the connectivity of the last one its points are moved, otherwise it is made anew.
//   2. The state. A vertex whose key the last mesh has keeps its values; those at new vertices are
//      interpolated. With a full adjustment or a morph nearly all are kept.
//   3. The ladder, each rung the fallback of the one before:
//        a. older factors (by_older_factors()): the chord method. The matrix M is that of an earlier state,
//           maybe of an earlier mesh, the step is -M^-1 R. Two means make it converge fast. Anderson's method
//           combines the last steps (D. G. Anderson, J. ACM 12, 1965; H. F. Walker and P. Ni, SIAM J. Numer.
//           Anal. 49, 2011). Where the mesh has changed, in the *zone* of vertices with other neighbours and
//           two rings about them, an exact solve with the present Jacobian follows (X.-C. Cai and M. Sarkis,
//           SIAM J. Sci. Comput. 21, 1999; here multiplicative and behind the whole).
//        b. own factors (by_own_factors()): a Jacobian at the carried state, factored, and steps with that.
//        c. Newton's method from the carried state, with pseudo-time where it is far (NewtonSearch::near()).
//        d. cold: from undisturbed flow, on a coarser mesh first where this one is fine.
//   4. A flow that was found is the last one from now on. One that was not leaves the last one as it is.
//
// When factors are made anew is a rental problem: nobody knows how many designs the present ones will serve.
// They are used until the steps that they took beyond those of new ones have cost as much as a factorisation
// (KeptFactors::charge()). That costs about twice what foresight would, at most (ski rental: A. R. Karlin et
// al., "Competitive snoopy caching", Algorithmica 3, 1988). Worth decides likewise whether (b) pays at all:
// factors that serve no other flow than their own cost more than Newton's method with incomplete ones; then
// more and more flows go by without.
//
// Which rung found a flow does not change it beyond the tolerance: every rung ends on the same residual.
// Where an equation has several solutions, the ladder follows the one that it is on (docs/flow.md).

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
