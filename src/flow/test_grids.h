#pragma once

// Grids of quadrilaterals for flows with friction: a plate, and C-grids around NACA 0012 in parabolic
// coordinates (A. Jameson, "Iterative solution of transonic flows over airfoils and wings", Comm. Pure Appl.
// Math. 27 (1974)), whose columns stand upright on the wall nearly everywhere.

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "flow/scheme/flow_mesh.h"
#include "remodel/flow.h"

namespace remodel::test {

struct QuadGrid {
  std::vector<Point> points;
  std::vector<flow::Cell> cells;
  std::vector<FrozenBoundary> boundaries;

  flow::FlowMesh dual(std::vector<flow::Patch> patches) const {
    return {points, cells, boundaries, std::move(patches), "grid"};
  }
  FrozenMesh frozen() const {
    FrozenMesh mesh;
    mesh.points = points, mesh.boundaries = boundaries;
    for (const flow::Cell& cell : cells) mesh.quads.push_back({cell[0], cell[1], cell[2], cell[3]});
    return mesh;
  }
};

// Places from 0 to `length` in n steps that grow evenly from `first`.
inline std::vector<double> growing(double first, double length, std::uint32_t n) {
  double low = 1e-9, high = 4.0;  // the growth less 1
  const auto sum = [&](double g) { return first * std::expm1(n * std::log1p(g)) / g; };
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (sum(middle) < length ? low : high) = middle;
  }
  std::vector<double> places(1, 0.0);
  for (std::uint32_t i = 1; i <= n; ++i) places.push_back(first * std::expm1(i * std::log1p(low)) / low);
  places.back() = length;
  return places;
}

// From 0 to 1 in n steps of about `first` at 0 and `last` at 1: M. Vinokur, J. Comput. Phys. 50 (1983).
inline std::vector<double> two_sided(double first, double last, std::uint32_t n) {
  const double b = 1.0 / (n * std::sqrt(first * last)), a = std::sqrt(last / first);
  double low = 1e-6, high = 30.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (std::sinh(middle) / middle < b ? low : high) = middle;
  }
  std::vector<double> places;
  for (std::uint32_t i = 0; i <= n; ++i) {
    const double u = 0.5 * (1.0 + std::tanh(low * (double(i) / n - 0.5)) / std::tanh(0.5 * low));
    places.push_back(u / (a + (1.0 - a) * u));
  }
  return places;
}

// A plate from 0 to `length`, `along` cells long and `up` high, the first one `first`; behind `before` cells
// of a line of symmetry that begin at `start`, less than 0.
struct PlateSize {
  double start = -0.33, length = 2.0, height = 1.0, first = 1e-4, at_edge = 2e-3;
  std::uint32_t before = 16, along = 48, up = 48;
};
inline QuadGrid plate_grid(const PlateSize& size) {
  std::vector<double> x;
  const std::vector<double> back = growing(size.at_edge, -size.start, size.before);
  for (std::uint32_t i = size.before; i > 0; --i) x.push_back(-back[i]);
  for (const double at : growing(size.at_edge, size.length, size.along)) x.push_back(at);
  const std::vector<double> y = growing(size.first, size.height, size.up);
  QuadGrid grid;
  const auto n = static_cast<std::uint32_t>(x.size() - 1);
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return i * (size.up + 1) + j; };
  for (const double px : x)
    for (const double py : y) grid.points.push_back({px, py});
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < size.up; ++j)
      grid.cells.push_back({{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}});
  grid.boundaries = {{"symmetry", {}}, {"wall", {}}, {"outlet", {}}, {"farfield", {}}};
  for (std::uint32_t i = 0; i < n; ++i) {
    grid.boundaries[i < size.before ? 0 : 1].edges.push_back({at(i, 0), at(i + 1, 0)});
    grid.boundaries[3].edges.push_back({at(i + 1, size.up), at(i, size.up)});
  }
  for (std::uint32_t j = 0; j < size.up; ++j) {
    grid.boundaries[2].edges.push_back({at(n, j), at(n, j + 1)});
    grid.boundaries[3].edges.push_back({at(0, j + 1), at(0, j)});
  }
  return grid;
}

// The plates whose friction is known: 5e-4 high cells for laminar flow at Re 1e5 a unit, 2e-6 for turbulent
// flow at 5e6.
inline QuadGrid laminar_plate(double height = 10.0, std::uint32_t up = 48) {
  return plate_grid({.start = -4.0,
                     .length = 4.0,
                     .height = height,
                     .first = 5e-4,
                     .at_edge = 2e-3,
                     .before = 24,
                     .along = 64,
                     .up = up});
}
inline QuadGrid turbulent_plate() {
  return plate_grid({.start = -0.33,
                     .length = 2.0,
                     .height = 1.0,
                     .first = 2e-6,
                     .at_edge = 2e-3,
                     .before = 16,
                     .along = 36,
                     .up = 48});
}
inline FlowOptions plate_options(FlowModel model) {
  FlowOptions options;
  options.model = model;
  options.tolerance = 1e-9;
  options.symmetry = {"symmetry"};
  options.outlets = {{.name = "outlet", .pressure = 1.0}};
  return options;
}

// NACA 0012 with the sharp edge of the closed formula, chord 1.
inline double naca0012(double x) {
  constexpr double chord = 1.008930411365;  // where the open formula's thickness is 0
  const double t = chord * x;
  return 0.6 / chord *
         std::max(0.0, 0.2969 * std::sqrt(t) - 0.1260 * t - 0.3516 * t * t + 0.2843 * t * t * t -
                           0.1015 * t * t * t * t);
}

struct CGridSize {
  std::uint32_t half = 64, wake = 32, up = 48;  // cells along one surface, along the wake and outwards
  double first = 1e-5;                          // height of the first cell, chords
  double at_nose = 2e-3, at_edge = 2e-3;        // lengths of cells along the wall
  double radius = 100.0;
};
inline QuadGrid c_grid(const CGridSize& size) {
  constexpr double focus = 0.00793;                 // half the radius of the nose
  const auto unwrapped = [&](double x, double y) {  // 2 (z - focus), its root in the upper right
    const double re = 2.0 * (x - focus), im = 2.0 * y, r = std::hypot(re, im);
    return Point{std::sqrt(0.5 * (r + re)), std::sqrt(std::max(0.0, 0.5 * (r - re)))};
  };
  // One surface from the nose, by the length of its arc.
  std::vector<double> arc(1, 0.0), place(1, 0.0);
  for (int i = 1; i <= 20000; ++i) {
    const double x = std::pow(i / 20000.0, 2), before = place.back();
    arc.push_back(arc.back() + std::hypot(x - before, naca0012(x) - naca0012(before)));
    place.push_back(x);
  }
  std::vector<Point>
      corner;  // in the plane of parabolic coordinates, from the nose along the upper surface and the wake
  for (const double part : two_sided(size.at_nose / arc.back(), size.at_edge / arc.back(), size.half)) {
    const double s = part * arc.back();
    const auto i = std::min<std::size_t>(
        arc.size() - 2,
        static_cast<std::size_t>(std::upper_bound(arc.begin(), arc.end(), s) - arc.begin()) - 1);
    const double x = place[i] + (place[i + 1] - place[i]) * (s - arc[i]) / (arc[i + 1] - arc[i]);
    corner.push_back(unwrapped(x, naca0012(x)));
  }
  corner.front().x = 0.0;
  corner.back() = unwrapped(1.0, 0.0);
  const double top = std::sqrt(2.0 * size.radius);
  for (const double s : growing(size.at_edge, size.radius, size.wake))
    if (s > 0.0) corner.push_back(unwrapped(1.0 + s, 0.0));
  QuadGrid grid;
  const auto columns = static_cast<std::uint32_t>(corner.size());  // of the upper half, with that of the nose
  const std::uint32_t edge = size.half;                            // the column of the trailing edge
  std::vector<std::vector<std::uint32_t>> column(2 * columns -
                                                 1);  // from the lower wake's end to the upper one's
  const auto mirrored = [&](std::uint32_t i) { return 2 * (columns - 1) - i; };
  for (std::uint32_t c = 2 * columns - 1; c-- > 0;) {
    const bool is_lower = c < columns - 1;
    const std::uint32_t i = is_lower ? columns - 1 - c : c - (columns - 1);
    const double xi = corner[i].x, eta = corner[i].y, stretch = std::hypot(xi, std::max(eta, 1e-9));
    // In the wake the first cell grows with those along it.
    double first = size.first;
    if (i > edge) first *= std::max(1.0, 0.2 * (0.5 * xi * xi + focus - 1.0) / 0.02);
    const std::vector<double> up = growing(std::min(first, 0.02 * size.radius) / stretch, top - eta, size.up);
    for (std::uint32_t j = 0; j <= size.up; ++j) {
      if (is_lower && j == 0 &&
          i >= edge) {  // the wake's and the edge's vertices are those of the upper half
        column[c].push_back(column[mirrored(c)][0]);
        continue;
      }
      const double y = eta + up[j], x = is_lower ? -xi : xi;
      column[c].push_back(static_cast<std::uint32_t>(grid.points.size()));
      grid.points.push_back({focus + 0.5 * (x * x - y * y), x * y});
      if (j == 0 && i >= edge) grid.points.back().y = 0.0;
    }
  }
  grid.boundaries = {{"airfoil", {}}, {"farfield", {}}};
  for (std::uint32_t c = 0; c + 1 < column.size(); ++c) {
    const auto &left = column[c], &right = column[c + 1];
    for (std::uint32_t j = 0; j < size.up; ++j)
      // Clockwise around the airfoil: from the lower wake over the nose to the upper one.
      grid.cells.push_back({{left[j], right[j], right[j + 1], left[j + 1]}});
    grid.boundaries[1].edges.push_back({right[size.up], left[size.up]});
    const bool is_wall = c >= columns - 1 - edge && c < columns - 1 + edge;
    if (is_wall) grid.boundaries[0].edges.push_back({left[0], right[0]});
  }
  for (std::uint32_t j = 0; j < size.up; ++j) {
    grid.boundaries[1].edges.push_back({column.front()[j + 1], column.front()[j]});
    grid.boundaries[1].edges.push_back({column.back()[j], column.back()[j + 1]});
  }
  return grid;
}

}  // namespace remodel::test
