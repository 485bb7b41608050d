#include <gtest/gtest.h>

#include <cmath>

#include "flow/test_flows.h"
#include "remodel/error.h"
#include "remodel/flow_error.h"
#include "remodel/generate.h"

namespace remodel {
namespace {

Mesh section_mesh(int points) {
  return generate(airfoil_domain(named_airfoil("naca:0012", 5), {.points = points}),
                  {.gradation = points / 50.0})
      .mesh;
}

// The estimate at I = 60 is compared with what I = 240 has, which is sixteen times nearer to the limit.
TEST(ErrorEstimate, IsTheErrorOfASubsonicFlow) {
  const FlowConditions conditions = {.mach = 0.3, .alpha_deg = 2.0};
  const Mesh coarse = section_mesh(60);
  const FlowResult flow = solve_flow(coarse, conditions), fine = solve_flow(section_mesh(240), conditions);
  const FlowError error = estimate_error(coarse, flow, conditions);
  ASSERT_TRUE(error.finer.converged());
  EXPECT_EQ(error.order, 2.0);
  EXPECT_GT(2 * error.vertices, 3 * flow.density.size());
  EXPECT_NEAR(error.cl, fine.cl - flow.cl, 0.35 * std::fabs(fine.cl - flow.cl));
  EXPECT_NEAR(error.cd, fine.cd - flow.cd, 0.35 * std::fabs(fine.cd - flow.cd));
  EXPECT_EQ(error.alpha_deg, 0.0);
}

TEST(ErrorEstimate, IsOfTheAngleWhereLiftIsGiven) {
  const FlowConditions conditions = {.mach = 0.3, .alpha_deg = 2.0, .cl = 0.25};
  const Mesh mesh = section_mesh(60);
  const FlowError error = estimate_error(mesh, solve_flow(mesh, conditions), conditions);
  EXPECT_EQ(error.cl, 0.0);
  EXPECT_NE(error.alpha_deg, 0.0);
  EXPECT_LT(std::fabs(error.alpha_deg), 0.2);
}

TEST(ErrorEstimate, TakesAwayNoMoreDragThanThereIsInAFreeStream) {
  EXPECT_EQ(lacking_drag(-11e-4, 2e-4, true), -2e-4);
  EXPECT_EQ(lacking_drag(-1e-4, 2e-4, true), -1e-4);
  EXPECT_EQ(lacking_drag(-11e-4, 2e-4, false), -11e-4);  // the walls of a duct may have thrust
  EXPECT_EQ(lacking_drag(1e-4, -2e-4, true), 1e-4);
}

TEST(ErrorEstimate, AsksForAFlow) {
  const Mesh mesh = section_mesh(40);
  EXPECT_THROW(estimate_error(mesh, FlowResult{}, {.mach = 0.3}), Error);
}

}  // namespace
}  // namespace remodel
