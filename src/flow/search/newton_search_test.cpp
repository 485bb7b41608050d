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
    find_flow_cold(system, measure, options, matrix, factors, state, search);
    found = state;
    for (std::uint32_t v = 0; v < mesh.size(); ++v)
      if (const Point from = mesh.points()[v] - Point{1.0, 0.0}; dot(from, from) < 1e-3)
        state.q[v][3] *= 1.0 + disturbance * std::sin(v);
    flow::Vector residual;
    flow::Augmented augmented;
    search = {};
    search.residual = measure(state, residual, augmented);
  }
  void go_on() { find_flow_beside(system, measure, options, matrix, factors, state, search); }

  FlowOptions options;
  flow::FlowMesh mesh{test::airfoil_mesh("naca:0012", 60).freeze(), "farfield", "mesh"};
  flow::FlowSystem system{mesh, {.mach = 0.5, .alpha = 0.02}};
  flow::Measure measure{system};
  flow::BlockRows matrix = system.pattern();
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
  EXPECT_NEAR(task.system.coefficients(task.state).lift, task.system.coefficients(task.found).lift, 1e-8);
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

}  // namespace
}  // namespace remodel
