#include "flow/linear_step.h"

#include "flow/gmres.h"

namespace remodel::flow {

namespace {

// GMRES ends after so many rows of steps, whatever it has reached.
constexpr int most_rounds = 4;

class System {
 public:
  System(const Euler& euler, const State& state, const BlockRows& matrix)
      : matrix_(matrix),
        columns_(euler.border_columns(state)),
        rows_(euler.border_rows(state)),
        length_(euler.stream().length) {}

  Increment times(const Increment& x) const {
    Increment result = zero(x.q.size());
    for (std::size_t r = 0; r < x.q.size(); ++r)
      for (std::size_t z = 0; z < 2; ++z)
        for (std::size_t k = 0; k < 4; ++k) result.q[r][k] += columns_[z][r][k] * x.border[z];
    add_product(matrix_, 1.0, x.q, result.q);
    for (const auto& entry : rows_.lift) result.border[0] += entry.value * x.q[entry.vertex][3];
    for (std::size_t row = 0; row < 2; ++row)
      for (std::size_t z = 0; z < 2; ++z) result.border[row] += rows_.corner[row][z] * x.border[z];
    scale(result.border, length_);
    return result;
  }
  const Euler::BorderRows& rows() const { return rows_; }
  double length() const { return length_; }
  static void scale(Border& border, double by) {
    for (double& x : border) x *= by;
  }

 private:
  const BlockRows& matrix_;
  std::array<Vector, 2> columns_;
  Euler::BorderRows rows_;
  double length_;  // residuals grow with the mesh: the border's equations are multiplied by it, too
};

}  // namespace

LinearStep linear_step(const Euler& euler, const State& state, const BlockRows& matrix, Factors& factors,
                       const Vector& residual, const Border& border, double part, StepObserver* observer) {
  Increment right{.q = residual, .border = {-border[0], -border[1]}};
  for (auto& block : right.q)
    for (double& x : block) x = -x;
  if (factors.whole()) {
    factors.solve(right.q);
    return {.step =
                close_border(std::move(right.q), factors.columns(), euler.border_rows(state), right.border)};
  }
  const System system(euler, state, matrix);
  System::scale(right.border, system.length());
  const auto precondition = [&](Increment& x) {
    System::scale(x.border, 1.0 / system.length());
    factors.solve(x.q);
    x = close_border(std::move(x.q), factors.columns(), system.rows(), x.border);
  };
  const double size = norm(right);
  LinearStep result;
  const GmresEnd end = gmres(
      [&](const Increment& x) { return system.times(x); }, precondition, right,
      {.wanted = part * size, .restart = factors.restart(), .rounds = most_rounds, .observer = observer},
      result.step);
  result.left = end.residual / size;
  result.iterations = end.iterations;
  result.solved = end.residual <= part * size;
  return result;
}

}  // namespace remodel::flow
