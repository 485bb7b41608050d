// What Newton's method does where a search has stalled with little residual left.

#include <gtest/gtest.h>

#include <cmath>

#include "flow/scheme/forces.h"
#include "flow/test_flows.h"
#include "remodel/flow.h"

namespace remodel {
namespace {

// A flow around NACA 0012 with the pressure about its trailing edge disturbed, as if all else had been found.
struct NearlyFound {
  explicit NearlyFound(double disturbance) {
    search.from_undisturbed_flow(measure, state);
    found = state;
    for (std::uint32_t v = 0; v < mesh.size(); ++v)
      if (const Point from = mesh.points()[v] - Point{1.0, 0.0}; dot(from, from) < 1e-3)
        state.q[v][3] *= 1.0 + disturbance * std::sin(v);
    record = {};
    record.residual = measure(state).size;
  }
  void go_on() { search.beside(measure, state); }

  FlowOptions options;
  flow::FlowMesh mesh{test::airfoil_mesh("naca:0012", 60).freeze(), "farfield", "mesh"};
  flow::FlowSystem system{mesh, {.mach = 0.5, .alpha = 0.02}};
  flow::Measure measure{system};
  flow::WholeMatrix matrix;
  flow::Factors factors;
  flow::State state, found;
  flow::SearchRecord record;
  flow::NewtonSearch search{options, matrix, factors, record};
};

TEST(Beside, GoesOnWhereLittleIsLeft) {
  NearlyFound task(3e-4);
  ASSERT_LT(task.record.residual, 1e-3);
  ASSERT_GT(task.record.residual, 1e-6);
  task.go_on();
  ASSERT_EQ(task.record.status, FlowStatus::converged) << task.record.reason;
  EXPECT_GT(task.record.newton_steps, 0);
  EXPECT_NEAR(coefficients(task.system, task.state).lift, coefficients(task.system, task.found).lift, 1e-8);
}

TEST(Beside, LeavesAloneWhatHasNotStalledOrIsFar) {
  NearlyFound far(0.1), ended(3e-4);
  ASSERT_GT(far.record.residual, 1e-3);
  ended.record.status = FlowStatus::step_limit;
  const flow::State before[] = {far.state, ended.state};
  far.go_on(), ended.go_on();
  EXPECT_EQ(far.record.newton_steps + ended.record.newton_steps, 0);
  EXPECT_EQ(far.state.q, before[0].q);
  EXPECT_EQ(ended.state.q, before[1].q);
}

}  // namespace
}  // namespace remodel
