// Meshes with quadrilaterals.

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "flow/scheme/forces.h"
#include "flow/test_flows.h"
#include "remodel/error.h"
#include "support.h"

namespace remodel::flow {
namespace {

const std::vector<Patch> open_ends = {{"farfield", FarField{}}};

// The unit square, n by n cells whose inner vertices are moved at random by a fifth of a cell at most. All
// sides are far field, or those at the bottom and the top walls.
FrozenMesh uneven_square(std::uint32_t n, bool walls = false) {
  std::mt19937_64 random(n);
  FrozenMesh mesh;
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i) {
      const double reach = i % n == 0 || j % n == 0 ? 0.0 : 0.2;
      mesh.points.push_back(
          {(i + test::uniform(random, -reach, reach)) / n, (j + test::uniform(random, -reach, reach)) / n});
    }
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return j * (n + 1) + i; };
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i)
      test::add_cell(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1), random() % 2 == 0);
  mesh.boundaries = {{"farfield", {}}, {walls ? "wall" : "farfield", {}}};
  for (std::uint32_t i = 0; i < n; ++i) {
    mesh.boundaries[1].edges.push_back({at(i, 0), at(i + 1, 0)});
    mesh.boundaries[0].edges.push_back({at(n, i), at(n, i + 1)});
    mesh.boundaries[1].edges.push_back({at(i + 1, n), at(i, n)});
    mesh.boundaries[0].edges.push_back({at(0, i + 1), at(0, i)});
  }
  return mesh;
}

FrozenMesh open_ring(std::uint32_t n) {
  FrozenMesh mesh = test::ring_mesh(n);
  for (FrozenBoundary& boundary : mesh.boundaries) boundary.name = "farfield";
  return mesh;
}

TEST(Quadrilaterals, UniformFlowHasNoResidualAndLinearGradientsAreExact) {
  for (const FrozenMesh& mesh : {uneven_square(7), open_ring(6)})
    for (const std::size_t stride : {0, 3}) {
      const FlowMesh dual = test::uncut(mesh, open_ends, stride);
      const FlowSystem system(dual, {.mach = 0.7, .alpha = 0.3, .vortex = false});
      Vector residual;
      system.residual(system.undisturbed(), residual);
      for (const auto& block : residual)
        for (const double value : block) EXPECT_LT(std::fabs(value), 2e-14);
      const auto linear = [&](std::size_t v) { return 3.0 * dual.points()[v].x - 2.0 * dual.points()[v].y; };
      double area = 0.0;
      for (std::size_t v = 0; v < dual.size(); ++v) {
        area += dual.areas()[v];
        Point gradient = {};
        for (const RingEntry& entry : dual.ring(v))
          gradient = gradient + (linear(entry.vertex) - linear(v)) * entry.weight;
        EXPECT_NEAR(gradient.x, 3.0, 1e-12);
        EXPECT_NEAR(gradient.y, -2.0, 1e-12);
      }
      double whole = 0.0;
      for (const auto& [a, b, c] : dual.triangles())
        whole += 0.5 * cross(dual.points()[b] - dual.points()[a], dual.points()[c] - dual.points()[a]);
      EXPECT_NEAR(area, whole, 1e-13);
    }
}

// The mesh as a file would have it: every third cell is two triangles, the others are quadrilaterals.
FrozenMesh with_quads(FrozenMesh mesh) {
  const FlowMesh cells = test::uncut(mesh, open_ends, 3);
  mesh.triangles.clear();
  for (const Cell& cell : cells.cells()) {
    if (cell.corners() == 3)
      mesh.triangles.push_back({cell[0], cell[1], cell[2]});
    else
      mesh.quads.push_back(cell);
  }
  return mesh;
}

TEST(Quadrilaterals, OfAFrozenMeshAreCells) {
  const FrozenMesh mesh = with_quads(uneven_square(7));
  const FlowMesh dual(mesh, open_ends, "m");
  ASSERT_EQ(dual.cells().size(), mesh.cell_count());
  EXPECT_EQ(std::ranges::count(dual.cells(), 4U, &Cell::corners), static_cast<long>(mesh.quads.size()));
  const FlowMesh same = test::uncut(uneven_square(7), open_ends, 3);
  ASSERT_EQ(dual.edges().size(), same.edges().size());
  for (std::size_t v = 0; v < dual.size(); ++v) EXPECT_NEAR(dual.areas()[v], same.areas()[v], 1e-16);
}

TEST(Quadrilaterals, DualFacesOfRectanglesAreRectangles) {
  FrozenMesh mesh = uneven_square(2);
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    mesh.points[v] = {0.5 * static_cast<double>(v % 3), 0.001 * static_cast<double>(v / 3)};
  const FlowMesh dual = test::uncut(mesh, open_ends);
  for (const DualEdge& edge : dual.edges()) {
    const Point d = dual.points()[edge.b] - dual.points()[edge.a];
    EXPECT_NEAR(cross(edge.normal, d), 0.0, 1e-18);  // along the edge, however flat the cells are
  }
}

TEST(Quadrilaterals, TheErrorOfTheSupersonicVortexFallsFasterThanTheSquare) {
  std::array<double, 2> before = {};
  for (const std::uint32_t n : {8U, 16U, 32U}) {
    const FlowMesh dual = test::uncut(test::ring_mesh(n), open_ends);
    const std::array<double, 2> errors = test::errors_of(
        FlowSystem(dual, {.mach = test::inner_mach, .vortex = false, .prescribed = test::supersonic_vortex}),
        test::supersonic_vortex);
    for (std::size_t i = 0; i < 2; ++i) {
      RecordProperty((i == 0 ? "density_" : "entropy_") + std::to_string(n), std::to_string(1e6 * errors[i]));
      if (n > 8) {
        EXPECT_GT(std::log2(before[i] / errors[i]), 2.0) << before[i] << " " << errors[i];
      }
    }
    before = errors;
  }
}

// The Jacobian and the derivatives by places, against differences of residuals.
TEST(Quadrilaterals, DerivativesAreThoseOfDifferences) {
  const unsigned long long seed = test::seed(12);
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  const FrozenMesh mesh = uneven_square(5, true);
  FlowMesh dual = test::uncut(mesh, open_ends, 4);
  const Stream stream = {.mach = 0.6, .alpha = 0.02};
  const FlowSystem system(dual, stream);
  State state = system.undisturbed();
  Vector weight(dual.size());
  Increment step = zero(dual.size());
  std::vector<Point> towards(dual.size());
  for (std::size_t v = 0; v < dual.size(); ++v) {
    towards[v] = {test::uniform(random, -1, 1), test::uniform(random, -1, 1)};
    for (std::size_t k = 0; k < unknown_count; ++k) {
      state.q[v][k] += test::uniform(random, -0.05, 0.05);
      weight[v][k] = test::uniform(random, -1, 1), step.q[v][k] = test::uniform(random, -1, 1);
    }
  }
  const auto weighted_residual = [&](const State& at) {
    Vector residual;
    FlowSystem(dual, stream).residual(at, residual);
    return inner(weight, residual);
  };
  constexpr double h = 1e-6;
  BlockRows matrix = system.pattern();
  system.jacobian(state, matrix);
  Vector product(dual.size());
  add_product(matrix, 1.0, step.q, product);
  const double by_state =
      (weighted_residual(moved(state, step, h)) - weighted_residual(moved(state, step, -h))) / (2 * h);
  EXPECT_NEAR(inner(weight, product), by_state, 1e-7);

  const ShapeSlope slope = system.residual_slopes(state, std::vector<Vector>{weight}).front();
  const FunctionalSlope force = slope_of(system, state, WallForce{.weight = {.lift = 1.0, .moment = 0.5}});
  double by_places = 0.0, force_by_places = 0.0;
  for (std::size_t v = 0; v < dual.size(); ++v)
    by_places += dot(slope.points[v], towards[v]), force_by_places += dot(force.shape.points[v], towards[v]);
  const auto along = [&](double s) {
    std::vector<Point> points = mesh.points;
    for (std::size_t v = 0; v < points.size(); ++v) points[v] = points[v] + s * towards[v];
    dual.move(points);
    const Coefficients sum = coefficients(FlowSystem(dual, stream), state);
    return std::array{weighted_residual(state), sum.lift + 0.5 * sum.moment};
  };
  const auto plus = along(h), less = along(-h);
  EXPECT_NEAR(by_places, (plus[0] - less[0]) / (2 * h), 1e-6 * std::fabs(by_places));
  EXPECT_NEAR(force_by_places, (plus[1] - less[1]) / (2 * h), 1e-6 * std::fabs(force_by_places));
}

TEST(Quadrilaterals, MustBeConvexAndCounterClockwise) {
  FrozenMesh mesh = uneven_square(2);
  mesh.points[4] = {0.05, 0.05};
  try {
    test::uncut(mesh, open_ends);
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "cells: quadrilateral 0 (points 0, 1, 4, 3) is clockwise or not convex, expected every "
                 "quadrilateral to be counter-clockwise and convex");
  }
}

}  // namespace
}  // namespace remodel::flow
