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

#include "flow/living_flow/living_solver.h"
#include "remodel/error.h"

namespace remodel {

struct KeptFlow::Flow {
  FlowModel model;
  flow::AnyLastFlow last;
};

KeptFlow changed(const KeptFlow& flow, const KeptFlow& from, const KeptFlow& to) {
  if (flow.empty() || from.empty() || to.empty())
    throw Error(ErrorCode::argument, "kept flow", "found an empty one, expected three flows");
  if (flow.flow_->model != from.flow_->model || flow.flow_->model != to.flow_->model)
    throw Error(ErrorCode::argument, "kept flow", "found flows of several models, expected one");
  const auto change = [&](const auto& last) -> flow::AnyLastFlow {
    using Last = std::decay_t<decltype(last)>;
    return last.changed(std::get<Last>(from.flow_->last), std::get<Last>(to.flow_->last));
  };
  KeptFlow result;
  result.flow_ = std::make_shared<const KeptFlow::Flow>(
      KeptFlow::Flow{flow.flow_->model, std::visit(change, flow.flow_->last)});
  return result;
}

struct LivingFlow::Impl {
  std::unique_ptr<flow::LivingSolver> solver;
};

LivingFlow::LivingFlow(const FlowOptions& options)
    : impl_(std::make_unique<Impl>(Impl{flow::living_solver(options)})) {}
LivingFlow::~LivingFlow() = default;
LivingFlow::LivingFlow(LivingFlow&&) noexcept = default;
LivingFlow& LivingFlow::operator=(LivingFlow&&) noexcept = default;

FlowResult LivingFlow::solve(const Mesh& mesh, const FlowConditions& conditions) {
  return impl_->solver->solve(mesh.freeze(), &mesh, conditions);
}

FlowResult LivingFlow::solve(const FrozenMesh& mesh, const FlowConditions& conditions) {
  return impl_->solver->solve(mesh, nullptr, conditions);
}

FlowGradients LivingFlow::gradients(const std::vector<FlowFunctional>& functions,
                                    const WantedGradients& wanted) {
  return impl_->solver->gradients(functions, wanted);
}

void LivingFlow::forget() {
  impl_->solver = flow::living_solver(FlowOptions(impl_->solver->options()));
}

KeptFlow LivingFlow::keep() const {
  KeptFlow kept;
  flow::AnyLastFlow last = impl_->solver->last();
  if (std::visit([](const auto& flow) { return flow.found(); }, last))
    kept.flow_ = std::make_shared<const KeptFlow::Flow>(
        KeptFlow::Flow{impl_->solver->options().model, std::move(last)});
  return kept;
}

void LivingFlow::go_on_from(const KeptFlow& kept) {
  if (kept.empty()) return;
  const FlowModel model = impl_->solver->options().model;
  if (kept.flow_->model != model)
    throw Error(
        ErrorCode::argument, "kept flow",
        std::string("found one of the model ") + name_of(kept.flow_->model) + ", expected " + name_of(model));
  impl_->solver->go_on_from(kept.flow_->last);
}

}  // namespace remodel
