#include "optimise/shape_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <stdexcept>

namespace remodel {
namespace {

const CstAirfoil& catalogued(std::string_view name) {
  static std::vector<std::pair<std::string, CstAirfoil>> airfoils = [] {
    std::vector<std::pair<std::string, CstAirfoil>> result;
    for (const CatalogueEntry& entry : airfoil_catalogue()) result.emplace_back(entry.name, entry.airfoil());
    return result;
  }();
  const auto found =
      std::find_if(airfoils.begin(), airfoils.end(), [&](const auto& a) { return a.first == name; });
  return found->second;
}

struct Outcome {
  double objective = std::numeric_limits<double>::infinity();
  double max_error = 0.0;
  std::uint64_t infeasible = 0;
  std::size_t unmoved = 0;  // stations of the last 1000 designs that are where they were in the design before
};

// A run without meshes.
Outcome interpolate(const CstAirfoil& from, const CstAirfoil& to, double sigma, std::uint64_t seed,
                    int evaluations) {
  const int degree = std::max(from.degree(), to.degree());
  const CstAirfoil start = raise_degree(from, degree), target = raise_degree(to, degree);
  const InterpolationObjective objective(target);
  ShapeSearch search(start, {}, initial_distribution(start, sigma, seed));
  Outcome outcome;
  CstAirfoil best, previous = start;
  for (int i = 0; i < evaluations; ++i) {
    const auto sample = search.next(10000);
    if (!sample) throw std::runtime_error("no feasible sample");
    outcome.infeasible += sample->refused;
    const double value = objective.mean_square(sample->design);
    if (value < outcome.objective) {
      outcome.objective = value;
      best = sample->design;
    }
    search.tell(*sample, value);
    for (int k = 1; k < 100 && i >= evaluations - 1000; ++k)
      outcome.unmoved += k != 50 && previous.at(k / 100.0) == sample->design.at(k / 100.0);
    previous = sample->design;
  }
  outcome.max_error = objective.max_error(best);
  return outcome;
}

TEST(ShapeSearch, InterpolatesTheTargetInNineThousandEvaluationsFromEverySigmaAndNeverStandsStill) {
  for (const double sigma : {0.01, 0.05, 0.25}) {
    for (const std::uint64_t seed : {1, 2, 3}) {
      const Outcome outcome = interpolate(catalogued("naca0012"), catalogued("rae2822"), sigma, seed, 9000);
      std::cout << "sigma " << sigma << " seed " << seed << ": max error " << outcome.max_error
                << ", infeasible " << outcome.infeasible << '\n';
      EXPECT_LT(outcome.max_error, 1e-8) << "sigma " << sigma << " seed " << seed;
      EXPECT_LE(outcome.unmoved, 98u) << "of 98000: sigma " << sigma << " seed " << seed;
    }
  }
}

TEST(ShapeSearch, ReachesEveryAirfoilOfTheCatalogue) {
  for (const CatalogueEntry& entry : airfoil_catalogue()) {
    const Outcome outcome = interpolate(catalogued("naca0012"), entry.airfoil(), 0.05, 1, 9000);
    EXPECT_LT(outcome.max_error, 1e-6) << entry.name;
  }
}

TEST(ShapeSearch, GivesOnlyDesignsWithTheirSurfacesApart) {
  const CstAirfoil& start = catalogued("naca0012");
  ShapeSearch search(start, {.points = 700}, initial_distribution(start, 0.25, 3));
  std::uint64_t refused = 0;
  for (int i = 0; i < 300; ++i) {
    const auto sample = search.next(1000);
    ASSERT_TRUE(sample);
    refused += sample->refused;
    EXPECT_TRUE(surfaces_apart(sample->design));
    for (int k = 1; k < 350; ++k)
      ASSERT_GT(sample->design.at(k / 700.0).y, sample->design.at(1.0 - k / 700.0).y)
          << "t = " << k << "/700";
  }
  EXPECT_GT(refused, 0u);
}

TEST(ShapeSearch, EndsAfterTheLimitOfInfeasibleSamples) {
  CstAirfoil inside_out = catalogued("naca0012");
  std::swap(inside_out.upper, inside_out.lower);
  ShapeSearch search(inside_out, {}, initial_distribution(inside_out, 1e-6, 1));
  EXPECT_FALSE(search.next(100));
}

TEST(Feasibility, RefusesDesignsThatReachTheFarfield) {
  CstAirfoil thick = catalogued("naca0012");
  const Feasibility near(thick, {.farfield_radius = 1.2}), far(thick, {});
  EXPECT_TRUE(near(thick));
  for (double& a : thick.upper) a *= 25.0;
  EXPECT_FALSE(near(thick));
  EXPECT_TRUE(far(thick));
}

TEST(InterpolationObjective, IsZeroAtTheTargetAloneAndMeasuresDistanceInChords) {
  const CstAirfoil& target = catalogued("rae2822");
  const InterpolationObjective objective(target);
  EXPECT_EQ(objective.mean_square(target), 0.0);
  EXPECT_EQ(objective.max_error(target), 0.0);
  CstAirfoil other = target;
  other.upper[2] += 1e-3;
  double largest = 0.0;
  for (int i = 1; i < 51; ++i) {
    const double t = i / 102.0;
    largest = std::max(largest, std::abs(other.at(t).y - target.at(t).y));
  }
  EXPECT_EQ(objective.max_error(other), largest);
  EXPECT_GT(objective.mean_square(other), 0.0);
  EXPECT_LT(objective.mean_square(other), largest * largest);
}

TEST(RaiseDegree, KeepsTheAirfoil) {
  for (const CatalogueEntry& entry : airfoil_catalogue()) {
    const CstAirfoil airfoil = entry.airfoil(), raised = raise_degree(airfoil, airfoil.degree() + 3);
    EXPECT_EQ(raised.degree(), airfoil.degree() + 3);
    for (int i = 0; i <= 100; ++i) EXPECT_NEAR(raised.at(i / 100.0).y, airfoil.at(i / 100.0).y, 1e-15);
  }
}

TEST(Coefficients, GoIntoOneVectorAndBack) {
  const CstAirfoil& airfoil = catalogued("rae2822");
  EXPECT_EQ(with_coefficients(airfoil, coefficients_of(airfoil)), airfoil);
}

}  // namespace
}  // namespace remodel
