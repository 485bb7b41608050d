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

double inner(const Increment& a, const Increment& b) {
  return inner(a.q, b.q) + a.border[0] * b.border[0] + a.border[1] * b.border[1];
}

void add_times(Increment& to, double factor, const Increment& v) {
  for (std::size_t i = 0; i < to.q.size(); ++i)
    for (std::size_t k = 0; k < 4; ++k) to.q[i][k] += factor * v.q[i][k];
  for (std::size_t k = 0; k < 2; ++k) to.border[k] += factor * v.border[k];
}

Increment zero(std::size_t size) {
  return {.q = Vector(size, std::array<double, 4>{}), .border = {0.0, 0.0}};
}

// to += factor times the transposed matrix times x, the r-th of x for its r-th row.
void add_transposed(const BlockRows& matrix, double factor, const Vector& x, Vector& to) {
  for (std::size_t r = 0; r < matrix.rows.size(); ++r) {
    std::array<double, 4> from = x[r];
    for (double& value : from) value *= factor;
    for (std::uint32_t i = matrix.start[r]; i < matrix.start[r + 1]; ++i) {
      const Block& block = matrix.block[i];
      std::array<double, 4>& sum = to[matrix.column[i]];
      for (std::size_t row = 0; row < 4; ++row)
        for (std::size_t k = 0; k < 4; ++k) sum[k] += block[4 * row + k] * from[row];
    }
  }
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

constexpr int most_steps = 25;  // before it begins anew

// Some rows of the whole matrix.
BlockRows rows_of(const BlockRows& matrix, const std::vector<std::uint32_t>& rows) {
  BlockRows some{.rows = rows, .start = {0}, .column = {}, .block = {}};
  for (const std::uint32_t r : rows) {
    const auto from = matrix.start[r], to = matrix.start[r + 1];
    some.column.insert(some.column.end(), matrix.column.begin() + from, matrix.column.begin() + to);
    some.block.insert(some.block.end(), matrix.block.begin() + from, matrix.block.begin() + to);
    some.start.push_back(static_cast<std::uint32_t>(some.column.size()));
  }
  return some;
}

}  // namespace

Increment TransposedSystem::times(const Increment& x) const {
  Increment result = zero(x.q.size());
  add_transposed(matrix_, 1.0, x.q, result.q);
  for (const auto& entry : rows_.lift) result.q[entry.vertex][3] += entry.value * x.border[0];
  for (std::size_t z = 0; z < 2; ++z)
    result.border[z] =
        inner(columns_[z], x.q) + rows_.corner[0][z] * x.border[0] + rows_.corner[1][z] * x.border[1];
  return result;
}

TransposedInverse::TransposedInverse(const TransposedSystem& system, Factors& factors, const Overlap& overlap,
                                     double memory_mb)
    : rows_(system.border_rows()), factors_(factors), overlap_(overlap) {
  if (!overlap.zone.empty()) {
    zone_ = rows_of(system.matrix(), overlap.zone);
    ready_ = zone_lu_.factor(zone_, memory_mb) == Factored::done;
    if (!ready_) return;
  }
  for (std::size_t z = 0; z < 2; ++z) {
    columns_[z].assign(overlap.row_of.size(), {});
    for (std::size_t v = 0; v < overlap.row_of.size(); ++v)
      if (overlap.row_of[v] != no_index) columns_[z][v] = factors.columns[z][overlap.row_of[v]];
    small_[z] = {rows_.corner[0][z], rows_.corner[1][z]};
    for (const auto& entry : rows_.lift) small_[z][0] -= columns_[z][entry.vertex][3] * entry.value;
  }
}

void TransposedInverse::apply_to_vertices(Vector& x) {
  Vector rest(zone_.rows.size());
  if (!rest.empty()) {
    for (std::size_t r = 0; r < rest.size(); ++r) rest[r] = x[zone_.rows[r]];
    zone_lu_.solve_transposed(rest, 1);
    add_transposed(zone_, -1.0, rest, x);
  }
  Vector earlier(overlap_.rows, {0, 0, 0, 0});
  for (std::size_t v = 0; v < x.size(); ++v)
    if (overlap_.row_of[v] != no_index) earlier[overlap_.row_of[v]] = x[v];
  factors_.lu.solve_transposed(earlier, 1);
  for (std::size_t v = 0; v < x.size(); ++v)
    x[v] = overlap_.row_of[v] != no_index ? earlier[overlap_.row_of[v]] : std::array<double, 4>{};
  for (std::size_t r = 0; r < rest.size(); ++r)
    for (std::size_t k = 0; k < 4; ++k) x[zone_.rows[r]][k] += rest[r][k];
}

void TransposedInverse::apply(Increment& x) {
  const double s0 = x.border[0] - inner(columns_[0], x.q), s1 = x.border[1] - inner(columns_[1], x.q);
  const double determinant = small_[0][0] * small_[1][1] - small_[0][1] * small_[1][0];
  x.border = {(s0 * small_[1][1] - small_[0][1] * s1) / determinant,
              (small_[0][0] * s1 - small_[1][0] * s0) / determinant};
  for (const auto& entry : rows_.lift) x.q[entry.vertex][3] -= entry.value * x.border[0];
  apply_to_vertices(x.q);
}

// Preconditioned from the right, so that the residual is that of the system itself. It is kept as small as
// rounding lets it by beginning anew once.
bool solve_transposed(const TransposedSystem& system, TransposedInverse& inverse, const Increment& right,
                      const TransposedLimits& limits, Increment& guess, int& iterations) {
  const std::size_t n = right.q.size();
  const double size_of_right = std::sqrt(inner(right, right)), wanted = limits.tolerance * size_of_right;
  Increment x = zero(n), residual = right;
  if (guess.q.size() == n) {
    add_times(residual, -1.0, system.times(guess));
    if (std::sqrt(inner(residual, residual)) < size_of_right)
      x = std::move(guess);
    else
      residual = right;
  }
  const int before = iterations;
  for (int round = 0; round < 2; ++round) {
    const double beta = std::sqrt(inner(residual, residual));
    if (!(beta > wanted)) break;
    std::vector<Increment> basis(1, zero(n)), solved;
    add_times(basis[0], 1.0 / beta, residual);
    Triangle triangle(beta);
    for (int step = 0; step < most_steps; ++step) {
      if (iterations - before >= limits.most_solves) return false;
      if (limits.observer != nullptr && limits.observer->cancelled()) return false;
      solved.push_back(basis.back());
      inverse.apply(solved.back());
      ++iterations;
      Increment next = system.times(solved.back());
      std::vector<double> column;
      for (const Increment& b : basis) {
        column.push_back(inner(b, next));
        add_times(next, -column.back(), b);
      }
      const double size = std::sqrt(inner(next, next));
      column.push_back(size);
      const double left = triangle.add(std::move(column));
      if (!(left > wanted) || size == 0.0) break;
      basis.push_back(zero(n));
      add_times(basis.back(), 1.0 / size, next);
    }
    const std::vector<double> y = triangle.solution();
    for (std::size_t i = 0; i < y.size(); ++i) add_times(x, y[i], solved[i]);
    residual = right;
    add_times(residual, -1.0, system.times(x));
  }
  constexpr double slack = 10.0;  // rounding of the residual itself
  guess = std::move(x);
  return std::sqrt(inner(residual, residual)) <= slack * wanted;
}

std::optional<std::vector<Total>> totals(const Euler& euler, const State& state, const BlockRows& matrix,
                                         Factors& factors, const Overlap& overlap, const FlowOptions& options,
                                         std::span<const ForceSlope> functions,
                                         std::vector<Increment>& multipliers, double most_solves,
                                         int& iterations) {
  const TransposedSystem system(euler, state, matrix);
  TransposedInverse inverse(system, factors, overlap, options.memory_mb);
  if (!inverse.ready()) return std::nullopt;
  multipliers.resize(functions.size());
  constexpr double least = 1e-12, most = 1e-8;  // rounding allows no less
  const double tolerance = std::clamp(options.tolerance, least, most);
  std::vector<Vector> weights;
  for (std::size_t i = 0; i < functions.size(); ++i) {
    Increment right = zero(euler.mesh().size());
    for (std::size_t v = 0; v < right.q.size(); ++v) right.q[v][3] = functions[i].pressure[v];
    right.border[1] = functions[i].alpha;
    const int before = iterations;
    const TransposedLimits limits{tolerance, most_solves, options.observer};
    if (!solve_transposed(system, inverse, right, limits, multipliers[i], iterations)) return std::nullopt;
    most_solves -= iterations - before;
    weights.push_back(multipliers[i].q);
  }
  const std::vector<ShapeSlope> by_residual = euler.residual_slopes(state, weights);
  const ForceSlope lift = euler.force_slope(state, {.lift = 1.0});
  std::vector<Total> result;
  for (std::size_t i = 0; i < functions.size(); ++i) {
    // The border's equations are "lift of the walls = lift of the vortex" and "angle, or lift = the given
    // one", whose derivative by the given one is -1.
    const auto [by_lift, by_condition] = multipliers[i].border;
    Total& total = result.emplace_back(Total{.shape = functions[i].shape, .condition = by_condition});
    for (std::size_t v = 0; v < total.shape.points.size(); ++v)
      total.shape.points[v] =
          total.shape.points[v] - by_residual[i].points[v] - by_lift * lift.shape.points[v];
    total.shape.mach += -by_residual[i].mach - by_lift * lift.shape.mach;
  }
  return result;
}

}  // namespace remodel::flow
