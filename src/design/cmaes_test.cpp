#include "remodel/cmaes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "design/portable_math.h"
#include "design/test_functions.h"
#include "remodel/error.h"

namespace remodel {
namespace {

using test::Problem;

// Evaluations to the target, or limit.
int evaluations_to(const Problem& problem, std::uint64_t seed, int limit) {
  Cmaes search(problem.start, {.sigma = problem.sigma, .seed = seed});
  for (int i = 1; i <= limit; ++i) {
    const std::vector<double> x = search.ask();
    const double value = problem.function(x);
    if (value <= problem.target) return i;
    search.tell(x, value);
  }
  return limit;
}

TEST(Cmaes, ReachesTheMinimumOfSmoothFunctionsFromEverySeed) {
  for (const Problem& problem : test::smooth_problems()) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      SCOPED_TRACE(problem.name + " seed " + std::to_string(seed));
      EXPECT_LT(evaluations_to(problem, seed, 15000), 15000);
    }
  }
}

TEST(Cmaes, FindsTheGlobalMinimumOfRastriginWithALargePopulation) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Cmaes search(std::vector<double>(5, 2.0), {.sigma = 2.0, .seed = seed, .population = 150});
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 30000; ++i) {
      const auto x = search.ask();
      const double value = test::rastrigin(x);
      best = std::min(best, value);
      search.tell(x, value);
    }
    found += best < 1e-8;
  }
  EXPECT_GE(found, 4);
}

TEST(Cmaes, HasTheTutorialsDefaultPopulation) {
  EXPECT_EQ(Cmaes({0.0}, {}).population(), 4);
  EXPECT_EQ(Cmaes(std::vector<double>(12), {}).population(), 11);
  EXPECT_EQ(Cmaes(std::vector<double>(100), {}).population(), 17);
  EXPECT_EQ(Cmaes(std::vector<double>(12), {.population = 20}).population(), 20);
}

TEST(Cmaes, SamplesTheDistributionItSays) {
  const double sigma = 0.25;
  Cmaes search({1.0, -2.0}, {.sigma = sigma, .seed = 7});
  const int count = 100000;
  double sum[2] = {}, squares[2] = {}, product = 0.0;
  for (int i = 0; i < count; ++i) {
    const auto x = search.ask();
    const double d[2] = {(x[0] - 1.0) / sigma, (x[1] + 2.0) / sigma};
    for (int k = 0; k < 2; ++k) {
      sum[k] += d[k];
      squares[k] += d[k] * d[k];
    }
    product += d[0] * d[1];
  }
  const double five_deviations = 5.0 / std::sqrt(count);
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(sum[k] / count, 0.0, five_deviations);
    EXPECT_NEAR(squares[k] / count, 1.0, five_deviations * std::sqrt(2.0));
  }
  EXPECT_NEAR(product / count, 0.0, five_deviations);
}

TEST(Cmaes, GivesTheSameSamplesForTheSameSeedAndOthersForAnother) {
  const Problem problem = test::smooth_problems()[1];
  Cmaes a(problem.start, {.seed = 3}), b(problem.start, {.seed = 3}), c(problem.start, {.seed = 4});
  EXPECT_NE(a.ask(), c.ask());
  b.ask();
  for (int i = 0; i < 2000; ++i) {
    const auto x = a.ask();
    ASSERT_EQ(x, b.ask());
    a.tell(x, problem.function(x));
    b.tell(x, problem.function(x));
  }
  EXPECT_EQ(a.state(), b.state());
}

TEST(Cmaes, GoesOnToTheSameSamplesFromAStateSavedAnywhereInAGeneration) {
  const Problem problem = test::smooth_problems()[2];
  Cmaes search(problem.start, {.sigma = 0.3, .seed = 11});
  const auto step = [&](Cmaes& one) {
    const auto x = one.ask();
    const double value = problem.function(x);
    one.tell(x, value > 100.0 ? std::numeric_limits<double>::quiet_NaN() : value);
    return x;
  };
  for (int i = 0; i < 200; ++i) {
    const std::string saved = search.state();
    Cmaes restored = Cmaes::restore(saved, "test");
    ASSERT_EQ(restored.state(), saved);
    ASSERT_EQ(restored.generation(), search.generation());
    Cmaes goes_on = Cmaes::restore(saved, "test");
    for (int k = 0; k < 25; ++k) ASSERT_EQ(step(restored), step(goes_on));
    step(search);
  }
  Cmaes restored = Cmaes::restore(search.state(), "test");
  for (int k = 0; k < 500; ++k) ASSERT_EQ(step(restored), step(search)) << "after " << k;
}

TEST(Cmaes, UpdatesAfterEveryGenerationAndIgnoresSamplesThatWereNotTold) {
  Cmaes search(std::vector<double>(3, 1.0), {});
  for (int generation = 0; generation < 20; ++generation) {
    for (int i = 1; i <= search.population(); ++i) {
      EXPECT_EQ(search.generation(), static_cast<std::uint64_t>(generation));
      search.ask();  // refused
      const auto x = search.ask();
      EXPECT_EQ(search.tell(x, test::sphere(x)), i == search.population());
    }
  }
}

TEST(Cmaes, RanksInfinityAndNanLast) {
  for (const double bad : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::max()}) {
    Cmaes with_bad(std::vector<double>(4, 1.0), {.sigma = 0.5, .seed = 5});
    Cmaes with_large(std::vector<double>(4, 1.0), {.sigma = 0.5, .seed = 5});
    for (int i = 0; i < 400; ++i) {
      const auto x = with_bad.ask();
      ASSERT_EQ(x, with_large.ask());
      const double value = test::sphere(x);
      with_bad.tell(x, x[0] > 1.0 ? bad : value);
      with_large.tell(x, x[0] > 1.0 ? 1e300 : value);
    }
    EXPECT_LT(test::sphere(with_bad.mean()), 1.0);
  }
}

TEST(Cmaes, StaysInOrderLongAfterConvergence) {
  for (const Problem& problem : test::smooth_problems()) {
    Cmaes search(problem.start, {.sigma = problem.sigma, .seed = 2});
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 60000; ++i) {
      const auto x = search.ask();
      ASSERT_TRUE(std::all_of(x.begin(), x.end(), [](double v) { return std::isfinite(v); })) << problem.name;
      const double value = problem.function(x);
      best = std::min(best, value);
      search.tell(x, value);
    }
    EXPECT_LT(best, 1e-28) << problem.name;
    EXPECT_LE(problem.function(search.mean()), 1e-25) << problem.name;
  }
}

TEST(Cmaes, KeepsTheLeastDeviationAskedFor) {
  Cmaes search(std::vector<double>(4, 1.0), {.sigma = 0.5, .seed = 6, .least_deviation = 1e-4});
  double farthest = 0.0;
  for (int i = 0; i < 10000; ++i) {
    const auto x = search.ask();
    if (i > 9000) farthest = std::max(farthest, test::sphere(x));
    search.tell(x, test::sphere(x));
  }
  EXPECT_GT(farthest, 1e-8);
  EXPECT_LT(farthest, 1e-5);
}

TEST(Cmaes, StaysFiniteOnFlatUnboundedAndAlwaysFailingFunctions) {
  const auto run = [](auto function) {
    Cmaes search(std::vector<double>(6, 1.0), {.sigma = 0.1, .seed = 9});
    for (int i = 0; i < 50000; ++i) {
      const auto x = search.ask();
      for (const double v : x) ASSERT_TRUE(std::isfinite(v));
      search.tell(x, function(x));
    }
    EXPECT_TRUE(std::isfinite(search.sigma()));
    EXPECT_GT(search.sigma(), 0.0);
  };
  run([](const auto&) { return 0.0; });
  run([](const auto& x) { return x[0]; });
  run([](const auto&) { return std::numeric_limits<double>::quiet_NaN(); });
  run([](const auto& x) { return x[0] * x[0]; });
}

TEST(Cmaes, IsInvariantUnderAnIncreasingTransformationOfTheObjective) {
  Cmaes plain(std::vector<double>(5, 1.0), {.seed = 21}),
      transformed(std::vector<double>(5, 1.0), {.seed = 21});
  for (int i = 0; i < 1000; ++i) {
    const auto x = plain.ask();
    ASSERT_EQ(x, transformed.ask());
    const double value = test::rosenbrock(x);
    plain.tell(x, value);
    transformed.tell(x, value < 10.0 ? 2.0 * value : 8.0 * value - 60.0);
  }
}

TEST(Cmaes, RefusesBadArguments) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Cmaes({}, {}), Error);
  EXPECT_THROW(Cmaes({1.0, nan}, {}), Error);
  EXPECT_THROW(Cmaes({1.0}, {.sigma = 0.0}), Error);
  EXPECT_THROW(Cmaes({1.0}, {.sigma = nan}), Error);
  EXPECT_THROW(Cmaes({1.0}, {.population = 3}), Error);
  EXPECT_THROW(Cmaes({1.0}, {.least_deviation = 0.0}), Error);
  Cmaes search({1.0, 2.0}, {});
  EXPECT_THROW(search.tell(std::vector<double>{1.0}, 0.0), Error);
  EXPECT_THROW(search.tell(std::vector<double>{1.0, nan}, 0.0), Error);
}

TEST(Cmaes, RefusesAStateThatIsNone) {
  const std::string good = Cmaes({1.0, 2.0}, {}).state();
  EXPECT_NO_THROW(Cmaes::restore(good, "test"));
  for (std::size_t length = 0; length < good.size(); length += 7)
    EXPECT_THROW(Cmaes::restore(good.substr(0, length), "test"), Error);
  EXPECT_THROW(Cmaes::restore("{}", "test"), Error);
  std::string shorter = good;
  shorter.replace(shorter.find("\"mean\":["), 8, "\"mean\":[1.0,");
  EXPECT_THROW(Cmaes::restore(shorter, "test"), Error);
}

TEST(PortableMath, AgreesWithTheLibraryToTwoUnitsInTheLastPlace) {
  std::mt19937_64 generator(12345);
  std::uniform_real_distribution<double> exponent(-300.0, 300.0), power(-690.0, 690.0), near_one(0.5, 2.0);
  const double epsilon = std::numeric_limits<double>::epsilon();
  for (int i = 0; i < 200000; ++i) {
    for (const double x : {std::pow(10.0, exponent(generator)), near_one(generator)}) {
      ASSERT_LE(std::abs(portable::log(x) - std::log(x)), 2.0 * epsilon * std::abs(std::log(x))) << x;
    }
    const double y = power(generator);
    ASSERT_LE(std::abs(portable::exp(y) - std::exp(y)), 2.0 * epsilon * std::exp(y)) << y;
  }
  EXPECT_EQ(portable::log(1.0), 0.0);
  EXPECT_EQ(portable::exp(0.0), 1.0);
}

}  // namespace
}  // namespace remodel
