#include "design/quadratic_program.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace remodel {

namespace {

using Eigen::ArrayXd, Eigen::MatrixXd, Eigen::VectorXd;

// In units in which ranges, rows and the objective's slopes are about 1; bounds are rows as well.
struct Scaled {
  MatrixXd h, a;
  VectorXd g, b;
  VectorXd unit, size;  // of variables, of rows but bounds
  double slope;         // of the objective
};

Scaled scaled(const QuadraticProgram& program) {
  const auto n = static_cast<Eigen::Index>(program.g.size());
  const auto rows = static_cast<Eigen::Index>(program.a.size());
  const auto at = [](const std::vector<double>& list, Eigen::Index i) {
    return list[static_cast<std::size_t>(i)];
  };
  Scaled result{MatrixXd(n, n),
                MatrixXd::Zero(rows + 2 * n, n),
                VectorXd(n),
                VectorXd(rows + 2 * n),
                VectorXd(n),
                VectorXd(rows),
                0.0};
  for (Eigen::Index i = 0; i < n; ++i)
    result.unit(i) = std::max({std::fabs(at(program.low, i)), std::fabs(at(program.high, i)), 1e-300});
  for (Eigen::Index i = 0; i < n; ++i) {
    result.g(i) = at(program.g, i) * result.unit(i);
    for (Eigen::Index j = 0; j < n; ++j)
      result.h(i, j) = at(program.h, i * n + j) * result.unit(i) * result.unit(j);
    result.a(rows + i, i) = 1.0, result.b(rows + i) = at(program.high, i) / result.unit(i);
    result.a(rows + n + i, i) = -1.0, result.b(rows + n + i) = -at(program.low, i) / result.unit(i);
  }
  for (Eigen::Index r = 0; r < rows; ++r) {
    for (Eigen::Index i = 0; i < n; ++i)
      result.a(r, i) = program.a[static_cast<std::size_t>(r)][static_cast<std::size_t>(i)] * result.unit(i);
    result.size(r) = std::max(result.a.row(r).norm(), 1e-300);
    result.a.row(r) /= result.size(r);
    result.b(r) = at(program.b, r) / result.size(r);
  }
  result.slope = std::max(result.g.cwiseAbs().maxCoeff(), 1e-300);
  result.g /= result.slope, result.h /= result.slope;
  return result;
}

// How far x may go along dx and stay positive, 1 at most.
double longest(const ArrayXd& x, const ArrayXd& dx) {
  double length = 1.0;
  for (Eigen::Index i = 0; i < x.size(); ++i)
    if (dx(i) < 0.0) length = std::min(length, -x(i) / dx(i));
  return length;
}

}  // namespace

QuadraticSolution solved(const QuadraticProgram& program) {
  constexpr int most_steps = 100;
  constexpr double accuracy = 1e-11, back_off = 0.995;
  const Scaled within = scaled(program);
  const MatrixXd &h = within.h, &a = within.a;
  const VectorXd &g = within.g, &b = within.b;
  VectorXd x = VectorXd::Zero(g.size());
  ArrayXd slack = (b - a * x).array().max(1.0), price = ArrayXd::Ones(b.size());
  for (int step = 0; step < most_steps; ++step) {
    const VectorXd dual = h * x + g + a.transpose() * price.matrix();
    const ArrayXd primal = (a * x - b).array() + slack;
    const double gap = (slack * price).mean();
    if (dual.cwiseAbs().maxCoeff() < accuracy && primal.abs().maxCoeff() < accuracy && gap < accuracy) break;
    const Eigen::LDLT<MatrixXd> matrix(h + a.transpose() * (price / slack).matrix().asDiagonal() * a);
    VectorXd dx;
    ArrayXd ds, dp;
    const auto solve = [&](const ArrayXd& wanted) {  // what slack times price is to change by
      dx = matrix.solve(-dual - a.transpose() * ((wanted + price * primal) / slack).matrix());
      ds = -primal - (a * dx).array();
      dp = (wanted - price * ds) / slack;
    };
    solve(-slack * price);
    const double reach = std::min(longest(slack, ds), longest(price, dp));
    const double predicted = ((slack + reach * ds) * (price + reach * dp)).mean();
    const double centring = std::pow(predicted / gap, 3);
    solve(centring * gap - slack * price - ds * dp);
    const double length = back_off * std::min(longest(slack, ds), longest(price, dp));
    if (!dx.allFinite() || !(length > 0.0)) break;
    x += length * dx, slack += length * ds, price += length * dp;
  }
  QuadraticSolution result;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    result.x.push_back(std::clamp(x(i) * within.unit(i), program.low[k], program.high[k]));
  }
  for (Eigen::Index r = 0; r < within.size.size(); ++r)
    result.multipliers.push_back(price(r) * within.slope / within.size(r));
  return result;
}

}  // namespace remodel
