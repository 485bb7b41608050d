#include "design/design_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <stdexcept>

#include "design/airfoil_space.h"
#include "design/interpolation.h"

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

Feasible feasible_in(const AirfoilSpace& space) {
  return [&space](std::span<const double> design) { return space.feasible(design); };
}

// A run without meshes.
Outcome interpolate(const CstAirfoil& from, const CstAirfoil& to, double sigma, std::uint64_t seed,
                    int evaluations) {
  const int degree = std::max(from.degree(), to.degree());
  const CstAirfoil start = raise_degree(from, degree), target = raise_degree(to, degree);
  const InterpolationObjective objective(target);
  const AirfoilSpace space(start);
  CmaesDesigner designer = interpolation_designer(space.start(), sigma, seed);
  Outcome outcome;
  CstAirfoil best, previous = start;
  for (int i = 0; i < evaluations; ++i) {
    const auto sample = next_sample(designer, feasible_in(space), 10000);
    if (!sample) throw std::runtime_error("no feasible sample");
    outcome.infeasible += sample->refused;
    const CstAirfoil design = space.airfoil(sample->proposal.design);
    const double value = objective.mean_square(design);
    if (value < outcome.objective) {
      outcome.objective = value;
      best = design;
    }
    designer.tell(sample->proposal, {.objective = value});
    for (int k = 1; k < 100 && i >= evaluations - 1000; ++k)
      outcome.unmoved += k != 50 && previous.at(k / 100.0) == design.at(k / 100.0);
    previous = design;
  }
  outcome.max_error = objective.max_error(best);
  return outcome;
}

TEST(DesignSearch, InterpolatesTheTargetInNineThousandEvaluationsFromEverySigmaAndNeverStandsStill) {
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

TEST(DesignSearch, ReachesEveryAirfoilOfTheCatalogue) {
  for (const CatalogueEntry& entry : airfoil_catalogue()) {
    const Outcome outcome = interpolate(catalogued("naca0012"), entry.airfoil(), 0.05, 1, 9000);
    EXPECT_LT(outcome.max_error, 1e-6) << entry.name;
  }
}

TEST(DesignSearch, GivesOnlyDesignsWithTheirSurfacesApart) {
  const CstAirfoil& start = catalogued("naca0012");
  const AirfoilSpace space(start, {.points = 700});
  CmaesDesigner designer = interpolation_designer(space.start(), 0.25, 3);
  std::uint64_t refused = 0;
  for (int i = 0; i < 300; ++i) {
    const auto sample = next_sample(designer, feasible_in(space), 1000);
    ASSERT_TRUE(sample);
    refused += sample->refused;
    const CstAirfoil design = space.airfoil(sample->proposal.design);
    EXPECT_TRUE(surfaces_apart(design));
    for (int k = 1; k < 350; ++k)
      ASSERT_GT(design.at(k / 700.0).y, design.at(1.0 - k / 700.0).y) << "t = " << k << "/700";
  }
  EXPECT_GT(refused, 0u);
}

TEST(DesignSearch, EndsAfterTheLimitOfInfeasibleSamples) {
  CstAirfoil inside_out = catalogued("naca0012");
  std::swap(inside_out.upper, inside_out.lower);
  const AirfoilSpace space(inside_out);
  CmaesDesigner designer = interpolation_designer(space.start(), 1e-6, 1);
  EXPECT_FALSE(next_sample(designer, feasible_in(space), 100));
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

TEST(InterpolationObjective, HasTheGradientOfCentralDifferences) {
  const InterpolationObjective objective(catalogued("rae2822"));
  const CstAirfoil at = catalogued("naca0012");
  const std::vector<double> start = coefficients_of(at), gradient = objective.gradient(at);
  ASSERT_EQ(gradient.size(), start.size());
  for (std::size_t i = 0; i < start.size(); ++i) {
    constexpr double h = 1e-5;  // the objective is quadratic: the difference is exact but for rounding
    std::vector<double> more = start, less = start;
    more[i] += h;
    less[i] -= h;
    const double difference = (objective.mean_square(with_coefficients(at, more)) -
                               objective.mean_square(with_coefficients(at, less))) /
                              (2 * h);
    EXPECT_NEAR(gradient[i], difference, 1e-12) << "coefficient " << i;
  }
}

// Proposes its start and nothing else.
class OneProposal final : public Designer {
 public:
  std::size_t population() const override { return 1; }
  Proposal ask() override { return ++asked_, Proposal{.design = {0.0}}; }
  void refuse(const Proposal&) override { finished_ = true; }
  void tell(const Proposal&, const Evaluation&) override { finished_ = true; }
  bool finished() const override { return finished_; }
  std::uint64_t generation() const override { return 0; }
  std::string state() const override { return {}; }
  void restore(const std::string&, const std::string&) override {}
  std::string description() const override { return "{}"; }
  int asked() const { return asked_; }

 private:
  int asked_ = 0;
  bool finished_ = false;
};

TEST(NextSample, IsNotAskedOfADesignerThatHasFinished) {
  OneProposal designer;
  EXPECT_FALSE(next_sample(
      designer, [](std::span<const double>) { return false; }, 100));
  EXPECT_EQ(designer.asked(), 1);
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
