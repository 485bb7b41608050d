// Evaluations to a target, against an independent CMA-ES: pagmo's (F. Biscani and D. Izzo, "A parallel global
// multiobjective framework for optimization: pagmo", 2020).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>

#include "design/test_functions.h"
#include "remodel/cmaes.h"

namespace {

using remodel::test::Problem;

constexpr int limit = 40000;
constexpr unsigned runs = 15;

// Counted in whole generations, as pagmo's population shows its best only then.
int ours(const Problem& problem, unsigned seed) {
  remodel::Cmaes search(problem.start, {.sigma = problem.sigma, .seed = seed});
  double best = std::numeric_limits<double>::infinity();
  for (int evaluations = 1; evaluations <= limit; ++evaluations) {
    const std::vector<double> x = search.ask();
    const double value = problem.function(x);
    best = std::min(best, value);
    if (search.tell(x, value) && best <= problem.target) return evaluations;
  }
  return limit;
}

// pagmo does not keep samples within the bounds unless asked to, but takes their width as the unit of sigma.
constexpr double half_width = 10.0;

struct PagmoProblem {
  const Problem* problem = nullptr;
  std::vector<double> fitness(const std::vector<double>& x) const { return {problem->function(x)}; }
  std::pair<std::vector<double>, std::vector<double>> get_bounds() const {
    const std::size_t n = problem->start.size();
    return {std::vector<double>(n, -half_width), std::vector<double>(n, half_width)};
  }
  template <typename Archive>
  void serialize(Archive&, unsigned) {}  // pagmo asks for it; nothing is archived here
};

int pagmos(const Problem& problem, unsigned seed) {
  const int samples = remodel::Cmaes(problem.start, {}).population();
  // The distribution starts at the population's best individual: all of them are the start.
  pagmo::population individuals(pagmo::problem(PagmoProblem{&problem}), 0U, seed);
  for (int i = 0; i < samples; ++i) individuals.push_back(problem.start);
  const pagmo::cmaes generation(1, -1, -1, -1, -1, problem.sigma / (2.0 * half_width), 0.0, 0.0, true, false,
                                seed);
  int evaluations = 0;
  while (evaluations < limit && individuals.champion_f()[0] > problem.target) {
    individuals = generation.evolve(individuals);
    evaluations += samples;
  }
  return evaluations;
}

struct Spread {
  int least, median, most;
};

Spread spread(const std::function<int(unsigned)>& evaluations_of) {
  std::vector<int> counts;
  for (unsigned seed = 1; seed <= runs; ++seed) counts.push_back(evaluations_of(seed));
  std::sort(counts.begin(), counts.end());
  return {counts.front(), counts[runs / 2], counts.back()};
}

TEST(CmaesOracle, NeedsAsManyEvaluationsAsPagmoWithinItsSpreadOverSeeds) {
  std::cout << "seeds 1 to " << runs << ": least, median, most evaluations to the target\n";
  for (const Problem& problem : remodel::test::smooth_problems()) {
    const Spread mine = spread([&](unsigned seed) { return ours(problem, seed); });
    const Spread theirs = spread([&](unsigned seed) { return pagmos(problem, seed); });
    std::cout << problem.name << ": ours " << mine.least << ' ' << mine.median << ' ' << mine.most
              << ", pagmo " << theirs.least << ' ' << theirs.median << ' ' << theirs.most << '\n';
    EXPECT_LT(mine.median, limit) << problem.name;
    EXPECT_GE(mine.median, theirs.least) << problem.name;
    EXPECT_LE(mine.median, theirs.most) << problem.name;
  }
}

}  // namespace
