#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "design/quadratic_program.h"
#include "remodel/error.h"
#include "remodel/sqp.h"

namespace remodel {
namespace {

// J. Nocedal and S. J. Wright, "Numerical Optimization", 2nd ed. (2006), example 16.4.
TEST(QuadraticPrograms, OfABookHaveItsSolution) {
  const QuadraticSolution solution = solved({.h = {2, 0, 0, 2},
                                             .g = {-2, -5},
                                             .a = {{-1, 2}, {1, 2}, {1, -2}},
                                             .b = {2, 6, 2},
                                             .low = {0, 0},
                                             .high = {1e3, 1e3}});
  EXPECT_NEAR(solution.x.at(0), 1.4, 1e-7);
  EXPECT_NEAR(solution.x.at(1), 1.7, 1e-7);
  EXPECT_NEAR(solution.multipliers.at(0), 0.8, 1e-7);  // of the only row that holds x
  EXPECT_NEAR(solution.multipliers.at(1), 0.0, 1e-7);
  EXPECT_NEAR(solution.multipliers.at(2), 0.0, 1e-7);
}

TEST(QuadraticPrograms, WithoutCurvatureEndInACorner) {
  const QuadraticSolution solution = solved({.h = std::vector<double>(9, 0.0),
                                             .g = {1e-6, -1e-6, 1e-9},
                                             .a = {{0, 1, 1}},
                                             .b = {1e-4},
                                             .low = {-1e-3, -1e-3, -1e-3},
                                             .high = {1e-3, 1e-3, 1e-3}});
  EXPECT_NEAR(solution.x.at(0), -1e-3, 1e-12);
  EXPECT_NEAR(solution.x.at(1), 1e-3, 1e-12);
  EXPECT_NEAR(solution.x.at(2), -1e-3, 1e-10);
}

// A long bent valley beside a constraint: f = 100 (y - x^2)^2 + (1 - x)^2 with x + y <= 1.
TEST(Sqp, FollowsAValleyToTheConstraintFromTheBestDesign) {
  SqpDesigner designer({-1.0, 1.0}, {.trust = 0.2, .low = {-2, -2}, .high = {2, 2}});
  std::vector<double> best = {-1.0, 1.0};
  double least = 1e9;
  for (int i = 0; i < 60 && !designer.finished(); ++i) {
    const Proposal proposal = designer.ask();
    EXPECT_EQ(proposal.from, best) << i;
    const double x = proposal.design.at(0), y = proposal.design.at(1), off = y - x * x;
    const Evaluation evaluation{.objective = 100 * off * off + (1 - x) * (1 - x),
                                .constraints = {x + y - 1},
                                .gradient = {-400 * x * off - 2 * (1 - x), 200 * off},
                                .constraint_gradients = {{1, 1}}};
    designer.tell(proposal, evaluation);
    if (evaluation.objective < least) least = evaluation.objective, best = proposal.design;
  }
  // On the constraint: where 100 (1 - x - x^2)^2 + (1 - x)^2 is least, by a search along it.
  EXPECT_NEAR(best.at(0), 0.6188, 2e-4);
  EXPECT_NEAR(best.at(0) + best.at(1), 1.0, 1e-6);
}

// f = -5000 x under x <= 0.1, over its first value of 1: more than the first penalty would hold.
TEST(Sqp, KeepsConstraintsWhoseViolationWouldPay) {
  SqpDesigner designer({0.0}, {.trust = 0.5, .low = {-2}, .high = {2}});
  double last = 0.0;
  for (int i = 0; i < 20 && !designer.finished(); ++i) {
    const Proposal proposal = designer.ask();
    last = proposal.design.at(0);
    designer.tell(proposal, {.objective = 1.0 - 5000.0 * last,
                             .constraints = {last - 0.1},
                             .gradient = {-5000.0},
                             .constraint_gradients = {{1.0}}});
  }
  EXPECT_NEAR(last, 0.1, 1e-6);
}

// Rosen and Suzuki's problem: two of three curved constraints hold the solution (0, 1, 2, -1). Source: W.
// Hock and K. Schittkowski, "Test Examples for Nonlinear Programming Codes" (1981), problem 43. The objective
// is 1 + size f / 20, the constraints are in the given unit.
Evaluation rosen_suzuki(const std::vector<double>& x, double size, double unit) {
  const double a = x[0], b = x[1], c = x[2], d = x[3], k = size / 20;
  const double f = a * a + b * b + 2 * c * c + d * d - 5 * a - 5 * b - 21 * c + 7 * d;
  Evaluation result{.objective = 1 + k * f,
                    .constraints = {a * a + b * b + c * c + d * d + a - b + c - d - 8,
                                    a * a + 2 * b * b + c * c + 2 * d * d - a - d - 10,
                                    2 * a * a + b * b + c * c + 2 * a - b - d - 5},
                    .gradient = {k * (2 * a - 5), k * (2 * b - 5), k * (4 * c - 21), k * (2 * d + 7)},
                    .constraint_gradients = {{2 * a + 1, 2 * b - 1, 2 * c + 1, 2 * d - 1},
                                             {2 * a - 1, 4 * b, 2 * c, 4 * d - 1},
                                             {4 * a + 2, 2 * b - 1, 2 * c, -1}}};
  for (double& constraint : result.constraints) constraint *= unit;
  for (std::vector<double>& row : result.constraint_gradients)
    for (double& slope : row) slope *= unit;
  return result;
}

TEST(Sqp, FollowsCurvedConstraintsWhateverTheirUnitsAndTheObjectivesSize) {
  for (const double size : {0.01, 1.0})
    for (const double unit : {0.01, 1.0, 100.0}) {
      SqpDesigner designer({0, 0, 0, 0}, {.trust = 0.2,
                                          .constraint_tolerance = 1e-7 * unit,
                                          .low = std::vector<double>(4, -9.0),
                                          .high = std::vector<double>(4, 9.0)});
      int designs = 0;
      for (; designs < 100 && !designer.finished(); ++designs) {
        const Proposal proposal = designer.ask();
        designer.tell(proposal, rosen_suzuki(proposal.design, size, unit));
      }
      EXPECT_LE(designs, 20) << size << ' ' << unit;
      const Evaluation found = rosen_suzuki(designer.centre(), size, unit);
      EXPECT_NEAR(found.objective, 1 - size * 44 / 20, 1e-5 * size);
      EXPECT_LE(violation_of(found.constraints), 1e-7 * unit);
    }
}

TEST(Sqp, WhoseStartIsRefusedTriesDesignsAroundItAndEnds) {
  SqpOptions options{.trust = 0.1, .other_starts = 6};
  options.low = {0.0, 0.0}, options.high = {1.0, 1.0};
  SqpDesigner designer({0.1, 0.2}, options);
  std::vector<std::vector<double>> tried;
  while (!designer.finished()) {
    SqpDesigner again({0.1, 0.2}, options);
    again.restore(designer.state(), "state");
    const Proposal proposal = designer.ask();
    EXPECT_EQ(again.ask().design, proposal.design);
    EXPECT_TRUE(std::find(tried.begin(), tried.end(), proposal.design) == tried.end());
    const double box = tried.empty() ? 0.0 : 0.1 * std::exp2(static_cast<double>(tried.size()) - 1.0);
    EXPECT_LE(std::fabs(proposal.design.at(0) - 0.1), box);
    EXPECT_GE(proposal.design.at(0), 0.0);
    tried.push_back(proposal.design);
    designer.refuse(proposal);
  }
  EXPECT_EQ(tried.size(), 7u);
  designer.refuse({.design = {0.1, 0.2}});
  EXPECT_TRUE(designer.finished());
}

// f = (x - 1)^2 + 2 y^2 with x <= 0.5.
Evaluation bowl(const std::vector<double>& x) {
  return {.objective = (x[0] - 1) * (x[0] - 1) + 2 * x[1] * x[1],
          .constraints = {x[0] - 0.5},
          .gradient = {2 * (x[0] - 1), 4 * x[1]},
          .constraint_gradients = {{1, 0}}};
}

// Nothing is known of the bowl for x + y < 0, where the start lies.
TEST(Sqp, BeginsBesideAStartThatFails) {
  SqpDesigner designer({-0.1, 0.05}, {.trust = 0.1, .low = {-2, -2}, .high = {2, 2}});
  int failed = 0;
  for (int i = 0; i < 60 && !designer.finished(); ++i) {
    const Proposal proposal = designer.ask();
    const bool is_known = proposal.design[0] + proposal.design[1] >= 0.0;
    failed += !is_known;
    designer.tell(proposal, is_known ? bowl(proposal.design) : Evaluation{});
  }
  EXPECT_GE(failed, 1);
  EXPECT_NEAR(designer.centre()[0], 0.5, 1e-6);
  EXPECT_NEAR(designer.centre()[1], 0.0, 1e-3);
}

TEST(Sqp, GoesOnFromItsStateToTheSameBits) {
  const SqpOptions options{.trust = 0.2, .low = {-2, -2}, .high = {2, 2}};
  SqpDesigner designer({-1.0, 1.0}, options);
  for (int i = 0; i < 40 && !designer.finished(); ++i) {
    SqpDesigner again({-1.0, 1.0}, options);
    again.restore(designer.state(), "state");
    const Proposal proposal = designer.ask();
    EXPECT_EQ(again.ask().design, proposal.design);
    EXPECT_EQ(again.ask().from, proposal.from);
    EXPECT_EQ(again.state(), designer.state());
    designer.tell(proposal, bowl(proposal.design));
  }
  EXPECT_TRUE(designer.finished());
  EXPECT_NEAR(designer.centre()[0], 0.5, 1e-6);
  EXPECT_NEAR(designer.centre()[1], 0.0, 1e-3);
}

// A steep bowl: f = 1000 (x - .3)^2 + (y + .2)^2. The second search needs no step to learn what the first
// knows.
TEST(Sqp, GoesOnWithWhatAnotherSearchHasLearnt) {
  const auto steep = [](const std::vector<double>& x, double shift) {
    return Evaluation{
        .objective = 10 + shift + 1000 * (x[0] - 0.3) * (x[0] - 0.3) + (x[1] + 0.2) * (x[1] + 0.2),
        .gradient = {2000 * (x[0] - 0.3), 2 * (x[1] + 0.2)}};
  };
  const SqpOptions options{.trust = 0.2, .low = {-2, -2}, .high = {2, 2}};
  const auto search = [&](SqpDesigner& designer, double shift) {
    int designs = 0;
    for (; designs < 100 && !designer.finished(); ++designs) {
      const Proposal proposal = designer.ask();
      designer.tell(proposal, steep(proposal.design, shift));
    }
    return designs;
  };
  SqpDesigner coarse({-1.0, 1.0}, options);
  search(coarse, 0.0);
  SqpDesigner cold({0.4, 0.1}, options), warm({0.4, 0.1}, options);
  warm.carry(coarse.state(), "state");
  SqpDesigner resumed({0.4, 0.1}, options);  // before its first design was told
  resumed.restore(warm.state(), "state");
  const int without = search(cold, 5.0), with = search(warm, 5.0);
  EXPECT_LT(with, without);
  EXPECT_EQ(search(resumed, 5.0), with);
  EXPECT_EQ(resumed.state(), warm.state());
  EXPECT_NEAR(warm.centre()[0], 0.3, 1e-4);
}

TEST(Sqp, RefusesStatesOfAnotherNumberOfVariables) {
  SqpDesigner two({0.0, 0.0}, {.low = {-1, -1}, .high = {1, 1}});
  two.tell(two.ask(), bowl({0.0, 0.0}));
  SqpDesigner three({0.0, 0.0, 0.0}, {.low = {-1, -1, -1}, .high = {1, 1, 1}});
  for (const std::string& state : {two.state(), std::string("{}"), std::string("[")})
    EXPECT_THROW(three.restore(state, "checkpoint.json"), Error);
  std::string cut = two.state();
  cut.replace(cut.find("\"curvature\":["), 13, "\"curvature\":[1,");
  EXPECT_THROW(two.restore(cut, "checkpoint.json"), Error);
}

}  // namespace
}  // namespace remodel
