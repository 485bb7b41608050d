#include "remodel/flow.h"

#include <gtest/gtest.h>

#include "flow/test_flows.h"
#include "remodel/error.h"

namespace remodel {
namespace {

FlowResult section_flow(const char* name, int points, const FlowConditions& conditions) {
  return solve_flow(test::airfoil_mesh(name, points).freeze(), conditions);
}

std::string message_of(const FrozenMesh& mesh, const FlowConditions& conditions,
                       const FlowOptions& options = {}) {
  try {
    solve_flow(mesh, conditions, options, "file.su2");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::argument);
    return error.what();
  }
  return "no error";
}

TEST(Flow, Naca0012AtMachHalfConvergesToTheReference) {
  // J. C. Vassberg and A. Jameson, J. Aircraft 47 (2010): a lift coefficient of .1803 and no drag.
  const FlowResult coarse = section_flow("naca:0012", 100, {.mach = 0.5, .alpha_deg = 1.25});
  const FlowResult fine = section_flow("naca:0012", 200, {.mach = 0.5, .alpha_deg = 1.25});
  ASSERT_TRUE(coarse.converged()) << coarse.reason;
  ASSERT_TRUE(fine.converged()) << fine.reason;
  EXPECT_NEAR(coarse.cl, 0.1803, 0.010);
  EXPECT_NEAR(fine.cl, 0.1803, 0.0045);
  EXPECT_LT(std::fabs(fine.cl - 0.1803), std::fabs(coarse.cl - 0.1803));
  EXPECT_GT(fine.cd, 0.0);
  EXPECT_LT(coarse.cd, 60e-4);
  EXPECT_LT(fine.cd, coarse.cd / 3.5);
  EXPECT_LE(fine.residual, 1e-10);
}

TEST(Flow, TransonicFlowHasAShock) {
  const FlowResult flow = section_flow("naca:0012", 100, {.mach = 0.8, .alpha_deg = 1.25});
  ASSERT_TRUE(flow.converged()) << flow.reason;
  EXPECT_NEAR(flow.cl, 0.355, 0.03);
  EXPECT_NEAR(flow.cd, 0.0260, 0.006);
  const std::vector<double> mach = mach_numbers(flow), cp = pressure_coefficients(flow);
  EXPECT_GT(*std::max_element(mach.begin(), mach.end()), 1.2);
  EXPECT_LT(*std::max_element(mach.begin(), mach.end()), 1.6);
  // The pressure at a stagnation point is ((1 + 0.2 M^2)^3.5 - 1) / (0.7 M^2).
  EXPECT_NEAR(*std::max_element(cp.begin(), cp.end()), 1.170, 0.06);
}

TEST(Flow, TheAngleIsFoundForALift) {
  const FrozenMesh mesh = test::airfoil_mesh("naca:2412", 60).freeze();
  const FlowResult wanted = solve_flow(mesh, {.mach = 0.5, .alpha_deg = 0.0, .cl = 0.5});
  ASSERT_TRUE(wanted.converged()) << wanted.reason;
  EXPECT_NEAR(wanted.cl, 0.5, 1e-9);
  const FlowResult given = solve_flow(mesh, {.mach = 0.5, .alpha_deg = wanted.alpha_deg});
  EXPECT_NEAR(given.cl, 0.5, 1e-8);
  EXPECT_NEAR(given.cd, wanted.cd, 1e-9);
}

TEST(Flow, PartsOfBodiesAddUp) {
  const Domain domain =
      airfoils_domain({{.name = "main", .airfoil = named_airfoil("naca:2412", 5)},
                       {.name = "flap",
                        .airfoil = named_airfoil("naca:0012", 5),
                        .placement = {.chord = 0.3, .rotation_deg = -15.0, .position = {1.05, -0.05}}}},
                      {.points = 80});
  const FlowResult flow =
      solve_flow(generate(domain, {.gradation = 2.0}).mesh.freeze(), {.mach = 0.2, .alpha_deg = 2});
  ASSERT_TRUE(flow.converged()) << flow.reason;
  ASSERT_EQ(flow.bodies.size(), 2U);
  EXPECT_NEAR(flow.bodies[0].cl + flow.bodies[1].cl, flow.cl, 1e-12);
  EXPECT_NEAR(flow.bodies[0].cd + flow.bodies[1].cd, flow.cd, 1e-12);
  EXPECT_NEAR(flow.bodies[0].cm + flow.bodies[1].cm, flow.cm, 1e-12);
  EXPECT_GT(flow.cl, 0.8);
}

TEST(Flow, MirroredFlowIsMirrored) {
  FrozenMesh mesh = test::airfoil_mesh("naca:2412", 60).freeze();
  const FlowResult up = solve_flow(mesh, {.mach = 0.6, .alpha_deg = 1.0});
  for (Point& p : mesh.points) p.y = -p.y;
  for (auto& corners : mesh.triangles) std::swap(corners[1], corners[2]);
  for (FrozenBoundary& boundary : mesh.boundaries)
    for (auto& edge : boundary.edges) std::swap(edge[0], edge[1]);
  const FlowResult down = solve_flow(mesh, {.mach = 0.6, .alpha_deg = -1.0});
  EXPECT_NEAR(up.cl, -down.cl, 1e-8);
  EXPECT_NEAR(up.cd, down.cd, 1e-8);
  EXPECT_NEAR(up.cm, -down.cm, 1e-8);
}

TEST(Flow, TheSameInputGivesTheSameBits) {
  const FrozenMesh mesh = test::airfoil_mesh("naca:4412", 60).freeze();
  const FlowResult first = solve_flow(mesh, {.mach = 0.6, .alpha_deg = 1.0});
  const FlowResult second = solve_flow(mesh, {.mach = 0.6, .alpha_deg = 1.0});
  EXPECT_EQ(first.pressure, second.pressure);
  EXPECT_EQ(first.history, second.history);
  EXPECT_EQ(first.cl, second.cl);
}

TEST(Flow, FineMeshesBeginOnCoarserOnesWhereShocksMayBe) {
  const Mesh fine = test::airfoil_mesh("naca:2412", 200);
  const FlowConditions conditions{.mach = 0.65, .alpha_deg = 0.0};
  const FlowResult direct = solve_flow(fine.freeze(), conditions);
  const FlowResult sequenced = solve_flow(fine, conditions);
  ASSERT_TRUE(direct.converged() && sequenced.converged()) << direct.reason << sequenced.reason;
  EXPECT_EQ(direct.origin, FlowOrigin::potential);
  EXPECT_EQ(direct.coarse_steps, 0);
  EXPECT_EQ(sequenced.origin, FlowOrigin::coarser_mesh);
  EXPECT_GT(sequenced.coarse_steps, 0);
  EXPECT_NEAR(sequenced.cl, direct.cl, 1e-8);
  EXPECT_NEAR(sequenced.cd, direct.cd, 1e-8);
}

TEST(Flow, PotentialFlowIsNearer) {
  const FrozenMesh mesh = test::airfoil_mesh("naca:4412", 80).freeze();
  const flow::FlowMesh dual(mesh, "farfield", "naca:4412");
  for (const std::optional<double> lift : {std::optional<double>{}, std::optional<double>{0.6}}) {
    const flow::FlowSystem system(dual, {.mach = 0.3, .alpha = 0.05, .lift = lift});
    const flow::Measure measure(system);
    const FlowOptions options;
    int steps[2];
    double lifts[2];
    for (const bool potential : {false, true}) {
      flow::WholeMatrix matrix;
      flow::Factors factors;
      flow::State state;
      flow::SearchRecord record;
      flow::NewtonSearch search(options, matrix, factors, record);
      potential ? search.cold(measure, state) : search.from_undisturbed_flow(measure, state);
      ASSERT_EQ(record.status, FlowStatus::converged) << record.reason;
      EXPECT_EQ(record.origin, potential ? FlowOrigin::potential : FlowOrigin::undisturbed);
      steps[potential] = record.newton_steps, lifts[potential] = state.augmented[0];
    }
    EXPECT_LE(3 * steps[1], 2 * steps[0]);
    EXPECT_NEAR(lifts[1], lifts[0], 1e-8);
  }
}

TEST(Flow, LimitsAreInTheResult) {
  const FrozenMesh mesh = test::airfoil_mesh("naca:4412", 60).freeze();
  const FlowResult few = solve_flow(mesh, {.mach = 0.6}, {.max_steps = 2});
  EXPECT_EQ(few.status, FlowStatus::step_limit);
  EXPECT_FALSE(few.converged());
  EXPECT_NE(few.reason, "");
  EXPECT_EQ(solve_flow(mesh, {.mach = 0.6}, {.memory_mb = 1}).status, FlowStatus::memory);
  struct Cancel : StepObserver {
    bool cancelled() override { return true; }
  } cancel;
  EXPECT_EQ(solve_flow(mesh, {.mach = 0.6}, {.observer = &cancel}).status, FlowStatus::interrupted);
}

TEST(Flow, BadInputIsOneSentence) {
  FrozenMesh mesh = test::airfoil_mesh("naca:0012", 40).freeze();
  EXPECT_EQ(message_of(mesh, {.mach = 0.0}), "mach: found 0, expected 0.01 to 3");
  EXPECT_EQ(message_of(mesh, {.mach = 4.0}), "mach: found 4, expected 0.01 to 3");
  EXPECT_EQ(message_of(mesh, {.alpha_deg = 120.0}), "alpha: found 120, expected -90 to 90 degrees");
  EXPECT_EQ(message_of(mesh, {.mach = 1.5, .cl = 0.3}),
            "mach: found 1.5, expected less than 1 where a lift coefficient is given");
  EXPECT_EQ(message_of(mesh, {.reference_length = 0.0}), "reference length: found 0, expected more than 0");
  EXPECT_EQ(message_of(mesh, {}, {.farfield = {"outer"}}),
            "file.su2: found boundaries 'airfoil', 'farfield', expected a far field of the name 'outer'");
  FrozenMesh open = mesh;
  open.boundaries[0].edges.pop_back();
  EXPECT_NE(message_of(open, {}).find("bounds the domain and has no name, expected a named boundary"),
            std::string::npos);
  FrozenMesh stray = mesh;
  stray.points.push_back({3.0, 3.0});
  EXPECT_NE(message_of(stray, {}).find("is of no triangle, expected every point to be of one"),
            std::string::npos);
  for (FrozenBoundary& boundary : mesh.boundaries) boundary.name = "farfield";
  EXPECT_EQ(message_of(mesh, {}), "file.su2: found no wall among the boundaries, expected one");
}

TEST(Flow, TrianglesThatAreNotCounterClockwiseAreRefused) {
  const FrozenMesh mesh = test::airfoil_mesh("naca:0012", 40).freeze();
  FrozenMesh turned = mesh;
  std::swap(turned.triangles[7][1], turned.triangles[7][2]);
  const auto& corners = turned.triangles[7];
  const std::string points =
      std::to_string(corners[0]) + ", " + std::to_string(corners[1]) + ", " + std::to_string(corners[2]);
  EXPECT_EQ(message_of(turned, {}), "file.su2: triangle 7 (points " + points +
                                        ") is clockwise, expected every triangle to be counter-clockwise");
  FrozenMesh flat = mesh;
  flat.triangles[9][2] = flat.triangles[9][1];
  EXPECT_NE(message_of(flat, {}).find("file.su2: triangle 9 "), std::string::npos);
  EXPECT_NE(message_of(flat, {}).find("has no area"), std::string::npos);
}

TEST(Flow, TheFarFieldLiesAroundTheWalls) {
  const FrozenMesh mesh = test::airfoil_mesh("naca:0012", 40).freeze();
  EXPECT_EQ(message_of(mesh, {}, {.farfield = {"airfoil"}}),
            "file.su2: the far field bounds a hole of the domain, expected it to lie around the walls");
}

// Also where a search has ended on its way, which need not be exact itself.
TEST(Flow, MessagesNameTheToleranceThatWasAskedFor) {
  const FrozenMesh mesh = test::airfoil_mesh("e376", 50).freeze();
  const FlowConditions stalls = {.mach = 0.823, .alpha_deg = -0.57};
  const FlowResult in_stages = solve_flow(mesh, stalls, {.tolerance = 1e-9, .max_steps = 45});
  ASSERT_EQ(in_stages.status, FlowStatus::step_limit);
  EXPECT_NE(in_stages.reason.find("expected 1e-09"), std::string::npos) << in_stages.reason;
  const FlowResult lift = solve_flow(mesh, {.mach = 0.5, .cl = 0.4}, {.tolerance = 1e-9, .max_steps = 2});
  ASSERT_EQ(lift.status, FlowStatus::step_limit);
  EXPECT_NE(lift.reason.find("expected 1e-09"), std::string::npos) << lift.reason;
}

TEST(Flow, EachNewtonStepIsTold) {
  const FrozenMesh mesh = test::airfoil_mesh("naca:2412", 40).freeze();
  std::vector<FlowProgress> steps;
  const FlowResult flow =
      solve_flow(mesh, {.mach = 0.5, .alpha_deg = 1.0, .reference_length = 0.5},
                 {.on_step = [&](const FlowProgress& progress) { steps.push_back(progress); }});
  ASSERT_FALSE(steps.empty());
  EXPECT_EQ(steps.back().newton_step, flow.newton_steps);
  EXPECT_EQ(steps.back().residual, flow.residual);
  EXPECT_DOUBLE_EQ(steps.back().cl, flow.cl);
}

// At the nose a vertex runs empty, from undisturbed flow.
TEST(Flow, AFlowThatStallsIsFoundInStages) {
  const FrozenMesh mesh = test::airfoil_mesh("e376", 50).freeze();
  const FlowOptions options = {.tolerance = 1e-10};
  const flow::FlowMesh dual(mesh, "farfield", "e376");
  const flow::FlowSystem system(dual, {.mach = 0.823, .alpha = -0.57 * M_PI / 180.0});
  const flow::Measure measure(system);
  flow::WholeMatrix matrix;
  flow::Factors factors;
  flow::State state = system.undisturbed();
  flow::SearchRecord straight, record;
  flow::NewtonSearch(options, matrix, factors, straight)
      .run(measure, {.cfl = flow::SearchPolicy::cold_cfl}, state);
  EXPECT_EQ(straight.status, FlowStatus::stalled);
  EXPECT_NE(straight.reason.find("has not halved in 30 Newton steps"), std::string::npos) << straight.reason;
  flow::NewtonSearch(options, matrix, factors, record).from_undisturbed_flow(measure, state);
  EXPECT_EQ(record.status, FlowStatus::converged) << record.reason;
  EXPECT_LE(measure(state).size, options.tolerance);  // of the whole scheme, not of a stage
}

}  // namespace
}  // namespace remodel
