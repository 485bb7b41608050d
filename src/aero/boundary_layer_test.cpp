#include "remodel/boundary_layer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flow/test_grids.h"
#include "remodel/error.h"
#include "remodel/flow.h"

namespace remodel {
namespace {

// Of constant viscosity.
FlowResult plate_flow(const FrozenMesh& mesh, FlowModel model, double reynolds) {
  FlowOptions options = test::plate_options(model);
  options.temperature_k = 0.0;
  return solve_flow(mesh, {.mach = 0.2, .reynolds = reynolds}, options, "plate");
}

// H. Schlichting, Boundary-Layer Theory (1979), chapter VII: 4.91, 1.7208 and 0.664 times x over the root of
// its Reynolds number.
TEST(BoundaryLayer, OfALaminarPlateIsThatOfBlasius) {
  const FrozenMesh mesh = test::laminar_plate().frozen();
  const FlowResult flow = plate_flow(mesh, FlowModel::laminar, 1e5);
  ASSERT_TRUE(flow.converged()) << flow.reason;
  int compared = 0;
  for (const BoundaryLayerStation& station : boundary_layer(mesh, flow)) {
    EXPECT_EQ(station.wall, "wall");
    const double x = mesh.points[station.vertex].x, unit = x / std::sqrt(1e5 * x);
    EXPECT_NEAR(station.arc, x, 1e-12);
    if (x < 0.4 || x > 1.5) continue;
    SCOPED_TRACE(x);
    EXPECT_NEAR(station.thickness / unit, 4.91, 0.15);
    EXPECT_NEAR(station.displacement_thickness / unit, 1.7208, 0.035);
    EXPECT_NEAR(station.momentum_thickness / unit, 0.664, 0.02);
    EXPECT_NEAR(station.shape_factor, 2.613, 0.06);  // 2.59 at Mach 0
    EXPECT_NEAR(station.edge_speed, 1.0, 0.01);
    ++compared;
  }
  EXPECT_GT(compared, 10);
}

// Von Karman: without a gradient of pressure the momentum thickness grows by half of the friction.
TEST(BoundaryLayer, OfATurbulentPlateLosesTheMomentumThatFrictionTakes) {
  const FrozenMesh mesh = test::turbulent_plate().frozen();
  const FlowResult flow = plate_flow(mesh, FlowModel::sa, 5e6);
  ASSERT_TRUE(flow.converged()) << flow.reason;
  const std::vector<BoundaryLayerStation> stations = boundary_layer(mesh, flow);
  double lost = 0.0, theta = BoundaryLayerStation::none, grown = 0.0;
  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    const BoundaryLayerStation &a = stations[i], &b = stations[i + 1];
    if (a.arc < 0.3 || b.arc > 1.8) continue;
    if (std::isnan(theta)) theta = a.momentum_thickness;
    lost += 0.25 * (a.cf + b.cf) * (b.arc - a.arc);
    grown = b.momentum_thickness - theta;
    EXPECT_NEAR(a.shape_factor, 1.4, 0.1) << a.arc;
  }
  EXPECT_GT(lost, 0.001);
  EXPECT_NEAR(grown / lost, 1.0, 0.03);
}

// Next to the wall u+ = y+; in the logarithmic layer u+ = log(y+) / 0.41 + 5 (D. Coles, J. Fluid Mech. 1,
// 1956; the constants are those that the turbulence model was made for).
TEST(BoundaryLayer, OfATurbulentPlateFollowsTheLawOfTheWall) {
  const FrozenMesh mesh = test::turbulent_plate().frozen();
  const FlowResult flow = plate_flow(mesh, FlowModel::sa, 5e6);
  ASSERT_TRUE(flow.converged()) << flow.reason;
  const std::vector<BoundaryLayerProfile> profiles = boundary_layer_profiles(mesh, flow, {0.4, 0.7});
  ASSERT_EQ(profiles.size(), 2U);
  for (const BoundaryLayerProfile& profile : profiles) {
    SCOPED_TRACE(profile.place);
    EXPECT_NEAR(mesh.points[profile.vertex].x, 2.0 * profile.place, 0.1);
    int viscous = 0, logarithmic = 0;
    for (const BoundaryLayerPoint& point : profile.points) {
      if (point.y_plus < 4.0) {
        EXPECT_NEAR(point.u_plus, point.y_plus, 0.03 * point.y_plus + 1e-12);
        ++viscous;
      } else if (point.y_plus > 40.0 && point.y_plus < 200.0) {
        EXPECT_NEAR(point.u_plus, std::log(point.y_plus) / 0.41 + 5.0, 0.9) << point.y_plus;
        EXPECT_NEAR(point.viscosity_ratio, 0.41 * point.y_plus, 0.25 * point.viscosity_ratio) << point.y_plus;
        ++logarithmic;
      }
    }
    EXPECT_GT(viscous, 3);
    EXPECT_GT(logarithmic, 3);
    EXPECT_NEAR(profile.points.back().speed, 1.0, 0.01);
    EXPECT_NEAR(profile.points.front().temperature, 1.0 + 0.2 * 0.04 * 0.89, 0.002);  // of recovery
  }
}

// Both sides of a symmetric section have the same layer, thin at the nose and thick at the trailing edge.
TEST(BoundaryLayer, OfASectionIsMirrored) {
  const FrozenMesh mesh =
      test::c_grid(
          {.half = 40, .wake = 20, .up = 32, .first = 3e-3, .at_nose = 5e-3, .at_edge = 5e-3, .radius = 50.0})
          .frozen();
  FlowOptions options;
  options.model = FlowModel::laminar;
  const FlowResult flow = solve_flow(mesh, {.mach = 0.5, .reynolds = 5000.0}, options, "section");
  ASSERT_TRUE(flow.converged()) << flow.reason;
  const std::vector<BoundaryLayerStation> stations = boundary_layer(mesh, flow);
  ASSERT_GT(stations.size(), 60U);
  int measured = 0;
  for (std::size_t i = 1; i < stations.size() / 2; ++i) {
    const BoundaryLayerStation &one = stations[i], &other = stations[stations.size() - i];
    const Point p = mesh.points[one.vertex], q = mesh.points[other.vertex];
    ASSERT_NEAR(p.x, q.x, 1e-12);
    ASSERT_NEAR(p.y, -q.y, 1e-12);
    if (std::isnan(one.thickness)) continue;
    EXPECT_NEAR(one.displacement_thickness, other.displacement_thickness, 1e-6) << p.x;
    EXPECT_NEAR(one.edge_speed, other.edge_speed, 1e-6) << p.x;
    if (p.x > 0.3 && p.x < 0.6) {
      EXPECT_NEAR(one.edge_speed, 1.15, 0.1) << p.x;
    }
    ++measured;
  }
  EXPECT_GT(measured, 20);
}

TEST(BoundaryLayer, WithoutFrictionIsRefused) {
  const FrozenMesh mesh = test::c_grid({.half = 8, .wake = 4, .up = 6, .first = 0.02}).frozen();
  FlowResult flow;
  EXPECT_THROW(boundary_layer(mesh, flow), Error);
  EXPECT_THROW(boundary_layer_profiles(mesh, flow, {0.5}), Error);
  flow.friction = FlowFriction{};
  EXPECT_THROW(boundary_layer(mesh, flow), Error);
}

}  // namespace
}  // namespace remodel
