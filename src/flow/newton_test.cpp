// What Newton's method does where a search has stalled with little residual left.

#include <gtest/gtest.h>

#include <cmath>

#include "flow/test_flows.h"
#include "remodel/flow.h"

namespace remodel {
namespace {

// A flow around NACA 0012 with the pressure about its trailing edge disturbed, as if all else had been found.
struct NearlyFound {
  explicit NearlyFound(double disturbance) {
    find_flow_cold(euler, measure, options, matrix, factors, state, search);
    found = state;
    for (std::uint32_t v = 0; v < mesh.size(); ++v)
      if (const Point from = mesh.points()[v] - Point{1.0, 0.0}; dot(from, from) < 1e-3)
        state.q[v][3] *= 1.0 + disturbance * std::sin(v);
    flow::Vector residual;
    flow::Border border;
    search = {};
    search.residual = measure(state, residual, border);
  }
  void go_on() { find_flow_beside(euler, measure, options, matrix, factors, state, search); }

  FlowOptions options;
  flow::FlowMesh mesh{test::airfoil_mesh("naca:0012", 60).freeze(), "farfield", "mesh"};
  flow::Euler euler{mesh, {.mach = 0.5, .alpha = 0.02}};
  flow::Measure measure{euler};
  flow::BlockRows matrix = euler.pattern();
  flow::Factors factors;
  flow::State state, found;
  flow::Search search;
};

TEST(Beside, GoesOnWhereLittleIsLeft) {
  NearlyFound task(3e-4);
  ASSERT_LT(task.search.residual, 1e-3);
  ASSERT_GT(task.search.residual, 1e-6);
  task.go_on();
  ASSERT_EQ(task.search.status, FlowStatus::converged) << task.search.reason;
  EXPECT_GT(task.search.newton_steps, 0);
  EXPECT_NEAR(task.euler.coefficients(task.state).lift, task.euler.coefficients(task.found).lift, 1e-8);
}

TEST(Beside, LeavesAloneWhatHasNotStalledOrIsFar) {
  NearlyFound far(0.1), ended(3e-4);
  ASSERT_GT(far.search.residual, 1e-3);
  ended.search.status = FlowStatus::step_limit;
  const flow::State before[] = {far.state, ended.state};
  far.go_on(), ended.go_on();
  EXPECT_EQ(far.search.newton_steps + ended.search.newton_steps, 0);
  EXPECT_EQ(far.state.q, before[0].q);
  EXPECT_EQ(ended.state.q, before[1].q);
}

// Number 25 of bench/flow_soak at seed 1: it stalls at a residual of 7e-4, and a search in stages takes 150
// steps.
TEST(Beside, ASectionWithAFlapIsNotLookedForAnew) {
  CstAirfoil section = named_airfoil("naca:0012", 5);
  section.upper = {0.078103757, 0.078225693, 0.144245553, 0.107214430, 0.100598064, 0.091950419};
  section.lower = {-0.063771088, -0.050379016, -0.073573041, -0.021880917, -0.049570055, 0.066843946};
  const Domain domain = airfoils_domain(
      {{.name = "main", .airfoil = section},
       {.name = "flap", .airfoil = section, .placement = {0.3, -17.154199572, {1.03, -0.05}}}},
      {.points = 76});
  const FrozenMesh mesh = generate(domain, {.gradation = 76 / 50.0}).mesh.freeze();
  const FlowResult flow = solve_flow(mesh, {.mach = 0.2, .alpha_deg = 3.911341499}, {.tolerance = 1e-8});
  ASSERT_TRUE(flow.converged()) << flow.reason;
  EXPECT_LT(flow.newton_steps, 100);
  EXPECT_NEAR(flow.cl, 1.71351, 1e-4);
}

}  // namespace
}  // namespace remodel
