#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "flow/test_flows.h"
#include "remodel/error.h"
#include "remodel/flow.h"
#include "remodel/remodel.h"
#include "support.h"

namespace remodel {
namespace {

// A section that has gone this far at random from the last one, coefficient by coefficient.
void walk(CstAirfoil& airfoil, double sigma, std::mt19937_64& random) {
  for (auto* surface : {&airfoil.upper, &airfoil.lower})
    for (double& coefficient : *surface) coefficient += test::uniform(random, -sigma, sigma);
}

Domain domain_of(const CstAirfoil& airfoil) {
  return airfoil_domain(airfoil, {.points = 60});
}

TEST(LivingFlow, FindsTheFlowThatAColdSolverFinds) {
  const unsigned long long seed = test::seed(11);
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  CstAirfoil airfoil = named_airfoil("naca:0012", 5);
  Mesh mesh = generate(domain_of(airfoil), {.gradation = 1.2}).mesh;
  LivingFlow living;
  const FlowConditions conditions = {.mach = 0.6, .alpha_deg = 1.25};
  EXPECT_EQ(living.solve(mesh, conditions).start, FlowStart::cold);
  int partial = 0;
  for (const double sigma : {1e-3, 1e-3, 1e-2, 2e-2, 2e-2, 1e-3}) {
    walk(airfoil, sigma, random);
    const RemodelResult step = remodel(mesh, domain_of(airfoil), {.strategy = Strategy::chain});
    partial += !step.full_adjustment;
    const FlowResult warm = living.solve(mesh, conditions);
    const FlowResult cold = solve_flow(mesh.freeze(), conditions);
    ASSERT_TRUE(warm.converged()) << warm.reason;
    ASSERT_TRUE(cold.converged()) << cold.reason;
    EXPECT_NEAR(warm.cl, cold.cl, 1e-8);
    EXPECT_NEAR(warm.cd, cold.cd, 1e-9);
    EXPECT_NE(warm.start, FlowStart::cold);
    EXPECT_LE(warm.residual, 1e-10);
    EXPECT_EQ(warm.density.size(), cold.density.size());
  }
  EXPECT_GE(partial, 1);
}

TEST(LivingFlow, AFrozenViewIsAsGoodAsItsMesh) {
  const Mesh mesh = generate(domain_of(named_airfoil("naca:0012", 5)), {.gradation = 1.2}).mesh;
  const FlowConditions conditions = {.mach = 0.6, .alpha_deg = 1.25};
  LivingFlow of_mesh, of_view;
  EXPECT_EQ(of_mesh.solve(mesh, conditions).density, of_view.solve(mesh.freeze(), conditions).density);
  FrozenMesh nameless = mesh.freeze();
  nameless.vertex_keys.clear();
  EXPECT_THROW(of_view.solve(nameless, conditions), Error);
}

TEST(LivingFlow, GoesOnFromAFlowThatWasKept) {
  Mesh mesh = generate(domain_of(named_airfoil("naca:0012", 5)), {.gradation = 1.2}).mesh;
  const Mesh first = mesh;
  const FlowConditions conditions = {.mach = 0.6, .alpha_deg = 1.25};
  LivingFlow living;
  EXPECT_TRUE(living.keep().empty());
  const FlowResult found = living.solve(first, conditions);
  const KeptFlow kept = living.keep();
  remodel(mesh, domain_of(named_airfoil("naca:2412", 5)), {.strategy = Strategy::chain});
  ASSERT_TRUE(living.solve(mesh, conditions).converged());
  living.go_on_from({});
  EXPECT_GT(living.solve(mesh, {.mach = 0.6, .alpha_deg = 1.0}).history.front(), 1e-10);
  living.go_on_from(kept);
  const FlowResult again = living.solve(first, conditions);
  EXPECT_LE(again.history.front(), 1e-10);  // it is that flow
  EXPECT_EQ(again.density, found.density);
}

// Says when it is asked for the nth time that the flow should end.
struct EndsAt final : StepObserver {
  explicit EndsAt(int n) : left(n) {}
  bool cancelled() override { return --left <= 0; }
  int left;
};

// Of two sections at two angles three flows are known: the fourth begins nearer to itself than any of them.
TEST(LivingFlow, AFlowThatIsChangedAsAnotherOneIsNearTheOneLookedFor) {
  CstAirfoil airfoil = named_airfoil("naca:0012", 5);
  const Mesh first = generate(domain_of(airfoil), {.gradation = 1.2}).mesh;
  for (double& coefficient : airfoil.upper) coefficient += 0.01;
  Mesh second = first;
  remodel(second, domain_of(airfoil), {.strategy = Strategy::morph});
  const FlowConditions flat = {.mach = 0.5, .alpha_deg = 0.0}, steep = {.mach = 0.5, .alpha_deg = 2.0};
  LivingFlow living;
  const auto kept = [&](const Mesh& mesh, const FlowConditions& at) {
    EXPECT_TRUE(living.solve(mesh, at).converged());
    return living.keep();
  };
  const KeptFlow first_flat = kept(first, flat), first_steep = kept(first, steep),
                 second_flat = kept(second, flat);
  const FlowResult cold = solve_flow(second.freeze(), steep);
  const auto begun_from = [&](const KeptFlow& flow) {
    LivingFlow fresh;
    fresh.go_on_from(flow);
    const FlowResult result = fresh.solve(second, steep);
    EXPECT_TRUE(result.converged());
    EXPECT_NEAR(result.cl, cold.cl, 1e-8);
    return result.history.front();
  };
  const double changed_one = begun_from(changed(first_steep, first_flat, second_flat));
  EXPECT_LT(changed_one, 0.5 * begun_from(first_steep));
  EXPECT_LT(changed_one, 0.5 * begun_from(second_flat));
  EXPECT_THROW(changed(first_steep, {}, second_flat), Error);
}

TEST(LivingFlow, AFlowThatIsCancelledInItsLastStepIsNotTheLastOne) {
  const Mesh mesh = generate(domain_of(named_airfoil("naca:0012", 5)), {.gradation = 1.2}).mesh;
  const FlowConditions conditions = {.mach = 0.6, .alpha_deg = 1.25};
  constexpr int many = 1000;
  EndsAt never(many);
  ASSERT_TRUE(LivingFlow({.observer = &never}).solve(mesh, conditions).converged());
  EndsAt last(many - never.left);
  LivingFlow living({.observer = &last});
  EXPECT_EQ(living.solve(mesh, conditions).status, FlowStatus::interrupted);
  EXPECT_THROW(living.gradients(), Error);
}

TEST(LivingFlow, GradientsEndWhereTheyAreCancelled) {
  const Mesh mesh = generate(domain_of(named_airfoil("naca:0012", 5)), {.gradation = 1.2}).mesh;
  constexpr int many = 1000;
  EndsAt observer(many);
  LivingFlow living({.observer = &observer});
  ASSERT_TRUE(living.solve(mesh, {.mach = 0.6, .alpha_deg = 1.25}).converged());
  observer.left = 1;
  const FlowGradients none = living.gradients();
  EXPECT_TRUE(none.interrupted);
  EXPECT_TRUE(none.cl.points.empty());
  EXPECT_EQ(none.krylov_iterations, 0);
  observer.left = many;
  EXPECT_FALSE(living.gradients().cl.points.empty());
}

// The first needs them: the flow that it begins with was found by GMRES.
TEST(LivingFlow, SmallStepsNeedNoFactorsOfTheirOwn) {
  std::mt19937_64 random(12);
  CstAirfoil airfoil = named_airfoil("naca:2412", 5);
  Mesh mesh = generate(domain_of(airfoil), {.gradation = 1.2}).mesh;
  LivingFlow living;
  const FlowConditions conditions = {.mach = 0.5, .alpha_deg = 1.25};
  living.solve(mesh, conditions);
  for (int i = 0; i < 5; ++i) {
    walk(airfoil, 3e-4, random);
    remodel(mesh, domain_of(airfoil), {.strategy = Strategy::chain});
    const FlowResult flow = living.solve(mesh, conditions);
    ASSERT_TRUE(flow.converged()) << flow.reason;
    EXPECT_EQ(flow.start, i == 0 ? FlowStart::refactored : FlowStart::carried);
    EXPECT_EQ(flow.factorisations, i == 0 ? 1 : 0);
    EXPECT_LT(flow.krylov_iterations, 15);
  }
}

TEST(LivingFlow, APartialStepIsCorrectedWhereTheMeshChanged) {
  std::mt19937_64 random(13);
  CstAirfoil airfoil = named_airfoil("naca:2412", 5);
  Mesh mesh = generate(domain_of(airfoil), {.gradation = 1.2}).mesh;
  LivingFlow living;
  const FlowConditions conditions = {.mach = 0.5, .alpha_deg = 1.25};
  living.solve(mesh, conditions);
  bool corrected = false;
  for (int i = 0; i < 20 && !corrected; ++i) {
    walk(airfoil, 1e-2, random);
    const bool full = remodel(mesh, domain_of(airfoil), {.strategy = Strategy::chain}).full_adjustment;
    const FlowResult flow = living.solve(mesh, conditions);
    ASSERT_TRUE(flow.converged()) << flow.reason;
    corrected = !full && flow.start == FlowStart::carried && flow.corrected_vertices > 0;
  }
  EXPECT_TRUE(corrected);
}

TEST(LivingFlow, OtherConditionsAndOtherMeshesOnlyTakeLonger) {
  Mesh mesh = test::airfoil_mesh("naca:0012", 60);
  LivingFlow living;
  for (const FlowConditions& conditions :
       {FlowConditions{.mach = 0.5, .alpha_deg = 1.0}, FlowConditions{.mach = 0.52, .alpha_deg = 2.0},
        FlowConditions{.mach = 0.75, .alpha_deg = 0.0},
        FlowConditions{.mach = 0.5, .alpha_deg = 0.0, .cl = 0.4}}) {
    const FlowResult warm = living.solve(mesh, conditions);
    ASSERT_TRUE(warm.converged()) << warm.reason;
    const FlowConditions same = {.mach = conditions.mach, .alpha_deg = warm.alpha_deg};
    EXPECT_NEAR(warm.cl, solve_flow(mesh.freeze(), same).cl, 1e-7);
  }
  const Mesh other = test::airfoil_mesh("naca:4412", 80);
  const FlowConditions conditions = {.mach = 0.5, .alpha_deg = 1.0};
  const FlowResult warm = living.solve(other, conditions);
  ASSERT_TRUE(warm.converged()) << warm.reason;
  EXPECT_NEAR(warm.cl, solve_flow(other.freeze(), conditions).cl, 1e-8);
}

TEST(LivingFlow, ATrialLeavesTheSolverGoodForTheMeshThatReturns) {
  CstAirfoil airfoil = named_airfoil("naca:2412", 5);
  Mesh mesh = generate(domain_of(airfoil), {.gradation = 1.2}).mesh;
  LivingFlow living;
  const FlowConditions conditions = {.mach = 0.5, .alpha_deg = 1.25};
  const FlowResult before = living.solve(mesh, conditions);
  std::mt19937_64 random(14);
  for (int i = 0; i < 3; ++i) {
    CstAirfoil tried = airfoil;
    walk(tried, 2e-2, random);
    const Trial trial(mesh, domain_of(tried), {.strategy = Strategy::chain});
    EXPECT_TRUE(living.solve(mesh, conditions).converged());
  }
  const FlowResult after = living.solve(mesh, conditions);
  ASSERT_TRUE(after.converged()) << after.reason;
  EXPECT_NEAR(after.cl, before.cl, 1e-8);
}

TEST(LivingFlow, TheSameRowOfDesignsGivesTheSameBits) {
  const auto row = [] {
    std::mt19937_64 random(15);
    CstAirfoil airfoil = named_airfoil("naca:0012", 5);
    Mesh mesh = generate(domain_of(airfoil), {.gradation = 1.2}).mesh;
    LivingFlow living;
    std::vector<double> figures;
    for (int i = 0; i < 6; ++i) {
      walk(airfoil, 1e-2, random);
      remodel(mesh, domain_of(airfoil), {.strategy = Strategy::chain});
      const FlowResult flow = living.solve(mesh, {.mach = 0.6, .alpha_deg = 1.25});
      figures.insert(figures.end(), flow.history.begin(), flow.history.end());
      figures.insert(figures.end(), flow.pressure.begin(), flow.pressure.end());
    }
    return figures;
  };
  EXPECT_EQ(row(), row());
}

TEST(LivingFlow, AFlowFromAnotherMeshsIsTheFlow) {
  const FrozenMesh before = test::airfoil_mesh("naca:0012", 60).freeze();
  const FrozenMesh mesh = test::airfoil_mesh("naca:0012", 70).freeze();
  const FlowConditions conditions = {.mach = 0.6, .alpha_deg = 1.25};
  const FlowResult known = solve_flow(before, conditions);
  const FlowResult warm = solve_flow_from(before, known, mesh, conditions);
  const FlowResult cold = solve_flow(mesh, conditions);
  ASSERT_TRUE(warm.converged()) << warm.reason;
  EXPECT_NEAR(warm.cl, cold.cl, 1e-8);
  EXPECT_EQ(warm.origin, FlowOrigin::last_flow);
}

}  // namespace
}  // namespace remodel
