#include "flow/linear/gmres.h"

#include <cmath>

namespace remodel::flow {

namespace {

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

}  // namespace

template <std::size_t N>
GmresEnd gmres_of(const std::function<BlockIncrement<N>(const BlockIncrement<N>&)>& times,
                  const std::function<void(BlockIncrement<N>&)>& precondition, const BlockIncrement<N>& right,
                  const GmresLimits& limits, BlockIncrement<N>& x) {
  using Step = BlockIncrement<N>;
  Step residual = right;
  GmresEnd end{.residual = norm(right), .iterations = 0};
  if (x.q.size() == right.q.size()) {
    add_times(residual, -1.0, times(x));
    if (const double size = norm(residual); size < end.residual)
      end.residual = size;
    else
      residual = right, x = zero_of<N>(right.q.size());
  } else {
    x = zero_of<N>(right.q.size());
  }
  for (int round = 0; round < limits.rounds && end.residual > limits.wanted; ++round) {
    std::vector<Step> basis(1, zero_of<N>(right.q.size())), solved;
    add_times(basis[0], 1.0 / end.residual, residual);
    Triangle triangle(end.residual);
    for (int step = 0; step < limits.restart; ++step) {
      if (end.iterations >= limits.most_iterations ||
          (limits.observer != nullptr && limits.observer->cancelled())) {
        end.in_time = false;
        return end;
      }
      Step direction = basis.back();
      precondition(direction);
      ++end.iterations;
      Step next = times(direction);
      if (solved.size() < gmres_kept) solved.push_back(std::move(direction));
      std::vector<double> column;
      for (const Step& b : basis) {
        column.push_back(inner(b, next));
        add_times(next, -column.back(), b);
      }
      const double size = norm(next);
      column.push_back(size);
      const double left = triangle.add(std::move(column));
      if (!(left > limits.wanted) || size == 0.0) break;
      basis.push_back(zero_of<N>(right.q.size()));
      add_times(basis.back(), 1.0 / size, next);
    }
    const std::vector<double> y = triangle.solution();
    for (std::size_t i = 0; i < std::min(y.size(), solved.size()); ++i) add_times(x, y[i], solved[i]);
    if (y.size() > solved.size()) {
      Step sum = zero_of<N>(right.q.size());
      for (std::size_t i = solved.size(); i < y.size(); ++i) add_times(sum, y[i], basis[i]);
      precondition(sum);
      add_times(x, 1.0, sum);
    }
    residual = right;
    add_times(residual, -1.0, times(x));
    end.residual = norm(residual);
  }
  return end;
}

template GmresEnd gmres_of<4>(const std::function<BlockIncrement<4>(const BlockIncrement<4>&)>&,
                              const std::function<void(BlockIncrement<4>&)>&, const BlockIncrement<4>&,
                              const GmresLimits&, BlockIncrement<4>&);
template GmresEnd gmres_of<5>(const std::function<BlockIncrement<5>(const BlockIncrement<5>&)>&,
                              const std::function<void(BlockIncrement<5>&)>&, const BlockIncrement<5>&,
                              const GmresLimits&, BlockIncrement<5>&);

}  // namespace remodel::flow
