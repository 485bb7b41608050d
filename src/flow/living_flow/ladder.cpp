#include "flow/living_flow/ladder.h"

#include "flow/search/chord.h"

namespace remodel::flow {

template <std::size_t N>
bool Ladder<N>::by_older_factors(LadderTask<N>& task) {
  if (!kept_.ready() || !kept_.factors.whole() || kept_.solves_left() < 0.0) return false;
  const BlockSystem<N>& system = task.measure.system();
  Overlap overlap = kept_.overlap(system.mesh(), task.keys);
  task.corrected = overlap.zone.size();
  if (!KeptFactors<N>::is_small(overlap)) return false;
  Preconditioner<N> inverse(system, task.state, kept_.factors, std::move(overlap), options_.memory_mb);
  if (!inverse.ready()) return false;
  BlockSearch<N> search(options_, matrix_, kept_.factors, task.record);
  const int before = task.record.iterations;
  const ChordEnd end = chord_steps(task.measure, inverse, search, task.state);
  kept_.charge(task.record.iterations - before, SearchPolicy::own_solves, inverse.zone_work());
  if (end == ChordEnd::interrupted) {
    task.record.interrupt();
    return true;
  }
  task.start = FlowStart::carried;
  if (end == ChordEnd::converged) task.record.status = FlowStatus::converged;
  return end == ChordEnd::converged;
}

template <std::size_t N>
bool Ladder<N>::by_own_factors(LadderTask<N>& task) {
  if (lasting_kind(options_) != FactorKind::whole || kept_.factors.too_large(task.keys.size()) ||
      !kept_.worth.pays())
    return false;
  task.start = FlowStart::refactored;
  const BlockSystem<N>& system = task.measure.system();
  BlockSearch<N> search(options_, matrix_, kept_.factors, task.record);
  const int before = task.record.factorisations;
  const ChordEnd end = steps_with_own_factors(task.measure, search, task.state);
  if (task.record.factorisations > before) kept_.belong(system.mesh(), task.keys);
  if (end == ChordEnd::slow) kept_.drop();
  return end != ChordEnd::slow;
}

template <std::size_t N>
void Ladder<N>::climb(LadderTask<N>& task) {
  if (task.from_last) {
    if (by_older_factors(task)) return kept_.worth.served();
    kept_.drop();
    if (by_own_factors(task)) return;
  }
  if (task.from_last) {
    task.start = FlowStart::refactored;
    task.near(task.state);
    if (!begins_again(task.record, options_)) return;
  }
  task.start = FlowStart::cold;
  task.cold(task.state);
}

template class Ladder<4>;
template class Ladder<5>;

}  // namespace remodel::flow
