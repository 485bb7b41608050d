#pragma once

// Sections of which the potential flow is known: Karman and Trefftz's, exactly, and any polygon by panels.

#include <cmath>
#include <complex>
#include <numbers>
#include <utility>
#include <vector>

#include "remodel/generate.h"

namespace remodel::test {

// T. von Karman and E. Trefftz, Z. Flugtechnik 9 (1918): the circle about `centre` through 1, mapped by
// (z - k) / (z + k) = ((c - 1) / (c + 1))^k, with k = 2 - edge / pi. Moved and scaled to a chord of 1.
class KarmanTrefftz {
 public:
  KarmanTrefftz(std::complex<double> centre, double edge_deg)
      : centre_(centre), k_(2.0 - edge_deg / 180.0), radius_(std::abs(1.0 - centre)) {
    double low = 0.0, high = 0.0;
    for (int i = 0; i < 100000; ++i) {
      const double x = mapped(circle(i / 100000.0)).real();
      low = std::min(low, x);
      high = std::max(high, x);
    }
    low_ = low;
    chord_ = high - low;
  }

  // t in [0, 1), counter-clockwise from the trailing edge.
  Point at(double t) const {
    const auto z = (mapped(circle(t)) - low_) / chord_;
    return {z.real(), z.imag()};
  }
  double lift(double alpha) const {
    return 8.0 * std::numbers::pi * radius_ / chord_ * std::sin(alpha + beta());
  }
  double speed(double t, double alpha) const {
    const std::complex<double> i(0.0, 1.0), c = circle(t), arm = c - centre_;
    const double circulation = 4.0 * std::numbers::pi * radius_ * std::sin(alpha + beta());
    const auto around = std::exp(-i * alpha) - radius_ * radius_ * std::exp(i * alpha) / (arm * arm) +
                        i * circulation / (2.0 * std::numbers::pi * arm);
    const auto w = (c - 1.0) / (c + 1.0), power = std::pow(w, k_);
    const auto slope = 2.0 * k_ * k_ * std::pow(w, k_ - 1.0) * 2.0 / ((c + 1.0) * (c + 1.0)) /
                       ((1.0 - power) * (1.0 - power));
    return std::abs(around / slope);
  }

 private:
  double beta() const { return std::asin(centre_.imag() / radius_); }
  std::complex<double> circle(double t) const {
    return centre_ + std::polar(radius_, 2.0 * std::numbers::pi * t - beta());
  }
  std::complex<double> mapped(std::complex<double> c) const {
    const auto power = std::pow((c - 1.0) / (c + 1.0), k_);
    return k_ * (1.0 + power) / (1.0 - power);
  }

  std::complex<double> centre_;
  double k_, radius_;
  double low_ = 0.0, chord_ = 1.0;
};

// Bodies in a circular far field of radius 25, each a closed polygon of its vertices.
inline FrozenMesh mesh_around(const std::vector<std::vector<Point>>& bodies, double gradation,
                              int farfield_points = 50) {
  Domain domain;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    std::vector<Point> closed = bodies[k];
    closed.push_back(closed.front());
    const std::string name = bodies.size() == 1 ? "airfoil" : "airfoil" + std::to_string(k + 1);
    domain.loops.push_back(
        {LoopRole::hole, {{name, Polyline{closed}, Parameters::uniform(bodies[k].size())}}});
  }
  domain.loops.push_back({LoopRole::outer,
                          {{"farfield", Arc{{0.5, 0.0}, 25.0, 0.0, 2.0 * std::numbers::pi},
                            Parameters::uniform(static_cast<std::size_t>(farfield_points))}}});
  QualityOptions quality;
  quality.gradation = gradation;
  return generate(domain, quality).mesh.freeze();
}

struct Panel {
  Point from, middle, along;
  double length;
  std::size_t body;
  bool at_edge;  // one of the two at the body's trailing edge
};

inline std::vector<Panel> panels_of(const std::vector<std::vector<Point>>& bodies) {
  std::vector<Panel> panels;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const std::size_t n = bodies[k].size();
    for (std::size_t i = 0; i < n; ++i) {
      const Point a = bodies[k][i], b = bodies[k][(i + 1) % n];
      const double length = std::hypot(b.x - a.x, b.y - a.y);
      panels.push_back({a, 0.5 * (a + b), (1.0 / length) * (b - a), length, k, i == 0 || i + 1 == n});
    }
  }
  return panels;
}

// The velocities of a source and of a vortex of strength 1 along a panel, at the middle of another or itself.
// The fluid is on the right of a counter-clockwise panel.
inline std::pair<Point, Point> induced(const Panel& at, const Panel& by) {
  const Point arm = at.middle - by.from, normal = {-by.along.y, by.along.x};
  const double x = dot(arm, by.along), y = cross(by.along, arm);
  const double along = std::log(std::hypot(x, y) / std::hypot(x - by.length, y)) / (2.0 * std::numbers::pi);
  const double across =
      &at == &by ? -0.5 : (std::atan2(y, x - by.length) - std::atan2(y, x)) / (2.0 * std::numbers::pi);
  return {along * by.along + across * normal, across * by.along - along * normal};
}

// Rows with their right sides; the solution is in the last column.
inline void eliminate(std::vector<std::vector<double>>& m) {
  const std::size_t n = m.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::abs(m[i][k]) > std::abs(m[pivot][k])) pivot = i;
    std::swap(m[k], m[pivot]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = m[i][k] / m[k][k];
      for (std::size_t j = k; j <= n; ++j) m[i][j] -= factor * m[k][j];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) m[k][n] -= m[k][j] * m[j][n];
    m[k][n] /= m[k][k];
  }
}

// Lift coefficient (chord 1) of counter-clockwise polygons that begin at their trailing edges, by panels with
// a source each and a vortex for all of a body; no flow through their middles, and the same speed on both
// sides of each edge: J. L. Hess and A. M. O. Smith, Prog. Aero. Sci. 8 (1967).
inline double lift_by_panels(const std::vector<std::vector<Point>>& bodies, double alpha) {
  const std::vector<Panel> panels = panels_of(bodies);
  const std::size_t count = panels.size(), n = count + bodies.size();
  std::vector<std::vector<double>> m(n, std::vector<double>(n + 1, 0.0));
  const Point stream = {std::cos(alpha), std::sin(alpha)};
  for (std::size_t i = 0; i < count; ++i) {
    const Panel& at = panels[i];
    const Point normal = {-at.along.y, at.along.x};
    std::vector<double>&through = m[i], &edge = m[count + at.body];
    for (std::size_t j = 0; j < count; ++j) {
      const auto [source, vortex] = induced(at, panels[j]);
      through[j] += dot(source, normal);
      through[count + panels[j].body] += dot(vortex, normal);
      if (!at.at_edge) continue;
      edge[j] += dot(source, at.along);
      edge[count + panels[j].body] += dot(vortex, at.along);
    }
    through[n] = -dot(stream, normal);
    if (at.at_edge) edge[n] -= dot(stream, at.along);
  }
  eliminate(m);
  double circulation = 0.0;
  for (const Panel& panel : panels) circulation += panel.length * m[count + panel.body][n];
  return 2.0 * std::abs(circulation);
}

}  // namespace remodel::test
