#include "flow/search/linear_step.h"

#include "flow/linear/gmres.h"

namespace remodel::flow {

namespace {

// GMRES ends after so many rows of steps, whatever it has reached.
constexpr int most_rounds = 4;

class System {
 public:
  System(const FlowSystem& system, const State& state, const BlockRows& matrix)
      : matrix_(matrix),
        columns_(system.augmented_columns(state)),
        rows_(system.augmented_rows(state)),
        length_(system.stream().length) {}

  Increment times(const Increment& x) const {
    Increment result = zero(x.q.size());
    for (std::size_t r = 0; r < x.q.size(); ++r)
      for (std::size_t z = 0; z < 2; ++z)
        for (std::size_t k = 0; k < 4; ++k) result.q[r][k] += columns_[z][r][k] * x.augmented[z];
    add_product(matrix_, 1.0, x.q, result.q);
    for (const auto& entry : rows_.lift) result.augmented[0] += entry.value * x.q[entry.vertex][3];
    for (std::size_t row = 0; row < 2; ++row)
      for (std::size_t z = 0; z < 2; ++z) result.augmented[row] += rows_.corner[row][z] * x.augmented[z];
    scale(result.augmented, length_);
    return result;
  }
  const FlowSystem::AugmentedRows& rows() const { return rows_; }
  double length() const { return length_; }
  static void scale(Augmented& augmented, double by) {
    for (double& x : augmented) x *= by;
  }

 private:
  const BlockRows& matrix_;
  std::array<Vector, 2> columns_;
  FlowSystem::AugmentedRows rows_;
  double length_;  // residuals grow with the mesh: the augmented's equations are multiplied by it, too
};

}  // namespace

LinearStep linear_step(const FlowSystem& system, const State& state, const BlockRows& matrix,
                       Factors& factors, const Vector& residual, const Augmented& augmented, double part,
                       StepObserver* observer) {
  Increment right{.q = residual, .augmented = {-augmented[0], -augmented[1]}};
  for (auto& block : right.q)
    for (double& x : block) x = -x;
  if (factors.whole()) {
    factors.solve(right.q);
    return {.step = close_augmented(std::move(right.q), factors.columns(), system.augmented_rows(state),
                                    right.augmented)};
  }
  const System matrix_of_step(system, state, matrix);
  System::scale(right.augmented, matrix_of_step.length());
  const auto precondition = [&](Increment& x) {
    System::scale(x.augmented, 1.0 / matrix_of_step.length());
    factors.solve(x.q);
    x = close_augmented(std::move(x.q), factors.columns(), matrix_of_step.rows(), x.augmented);
  };
  const double size = norm(right);
  LinearStep result;
  const GmresEnd end = gmres(
      [&](const Increment& x) { return matrix_of_step.times(x); }, precondition, right,
      {.wanted = part * size, .restart = factors.restart(), .rounds = most_rounds, .observer = observer},
      result.step);
  result.left = end.residual / size;
  result.iterations = end.iterations;
  result.solved = end.residual <= part * size;
  return result;
}

}  // namespace remodel::flow
