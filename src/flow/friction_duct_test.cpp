// Flows with friction in ducts: on layers that end at an inlet and an outlet.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "flow/living_flow/last_flow.h"
#include "flow/scheme/friction_mesh.h"
#include "flow/solution.h"
#include "remodel/flow.h"
#include "remodel/generate.h"
#include "remodel/layers.h"

namespace remodel::flow {
namespace {

// A channel of height 1 between two walls.
LayeredMesh channel_mesh(double length) {
  const auto line = [](const std::string& name, Point from, Point to, std::size_t pieces) {
    return Curve{.name = name, .shape = Line{from, to}, .parameters = Parameters::uniform(pieces)};
  };
  Domain domain{
      {{.role = LoopRole::outer,
        .curves = {line("wall", {0, 0}, {length, 0}, 1), line("outlet", {length, 0}, {length, 1}, 4),
                   line("wall", {length, 1}, {0, 1}, 1), line("inlet", {0, 1}, {0, 0}, 4)}}}};
  space_walls(domain, {.trailing_edge = 0.05, .most = 0.1, .growth = 0.2});
  return generate_layered(domain, {.first_height = 0.01, .growth = 1.3, .thickness = 0.2}, {.gradation = 8.0})
      .mesh;
}

FlowOptions channel_options(double pressure) {
  FlowOptions options;
  options.model = FlowModel::laminar, options.temperature_k = 0.0, options.tolerance = 1e-11;
  options.inlets = {{.name = "inlet"}};
  options.outlets = {{.name = "outlet", .pressure = pressure}};
  return options;
}

// Between plates the flow becomes Poiseuille's: a parabola, whose friction is 12 / Re by mean speed and
// height. It stays so up to the outlet, corners included.
TEST(FrictionInDucts, AChannelsFlowBecomesPoiseuilles) {
  const double mach = 0.03, reynolds = 20.0, length = 3.0;
  const FrozenMesh mesh = channel_mesh(length).freeze();
  const FlowResult flow =
      solve_flow(mesh, {.mach = mach, .reynolds = reynolds}, channel_options(0.9976), "channel");
  ASSERT_TRUE(flow.converged()) << flow.reason;
  ASSERT_EQ(flow.openings.size(), 2);
  EXPECT_NEAR(flow.openings[0].mass_flow, -flow.openings[1].mass_flow, 1e-9);
  const double mean = flow.openings[0].mass_flow / mach;  // over the stream's
  int on_walls = 0, inside = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const Point p = mesh.points[v];
    if (p.x < 1.5) continue;
    if (p.y == 0.0 || p.y == 1.0) {
      EXPECT_NEAR(flow.friction->cf[v] / (12.0 * mean / reynolds), 1.0, 0.035) << p.x << " " << p.y;
      ++on_walls;
    }
    const double mass = flow.density[v] * flow.velocity_x[v] / (mach * mean);
    EXPECT_NEAR(mass, 6.0 * p.y * (1.0 - p.y), 0.03) << p.x << " " << p.y;
    ++inside;
  }
  EXPECT_GT(on_walls, 30);
  EXPECT_GT(inside, 200);
}

// Gas beside warm walls has another entropy than what enters, which is still as it was given.
TEST(FrictionInDucts, WarmWallsLeaveTheInletAsItIsGiven) {
  const FrozenMesh mesh = channel_mesh(3.0).freeze();
  FlowConditions conditions{.mach = 0.05, .reynolds = 20.0};
  conditions.wall_temperature = 1.02;
  const FlowResult flow = solve_flow(mesh, conditions, channel_options(0.9934), "channel");
  ASSERT_TRUE(flow.converged()) << flow.reason;
  const FlowOpening& inlet = flow.openings[0];
  const double dynamic = 0.7 * inlet.mach * inlet.mach * inlet.pressure;
  EXPECT_NEAR(inlet.total_pressure, 1.0, 0.1 * dynamic);
  for (const std::string& warning : flow.warnings)
    EXPECT_EQ(warning.find("'inlet'"), warning.npos) << warning;
}

// Against differences of whole flows along a smooth displacement of all points.
TEST(FrictionInDucts, GradientsAreThoseOfWholeFlows) {
  const FlowConditions conditions{.mach = 0.3, .reynolds = 40.0};
  FlowOptions options = channel_options(0.9);
  options.tolerance = 1e-12;
  const FrozenMesh mesh = channel_mesh(1.0).freeze();
  LivingFlow living(options);
  ASSERT_TRUE(living.solve(mesh, conditions).converged());
  const FlowGradients found = living.gradients();
  const auto direction = [](Point p) {
    return Point{0.2 * std::sin(3.0 * p.y + 1.0) * p.x, std::cos(2.0 * p.x - 0.5) * (p.y + 0.3)};
  };
  const auto drag = [&](double step) {
    FrozenMesh moved = mesh;
    for (Point& p : moved.points) p = p + step * direction(p);
    const FlowResult flow = living.solve(moved, conditions);
    EXPECT_TRUE(flow.converged()) << flow.reason;
    return flow.cd;
  };
  const double h = 1e-5;
  const double by_flows = (8.0 * (drag(h) - drag(-h)) - (drag(2 * h) - drag(-2 * h))) / (12.0 * h);
  double by_adjoint = 0.0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    by_adjoint += dot(found.cd.points[v], direction(mesh.points[v]));
  EXPECT_NEAR(by_adjoint, by_flows, 1e-6 * std::fabs(by_flows) + 1e-8);
}

// Whichever way a wall bulges, gas lies above the floor and below the ceiling.
TEST(FrictionInDucts, FloorsAreUpperSidesAndCeilingsLowerOnes) {
  for (const double bulge : {-0.01, 0.0, 0.01}) {
    const auto wall = [](Point from, Point middle, Point to) {
      return Curve{
          .name = "wall", .shape = spline_through({from, middle, to}), .parameters = Parameters::uniform(24)};
    };
    const auto line = [](const char* name, Point from, Point to) {
      return Curve{.name = name, .shape = Line{from, to}, .parameters = Parameters::uniform(8)};
    };
    const Domain domain{
        {{.role = LoopRole::outer,
          .curves = {wall({0, 0}, {1.5, bulge}, {3, 0}), line("outlet", {3, 0}, {3, 1}),
                     wall({3, 1}, {1.5, 1 + bulge}, {0, 1}), line("inlet", {0, 1}, {0, 0})}}}};
    FlowOptions options = channel_options(1.0);
    options.model = FlowModel::sa;
    const FlowMesh mesh =
        dual_of(generate(domain).mesh.freeze(), {.mach = 0.2, .reynolds = 1e6}, options, "duct");
    const FrictionMesh friction(mesh, std::array{0.5, 0.2});
    for (std::size_t v = 0; v < mesh.size(); ++v) {
      const Point p = mesh.points()[v];
      const double transition = p.y < 0.5 ? 1.5 : 0.6;
      if (std::abs(p.y - 0.5) < 0.1 || std::abs(p.x - transition) < 0.1) continue;
      EXPECT_EQ(friction.is_laminar(v), p.x < transition) << bulge << ": " << p.x << " " << p.y;
    }
  }
}

// A section whose base is an outlet has both sides all the same.
TEST(FrictionInDucts, ABodyWithAnOpeningHasTwoSides) {
  const auto line = [](const char* name, Point from, Point to) {
    return Curve{.name = name, .shape = Line{from, to}, .parameters = Parameters::uniform(10)};
  };
  const Domain domain{
      {{.role = LoopRole::hole,
        .curves = {line("wall", {0, 0}, {1, 0.1}), line("base", {1, 0.1}, {1, -0.1}),
                   line("wall", {1, -0.1}, {0, 0})}},
       {.role = LoopRole::outer,
        .curves = {{.name = "farfield",
                    .shape = Arc{.centre = {0, 0}, .radius = 5, .start = 0, .sweep = 6.283185307179586},
                    .parameters = Parameters::uniform(20)}}}}};
  FlowOptions options;
  options.model = FlowModel::sa;
  options.outlets = {{.name = "base"}};
  const FlowMesh mesh =
      dual_of(generate(domain).mesh.freeze(), {.mach = 0.2, .reynolds = 1e6}, options, "body");
  const FrictionMesh friction(mesh, std::array{0.7, 0.2});
  int seen = 0;
  for (std::size_t v = 0; v < mesh.size(); ++v) {
    const Point p = mesh.points()[v];
    const double transition = p.y > 0.0 ? 0.7 : 0.2;
    if (!friction.sticks(v) || std::abs(p.x - transition) < 0.05) continue;
    EXPECT_EQ(friction.is_laminar(v), p.x < transition) << p.x << " " << p.y;
    ++seen;
  }
  EXPECT_GT(seen, 12);
}

}  // namespace
}  // namespace remodel::flow
