#include "aero/first_flow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "remodel/airfoil.h"
#include "remodel/generate.h"

namespace remodel::aero {
namespace {

FlowResult with_status(FlowStatus status) {
  FlowResult flow;
  flow.status = status;
  return flow;
}

TEST(FirstFlow, BeginsWithoutLoadAtHalfTheSpeedOfSoundAndGoesOnByHalvedSteps) {
  std::vector<FlowConditions> searches;
  double last = 0.5;
  // Flows are found within .1 of the last one's Mach number.
  const auto find = [&](const FlowConditions& conditions) {
    searches.push_back(conditions);
    if (std::abs(conditions.mach - last) > 0.1) return with_status(FlowStatus::stalled);
    last = conditions.mach;
    FlowResult flow = with_status(FlowStatus::converged);
    flow.seconds = 1.0;
    return flow;
  };
  const FlowConditions wanted{.mach = 0.8, .alpha_deg = 4.0};
  const FlowResult flow = by_easier_flows(wanted, with_status(FlowStatus::stalled), find);
  EXPECT_TRUE(flow.converged());
  ASSERT_FALSE(searches.empty());
  EXPECT_EQ(searches.front().mach, 0.5);
  EXPECT_EQ(searches.front().alpha_deg, 0.0);
  EXPECT_EQ(searches.back().mach, 0.8);
  EXPECT_EQ(searches.back().alpha_deg, 4.0);
  EXPECT_EQ(flow.seconds, 5.0);  // of all flows on the way: none and four quarters
}

TEST(FirstFlow, KeepsWhatIsFoundOrCannotBeMadeEasier) {
  int searches = 0;
  const auto find = [&](const FlowConditions&) {
    ++searches;
    return with_status(FlowStatus::converged);
  };
  const FlowConditions loaded{.mach = 0.8, .alpha_deg = 4.0}, slow{.mach = 0.4, .alpha_deg = 0.0};
  by_easier_flows(loaded, with_status(FlowStatus::converged), find);
  by_easier_flows(loaded, with_status(FlowStatus::interrupted), find);
  EXPECT_EQ(by_easier_flows(slow, with_status(FlowStatus::stalled), find).status, FlowStatus::stalled);
  EXPECT_EQ(searches, 0);
}

TEST(FirstFlow, IsTheOneThatWasNotFoundWhereNothingLeadsToIt) {
  const auto nowhere = [](const FlowConditions&) { return with_status(FlowStatus::stalled); };
  FlowResult direct = with_status(FlowStatus::step_limit);
  direct.reason = "its own";
  EXPECT_EQ(by_easier_flows({.mach = 0.8}, direct, nowhere).reason, "its own");
}

// Seven Newton steps are too few for this flow straight away, and enough from one flow to the next.
TEST(FirstFlow, IsFoundWhereOnlyTheMarchLeadsToIt) {
  const FrozenMesh mesh =
      generate(airfoil_domain(named_airfoil("naca:0012", 5), {.points = 40}), {.gradation = 1.0})
          .mesh.freeze();
  const FlowConditions wanted{.mach = 0.65, .alpha_deg = 4.0};
  const FlowOptions few{.tolerance = 1e-8, .max_steps = 7};
  LivingFlow living(few);
  const FlowResult direct = living.solve(mesh, wanted);
  ASSERT_EQ(direct.status, FlowStatus::step_limit);
  const FlowResult flow = by_easier_flows(
      wanted, direct, [&](const FlowConditions& between) { return living.solve(mesh, between); });
  ASSERT_TRUE(flow.converged()) << flow.reason;
  EXPECT_NE(flow.start, FlowStart::cold);
  const FlowResult whole = solve_flow(mesh, wanted, {.tolerance = 1e-8});
  ASSERT_TRUE(whole.converged());
  EXPECT_NEAR(flow.cl, whole.cl, 1e-6);
  EXPECT_NEAR(flow.cd, whole.cd, 1e-7);
}

}  // namespace
}  // namespace remodel::aero
