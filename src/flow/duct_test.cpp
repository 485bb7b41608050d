#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "flow/search/newton_search.h"
#include "flow/test_flows.h"
#include "remodel/error.h"
#include "support.h"

namespace remodel {
namespace {

// A duct from x = 0 to `length`, as high as height(x) and symmetric about the x axis, n cells high: walls
// "lower" and "upper", ends "in" and "out".
FrozenMesh duct_mesh(std::uint32_t n, std::uint32_t cells_along, double length,
                     const std::function<double(double)>& height) {
  FrozenMesh mesh;
  const std::uint32_t m = cells_along;
  for (std::uint32_t j = 0; j <= m; ++j)
    for (std::uint32_t i = 0; i <= n; ++i) {
      const double x = length * j / m;
      mesh.points.push_back({x, height(x) * (static_cast<double>(i) / n - 0.5)});
    }
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return j * (n + 1) + i; };
  for (std::uint32_t j = 0; j < m; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = at(i, j), b = at(i, j + 1), c = at(i + 1, j + 1), d = at(i + 1, j);
      test::add_cell(mesh, a, b, c, d, (i < n / 2) == (j % 2 == 0));
    }
  mesh.boundaries = {{"lower", {}}, {"upper", {}}, {"in", {}}, {"out", {}}};
  for (std::uint32_t j = 0; j < m; ++j) {
    mesh.boundaries[0].edges.push_back({at(0, j), at(0, j + 1)});
    mesh.boundaries[1].edges.push_back({at(n, j + 1), at(n, j)});
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    mesh.boundaries[2].edges.push_back({at(i + 1, 0), at(i, 0)});
    mesh.boundaries[3].edges.push_back({at(i, m), at(i + 1, m)});
  }
  return mesh;
}

// 1 at both ends, 0.8 in the middle of the four units of length.
double nozzle_height(double x) {
  return 0.9 + 0.1 * std::cos(0.5 * M_PI * x);
}

// Height over that of the throat of one-dimensional flow at the speed of sound.
double area_ratio(double mach) {
  return std::pow((1.0 + 0.2 * mach * mach) / 1.2, 3.0) / mach;
}
double mach_of_ratio(double ratio, double low, double high) {
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    ((area_ratio(middle) > ratio) == (area_ratio(low) > ratio) ? low : high) = middle;
  }
  return low;
}

FlowOptions through(double total_pressure, double pressure) {
  FlowOptions options;
  options.inlets = {{.name = "in", .total_pressure = total_pressure}};
  options.outlets = {{.name = "out", .pressure = pressure}};
  return options;
}

std::string message_of(const FrozenMesh& mesh, const FlowConditions& conditions, const FlowOptions& options) {
  try {
    solve_flow(mesh, conditions, options, "duct");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::argument);
    return error.what();
  }
  return "no error";
}

TEST(Duct, UniformFlowIsFoundFromAnotherState) {
  const FrozenMesh mesh = duct_mesh(6, 24, 3.0, [](double) { return 1.0; });
  // The search begins at Mach 0.3; the pressures are those of Mach 0.5.
  const double ratio = std::pow(1.05 / 1.018, 3.5);
  const FlowResult flow = solve_flow(mesh, {.mach = 0.3}, through(ratio, 1.0));
  ASSERT_TRUE(flow.converged()) << flow.reason;
  for (const double mach : mach_numbers(flow)) EXPECT_NEAR(mach, 0.5, 1e-9);
  for (const double p : flow.pressure) EXPECT_NEAR(p, 1.0 / 1.4, 1e-9);
}

TEST(Duct, SubsonicFlowThroughANozzleIsThatOfOneDimension) {
  const double exit_mach = 0.3, ratio = area_ratio(exit_mach);
  double last = 1.0;
  for (const std::uint32_t n : {6U, 12U}) {
    const FrozenMesh mesh = duct_mesh(n, 4 * n, 4.0, nozzle_height);
    const FlowResult flow = solve_flow(mesh, {.mach = exit_mach}, through(1.0, 1.0));
    ASSERT_TRUE(flow.converged()) << flow.reason;
    // In the throat the Mach number is larger at the walls and smaller in the middle; its mean over the
    // height is that of one dimension but for the square of the walls' slope.
    const std::vector<double> mach = mach_numbers(flow);
    double mean = 0.0;
    for (std::uint32_t i = 0; i <= n; ++i)
      mean += mach[2 * n * (n + 1) + i] * (i == 0 || i == n ? 0.5 : 1.0) / n;
    EXPECT_NEAR(mean, mach_of_ratio(0.8 * ratio, 0.1, 1.0), 0.01);
    ASSERT_EQ(flow.openings.size(), 2U);
    EXPECT_NEAR(flow.openings[0].mass_flow, exit_mach, 2e-3);
    EXPECT_NEAR(flow.openings[0].mass_flow + flow.openings[1].mass_flow, 0.0, 1e-9);
    const std::vector<double> entropy = entropy_errors(flow);
    const double worst = std::fabs(*std::max_element(
        entropy.begin(), entropy.end(), [](double a, double b) { return std::fabs(a) < std::fabs(b); }));
    EXPECT_LT(worst, 0.6 * last);
    last = worst;
  }
  EXPECT_LT(last, 2e-3);
}

TEST(Duct, AChokedNozzleLeavesFasterThanSoundWhateverThePressureOutside) {
  constexpr std::uint32_t n = 6;
  const FrozenMesh mesh = duct_mesh(n, 5 * n, 4.0, nozzle_height);
  const double inlet_mach = mach_of_ratio(1.25, 0.1, 1.0), exit_mach = mach_of_ratio(1.25, 1.0, 3.0);
  const FlowResult flow = solve_flow(mesh, {.mach = inlet_mach}, through(1.0, 0.2));
  ASSERT_TRUE(flow.converged()) << flow.reason;
  const std::vector<double> mach = mach_numbers(flow);
  double mean = 0.0;
  for (std::uint32_t i = 0; i <= n; ++i)
    mean += mach[5 * n * (n + 1) + i] * (i == 0 || i == n ? 0.5 : 1.0) / n;
  EXPECT_NEAR(mean, exit_mach, 0.03);
  EXPECT_NEAR(flow.openings[0].mass_flow, inlet_mach, 0.01 * inlet_mach);
  const FlowResult other = solve_flow(mesh, {.mach = inlet_mach}, through(1.0, 0.3));
  ASSERT_TRUE(other.converged()) << other.reason;
  EXPECT_NEAR(other.openings[0].mass_flow, flow.openings[0].mass_flow, 1e-6);
}

TEST(Duct, TheJacobianOfInletsAndOutletsIsExact) {
  const unsigned long long seed = test::seed(9);
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  const FrozenMesh mesh = duct_mesh(4, 8, 2.0, [](double x) { return 1.0 + 0.1 * x; });
  const std::vector<flow::Patch> patches = {
      {"in", flow::Inlet{.total_pressure = 1.14, .total_temperature = 1.07}},
      {"out", flow::Outlet{.given = 0.84}}};
  const flow::FlowMesh dual(mesh, patches, "duct");
  const flow::FlowSystem system(dual, {.mach = 0.4});
  flow::State state = system.undisturbed();
  for (auto& q : state.q)
    for (double& value : q) value += test::uniform(random, -0.05, 0.05);
  flow::BlockRows matrix = system.pattern();
  system.jacobian(state, matrix);
  flow::Increment step;
  step.q.resize(dual.size());
  for (auto& block : step.q)
    for (double& value : block) value = test::uniform(random, -1, 1);
  constexpr double length = 1e-6;
  flow::Vector plus, less;
  system.residual(flow::moved(state, step, length), plus);
  system.residual(flow::moved(state, step, -length), less);
  for (std::size_t r = 0; r < matrix.rows.size(); ++r)
    for (std::size_t j = 0; j < 4; ++j) {
      double product = 0.0;
      for (std::uint32_t i = matrix.start[r]; i < matrix.start[r + 1]; ++i)
        for (std::size_t k = 0; k < 4; ++k)
          product += matrix.block[i][4 * j + k] * step.q[matrix.column[i]][k];
      EXPECT_NEAR(product, (plus[r][j] - less[r][j]) / (2.0 * length), 1e-6);
    }
}

TEST(Duct, GasLeavesAgainstLessThanTheTotalPressure) {
  const FrozenMesh mesh = duct_mesh(4, 8, 2.0, [](double) { return 1.0; });
  const std::string refusal =
      ", expected less than the 1.06443 of the total pressure that the gas enters with, for it to leave by "
      "'out'";
  EXPECT_EQ(message_of(mesh, {.mach = 0.3}, through(1.0, 2.0)), "pressure: found 2" + refusal);
  EXPECT_EQ(message_of(mesh, {.mach = 0.3}, through(1.0, 1.07)), "pressure: found 1.07" + refusal);
  EXPECT_EQ(message_of(mesh, {.mach = 0.3}, through(1.0, 1.06)), "no error");
}

TEST(Duct, WrongNamesAndPressuresAreOneSentence) {
  const FrozenMesh mesh = duct_mesh(4, 8, 2.0, [](double) { return 1.0; });
  EXPECT_EQ(
      message_of(mesh, {.mach = 0.3}, {}),
      "duct: found boundaries 'lower', 'upper', 'in', 'out', expected a far field of the name 'farfield'");
  FlowOptions options = through(1.0, 1.0);
  options.outlets[0].name = "exit";
  EXPECT_EQ(
      message_of(mesh, {.mach = 0.3}, options),
      "duct: found boundaries 'lower', 'upper', 'in', 'out', expected an inlet or outlet of the name 'exit'");
  options.outlets.clear();
  EXPECT_EQ(message_of(mesh, {.mach = 0.3}, options),
            "duct: found no far field and no outlet, expected one for the gas to leave by");
  options.outlets = {{.name = "in"}};
  EXPECT_EQ(message_of(mesh, {.mach = 0.3}, options),
            "boundary 'in': named twice, expected it to be far field, inlet or outlet");
  EXPECT_EQ(
      message_of(mesh, {.mach = 1.2}, through(1.0, 1.0)),
      "mach: found 1.2, expected less than 1 where there is an inlet (gas enters faster than sound through "
      "a far field)");
  EXPECT_EQ(message_of(mesh, {.mach = 0.3}, through(0.0, 1.0)),
            "total pressure: found 0, expected more than 0");
  EXPECT_EQ(message_of(mesh, {.mach = 0.3}, through(1.0, -1.0)), "pressure: found -1, expected more than 0");
  EXPECT_EQ(message_of(mesh, {.mach = 0.3, .cl = 0.5}, through(1.0, 1.0)),
            "cl: given for a mesh without a far field, expected an angle of attack");
}

}  // namespace
}  // namespace remodel
