// The length that the limiter has, and that flows through meshes of another size are the same.

#include "flow/scheme/wall_extent.h"

#include <gtest/gtest.h>

#include "flow/test_flows.h"
#include "remodel/flow.h"
#include "remodel/mesh_derivative.h"

namespace remodel {
namespace {

// Walls from one point to the next, closed or not.
struct Outline {
  std::vector<Point> points = {};
  std::vector<flow::BoundaryEdge> edges = {};
  void add(const std::vector<Point>& chain, bool closed) {
    const auto first = static_cast<std::uint32_t>(points.size());
    const auto count = static_cast<std::uint32_t>(chain.size());
    points.insert(points.end(), chain.begin(), chain.end());
    for (std::uint32_t i = 0; i + (closed ? 0 : 1) < count; ++i)
      edges.push_back({first + i, first + (i + 1) % count, {}, 0});
  }
  double extent() const { return flow::wall_extent(points, edges).length; }
};

TEST(WallExtent, IsTheChordOfASection) {
  EXPECT_NEAR(flow::FlowMesh(test::airfoil_mesh("naca:0012", 60).freeze(), "farfield", "").extent().length,
              1.0, 1e-12);
  EXPECT_NEAR(flow::FlowMesh(test::airfoil_mesh("naca:4412", 60).freeze(), "farfield", "").extent().length,
              1.0, 1e-12);
}

TEST(WallExtent, IsThatOfTheLargestOfSeveralWalls) {
  Outline outline;
  outline.add({{0, 0}, {1, -0.1}, {2, 0}, {1, 0.1}}, true);
  outline.add({{5, 0}, {5.5, -0.1}, {6, 0}, {5.5, 0.1}}, true);
  EXPECT_DOUBLE_EQ(outline.extent(), 2.0);
}

TEST(WallExtent, LeavesOutWhatIsStraightWhereAWallBends) {
  Outline half;  // a section on a line of symmetry
  half.add({{-25, 0}, {-10, 0}, {0, 0}, {0.3, 0.06}, {1, 0}, {10, 0}, {25, 0}}, false);
  EXPECT_DOUBLE_EQ(half.extent(), 1.0);
  Outline duct;
  duct.add({{0, 0}, {1, 0}, {4, 0}}, false);
  duct.add({{4, 1}, {1, 1}, {0, 1}}, false);
  EXPECT_DOUBLE_EQ(duct.extent(), 4.0);
  EXPECT_EQ(Outline{}.extent(), 0.0);
}

TEST(WallExtent, TheReferenceLengthChangesCoefficientsAlone) {
  const FrozenMesh mesh = test::airfoil_mesh("naca:2412", 60).freeze();
  const FlowResult one = solve_flow(mesh, {.mach = 0.7, .alpha_deg = 1.25});
  const FlowResult half = solve_flow(mesh, {.mach = 0.7, .alpha_deg = 1.25, .reference_length = 0.5});
  ASSERT_TRUE(one.converged()) << one.reason;
  EXPECT_EQ(half.pressure, one.pressure);
  EXPECT_EQ(half.velocity_y, one.velocity_y);
  EXPECT_EQ(half.history, one.history);
  EXPECT_DOUBLE_EQ(half.cl, 2.0 * one.cl);
  EXPECT_DOUBLE_EQ(half.cd, 2.0 * one.cd);
  EXPECT_DOUBLE_EQ(half.cm, 4.0 * one.cm);
  EXPECT_DOUBLE_EQ(half.bodies.at(0).cl, half.cl);
  const FlowResult lift =
      solve_flow(mesh, {.mach = 0.7, .alpha_deg = 1.0, .cl = 2.0 * one.cl, .reference_length = 0.5});
  ASSERT_TRUE(lift.converged()) << lift.reason;
  EXPECT_NEAR(lift.alpha_deg, 1.25, 1e-7);
}

TEST(WallExtent, AMeshInMillimetresHasTheSameFlow) {
  for (const std::optional<double> cl : {std::optional<double>{}, std::optional<double>{0.3}}) {
    FrozenMesh mesh = test::airfoil_mesh("naca:2412", 60).freeze();
    const FlowResult chords = solve_flow(mesh, {.mach = 0.7, .alpha_deg = 1.25, .cl = cl});
    for (Point& p : mesh.points) p = 1000.0 * p;
    const FlowResult large = solve_flow(
        mesh,
        {.mach = 0.7, .alpha_deg = 1.25, .cl = cl, .reference = {250.0, 0.0}, .reference_length = 1000.0});
    ASSERT_TRUE(chords.converged() && large.converged()) << chords.reason << large.reason;
    EXPECT_EQ(large.newton_steps, chords.newton_steps);
    EXPECT_NEAR(large.cl, chords.cl, 1e-10);
    EXPECT_NEAR(large.cd, chords.cd, 1e-10);
    EXPECT_NEAR(large.cm, chords.cm, 1e-10);
  }
}

// Gradients by what moves the trailing edge, and so the length itself, with another reference length.
TEST(WallExtent, GradientsFollowTheLength) {
  const Mesh mesh = test::airfoil_mesh("naca:2412", 60);
  const FlowConditions conditions = {.mach = 0.6, .alpha_deg = 1.25, .reference_length = 0.4};
  const FlowOptions options = {.tolerance = 1e-12};
  LivingFlow living(options);
  ASSERT_TRUE(living.solve(mesh, conditions).converged());
  const FlowGradients gradients = living.gradients();
  FrozenMesh frozen = mesh.freeze();
  std::size_t tip = 0;  // the trailing edge
  for (std::size_t v = 0; v < frozen.points.size(); ++v)
    if (squared_distance(frozen.points[v], {1.0, 0.0}) < squared_distance(frozen.points[tip], {1.0, 0.0}))
      tip = v;
  const double x = frozen.points[tip].x, h = 1e-6;
  const auto at = [&](double step) {
    frozen.points[tip].x = x + step;
    return solve_flow(frozen, conditions, options);
  };
  const FlowResult a = at(-2 * h), b = at(-h), c = at(h), d = at(2 * h);
  const auto slope = [&](double FlowResult::*of) {
    return (a.*of - 8 * (b.*of) + 8 * (c.*of) - d.*of) / (12 * h);
  };
  EXPECT_NEAR(gradients.cl.points[tip].x, slope(&FlowResult::cl), 2e-6 * std::fabs(slope(&FlowResult::cl)));
  EXPECT_NEAR(gradients.cd.points[tip].x, slope(&FlowResult::cd), 2e-6 * std::fabs(slope(&FlowResult::cd)));
  EXPECT_NEAR(gradients.cm.points[tip].x, slope(&FlowResult::cm), 2e-6 * std::fabs(slope(&FlowResult::cm)));
}

}  // namespace
}  // namespace remodel
