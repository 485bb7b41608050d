#include "flow/search/linear_step.h"

#include "flow/linear/gmres.h"
#include "flow/search/policy.h"

namespace remodel::flow {

LinearStep linear_step(const FlowSystem& system, const State& state, const BlockRows& matrix,
                       Factors& factors, Increment right, double part, StepObserver* observer) {
  if (factors.whole()) {
    factors.solve(right.q);
    return {.step = close_augmented(std::move(right.q), factors.columns(), system.augmented_rows(state),
                                    right.augmented)};
  }
  const AugmentedMatrix whole(matrix, system.augmented_columns(state), system.augmented_rows(state));
  // Residuals grow with the mesh: the augmented equations are multiplied by its length, too.
  const double length = system.stream().length;
  const auto scale = [](Augmented& augmented, double by) {
    for (double& x : augmented) x *= by;
  };
  const auto times = [&](const Increment& x) {
    Increment result = whole.times(x);
    scale(result.augmented, length);
    return result;
  };
  const auto precondition = [&](Increment& x) {
    scale(x.augmented, 1.0 / length);
    factors.solve(x.q);
    x = close_augmented(std::move(x.q), factors.columns(), whole.rows(), x.augmented);
  };
  scale(right.augmented, length);
  const double size = norm(right);
  LinearStep result;
  const GmresEnd end = gmres(times, precondition, right,
                             {.wanted = part * size,
                              .restart = factors.restart(),
                              .rounds = SearchPolicy::most_rounds,
                              .observer = observer},
                             result.step);
  result.left = end.residual / size;
  result.iterations = end.iterations;
  result.solved = end.residual <= part * size;
  return result;
}

}  // namespace remodel::flow
