#include "flow/living_flow/living_solver.h"

#include <utility>

#include "base/stopwatch.h"
#include "flow/friction_flow.h"
#include "flow/living_flow/ladder.h"
#include "flow/living_flow/model_gradients.h"
#include "flow/search/coarse_start.h"
#include "flow/solution.h"

namespace remodel::flow {

namespace {

// What all models have: the four parts, and what becomes of them with each flow.
template <std::size_t N>
class LivingOf : public LivingSolver {
 public:
  using LivingSolver::LivingSolver;
  FlowResult solve(const FrozenMesh& frozen, const Mesh* living, const FlowConditions& conditions) final;
  AnyLastFlow last() const final { return last_; }
  void go_on_from(const AnyLastFlow& last) final { last_ = std::get<LastFlow<N>>(last); }

 protected:
  // A flow that is looked for: `task` has neither measure nor searches yet, and comes back as the ladder left
  // it.
  struct Wanted {
    std::shared_ptr<const FlowMesh> mesh;
    Keys keys;
    const Mesh* living;
    const FlowConditions& conditions;
  };
  virtual FlowResult look_for(const Wanted& wanted) = 0;
  // Looks for it, and makes a flow that is found the last one. `result` makes the public result of a task.
  template <class Result>
  FlowResult climb(const Wanted& wanted, LadderTask<N> task, Result result);

  LastFlow<N> last_ = {};
  KeptFactors<N> kept_ = {};
  BlockWholeMatrix<N> matrix_ = {};

 private:
  std::shared_ptr<const FlowMesh> mesh_of(const FrozenMesh& frozen, const Keys& keys,
                                          const FlowConditions& conditions) const;
  Ladder<N> ladder_{options_, kept_, matrix_};
};

// The last one's with vertices elsewhere, where connectivity is the same.
template <std::size_t N>
std::shared_ptr<const FlowMesh> LivingOf<N>::mesh_of(const FrozenMesh& frozen, const Keys& keys,
                                                     const FlowConditions& conditions) const {
  if (!last_.found() || last_.mesh->cells() != FlowMesh::cells_of(frozen) || last_.keys != keys)
    return std::make_shared<FlowMesh>(dual_of(frozen, conditions, options_, "mesh"));
  auto moved = std::make_shared<FlowMesh>(*last_.mesh);
  moved->move(frozen.points, "mesh");
  moved->require_cells("mesh");
  require_ways(*moved, conditions, options_, "mesh");
  return moved;
}

template <std::size_t N>
FlowResult LivingOf<N>::solve(const FrozenMesh& frozen, const Mesh* living,
                              const FlowConditions& conditions) {
  const Stopwatch watch;
  require_possible(conditions, options_);
  Keys keys = keys_of(frozen);
  auto mesh = mesh_of(frozen, keys, conditions);
  FlowResult result = look_for({std::move(mesh), std::move(keys), living, conditions});
  result.seconds = watch.seconds();
  return result;
}

template <std::size_t N>
template <class Result>
FlowResult LivingOf<N>::climb(const Wanted& wanted, LadderTask<N> task, Result make_result) {
  const Stream& stream = task.measure.system().stream();
  task.from_last = last_.found();
  if (task.from_last) task.state = last_.carried(*wanted.mesh, wanted.keys, stream);
  ladder_.climb(task);
  FlowResult result = make_result(task);
  result.corrected_vertices = task.corrected;
  // Asked to stop during its last step: whoever asked does not know this flow, gradients() must not have it.
  if (result.converged() && options_.observer != nullptr && options_.observer->cancelled())
    result.status = FlowStatus::interrupted, result.reason = "interrupted";
  // A flow that was not found is not carried on: the last one that was found is.
  if (result.converged())
    last_ = {.mesh = wanted.mesh, .keys = wanted.keys, .state = std::move(task.state), .stream = stream};
  return result;
}

class LivingEuler final : public LivingOf<unknown_count> {
 public:
  using LivingOf::LivingOf;
  FlowGradients gradients(const std::vector<FlowFunctional>& functions,
                          const WantedGradients& wanted) override {
    return gradients_of(last_, functions, wanted, matrix_, gradients_);
  }

 private:
  FlowResult look_for(const Wanted& wanted) override {
    const FlowSystem system(*wanted.mesh, stream_of(wanted.conditions, options_, *wanted.mesh));
    const Measure measure(system);
    SearchRecord record, spent;  // spent: on coarser meshes
    NewtonSearch search(options_, matrix_, passing_, record);
    const auto near = [&](State& state) { search.near(measure, state); };
    const auto cold = [&](State& state) {
      if (wanted.living == nullptr) return search.cold(measure, state);
      search_by_meshes(wanted.living->domain(), wanted.living->options(), measure, wanted.conditions, search,
                       state, spent);
    };
    return climb(wanted, {measure, wanted.keys, near, cold, record},
                 [&](const LadderTask<unknown_count>& task) {
                   FlowResult result = result_of(system, task.state, record, task.start);
                   add_coarse(spent, result);
                   return result;
                 });
  }

  Factors passing_;  // of steps of which each has a matrix of its own
  Gradients<unknown_count> gradients_{options_, kept_, matrix_};
};

template <std::size_t N>
class LivingFriction final : public LivingOf<N> {
 public:
  using LivingOf<N>::LivingOf;
  FlowGradients gradients(const std::vector<FlowFunctional>& functions,
                          const WantedGradients& wanted) override {
    return gradients_of<N>(this->last_, viscosity_, functions, wanted, this->matrix_, gradients_);
  }

 private:
  using typename LivingOf<N>::Wanted;
  FlowResult look_for(const Wanted& wanted) override {
    const FrictionMesh mesh(*wanted.mesh, wanted.conditions.transition);
    const FrictionSystem<N> system(mesh, stream_of(wanted.conditions, this->options_, *wanted.mesh),
                                   viscosity_of(wanted.conditions, this->options_));
    const BlockMeasure<N> measure(system);
    SearchRecord record;
    FrictionSearch<N> search(system, measure, this->options_, record);
    const auto near = [&](BlockState<N>& state) { search.near(state); };
    const auto cold = [&](BlockState<N>& state) { search.cold(state); };
    FlowResult result = this->climb(
        wanted, {measure, wanted.keys, near, cold, record},
        [&](const LadderTask<N>& task) { return result_of(system, task.state, record, task.start); });
    if (result.converged()) viscosity_ = system.terms().viscosity;
    return result;
  }

  Viscosity viscosity_;  // of the last flow
  Gradients<N> gradients_{this->options_, this->kept_, this->matrix_};
};

}  // namespace

std::unique_ptr<LivingSolver> living_solver(const FlowOptions& options) {
  switch (options.model) {
    case FlowModel::laminar:
      return std::make_unique<LivingFriction<4>>(options);
    case FlowModel::sa:
      return std::make_unique<LivingFriction<5>>(options);
    case FlowModel::euler:
      break;
  }
  return std::make_unique<LivingEuler>(options);
}

}  // namespace remodel::flow
