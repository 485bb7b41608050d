// Flows whose solutions are known.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "flow/search/newton_search.h"
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
  static Unknowns<double> at(Point p) {
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
      test::add_cell(mesh, a, b, c, d, (i + j) % 2 == 0);
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
    errors.push_back(test::errors_of(
        FlowSystem(dual, {.mach = 0.5, .vortex = false, .prescribed = Ringleb::at}), Ringleb::at));
    ::testing::Test::RecordProperty(
        "errors_" + std::to_string(n),
        std::to_string(1e6 * errors.back()[0]) + " " + std::to_string(1e6 * errors.back()[1]) + " e-6");
  }
  return errors;
}

TEST(Verification, ErrorsOfRinglebsSubsonicFlowFall) {
  const auto errors = ringleb_errors(0.9);
  for (std::size_t n = 1; n < 4; ++n) {
    EXPECT_GT(std::log2(errors[n - 1][0] / errors[n][0]), 2.2) << n;
    EXPECT_GT(std::log2(errors[n - 1][1] / errors[n][1]), 2.2) << n;
  }
}

// The return through the speed of sound takes a fine mesh: from there on both fall faster than the square.
TEST(Verification, RinglebsFlowThroughTheSpeedOfSound) {
  const auto errors = ringleb_errors(1.2);
  EXPECT_GT(std::log2(errors[1][0] / errors[3][0]) / 2.0, 2.3);
  EXPECT_GT(std::log2(errors[1][1] / errors[3][1]) / 2.0, 2.3);
}

// Manufactured solutions: flows that are written down, with the sources that make them steady. Source: P. J.
// Roache, "Code verification by the method of manufactured solutions", J. Fluids Eng. 124 (2002).

// A flow as a function of the place, for derivatives by it.
using Written = std::function<Unknowns<Dual<2>>(const Dual<2>& x, const Dual<2>& y)>;

Unknowns<double> values_at(const Written& flow, Point p) {
  const Unknowns<Dual<2>> q = flow(Dual<2>(p.x), Dual<2>(p.y));
  return {q[0].value, q[1].value, q[2].value, q[3].value};
}

// The divergence of the fluxes of mass, momentum and energy.
std::array<double, 4> source_at(const Written& flow, Point p) {
  const auto [rho, u, v, pressure] = flow(Dual<2>::variable(p.x, 0), Dual<2>::variable(p.y, 1));
  const Dual<2> energy =
      pressure * (gas_gamma / (gas_gamma - 1.0)) + 0.5 * rho * (u * u + v * v);  // and the pressure's work
  const Dual<2> along_x[4] = {rho * u, rho * u * u + pressure, rho * u * v, energy * u};
  const Dual<2> along_y[4] = {rho * v, rho * u * v, rho * v * v + pressure, energy * v};
  std::array<double, 4> sum;
  for (std::size_t k = 0; k < 4; ++k) sum[k] = along_x[k].slope[0] + along_y[k].slope[1];
  return sum;
}

// Sources of the kind the scheme is exact for: where fluxes are quadratic, and sources linear, those out of a
// dual cell are the vertex's own source times the area (A. Katz and V. Sankaran, J. Comput. Phys. 230
// (2011)). The area between a wall and its chord, which the halves' turn bounds with it, belongs to both
// ends.
Vector sources_on(const FlowMesh& dual, const Written& flow) {
  std::vector<double> areas = dual.areas();
  for (const BoundaryEdge& edge : dual.boundary()) {
    if (!dual.patch(edge).solid()) continue;
    const Point d = dual.points()[edge.b] - dual.points()[edge.a];
    const double between = 0.25 * dot(edge.half[1] - edge.half[0], d);
    areas[edge.a] += 0.5 * between, areas[edge.b] += 0.5 * between;
  }
  Vector sources(dual.size());
  for (std::size_t v = 0; v < dual.size(); ++v) {
    sources[v] = source_at(flow, dual.points()[v]);
    for (double& source : sources[v]) source *= areas[v];
  }
  return sources;
}

// The errors of density, velocity and pressure in the mean square over the area.
std::array<double, 4> errors_of_written(const FrozenMesh& mesh, const Written& flow) {
  const FlowMesh dual(mesh, "farfield", "manufactured");
  const auto exact = [&](Point p) { return values_at(flow, p); };
  const FlowSystem system(
      dual, {.mach = 0.5, .vortex = false, .prescribed = exact, .source = sources_on(dual, flow)});
  const State state = test::found_from(system, exact);
  std::array<double, 4> errors = {};
  double area = 0.0;
  for (std::size_t v = 0; v < dual.size(); ++v) {
    const Unknowns<double> expected = exact(dual.points()[v]);
    area += dual.areas()[v];
    for (std::size_t k = 0; k < 4; ++k) {
      const double e = state.q[v][k] - expected[k];
      errors[k] += dual.areas()[v] * e * e;
    }
  }
  for (double& e : errors) e = std::sqrt(e / area);
  return errors;
}

// The unit square, n cells across, its inner vertices moved at random by up to a fifth of a cell, its
// diagonals this way or that at random.
FrozenMesh uneven_square(std::uint32_t n) {
  std::mt19937 random(n);
  const auto uniform = [&] { return static_cast<double>(random()) * 0x1p-32; };
  FrozenMesh mesh;
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i) {
      const double reach = i % n == 0 || j % n == 0 ? 0.0 : 0.4;
      const double dx = reach * (uniform() - 0.5), dy = reach * (uniform() - 0.5);
      mesh.points.push_back({(i + dx) / n, (j + dy) / n});
    }
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return j * (n + 1) + i; };
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      test::add_cell(mesh, a, b, c, d, random() % 2 == 0);
    }
  mesh.boundaries = {{"farfield", {}}};
  for (std::uint32_t i = 0; i < n; ++i) {
    mesh.boundaries[0].edges.push_back({at(i, 0), at(i + 1, 0)});
    mesh.boundaries[0].edges.push_back({at(n, i), at(n, i + 1)});
    mesh.boundaries[0].edges.push_back({at(i + 1, n), at(i, n)});
    mesh.boundaries[0].edges.push_back({at(0, i + 1), at(0, i)});
  }
  return mesh;
}

void expect_second_order(const std::function<FrozenMesh(std::uint32_t)>& mesh, const Written& flow) {
  std::array<double, 4> before = {};
  for (const std::uint32_t n : {8U, 16U, 32U}) {
    const std::array<double, 4> errors = errors_of_written(mesh(n), flow);
    for (std::size_t k = 0; k < 4; ++k) {
      if (n > 8) {
        EXPECT_GT(std::log2(before[k] / errors[k]), 1.9) << "unknown " << k << ", " << n << " cells across";
      }
      ::testing::Test::RecordProperty("error_" + std::to_string(k) + "_" + std::to_string(n),
                                      std::to_string(1e6 * errors[k]) + "e-6");
    }
    before = errors;
  }
}

TEST(Verification, AManufacturedFlowInsideAnUnevenMesh) {
  expect_second_order(uneven_square, [](const Dual<2>& x, const Dual<2>& y) -> Unknowns<Dual<2>> {
    return {1.0 + 0.15 * sin(2.0 * x + y), 0.5 + 0.1 * sin(1.5 * x - y), 0.2 + 0.1 * cos(x + 2.0 * y),
            (1.0 / gas_gamma) * (1.0 + 0.2 * cos(1.5 * x + 1.5 * y))};
  });
}

// In the ring of the supersonic vortex, slower than sound, with a speed across that vanishes at the walls.
TEST(Verification, AManufacturedFlowBetweenCurvedWalls) {
  using test::inner_radius, test::outer_radius;
  expect_second_order(test::ring_mesh, [](const Dual<2>& x, const Dual<2>& y) -> Unknowns<Dual<2>> {
    const Dual<2> r = sqrt(x * x + y * y);
    const Dual<2> along = 0.5 + 0.1 * sin(1.5 * x - y);
    const Dual<2> across = 0.05 * sin((M_PI / (outer_radius - inner_radius)) * (r - inner_radius));
    return {1.0 + 0.15 * sin(2.0 * x + y), (across * x + along * y) / r, (across * y - along * x) / r,
            (1.0 / gas_gamma) * (1.0 + 0.2 * cos(1.5 * x + 1.5 * y))};
  });
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
      test::add_cell(mesh, a, b, c, d, tilt || (i < n / 2) == (j % 2 == 0));
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
