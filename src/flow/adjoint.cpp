#include "flow/adjoint.h"

#include <algorithm>
#include <cmath>

namespace remodel::flow {

namespace {

double inner(const Vector& a, const Vector& b) {
  double sum = 0.0;
  for (std::size_t v = 0; v < a.size(); ++v)
    for (std::size_t k = 0; k < 4; ++k) sum += a[v][k] * b[v][k];
  return sum;
}

void add_times(Vector& to, double factor, const Vector& v) {
  for (std::size_t i = 0; i < to.size(); ++i)
    for (std::size_t k = 0; k < 4; ++k) to[i][k] += factor * v[i][k];
}

Vector transposed_product(const BlockRows& matrix, const Vector& x) {
  Vector result(x.size(), std::array<double, 4>{});
  for (std::size_t r = 0; r < matrix.rows.size(); ++r) {
    const std::array<double, 4>& from = x[matrix.rows[r]];
    for (std::uint32_t i = matrix.start[r]; i < matrix.start[r + 1]; ++i) {
      const Block& block = matrix.block[i];
      std::array<double, 4>& to = result[matrix.column[i]];
      for (std::size_t row = 0; row < 4; ++row)
        for (std::size_t k = 0; k < 4; ++k) to[k] += block[4 * row + k] * from[row];
    }
  }
  return result;
}

// The upper triangle of GMRES by Givens rotations, one column a step.
class Triangle {
 public:
  explicit Triangle(double beta) : right_{beta} {}
  // Returns what is left of the residual.
  double add(std::vector<double> column) {
    for (std::size_t i = 0; i < cosine_.size(); ++i) {
      const double a = column[i], b = column[i + 1];
      column[i] = cosine_[i] * a + sine_[i] * b;
      column[i + 1] = cosine_[i] * b - sine_[i] * a;
    }
    const std::size_t n = cosine_.size();
    const double size = std::hypot(column[n], column[n + 1]);
    cosine_.push_back(column[n] / size), sine_.push_back(column[n + 1] / size);
    column[n] = size;
    columns_.push_back(std::move(column));
    right_.push_back(-sine_[n] * right_[n]);
    right_[n] *= cosine_[n];
    return std::fabs(right_.back());
  }
  std::vector<double> solution() const {
    const std::size_t n = columns_.size();
    std::vector<double> y(right_.begin(), right_.end() - 1);
    for (std::size_t i = n; i-- > 0;) {
      for (std::size_t j = i + 1; j < n; ++j) y[i] -= columns_[j][i] * y[j];
      y[i] /= columns_[i][i];
    }
    return y;
  }

 private:
  std::vector<double> right_, cosine_, sine_;
  std::vector<std::vector<double>> columns_;
};

constexpr double adjoint_tolerance = 1e-12;  // of the right-hand side
// More steps than these cost more than a factorisation.
constexpr int most_steps = 25;

}  // namespace

// Preconditioned from the right, so that the residual is that of the system itself. It is kept as small as
// rounding lets it by beginning anew once.
bool solve_transposed(const BlockRows& matrix, DirectSolver& factors, Vector& right, int& iterations) {
  const double wanted = adjoint_tolerance * std::sqrt(inner(right, right));
  Vector x(right.size(), std::array<double, 4>{});
  if (wanted == 0.0) {
    right = x;
    return true;
  }
  Vector residual = right;
  for (int round = 0; round < 2; ++round) {
    const double beta = std::sqrt(inner(residual, residual));
    if (!(beta > wanted)) break;
    std::vector<Vector> basis(1, Vector(right.size(), std::array<double, 4>{})), solved;
    add_times(basis[0], 1.0 / beta, residual);
    Triangle triangle(beta);
    for (int step = 0; step < most_steps; ++step) {
      solved.push_back(basis.back());
      factors.solve_transposed(solved.back(), 1);
      ++iterations;
      Vector next = transposed_product(matrix, solved.back());
      std::vector<double> column;
      for (const Vector& b : basis) {
        column.push_back(inner(b, next));
        add_times(next, -column.back(), b);
      }
      const double size = std::sqrt(inner(next, next));
      column.push_back(size);
      const double left = triangle.add(std::move(column));
      if (!(left > wanted) || size == 0.0) break;
      basis.emplace_back(right.size(), std::array<double, 4>{});
      add_times(basis.back(), 1.0 / size, next);
    }
    const std::vector<double> y = triangle.solution();
    for (std::size_t i = 0; i < y.size(); ++i) add_times(x, y[i], solved[i]);
    residual = right;
    add_times(residual, -1.0, transposed_product(matrix, x));
  }
  constexpr double slack = 100.0;  // rounding of the residual itself
  const bool found = std::sqrt(inner(residual, residual)) <= slack * wanted;
  right = std::move(x);
  return found;
}

std::optional<Adjoint> Adjoint::make(const Euler& euler, const State& state, const BlockRows& matrix,
                                     DirectSolver& factors, int& iterations) {
  Adjoint adjoint(euler, state, matrix, factors);
  adjoint.columns_ = euler.border_columns(state);
  adjoint.rows_ = euler.border_rows(state);
  adjoint.lift_.assign(euler.mesh().size(), {});
  for (const auto& entry : adjoint.rows_.lift) adjoint.lift_[entry.vertex][3] += entry.value;
  if (!solve_transposed(matrix, factors, adjoint.lift_, iterations)) return std::nullopt;
  return adjoint;
}

// The border's equations are "lift of the walls = lift of the vortex" (multiplier m0) and "angle, or lift =
// the given one" (m1), whose derivative by the given one is -1.
std::optional<Total> Adjoint::total(const ForceSlope& function, int& iterations) {
  Vector multiplier(euler_.mesh().size(), std::array<double, 4>{});
  for (std::size_t v = 0; v < multiplier.size(); ++v) multiplier[v][3] = function.pressure[v];
  if (!solve_transposed(matrix_, factors_, multiplier, iterations)) return std::nullopt;
  const auto& e = rows_.corner;
  const double a00 = e[0][0] - inner(columns_[0], lift_), a01 = e[1][0];
  const double a10 = e[0][1] - inner(columns_[1], lift_), a11 = e[1][1];
  const double r0 = -inner(columns_[0], multiplier), r1 = function.alpha - inner(columns_[1], multiplier);
  const double determinant = a00 * a11 - a01 * a10;
  const double m0 = (r0 * a11 - a01 * r1) / determinant, m1 = (a00 * r1 - a10 * r0) / determinant;
  add_times(multiplier, -m0, lift_);

  Total total{.shape = function.shape, .condition = m1};
  const ShapeSlope by_residual = euler_.residual_slope(state_, multiplier);
  const ForceSlope by_lift = euler_.force_slope(state_, {.lift = 1.0});
  for (std::size_t v = 0; v < total.shape.points.size(); ++v)
    total.shape.points[v] = total.shape.points[v] - by_residual.points[v] - m0 * by_lift.shape.points[v];
  total.shape.mach += -by_residual.mach - m0 * by_lift.shape.mach;
  return total;
}

}  // namespace remodel::flow
