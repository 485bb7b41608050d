#include "remodel/batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <random>

#include "design/airfoil_space.h"
#include "remodel/error.h"
#include "remodel/generate.h"
#include "remodel/remodel.h"
#include "remodel/shape_files.h"
#include "support.h"

namespace remodel {
namespace {

CstAirfoil changed(CstAirfoil design, std::size_t coefficient, double by) {
  (coefficient < design.upper.size() ? design.upper[coefficient]
                                     : design.lower[coefficient - design.upper.size()]) += by;
  return design;
}

TEST(OrderDesigns, IsAChainOfNearestNeighboursByEitherDistance) {
  const CstAirfoil start = load_airfoil("naca:0012", 5);
  std::vector<CstAirfoil> designs;
  for (const double by : {0.03, 0.01, 0.05, 0.02, 0.04}) designs.push_back(changed(start, 2, by));
  for (const DesignDistance distance : {DesignDistance::displacement, DesignDistance::coefficients})
    EXPECT_EQ(order_designs(start, designs, {.distance = distance}),
              (std::vector<std::size_t>{1, 3, 0, 4, 2}));
  EXPECT_TRUE(order_designs(start, {}).empty());
  designs.assign(3, start);
  EXPECT_EQ(order_designs(start, designs), (std::vector<std::size_t>{0, 1, 2}));
}

TEST(OrderDesigns, MeasuresDisplacementAgainstTheVerticesThere) {
  const CstAirfoil start = load_airfoil("naca:0012", 5);
  // The same change of a coefficient moves small edges near the nose less far, but over more of their
  // lengths.
  const std::vector<CstAirfoil> designs = {changed(start, 0, 0.02), changed(start, 3, 0.03)};
  EXPECT_EQ(order_designs(start, designs, {.distance = DesignDistance::coefficients}).front(), 0u);
  EXPECT_EQ(order_designs(start, designs, {.distance = DesignDistance::displacement}).front(), 1u);
}

TEST(OrderDesigns, RaisesDegreesAndRefusesWhatHasNoDistance) {
  const CstAirfoil start = load_airfoil("naca:0012", 5);
  const std::vector<CstAirfoil> designs = {load_airfoil("naca:2412", 7), raise_degree(start, 8)};
  for (const DesignDistance distance : {DesignDistance::displacement, DesignDistance::coefficients})
    EXPECT_EQ(order_designs(start, designs, {.distance = distance}), (std::vector<std::size_t>{1, 0}));
  CstAirfoil other = start;
  other.e1 = 0.6;
  EXPECT_THROW(order_designs(start, {other}, {.distance = DesignDistance::coefficients}), Error);
  EXPECT_THROW(order_designs(start, {other}, {.points = 7}), Error);
  EXPECT_THROW(order_designs(start, {other}, {.points = 0}), Error);
}

std::size_t lost_in(Mesh mesh, const std::vector<CstAirfoil>& designs,
                    const std::vector<std::size_t>& order) {
  std::size_t lost = 0;
  for (const std::size_t i : order) {
    const RemodelResult result =
        remodel(mesh, airfoil_domain(designs[i], {.points = 100}), {.strategy = Strategy::renew});
    lost += result.triangles_before - result.preserved;
  }
  return lost;
}

TEST(OrderDesigns, LosesFewerTrianglesThanAnOrderByChance) {
  const auto seed = test::seed(1);
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  const CstAirfoil start = load_airfoil("rae2822", 5);
  // A study of two coefficients.
  std::vector<CstAirfoil> designs;
  for (int i = -4; i <= 4; ++i)
    for (int k = -4; k <= 4; ++k) designs.push_back(changed(changed(start, 2, 0.01 * i), 8, 0.01 * k));
  std::vector<std::size_t> by_chance(designs.size());
  std::iota(by_chance.begin(), by_chance.end(), std::size_t{0});
  for (std::size_t i = by_chance.size(); i > 1; --i) std::swap(by_chance[i - 1], by_chance[random() % i]);
  const Mesh mesh = generate(airfoil_domain(start, {.points = 100}), {.gradation = 2.0}).mesh;
  EXPECT_LT(static_cast<double>(lost_in(mesh, designs, order_designs(start, designs, {.points = 100}))),
            0.9 * static_cast<double>(lost_in(mesh, designs, by_chance)));
}

// T_b: triangles of a mesh at vertices that a change of coefficients can move, all of an airfoil but its
// edges.
std::size_t movable_triangles(const FrozenMesh& mesh, std::int32_t airfoil) {
  const auto movable = [&](std::uint32_t v) {
    return mesh.curve[v] == airfoil && mesh.parameter[v] != 0.0 && mesh.parameter[v] != 0.5;
  };
  return static_cast<std::size_t>(std::count_if(
      mesh.triangles.begin(), mesh.triangles.end(),
      [&](const auto& corners) { return std::any_of(corners.begin(), corners.end(), movable); }));
}

// Each coefficient in turn is changed by 1e-4, then a step is made: most vertices of an evaluation stand
// still.
TEST(FiniteDifferences, LoseAtMostSevenTenthsOfTheTrianglesAtTheAirfoil) {
  const CstAirfoil from = load_airfoil("naca:0012", 5), to = load_airfoil("rae2822", 5);
  const std::vector<double> a = coefficients_of(from), b = coefficients_of(to);
  constexpr int steps = 10;
  for (const Strategy strategy : {Strategy::renew, Strategy::chain}) {
    SCOPED_TRACE(name_of(strategy));
    const Domain domain = airfoil_domain(from, {.points = 200});
    Mesh mesh = generate(domain, {.gradation = 4.0}).mesh;
    const FrozenMesh fresh = mesh.freeze();
    std::int32_t airfoil = 0;
    while (!std::holds_alternative<CstAirfoil>(domain.curve(static_cast<std::size_t>(airfoil)).shape))
      ++airfoil;
    const double t_b = static_cast<double>(movable_triangles(fresh, airfoil));
    EXPECT_NEAR(t_b, 416.0, 25.0);

    double lost = 0.0;
    int evaluations = 0;
    for (int step = 0; step < steps; ++step) {
      std::vector<double> here(a.size());
      for (std::size_t i = 0; i < a.size(); ++i) here[i] = a[i] + (b[i] - a[i]) * step / steps;
      const CstAirfoil design = with_coefficients(from, here);
      for (std::size_t i = 0; i <= a.size(); ++i) {
        const CstAirfoil next = i == 0 ? design : changed(design, i - 1, 1e-4);
        const RemodelResult result =
            remodel(mesh, airfoil_domain(next, {.points = 200}), {.strategy = strategy});
        lost += static_cast<double>(result.triangles_before - result.preserved);
        evaluations += step > 0 || i > 0;
      }
    }
    std::printf("%s: %.1f of %.0f lost an evaluation\n", name_of(strategy), lost / evaluations, t_b);
    EXPECT_LE(lost / evaluations, 0.7 * t_b);
    EXPECT_GE(lost / evaluations, 0.4 * t_b);
    EXPECT_EQ(mesh.quick_check(), "");
  }
}

}  // namespace
}  // namespace remodel
