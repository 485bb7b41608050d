#pragma once

// Meshes and flows that several tests share.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "flow/scheme/flow_system.h"
#include "flow/search/newton_search.h"
#include "remodel/generate.h"

namespace remodel::test {

inline Mesh airfoil_mesh(const std::string& name, int points) {
  return generate(airfoil_domain(named_airfoil(name, 5), {.points = points}), {.gradation = points / 50.0})
      .mesh;
}

// Adds the cell of these corners, cut along a and c or along b and d.
inline void add_cell(FrozenMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d,
                     bool along_ac) {
  mesh.triangles.push_back(along_ac ? std::array{a, b, c} : std::array{a, b, d});
  mesh.triangles.push_back(along_ac ? std::array{a, c, d} : std::array{b, c, d});
}

// A mesh of such cells with every cell uncut, or every `stride`-th left as it is.
inline flow::FlowMesh uncut(const FrozenMesh& mesh, std::vector<flow::Patch> patches,
                            std::size_t stride = 0) {
  std::vector<flow::Cell> cells;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 2) {
    const auto &first = mesh.triangles[t], &second = mesh.triangles[t + 1];
    if (stride > 0 && (t / 2) % stride == 0) {
      cells.push_back({{first[0], first[1], first[2], no_index}});
      cells.push_back({{second[0], second[1], second[2], no_index}});
    } else if (first[0] == second[0]) {
      cells.push_back({{first[0], first[1], first[2], second[2]}});
    } else {
      cells.push_back({{first[0], second[0], second[1], second[2]}});
    }
  }
  return {mesh.points, std::move(cells), mesh.boundaries, std::move(patches), "cells"};
}

// The supersonic vortex: flow in circles between the radii 1 and 1.384, Mach 2.25 at the inner one. Source:
// M. Aftosmis, D. Gaitonde and T. S. Tavares, AIAA J. 33 (1995).
inline constexpr double inner_radius = 1.0, outer_radius = 1.384, inner_mach = 2.25;
inline flow::Unknowns<double> supersonic_vortex(Point p) {
  const double r = std::sqrt(dot(p, p));
  const double ratio = inner_radius / r;
  const double c2 = 1.0 + 0.2 * inner_mach * inner_mach * (1.0 - ratio * ratio);
  const double rho = std::pow(c2, 2.5), speed = inner_mach * ratio;
  return {rho, speed * p.y / r, -speed * p.x / r, rho * c2 / flow::gas_gamma};
}

// A quarter of the ring, n cells across and 4 n along, cut in triangles that alternate: walls "inner" and
// "outer".
inline FrozenMesh ring_mesh(std::uint32_t n) {
  FrozenMesh mesh;
  const std::uint32_t m = 4 * n;
  for (std::uint32_t j = 0; j <= m; ++j)
    for (std::uint32_t i = 0; i <= n; ++i) {
      const double r = inner_radius + (outer_radius - inner_radius) * i / n, angle = 0.5 * M_PI * j / m;
      mesh.points.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return j * (n + 1) + i; };
  for (std::uint32_t j = 0; j < m; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      add_cell(mesh, a, b, c, d, (i + j) % 2 == 0);
    }
  mesh.boundaries = {{"inner", {}}, {"outer", {}}, {"farfield", {}}};
  for (std::uint32_t j = 0; j < m; ++j) {
    mesh.boundaries[0].edges.push_back({at(0, j + 1), at(0, j)});
    mesh.boundaries[1].edges.push_back({at(n, j), at(n, j + 1)});
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    mesh.boundaries[2].edges.push_back({at(i, 0), at(i + 1, 0)});
    mesh.boundaries[2].edges.push_back({at(i + 1, m), at(i, m)});
  }
  return mesh;
}

// The flow that is found from this one.
inline flow::State found_from(const flow::FlowSystem& system,
                              const std::function<flow::Unknowns<double>(Point)>& exact_at) {
  flow::State state = system.undisturbed();
  for (std::size_t v = 0; v < state.q.size(); ++v) state.q[v] = exact_at(system.mesh().points()[v]);
  const FlowOptions options = {.tolerance = 1e-11};
  flow::WholeMatrix matrix;
  flow::Factors factors;
  flow::SearchRecord record;
  flow::NewtonSearch(options, matrix, factors, record).run(flow::Measure(system), {.cfl = 1e3}, state);
  EXPECT_EQ(record.status, FlowStatus::converged) << record.reason;
  return state;
}

// The errors of density and of p / rho^gamma in the mean square over the area, of the flow found from the
// exact one.
inline std::array<double, 2> errors_of(const flow::FlowSystem& system,
                                       const std::function<flow::Unknowns<double>(Point)>& exact_at) {
  const flow::FlowMesh& dual = system.mesh();
  const flow::State state = found_from(system, exact_at);
  double density = 0.0, entropy = 0.0, area = 0.0;
  for (std::size_t v = 0; v < dual.size(); ++v) {
    const double e = flow::density(state.q[v]) - flow::density(exact_at(dual.points()[v]));
    const double s =
        flow::gas_gamma * flow::pressure(state.q[v]) / std::pow(flow::density(state.q[v]), flow::gas_gamma) -
        1.0;
    density += dual.areas()[v] * e * e, entropy += dual.areas()[v] * s * s, area += dual.areas()[v];
  }
  return {std::sqrt(density / area), std::sqrt(entropy / area)};
}

}  // namespace remodel::test
