// Flows whose solutions are known.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flow/newton.h"
#include "flow/test_flows.h"
#include "remodel/flow.h"

namespace remodel::flow {
namespace {

// F. Ringleb, "Exakte Loesungen der Differentialgleichungen einer adiabatischen Gasstroemung", Z. angew.
// Math. Mech. 20 (1940): flow that turns around the end of a plate, by the speed q and the number k of its
// streamline. Here from the x axis, where q = k, to q = 0.5, between
// k = 0.7 and an inner wall: at 0.9 all is slower than sound, at 1.2 the flow reaches Mach 1.42 and returns
// without a shock.
class Ringleb {
 public:
  static constexpr double outer = 0.7, slowest = 0.5;

  static Point place(double k, double q) {
    const double rho = density(q);
    return {(2.0 / (k * k) - 1.0 / (q * q)) / (2.0 * rho) - 0.5 * shift(q),
            std::sqrt(std::max(0.0, 1.0 - q * q / (k * k))) / (k * rho * q)};
  }
  // Points of one speed lie on a circle.
  static Primitive<double> at(Point p) {
    double low = 0.3, high = 1.4;
    for (int i = 0; i < 60; ++i) {
      const double q = 0.5 * (low + high);
      (std::hypot(p.x + 0.5 * shift(q), p.y) < 1.0 / (2.0 * density(q) * q * q) ? low : high) = q;
    }
    const double q = 0.5 * (low + high), rho = density(q);
    const double k = std::sqrt(2.0 / (2.0 * rho * (p.x + 0.5 * shift(q)) + 1.0 / (q * q)));
    const double sine = std::min(1.0, q / k);
    return {rho, -q * std::sqrt(1.0 - sine * sine), q * sine, rho * sound_square(q) / gas_gamma};
  }

 private:
  static double sound_square(double q) { return 1.0 - 0.2 * q * q; }
  static double density(double q) { return std::pow(sound_square(q), 2.5); }
  static double shift(double q) {
    const double c = std::sqrt(sound_square(q));
    return 1.0 / c + 1.0 / (3.0 * c * c * c) + 1.0 / (5.0 * std::pow(c, 5)) -
           0.5 * std::log((1.0 + c) / (1.0 - c));
  }
};

// n cells across, 2 n along.
FrozenMesh ringleb_mesh(std::uint32_t n, double inner) {
  FrozenMesh mesh;
  const std::uint32_t m = 2 * n;
  for (std::uint32_t j = 0; j <= m; ++j)
    for (std::uint32_t i = 0; i <= n; ++i) {
      const double k = inner + (Ringleb::outer - inner) * i / n;
      const double last = std::asin(Ringleb::slowest / k);
      mesh.points.push_back(Ringleb::place(k, k * std::sin(0.5 * M_PI + (last - 0.5 * M_PI) * j / m)));
    }
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return j * (n + 1) + i; };
  for (std::uint32_t j = 0; j < m; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      if ((i + j) % 2 == 0) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      } else {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({b, c, d});
      }
    }
  mesh.boundaries = {{"wall", {}}, {"farfield", {}}};
  for (std::uint32_t j = 0; j < m; ++j) {
    mesh.boundaries[0].edges.push_back({at(0, j + 1), at(0, j)});
    mesh.boundaries[0].edges.push_back({at(n, j), at(n, j + 1)});
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    mesh.boundaries[1].edges.push_back({at(i, 0), at(i + 1, 0)});
    mesh.boundaries[1].edges.push_back({at(i + 1, m), at(i, m)});
  }
  return mesh;
}

// Errors of density and entropy at 4, 8, 16 and 32 cells across.
std::vector<std::array<double, 2>> ringleb_errors(double inner) {
  std::vector<std::array<double, 2>> errors;
  for (const std::uint32_t n : {4U, 8U, 16U, 32U}) {
    const FlowMesh dual(ringleb_mesh(n, inner), "farfield", "ringleb");
    EXPECT_GT(*std::min_element(dual.areas().begin(), dual.areas().end()), 0.0);
    errors.push_back(
        test::errors_of(Euler(dual, {.mach = 0.5, .vortex = false, .prescribed = Ringleb::at}), Ringleb::at));
    ::testing::Test::RecordProperty(
        "errors_" + std::to_string(n),
        std::to_string(1e6 * errors.back()[0]) + " " + std::to_string(1e6 * errors.back()[1]) + " e-6");
  }
  return errors;
}

TEST(Verification, ErrorsOfRinglebsSubsonicFlowFall) {
  const auto errors = ringleb_errors(0.9);
  for (std::size_t n = 1; n < 4; ++n) {
    EXPECT_GT(std::log2(errors[n - 1][0] / errors[n][0]), 1.8) << n;
    EXPECT_GT(std::log2(errors[n - 1][1] / errors[n][1]), 1.5) << n;
  }
}

// The return through the speed of sound takes a fine mesh: from there on density falls faster than the
// square, entropy a little slower.
TEST(Verification, RinglebsFlowThroughTheSpeedOfSound) {
  const auto errors = ringleb_errors(1.2);
  EXPECT_GT(std::log2(errors[1][0] / errors[3][0]) / 2.0, 1.9);
  EXPECT_GT(std::log2(errors[1][1] / errors[3][1]) / 2.0, 1.7);
}

// Around a cylinder of radius 1/2, out to 20, n edges around it; `tilt` turns the mesh's diagonals one way.
FrozenMesh cylinder_mesh(std::uint32_t n, bool tilt) {
  FrozenMesh mesh;
  const double ratio = 1.0 + 2.0 * M_PI / n;
  const auto m = static_cast<std::uint32_t>(std::ceil(std::log(40.0) / std::log(ratio)));
  for (std::uint32_t j = 0; j <= m; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const double r = 0.5 * std::pow(40.0, static_cast<double>(j) / m), angle = 2.0 * M_PI * i / n;
      mesh.points.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return j * n + i % n; };
  mesh.boundaries = {{"cylinder", {}}, {"farfield", {}}};
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < m; ++j) {
      const std::uint32_t a = at(i, j), b = at(i, j + 1), c = at(i + 1, j + 1), d = at(i + 1, j);
      if (tilt || (i < n / 2) == (j % 2 == 0)) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      } else {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({b, c, d});
      }
    }
    mesh.boundaries[0].edges.push_back({at(i + 1, 0), at(i, 0)});
    mesh.boundaries[1].edges.push_back({at(i, m), at(i + 1, m)});
  }
  return mesh;
}

// No trailing edge says how much circulation there is. On a mesh that is its own mirror image it stays 0 to
// round-off, and drag falls; on one whose diagonals all lean to one side the same method finds another
// solution of the same equations, with lift.
TEST(Verification, TheFlowAroundACylinderHasTheSymmetryOfItsMesh) {
  const auto flow = [](std::uint32_t n, bool tilt) {
    const FlowResult result = solve_flow(cylinder_mesh(n, tilt), {.mach = 0.38, .reference = {0, 0}});
    EXPECT_TRUE(result.converged()) << result.reason;
    return result;
  };
  const FlowResult coarse = flow(16, false), fine = flow(32, false), leaning = flow(16, true);
  EXPECT_LT(std::fabs(coarse.cl), 1e-9);
  EXPECT_LT(std::fabs(fine.cl), 1e-9);
  EXPECT_LT(fine.cd, coarse.cd / 4.0);
  EXPECT_GT(std::fabs(leaning.cl), 1.0);
}

}  // namespace
}  // namespace remodel::flow
