#include "design/augmented_lagrangian.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "design/test_functions.h"
#include "remodel/designer.h"
#include "remodel/error.h"

namespace remodel {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

struct ConstrainedProblem {
  std::string name;
  std::function<double(const std::vector<double>&)> objective;
  std::function<std::vector<double>(const std::vector<double>&)> constraints;
  std::vector<double> start;
  double sigma;
  double optimum;

  Evaluation operator()(const std::vector<double>& x) const {
    return {.objective = objective(x), .constraints = constraints(x)};
  }
};

double sphere_of(const std::vector<double>& x) {
  return test::sphere(x);
}

ConstrainedProblem sphere_above_a_plane(double unit = 1.0, double distance = 1.0) {
  return {"sphere above a plane in units of " + std::to_string(unit),
          sphere_of,
          [=](const auto& x) { return std::vector<double>{unit * (distance - x[0])}; },
          std::vector<double>(10, 2.0),
          0.5,
          distance * distance};
}

std::vector<ConstrainedProblem> constrained_problems() {
  const auto two_planes = [](double a, double b) {
    return [=](const auto& x) {
      return std::vector<double>{a * (1.0 - x[0]), b * (3.0 - x[0] - 2.0 * x[1])};
    };
  };
  const auto sum = [](const auto& x) { return -x[0] - x[1]; };
  const auto in_ball = [](const auto& x) { return std::vector<double>{test::sphere(x) - 1.0}; };
  const auto above_a_plane_in_a_large_ball = [](const auto& x) {
    return std::vector<double>{1.0 - x[0], test::sphere(x) - 30.0};
  };
  const std::vector<double> twos(10, 2.0);
  return {sphere_above_a_plane(),
          sphere_above_a_plane(1e6),
          sphere_above_a_plane(1e-6),
          {"infeasible start", sphere_of, sphere_above_a_plane(1.0, 5.0).constraints, twos, 0.3, 25.0},
          {"two planes", sphere_of, two_planes(1.0, 1.0), twos, 0.5, 2.0},
          {"two planes in other units", sphere_of, two_planes(1e6, 1e-6), twos, 0.5, 2.0},
          {"ball, infeasible start", sum, in_ball, twos, 0.5, -std::sqrt(2.0)},
          {"active and inactive", sphere_of, above_a_plane_in_a_large_ball, twos, 0.5, 1.0}};
}

// By how much the best design within all constraints is above the optimum.
class BestWithin {
 public:
  explicit BestWithin(double optimum) : optimum_(optimum) {}
  void add(const Evaluation& evaluation) {
    if (violation_of(evaluation.constraints) == 0.0) best_ = std::min(best_, evaluation.objective);
  }
  double excess() const { return best_ - optimum_; }

 private:
  double optimum_;
  double best_ = infinite;
};

double excess_of_the_designer(const ConstrainedProblem& problem, std::uint64_t seed, int evaluations) {
  CmaesDesigner designer(problem.start, {.sigma = problem.sigma, .seed = seed});
  BestWithin best(problem.optimum);
  for (int i = 0; i < evaluations; ++i) {
    const Proposal proposal = designer.ask();
    const Evaluation evaluation = problem(proposal.design);
    best.add(evaluation);
    designer.tell(proposal, evaluation);
  }
  return best.excess();
}

// K. Deb, 2000: feasible ones by their objective, the others behind them by their violation.
double excess_by_debs_rules(const ConstrainedProblem& problem, std::uint64_t seed, int evaluations) {
  Cmaes search(problem.start, {.sigma = problem.sigma, .seed = seed});
  BestWithin best(problem.optimum);
  for (int i = 0; i < evaluations; ++i) {
    const std::vector<double> x = search.ask();
    const Evaluation evaluation = problem(x);
    best.add(evaluation);
    const double violation = violation_of(evaluation.constraints);
    search.tell(x, violation == 0.0 ? evaluation.objective : 1e300 * (1.0 + violation / (1.0 + violation)));
  }
  return best.excess();
}

TEST(ConstrainedDesigner, ComesFarNearerToTheOptimumThanDebsRulesWithAsManyEvaluations) {
  for (const ConstrainedProblem& problem : constrained_problems()) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      SCOPED_TRACE(problem.name + " seed " + std::to_string(seed));
      const double excess = excess_of_the_designer(problem, seed, 4000);
      EXPECT_GE(excess, -1e-12);
      EXPECT_LT(excess, 1e-6);
      EXPECT_LT(excess, 1e-2 * excess_by_debs_rules(problem, seed, 4000));
    }
  }
}

// The proposals of the two are the same for so many evaluations.
void expect_same_proposals(CmaesDesigner& a, CmaesDesigner& b, int evaluations,
                           const std::function<Evaluation(const std::vector<double>&, int)>& of_a,
                           const std::function<Evaluation(const std::vector<double>&, int)>& of_b) {
  for (int i = 0; i < evaluations; ++i) {
    const Proposal proposal = a.ask();
    ASSERT_EQ(proposal.design, b.ask().design) << i;
    a.tell(proposal, of_a(proposal.design, i));
    b.tell(proposal, of_b(proposal.design, i));
  }
}

TEST(ConstrainedDesigner, DoesNotDependOnTheUnitsOfObjectiveAndConstraints) {
  const auto problem = constrained_problems()[4];
  const auto in_units = [&](double of_objective, double of_first, double of_second) {
    return [=](const auto& x, int) {
      const Evaluation one = problem(x);
      return Evaluation{.objective = of_objective * one.objective,
                        .constraints = {of_first * one.constraints[0], of_second * one.constraints[1]}};
    };
  };
  CmaesDesigner a(problem.start, {.sigma = 0.5, .seed = 3}), b(problem.start, {.sigma = 0.5, .seed = 3});
  expect_same_proposals(a, b, 2000, in_units(1.0, 1.0, 1.0), in_units(0x1p-10, 0x1p20, 0x1p-20));
}

TEST(ConstrainedDesigner, IsTheSearchWithoutConstraintsWhereNoneIsEverViolated) {
  CmaesDesigner free({1.0, -1.0, 2.0}, {.sigma = 0.5, .seed = 4}),
      within({1.0, -1.0, 2.0}, {.sigma = 0.5, .seed = 4});
  const auto fails = [](int i) { return i % 7 == 3; };
  expect_same_proposals(
      free, within, 1000,
      [&](const auto& x, int i) {
        return fails(i) ? Evaluation{} : Evaluation{.objective = test::sphere(x)};
      },
      [&](const auto& x, int i) {
        return fails(i) ? Evaluation{}
                        : Evaluation{.objective = test::sphere(x), .constraints = {-1e9, x[0] - 1e9}};
      });
}

TEST(ConstrainedDesigner, LeavesAConstraintThatIsInactiveAtTheOptimum) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const ConstrainedProblem problem{"",
                                     sphere_of,
                                     [](const auto& x) { return std::vector<double>{test::sphere(x) - 9.0}; },
                                     std::vector<double>(6, 3.0),
                                     0.5,
                                     0.0};
    EXPECT_LT(excess_of_the_designer(problem, seed, 3000), 1e-20) << "seed " << seed;
  }
}

TEST(ConstrainedDesigner, ComesBackFromFarOutsideWhereTheObjectiveLeadsFurther) {
  const ConstrainedProblem problem{"",
                                   [](const auto& x) { return -x[0] - x[1]; },
                                   [](const auto& x) { return std::vector<double>{test::sphere(x) - 1.0}; },
                                   std::vector<double>(6, 10.0),
                                   1.0,
                                   -std::sqrt(2.0)};
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    EXPECT_LT(excess_of_the_designer(problem, seed, 1200), 0.1) << "seed " << seed;
}

// A design fails altogether, or has a constraint that is no number, or one too few.
Evaluation with_failures(const ConstrainedProblem& problem, const std::vector<double>& x, int i) {
  Evaluation evaluation = problem(x);
  if (i % 11 == 5) evaluation.objective = infinite;
  if (i % 13 == 7) evaluation.constraints[1] = not_a_number;
  if (i % 17 == 3) evaluation.constraints.pop_back();
  if (i % 19 == 0) evaluation = {};
  return evaluation;
}

TEST(ConstrainedDesigner, GoesOnToTheSameDesignsFromAStateSavedAnywhereInAGeneration) {
  const auto problem = constrained_problems()[4];
  const auto evaluate = [&](const auto& x, int i) { return with_failures(problem, x, i); };
  CmaesDesigner designer(problem.start, {.sigma = 0.5, .seed = 6});
  for (int i = 0; i < 600; ++i) {
    const Proposal proposal = designer.ask();
    designer.tell(proposal, evaluate(proposal.design, i));
  }
  for (int i = 0; i < 80; ++i) {
    CmaesDesigner first(problem.start, {}), second(problem.start, {});
    first.restore(designer.state(), "test");
    second.restore(designer.state(), "test");
    ASSERT_EQ(first.state(), designer.state());
    for (int k = i; k < i + 25; ++k) {
      const Proposal proposal = first.ask();
      first.tell(proposal, evaluate(proposal.design, k));
      second.restore(second.state(), "test");
      ASSERT_EQ(second.ask().design, proposal.design) << i << ' ' << k;
      second.tell(proposal, evaluate(proposal.design, k));
    }
    ASSERT_EQ(first.state(), second.state()) << i;
    const Proposal proposal = designer.ask();
    designer.tell(proposal, evaluate(proposal.design, i));
  }
}

TEST(ConstrainedDesigner, ReadsTheStateOfASearchWithoutConstraints) {
  Cmaes search({1.0, 2.0, 3.0}, {.sigma = 0.5, .seed = 8});
  for (int i = 0; i < 40; ++i) {
    const auto x = search.ask();
    search.tell(x, test::sphere(x));
  }
  CmaesDesigner designer({0.0, 0.0, 0.0}, {});
  designer.restore(search.state(), "test");
  EXPECT_EQ(designer.state(), search.state());
  for (int i = 0; i < 40; ++i) {
    const Proposal proposal = designer.ask();
    ASSERT_EQ(proposal.design, search.ask());
    designer.tell(proposal, {.objective = test::sphere(proposal.design)});
    search.tell(proposal.design, test::sphere(proposal.design));
  }
}

TEST(ConstrainedDesigner, RefusesAStateThatIsNone) {
  const auto problem = sphere_above_a_plane();
  CmaesDesigner designer(problem.start, {}), other(problem.start, {});
  for (int i = 0; i < 35; ++i) {
    const Proposal proposal = designer.ask();
    designer.tell(proposal, problem(proposal.design));
  }
  const std::string good = designer.state();
  EXPECT_NO_THROW(other.restore(good, "test"));
  for (std::size_t length = 0; length < good.size(); length += 37)
    EXPECT_THROW(other.restore(good.substr(0, length), "test"), Error);
  const auto refused = [&](const std::function<void(nlohmann::json&)>& change) {
    auto json = nlohmann::json::parse(good);
    change(json);
    EXPECT_THROW(other.restore(json.dump(), "test"), Error) << json.dump().substr(0, 200);
  };
  refused([](auto& json) { json["version"] = 2; });
  refused([](auto& json) { json.erase("cmaes"); });
  refused([](auto& json) { json["lagrangian"]["penalties"].push_back(1.0); });
  refused([](auto& json) { json["lagrangian"]["penalties"][0] = -1.0; });
  refused([](auto& json) { json["lagrangian"]["mean"]["constraints"].push_back(1.0); });
  refused([](auto& json) { json["told"][0]["constraints"].push_back(1.0); });
  refused([](auto& json) { json["told"][0]["design"].push_back(1.0); });
  refused([](auto& json) { json["told"][0]["objective"] = nullptr; });
  refused([](auto& json) {
    for (int i = 0; i < 10; ++i) json["told"].push_back(json["told"][0]);
  });
  EXPECT_EQ(other.state(), good);
}

TEST(ConstrainedDesigner, RanksWhatCannotBeComparedBehindAllElse) {
  const std::vector<Evaluation> bad = {{},
                                       {.objective = -9.0},
                                       {.objective = -9.0, .constraints = {-1.0}},
                                       {.objective = -9.0, .constraints = {-1.0, not_a_number}},
                                       {.objective = -9.0, .constraints = {-1.0, -infinite}},
                                       {.objective = not_a_number, .constraints = {-1.0, -1.0}},
                                       {.objective = infinite, .constraints = {-1.0, -1.0}}};
  const auto state_after = [](const Evaluation& second) {
    CmaesDesigner designer({0.0, 0.0}, {.sigma = 1.0, .seed = 1, .population = 4});
    const std::vector<Evaluation> told = {{.objective = 1.0, .constraints = {1e3, -1.0}},
                                          second,
                                          {.objective = 3.0, .constraints = {-1.0, 2.0}},
                                          {.objective = 4.0, .constraints = {-1.0, -1.0}}};
    std::vector<Proposal> asked;
    for (std::size_t i = 0; i < told.size(); ++i) asked.push_back(designer.ask());
    for (std::size_t i = 0; i < told.size(); ++i) designer.tell(asked[i], told[i]);
    EXPECT_EQ(designer.generation(), 1U);
    return designer.state();
  };
  for (std::size_t i = 0; i < bad.size(); ++i) EXPECT_EQ(state_after(bad[i]), state_after(bad[0])) << i;
  EXPECT_NE(state_after({.objective = -9.0, .constraints = {-1.0, -1.0}}), state_after(bad[0]));
}

TEST(ConstrainedDesigner, EndsGenerationsInWhichAllFails) {
  CmaesDesigner designer({0.0, 0.0}, {.population = 4});
  for (int i = 0; i < 400; ++i) {
    const Proposal proposal = designer.ask();
    if (i % 8 == 0) {
      designer.tell(proposal, {.objective = proposal.design[0], .constraints = {proposal.design[1]}});
    } else {
      designer.tell(proposal, {.constraints = {not_a_number}});
    }
  }
  EXPECT_EQ(designer.generation(), 100U);
}

TEST(ConstrainedDesigner, StaysFiniteOnConstraintsThatCannotBeMet) {
  const auto run = [](const auto& constraints) {
    CmaesDesigner designer(std::vector<double>(4, 1.0), {.sigma = 0.5, .seed = 2});
    for (int i = 0; i < 40000; ++i) {
      const Proposal proposal = designer.ask();
      for (const double v : proposal.design) ASSERT_TRUE(std::isfinite(v));
      designer.tell(proposal, {.objective = test::sphere(proposal.design),
                               .constraints = constraints(proposal.design)});
    }
    EXPECT_EQ(designer.state().find("null"), std::string::npos) << designer.state();
  };
  run([](const auto& x) { return std::vector<double>{1.0 - x[0], x[0] + 1.0}; });
  run([](const auto&) { return std::vector<double>{1.0}; });
  run([](const auto& x) { return std::vector<double>{std::pow(1.0 - x[0], 3.0)}; });
  run([](const auto& x) { return std::vector<double>{1e200 * (1.0 - x[0])}; });
}

// Two constraints, the second never violated.
TEST(AugmentedLagrangian, HasTheValuesOfItsFormula) {
  const std::vector<Evaluation> generation = {{.objective = 1.0, .constraints = {2.0, -1.0}},
                                              {.objective = 3.0, .constraints = {-2.0, -5.0}},
                                              {.objective = 2.0, .constraints = {0.5, -3.0}}};
  const std::vector<double> weights = {0.75, 0.25};
  AugmentedLagrangian lagrangian(2);
  const double penalty = 5.0 * 2.0 / (2.0 * 4.0 * 4.0);
  EXPECT_EQ(lagrangian.rank(generation, weights),
            (std::vector<double>{1.0 + 0.5 * penalty * 4.0, 3.0, 2.0 + 0.5 * penalty * 0.25}));
  // The first is best, the third is next.
  const double multiplier = penalty * (0.75 * 2.0 + 0.25 * 0.5) / 5.0;
  const auto next = lagrangian.rank(generation, weights);
  EXPECT_DOUBLE_EQ(next[0], 1.0 + multiplier * 2.0 + 0.5 * penalty * 4.0);
  EXPECT_DOUBLE_EQ(next[1], 3.0 - multiplier * multiplier / (2.0 * penalty));
  EXPECT_DOUBLE_EQ(next[2], 2.0 + multiplier * 0.5 + 0.5 * penalty * 0.25);
  EXPECT_EQ(lagrangian.state().at("penalties")[1], 0.0);
}

TEST(AugmentedLagrangian, LeavesThePenaltyOfAConstraintThatBecomesInactive) {
  AugmentedLagrangian lagrangian(2);
  const auto state_after = [&](double constraint) {
    const std::vector<Evaluation> generation = {{.objective = 1.0, .constraints = {constraint}},
                                                {.objective = 2.0, .constraints = {constraint + 1.0}}};
    lagrangian.rank(generation, std::vector<double>{0.5, 0.5});
    return lagrangian.state();
  };
  state_after(0.0);
  const double penalty = state_after(-10.0).at("penalties")[0];
  EXPECT_GT(penalty, 0.0);
  for (int i = 0; i < 100; ++i) {
    const auto state = state_after(-10.0 - i % 3);
    EXPECT_EQ(state.at("penalties")[0], penalty);
    EXPECT_EQ(state.at("multipliers")[0], 0.0);
  }
}

TEST(AugmentedLagrangian, FindsTheMultiplier) {
  const auto problem = sphere_above_a_plane();
  Cmaes search(problem.start, {.sigma = 0.5, .seed = 5});
  AugmentedLagrangian lagrangian(search.dimension());
  for (int generation = 0; generation < 400; ++generation) {
    std::vector<std::vector<double>> samples;
    std::vector<Evaluation> evaluations;
    for (int i = 0; i < search.population(); ++i) {
      samples.push_back(search.ask());
      evaluations.push_back(problem(samples.back()));
    }
    const auto values = lagrangian.rank(evaluations, search.weights());
    for (std::size_t i = 0; i < samples.size(); ++i) search.tell(samples[i], values[i]);
  }
  EXPECT_NEAR(lagrangian.state().at("multipliers")[0].get<double>(), 2.0, 1e-3);
}

}  // namespace
}  // namespace remodel
