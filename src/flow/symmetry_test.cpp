// Half a flow beside a symmetry plane.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flow/test_flows.h"
#include "remodel/error.h"
#include "remodel/flow.h"

namespace remodel {
namespace {

// Around a cylinder of radius 1/2, out to 20, n edges around its upper half; or around all of it. The lower
// half is the mirror image of the upper one.
FrozenMesh cylinder(std::uint32_t n, bool whole) {
  FrozenMesh mesh;
  const std::uint32_t around = whole ? 2 * n : n + 1, steps = whole ? 2 * n : n;
  const auto m = static_cast<std::uint32_t>(std::ceil(std::log(40.0) / std::log(1.0 + M_PI / n)));
  for (std::uint32_t j = 0; j <= m; ++j)
    for (std::uint32_t i = 0; i < around; ++i) {
      const double r = 0.5 * std::pow(40.0, static_cast<double>(j) / m), angle = M_PI * i / n;
      mesh.points.push_back({r * std::cos(angle), i % n == 0 ? 0.0 : r * std::sin(angle)});
      mesh.vertex_keys.push_back(mesh.points.size());
    }
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return j * around + i % around; };
  mesh.boundaries = {{"cylinder", {}}, {"farfield", {}}, {"plane", {}}};
  for (std::uint32_t i = 0; i < steps; ++i) {
    for (std::uint32_t j = 0; j < m; ++j)
      test::add_cell(mesh, at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j), (i < n) == (j % 2 == 0));
    mesh.boundaries[0].edges.push_back({at(i + 1, 0), at(i, 0)});
    mesh.boundaries[1].edges.push_back({at(i, m), at(i + 1, m)});
  }
  for (std::uint32_t j = 0; j < m && !whole; ++j) {
    mesh.boundaries[2].edges.push_back({at(0, j), at(0, j + 1)});
    mesh.boundaries[2].edges.push_back({at(n, j + 1), at(n, j)});
  }
  return mesh;
}

FlowOptions beside_plane() {
  FlowOptions options;
  options.tolerance = 1e-12;
  options.symmetry = {"plane"};
  return options;
}

TEST(Symmetry, HalfAFlowIsHalfOfTheWholeOne) {
  const FlowConditions conditions = {.mach = 0.38, .reference = {0, 0}};
  double before = 0.0;
  for (const std::uint32_t n : {8U, 16U, 32U}) {
    const FlowResult half = solve_flow(cylinder(n, false), conditions, beside_plane());
    const FlowResult whole = solve_flow(cylinder(n, true), conditions);
    ASSERT_TRUE(half.converged() && whole.converged()) << half.reason << whole.reason;
    ASSERT_EQ(half.bodies.size(), 1U);  // the plane is none
    double wrong = 0.0;
    for (std::uint32_t i = 0; i <= n; ++i)
      wrong = std::max(wrong, std::fabs(half.pressure[i] - whole.pressure[i]));
    RecordProperty("wrong_" + std::to_string(n), std::to_string(wrong));
    if (n > 8) {
      EXPECT_LT(wrong, before / 2.0);
    }
    before = wrong;
  }
  EXPECT_LT(before, 5e-3);
}

TEST(Symmetry, GradientsAreThoseOfWholeFlows) {
  FrozenMesh mesh = cylinder(12, false);
  const FlowConditions conditions = {.mach = 0.38, .reference = {0, 0}};
  FlowOptions options = beside_plane();
  options.tolerance = 1e-13;
  LivingFlow living(options);
  const FrozenMesh before = mesh;
  const FlowResult flow = living.solve(mesh, conditions);
  ASSERT_TRUE(flow.converged());
  const FlowGradients gradients = living.gradients();
  constexpr std::uint32_t at_top = 6, on_plane = 13;  // of the wall, and one of the plane beside it
  constexpr double h = 4e-5;
  for (const auto& [v, along_y] : {std::pair{at_top, true}, std::pair{on_plane, false}}) {
    double& coordinate = along_y ? mesh.points[v].y : mesh.points[v].x;
    const double at = coordinate;
    const auto flow_at = [&](double step) {
      coordinate = at + step;
      return solve_flow_from(before, flow, mesh, conditions, options);  // the same of several flows
    };
    const FlowResult a = flow_at(-2 * h), b = flow_at(-h), c = flow_at(h), d = flow_at(2 * h);
    coordinate = at;
    const auto of = [&, along = along_y](Point p) { return along ? p.y : p.x; };
    const auto slope = [&](double FlowResult::*x) {
      return (a.*x - 8 * (b.*x) + 8 * (c.*x) - d.*x) / (12 * h);
    };
    EXPECT_NEAR(of(gradients.cd.points[v]), slope(&FlowResult::cd), 1e-6 * std::fabs(slope(&FlowResult::cd)));
    EXPECT_NEAR(of(gradients.cl.points[v]), slope(&FlowResult::cl), 1e-6 * std::fabs(slope(&FlowResult::cl)));
  }
}

std::string message_of(const FrozenMesh& mesh, const FlowConditions& conditions,
                       const FlowOptions& options = beside_plane()) {
  try {
    solve_flow(mesh, conditions, options, "half.su2");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::argument);
    return error.what();
  }
  return "no error";
}

TEST(Symmetry, IsStraightAndAlongTheStream) {
  FrozenMesh mesh = cylinder(8, false);
  EXPECT_EQ(message_of(mesh, {.mach = 0.3, .cl = 0.1}),
            "cl: given for a mesh with a symmetry plane, expected an angle of attack");
  EXPECT_EQ(message_of(mesh, {.mach = 0.3, .alpha_deg = 1.25}),
            "half.su2: the symmetry plane 'plane' is not along the stream between points 0 and 9, expected a "
            "straight line along the stream of angle 1.25");
  FlowOptions other = beside_plane();
  other.symmetry = {"mirror"};
  EXPECT_EQ(message_of(mesh, {.mach = 0.3}, other),
            "half.su2: found boundaries 'cylinder', 'farfield', 'plane', expected a symmetry plane of the "
            "name 'mirror'");
  other.symmetry = {"farfield"};
  EXPECT_EQ(
      message_of(mesh, {.mach = 0.3}, other),
      "boundary 'farfield': named twice, expected it to be far field, inlet or outlet, or symmetry plane");
  mesh.points[9].y += 0.01;
  EXPECT_EQ(message_of(mesh, {.mach = 0.3}),
            "half.su2: the symmetry plane 'plane' is not along the stream between points 0 and 9, expected a "
            "straight line along the stream of angle 0");
}

}  // namespace
}  // namespace remodel
