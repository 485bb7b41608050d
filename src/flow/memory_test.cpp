// Flows and gradients where memory is short: GMRES with incomplete factors instead of LU.

#include <gtest/gtest.h>

#include <cmath>

#include "flow/test_flows.h"
#include "remodel/flow.h"
#include "remodel/remodel.h"

namespace remodel {
namespace {

// Less than LU takes at I = 60 (12 MB), more than incomplete factors of level 0 do.
constexpr double little_mb = 2.0;

void expect_the_same_flow(const FlowConditions& conditions, double little) {
  const FrozenMesh mesh = test::airfoil_mesh("naca:0012", 60).freeze();
  const FlowResult lu = solve_flow(mesh, conditions, {.solver = FlowSolver::lu});
  const FlowResult gmres = solve_flow(mesh, conditions, {.memory_mb = little, .solver = FlowSolver::lu});
  ASSERT_TRUE(lu.converged() && gmres.converged()) << lu.reason << gmres.reason;
  EXPECT_EQ(lu.solver, FlowSolver::lu);
  EXPECT_EQ(lu.gmres_iterations, 0);
  EXPECT_GT(lu.memory_mb, little);
  EXPECT_EQ(gmres.solver, FlowSolver::gmres);
  EXPECT_GT(gmres.gmres_iterations, gmres.newton_steps);
  EXPECT_LE(gmres.memory_mb, little);
  EXPECT_LE(gmres.residual, 1e-10);
  EXPECT_NEAR(gmres.cl, lu.cl, 1e-9);
  EXPECT_NEAR(gmres.cd, lu.cd, 1e-10);
  EXPECT_NEAR(gmres.alpha_deg, lu.alpha_deg, 1e-8);
}

TEST(Memory, SubsonicFlowsAreThoseOfLu) {
  expect_the_same_flow({.mach = 0.5, .alpha_deg = 1.25}, little_mb);
}

TEST(Memory, TransonicFlowsAreThoseOfLu) {
  expect_the_same_flow({.mach = 0.8, .alpha_deg = 1.25}, little_mb);
}

TEST(Memory, FlowsOfAGivenLiftAreThoseOfLu) {
  expect_the_same_flow({.mach = 0.5, .alpha_deg = 0.0, .cl = 0.3}, little_mb);
}

TEST(Memory, BetterFactorsAreMadeWhereThereIsRoom) {
  const FrozenMesh mesh = test::airfoil_mesh("naca:0012", 60).freeze();
  const FlowConditions conditions = {.mach = 0.5, .alpha_deg = 1.25};
  const FlowResult little = solve_flow(mesh, conditions, {.memory_mb = little_mb});
  const FlowResult more = solve_flow(mesh, conditions, {.memory_mb = 2.0 * little_mb});
  ASSERT_TRUE(little.converged() && more.converged());
  EXPECT_EQ(more.solver, FlowSolver::gmres);
  EXPECT_LT(more.gmres_iterations, little.gmres_iterations);
  EXPECT_LE(more.memory_mb, 2.0 * little_mb);
  EXPECT_GT(more.memory_mb, little.memory_mb);
}

TEST(Memory, TheSameInputGivesTheSameBits) {
  const FrozenMesh mesh = test::airfoil_mesh("naca:4412", 60).freeze();
  const FlowResult first = solve_flow(mesh, {.mach = 0.6, .alpha_deg = 1.0}, {.memory_mb = little_mb});
  const FlowResult second = solve_flow(mesh, {.mach = 0.6, .alpha_deg = 1.0}, {.memory_mb = little_mb});
  ASSERT_TRUE(first.converged()) << first.reason;
  EXPECT_EQ(first.pressure, second.pressure);
  EXPECT_EQ(first.history, second.history);
}

TEST(Memory, AFlowThatIsNotFoundSaysSo) {
  const FrozenMesh mesh = test::airfoil_mesh("naca:0012", 60).freeze();
  const FlowResult none = solve_flow(mesh, {.mach = 0.5}, {.memory_mb = 1.0});
  EXPECT_EQ(none.status, FlowStatus::memory);
  EXPECT_EQ(none.reason, "even incomplete factors need more than the 1 MB that they may take");
  const FlowResult few = solve_flow(mesh, {.mach = 0.5}, {.max_steps = 3, .memory_mb = little_mb});
  EXPECT_EQ(few.status, FlowStatus::step_limit);
  EXPECT_EQ(few.solver, FlowSolver::gmres);
}

double relative_difference(const std::vector<Point>& a, const std::vector<Point>& b) {
  double wrong = 0.0, size = 0.0;
  for (std::size_t p = 0; p < a.size(); ++p) {
    const Point difference = a[p] - b.at(p);
    wrong += dot(difference, difference), size += dot(a[p], a[p]);
  }
  return std::sqrt(wrong / size);
}

// Over steps that keep the mesh's connectivity and steps that do not.
TEST(Memory, LivingFlowsAndGradientsAreThoseOfLu) {
  CstAirfoil airfoil = named_airfoil("naca:2412", 5);
  const auto domain = [&] { return airfoil_domain(airfoil, {.points = 60}); };
  constexpr double some_mb = 3.0;  // the mesh grows
  Mesh mesh = generate(domain(), {.gradation = 1.2}).mesh;
  LivingFlow lu({.tolerance = 1e-12}), gmres({.tolerance = 1e-12, .memory_mb = some_mb});
  bool full = false, partial = false;
  for (const double by : {0.0, 1e-3, 5e-2, 1e-3}) {
    for (double& coefficient : airfoil.upper) coefficient += by;
    const bool is_full = remodel(mesh, domain(), {.strategy = Strategy::chain}).full_adjustment;
    full |= is_full, partial |= !is_full;
    const FlowConditions conditions = {.mach = 0.5, .alpha_deg = 1.0, .cl = 0.3};
    const FlowResult expected = lu.solve(mesh, conditions), found = gmres.solve(mesh, conditions);
    ASSERT_TRUE(expected.converged() && found.converged()) << expected.reason << found.reason;
    EXPECT_EQ(found.solver, FlowSolver::gmres);
    EXPECT_EQ(found.start, by == 0.0 ? FlowStart::cold : FlowStart::refactored);
    EXPECT_LE(found.memory_mb, some_mb);
    EXPECT_NEAR(found.alpha_deg, expected.alpha_deg, 1e-9);
    EXPECT_NEAR(found.cd, expected.cd, 1e-10);
    const FlowGradients right = lu.gradients(), same = gmres.gradients();
    EXPECT_LT(relative_difference(right.cd.points, same.cd.points), 1e-8);
    EXPECT_LT(relative_difference(right.alpha_deg.points, same.alpha_deg.points), 1e-8);
    EXPECT_NEAR(same.cd.cl, right.cd.cl, 1e-8 * std::fabs(right.cd.cl));
    EXPECT_NEAR(same.cd.mach, right.cd.mach, 1e-7 * std::fabs(right.cd.mach));
  }
  EXPECT_TRUE(full && partial);
}

}  // namespace
}  // namespace remodel
