// Walls with a temperature: the heat that passes them, against theory.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

#include "flow/test_grids.h"
#include "remodel/error.h"
#include "remodel/flow.h"

namespace remodel::flow {
namespace {

constexpr double prandtl = 0.72;

// E. Pohlhausen, Z. angew. Math. Mech. 1 (1921): heat through a laminar boundary layer of constant properties
// on a plate. By Blasius's stream function f''' + f f'' / 2 = 0, whose f''(0) is known, the temperature's
// slope at the wall is 1 over the integral of (f'' / f''(0))^Pr, and over f''(0) Pr it is St / (Cf / 2).
double stanton_over_half_friction() {
  constexpr double curvature = 0.332057336, step = 1e-3;
  double f = 0.0, slope = 0.0, bend = curvature, integral = 0.0;
  for (int i = 0; i < 12000; ++i) {
    const double middle = bend - 0.25 * step * f * bend;
    f += step * slope + 0.5 * step * step * bend, slope += step * middle;
    integral += step * std::pow(middle / curvature, prandtl);
    bend -= 0.5 * step * f * middle;
  }
  return 1.0 / (integral * curvature * prandtl);
}

FlowResult plate_flow(const FrozenMesh& mesh, std::optional<double> wall_temperature) {
  FlowOptions options = test::plate_options(FlowModel::laminar);
  options.temperature_k = 0.0;
  return solve_flow(mesh, {.mach = 0.2, .reynolds = 1e5, .wall_temperature = wall_temperature}, options,
                    "plate");
}

// Warm and cold walls: the Stanton number by the recovery temperature, whose factor is the root of Pr.
TEST(WallHeat, ThePlatesHeatIsThatOfPohlhausen) {
  const double theory = stanton_over_half_friction();
  EXPECT_NEAR(theory, std::pow(prandtl, -2.0 / 3.0), 0.01);
  const double recovery = 1.0 + 0.2 * std::sqrt(prandtl) * 0.2 * 0.2;
  const FrozenMesh mesh = test::laminar_plate().frozen();
  for (const double warmth : {1.05, 0.97}) {
    const FlowResult flow = plate_flow(mesh, warmth);
    ASSERT_TRUE(flow.converged()) << flow.reason;
    EXPECT_LE(flow.newton_steps, 20);
    int compared = 0;
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
      const Point p = mesh.points[v];
      if (p.y != 0.0) continue;
      if (p.x >= 0.0) {
        EXPECT_NEAR(gas_gamma * flow.pressure[v] / flow.density[v], warmth, 1e-9) << p.x;
      }
      if (p.x < 0.2 || p.x > 1.0) continue;
      const double stanton = flow.friction->ch[v] / (recovery - warmth);
      EXPECT_NEAR(stanton / (0.5 * flow.friction->cf[v]) / theory, 1.0, 0.01) << p.x << " " << warmth;
      EXPECT_NEAR(stanton / (0.332057336 * theory / std::sqrt(1e5 * p.x)), 1.0, 0.02) << p.x << " " << warmth;
      ++compared;
    }
    EXPECT_GT(compared, 10);
    // All of it is the plate's length, 4, times twice the Stanton number at its end.
    const double whole = flow.friction->heat / (recovery - warmth);
    EXPECT_NEAR(whole / (2.0 * 0.332057336 * theory * std::sqrt(4.0 / 1e5)), 1.0, 0.03) << warmth;
  }
}

// A wall as warm as one that no heat passes takes none.
TEST(WallHeat, AWallOfRecoveryTemperatureTakesNoHeat) {
  const FrozenMesh mesh = test::laminar_plate().frozen();
  const FlowResult adiabatic = plate_flow(mesh, std::nullopt);
  ASSERT_TRUE(adiabatic.converged()) << adiabatic.reason;
  EXPECT_TRUE(adiabatic.friction->ch.empty());
  EXPECT_EQ(adiabatic.friction->heat, 0.0);
  double recovery = 0.0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if (mesh.points[v].y == 0.0 && std::fabs(mesh.points[v].x - 0.5) < 0.03)
      recovery = gas_gamma * adiabatic.pressure[v] / adiabatic.density[v];
  EXPECT_NEAR((recovery - 1.0) / (0.2 * 0.2 * 0.2), std::sqrt(prandtl), 0.01);
  const FlowResult flow = plate_flow(mesh, recovery), warm = plate_flow(mesh, recovery + 0.01);
  ASSERT_TRUE(flow.converged() && warm.converged()) << flow.reason << warm.reason;
  EXPECT_LT(std::fabs(flow.friction->heat), 0.01 * std::fabs(warm.friction->heat));
  EXPECT_LT(warm.friction->heat, 0.0);
}

TEST(WallHeat, ATemperatureOfWallsWithoutFrictionOrOfNothingIsRefused) {
  const FrozenMesh mesh = test::laminar_plate().frozen();
  FlowConditions conditions = {.mach = 0.2, .reynolds = 1e5, .wall_temperature = 1.1};
  EXPECT_THROW(solve_flow(mesh, conditions, test::plate_options(FlowModel::euler), "plate"), Error);
  for (const double of : {0.0, -1.0, std::numeric_limits<double>::infinity()}) {
    conditions.wall_temperature = of;
    EXPECT_THROW(solve_flow(mesh, conditions, test::plate_options(FlowModel::laminar), "plate"), Error);
  }
}

}  // namespace
}  // namespace remodel::flow
