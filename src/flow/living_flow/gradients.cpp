#include "flow/living_flow/gradients.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "flow/search/policy.h"
#include "remodel/error.h"

namespace remodel::flow {

FlowGradient gradient_of(Total total, double scale, const Stream& stream) {
  for (Point& point : total.shape.points) point = scale * point;
  const double by_condition = scale * total.condition;
  return {.points = std::move(total.shape.points),
          .mach = scale * total.shape.mach,
          .alpha_deg = stream.lift ? 0.0 : by_condition * one_degree,
          .cl = stream.lift ? by_condition / reported_length(stream) : 0.0,
          .reynolds = scale * total.shape.reynolds};
}

void require_gradients(bool found) {
  if (!found) throw Error(ErrorCode::argument, "gradients", "no flow was found yet, expected one");
}

// The multipliers of the last gradients are the guess for the next ones.
template <std::size_t N>
void Gradients<N>::guess_multipliers(const Keys& keys, std::size_t functions) {
  if (multipliers_.size() != functions) multipliers_.assign(functions, {});
  const KeyTable table(multiplier_keys_);
  for (BlockIncrement<N>& multiplier : multipliers_) {
    if (multiplier.q.size() != multiplier_keys_.size()) continue;
    BlockVector<N> guess(keys.size());
    for (std::size_t v = 0; v < keys.size(); ++v)
      if (const std::uint32_t old = table.find(keys[v]); old != no_index) guess[v] = multiplier.q[old];
    multiplier.q = std::move(guess);
  }
  multiplier_keys_ = keys;
}

template <std::size_t N>
bool Gradients<N>::by_kept_factors(const LastFlow<N>& last, const BlockSystem<N>& system,
                                   std::span<const BlockIncrement<N>> functions, int& iterations) {
  if (!kept_.ready()) return false;
  const Overlap overlap = kept_.overlap(*last.mesh, last.keys);
  if (!KeptFactors<N>::is_small(overlap)) return false;
  guess_multipliers(last.keys, functions.size());
  const bool are_own = overlap.zone.empty() && kept_.are_fresh();
  const double most_solves =
      are_own ? std::numeric_limits<double>::infinity() : std::max(0.0, kept_.solves_left());
  const int before = iterations;
  Adjoint<N> adjoint(system, last.state, matrix_.of(system), kept_.factors, overlap, options_);
  const bool solved = adjoint.solve(functions, multipliers_, most_solves, iterations);
  kept_.charge(iterations - before, SearchPolicy::own_solves * static_cast<int>(functions.size()), 0.0);
  return solved;
}

template <std::size_t N>
const std::vector<BlockIncrement<N>>* Gradients<N>::multipliers(const LastFlow<N>& last,
                                                                const BlockSystem<N>& system,
                                                                std::span<const BlockIncrement<N>> functions,
                                                                FlowGradients& result) {
  const auto told_to_end = [&] {
    result.interrupted = options_.observer != nullptr && options_.observer->cancelled();
    return result.interrupted;
  };
  bool solved = by_kept_factors(last, system, functions, result.krylov_iterations);
  if (told_to_end()) return nullptr;
  if (solved) return &multipliers_;
  SearchRecord made;
  kept_.replace();
  BlockSearch<N> search(options_, matrix_, kept_.factors, made);
  const Factored outcome = search.factor_at(system, last.state, lasting_kind(options_));
  kept_.belong(*last.mesh, last.keys);
  if (outcome == Factored::done) {
    result.factorisations = 1;
    solved = by_kept_factors(last, system, functions, result.krylov_iterations);
  }
  if (told_to_end()) return nullptr;
  if (!solved)
    throw Error(ErrorCode::argument, "gradients",
                "the adjoint was not found: the Jacobian is singular, or the factors need more than the "
                "memory that they may take, or GMRES takes too long with them");
  return &multipliers_;
}

template class Gradients<4>;
template class Gradients<5>;

}  // namespace remodel::flow
