#include "remodel/mesh_derivative.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include "remodel/generate.h"
#include "support.h"

namespace remodel {
namespace {

// The reference: curves evaluated in complex numbers, whose imaginary parts are derivatives to rounding.
// Source: W. Squire and G. Trapp, SIAM Rev. 40 (1998).
using Complex = std::complex<double>;
using Numbers = std::vector<Complex>;
using ComplexPoint = std::array<Complex, 2>;

std::vector<ComplexPoint> points_of(const Numbers& numbers, std::size_t size) {
  std::vector<ComplexPoint> points;
  for (std::size_t i = 0; i < numbers.size(); i += 2) points.push_back({numbers[i], numbers[i + 1]});
  if (points.size() < size) points.push_back(points.front());
  return points;
}

// Gauss's elimination, dense; both coordinates on the right.
std::vector<ComplexPoint> solved(std::vector<Numbers> a, std::vector<ComplexPoint> b) {
  const std::size_t n = b.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      if (j == i) continue;
      const Complex factor = a[j][i] / a[i][i];
      for (std::size_t k = 0; k < n; ++k) a[j][k] -= factor * a[i][k];
      for (std::size_t k = 0; k < 2; ++k) b[j][k] -= factor * b[i][k];
    }
  for (std::size_t i = 0; i < n; ++i)
    for (Complex& x : b[i]) x /= a[i][i];
  return b;
}

ComplexPoint on_spline(const Spline& kind, const Numbers& numbers, double t) {
  const std::vector<ComplexPoint> p = points_of(numbers, kind.points.size());
  const std::size_t n = p.size();
  Numbers knots{0.0};
  for (std::size_t i = 1; i < n; ++i) {
    const Complex x = p[i][0] - p[i - 1][0], y = p[i][1] - p[i - 1][1];
    knots.push_back(knots.back() + std::sqrt(x * x + y * y));
  }
  for (Complex& knot : knots) knot /= Complex(knots.back());
  const bool periodic = kind.points.front() == kind.points.back() && !kind.corner;
  std::vector<Numbers> a(n, Numbers(n));
  std::vector<ComplexPoint> b(n);
  const auto h = [&](std::size_t i) { return knots[i + 1] - knots[i]; };
  for (std::size_t i = 0; i < n; ++i) {
    if (i == n - 1 && periodic) a[i][i] = 1.0, a[i][0] = -1.0;
    if ((i == 0 || i == n - 1) && !periodic) a[i][i] = 1.0;
    if (i == n - 1 || (i == 0 && !periodic)) continue;
    const std::size_t before = i == 0 ? n - 2 : i - 1;
    a[i][i == 0 ? n - 2 : i - 1] += h(before);
    a[i][i] += 2.0 * (h(before) + h(i));
    a[i][i + 1] += h(i);
    for (std::size_t k = 0; k < 2; ++k)
      b[i][k] = 6.0 * ((p[i + 1][k] - p[i][k]) / h(i) - (p[before + 1][k] - p[before][k]) / h(before));
  }
  const std::vector<ComplexPoint> m = solved(a, b);
  std::size_t i = 0;
  while (i + 2 < n && t >= kind.knots[i + 1]) ++i;
  const Complex right = (t - knots[i]) / h(i), left = 1.0 - right;
  ComplexPoint result;
  for (std::size_t k = 0; k < 2; ++k)
    result[k] = left * p[i][k] + right * p[i + 1][k] +
                h(i) * h(i) / 6.0 *
                    ((left * left * left - left) * m[i][k] + (right * right * right - right) * m[i + 1][k]);
  return result;
}

ComplexPoint on_curve(const Shape& kind, const Numbers& numbers, double t) {
  if (const auto* airfoil = std::get_if<CstAirfoil>(&kind)) {
    const std::size_t n = airfoil->upper.size();
    std::vector<double> row(n);
    const CstStation at = cst_basis(t, airfoil->degree(), airfoil->e1, airfoil->e2, row);
    Complex y = at.x * numbers[2 * n + (at.upper ? 0 : 1)];
    for (std::size_t i = 0; i < n; ++i) y += row[i] * numbers[i + (at.upper ? 0 : n)];
    return {at.x, y};
  }
  if (const auto* spline = std::get_if<Spline>(&kind)) return on_spline(*spline, numbers, t);
  if (std::holds_alternative<Arc>(kind)) {
    const Complex angle = numbers[3] + t * numbers[4];
    return {numbers[0] + numbers[2] * std::cos(angle), numbers[1] + numbers[2] * std::sin(angle)};
  }
  const std::size_t size = std::holds_alternative<Line>(kind) ? 2 : std::get<Polyline>(kind).points.size();
  const std::vector<ComplexPoint> p = points_of(numbers, size);
  const double along = t * static_cast<double>(size - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(along), size - 2);
  const double part = along - static_cast<double>(i);
  return {(1.0 - part) * p[i][0] + part * p[i + 1][0], (1.0 - part) * p[i][1] + part * p[i + 1][1]};
}

Complex add_imaginary(double x, double slope) {
  return {x, 1e-30 * slope};
}

// The derivative of a boundary vertex in a direction of all coefficients.
Point reference(const Domain& domain, std::span<const double> direction, std::size_t curve, double t) {
  const std::vector<double> all = coefficients_of(domain);
  std::size_t next = 0, index = 0;
  for (const Loop& loop : domain.loops) {
    std::optional<ComplexPoint> p;
    for (const Curve& part : loop.curves) {
      Domain alone;
      alone.loops = {{.curves = {part}}};
      const std::size_t count = coefficients_of(alone).size() - 4;
      if (index++ == curve) {
        Numbers numbers;
        for (std::size_t i = next; i < next + count; ++i)
          numbers.push_back(add_imaginary(all[i], direction[i]));
        p = on_curve(part.shape, numbers, t);
      }
      next += count;
    }
    const auto placed = [&](std::size_t i) { return add_imaginary(all[next + i], direction[next + i]); };
    const Complex turn = placed(1) * (std::numbers::pi / 180.0);
    if (p) {
      const Complex x = placed(0) * (std::cos(turn) * (*p)[0] - std::sin(turn) * (*p)[1]) + placed(2);
      const Complex y = placed(0) * (std::sin(turn) * (*p)[0] + std::cos(turn) * (*p)[1]) + placed(3);
      return {x.imag() * 1e30, y.imag() * 1e30};
    }
    next += 4;
  }
  return {};
}

Curve curve_of(const std::string& name, Spline spline) {
  std::vector<double> stations(spline.knots.begin(), spline.knots.end() - 1);
  // Some stations are no knots.
  for (double& t : stations) t *= 0.99;
  return {.name = name, .shape = std::move(spline), .parameters = stations};
}

// Curves of every kind: an airfoil with an open trailing edge, splines with and without a corner, a polygon,
// a circle.
Domain every_kind() {
  CstAirfoil airfoil = named_airfoil("naca:2412", 5);
  airfoil.te_upper = 0.01, airfoil.te_lower = -0.012;
  Domain domain =
      airfoils_domain({{.name = "airfoil", .airfoil = airfoil, .placement = {1.3, -7.0, {-3.0, 0.2}}}},
                      {.points = 40, .farfield_radius = 12, .farfield_points = 30});
  std::vector<Point> ellipse;
  for (int i = 0; i < 24; ++i)
    ellipse.push_back(
        {std::cos(2 * std::numbers::pi * i / 24), 0.4 * std::sin(2 * std::numbers::pi * i / 24)});
  ellipse.push_back(ellipse.front());
  domain.loops.push_back({.role = LoopRole::hole,
                          .curves = {curve_of("smooth", spline_through(ellipse))},
                          .placement = {1.0, 20.0, {1.0, 0.0}}});
  domain.loops.push_back({.role = LoopRole::hole,
                          .curves = {curve_of("corner", spline_through(ellipse, SplineEnds::corner))},
                          .placement = {0.7, 0.0, {4.0, 1.0}}});
  domain.loops.push_back({.role = LoopRole::hole,
                          .curves = {{"polygon", Polyline{{{0, 0}, {1, 0}, {1.2, 0.8}, {0.3, 1}, {0, 0}}},
                                      Parameters::uniform(12)}},
                          .placement = {1.0, 0.0, {0.0, 3.0}}});
  return domain;
}

std::vector<double> random_direction(std::size_t size, std::mt19937_64& random) {
  std::vector<double> direction(size);
  for (double& x : direction) x = test::uniform(random, -1.0, 1.0);
  return direction;
}

TEST(MeshDerivative, IsThatOfAComplexStepForEveryKindOfCurve) {
  const unsigned long long seed = test::seed(31);
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  const Domain domain = every_kind();
  const Mesh mesh = generate(domain).mesh;
  const FrozenMesh frozen = mesh.freeze();
  const MeshDerivative derivative(mesh);
  for (int trial = 0; trial < 3; ++trial) {
    const std::vector<double> direction = random_direction(derivative.coefficients(), random);
    const std::vector<Point> moved = derivative.jvp(direction);
    ASSERT_EQ(moved.size(), frozen.points.size());
    std::size_t boundary = 0;
    for (std::size_t p = 0; p < moved.size(); ++p) {
      Point expected = {};
      if (frozen.curve[p] >= 0)
        expected =
            reference(domain, direction, static_cast<std::size_t>(frozen.curve[p]), frozen.parameter[p]),
        ++boundary;
      EXPECT_NEAR(moved[p].x, expected.x, 1e-12 * (1.0 + std::fabs(expected.x)));
      EXPECT_NEAR(moved[p].y, expected.y, 1e-12 * (1.0 + std::fabs(expected.y)));
    }
    EXPECT_GE(boundary, 140u);
  }
}

TEST(MeshDerivative, TheTransposedOneIsTheTransposedOne) {
  std::mt19937_64 random(test::seed(32));
  const Mesh mesh = generate(every_kind()).mesh;
  const MeshDerivative derivative(mesh);
  const std::vector<double> direction = random_direction(derivative.coefficients(), random);
  std::vector<Point> bar(derivative.points());
  for (Point& p : bar) p = {test::uniform(random, -1.0, 1.0), test::uniform(random, -1.0, 1.0)};
  const std::vector<Point> moved = derivative.jvp(direction);
  const std::vector<double> back = derivative.vjp(bar);
  double over_points = 0.0, over_coefficients = 0.0, size = 0.0;
  for (std::size_t p = 0; p < bar.size(); ++p)
    over_points += dot(bar[p], moved[p]), size += std::fabs(dot(bar[p], moved[p]));
  for (std::size_t i = 0; i < back.size(); ++i) over_coefficients += back[i] * direction[i];
  EXPECT_NEAR(over_points, over_coefficients, 1e-13 * size);
}

TEST(MeshDerivative, CoefficientsMakeTheSameDomainAgain) {
  const Domain domain = every_kind();
  const std::vector<double> numbers = coefficients_of(domain);
  EXPECT_EQ(with_coefficients(domain, numbers), domain);
  EXPECT_EQ(coefficients_of(with_coefficients(domain, numbers)), numbers);
  EXPECT_THROW(with_coefficients(domain, std::vector<double>(3)), Error);
}

TEST(MeshAt, KeepsTheConnectivityOrSaysThatItCannot) {
  const CstAirfoil airfoil = named_airfoil("naca:0012", 5);
  const Mesh mesh = generate(airfoil_domain(airfoil, {.points = 60}), {.gradation = 1.2}).mesh;
  CstAirfoil near = airfoil, far = named_airfoil("naca:4424", 5);
  near.upper[2] += 1e-4;
  const Domain domain = airfoil_domain(near, {.points = 60});
  const Mesh moved = mesh_at(mesh, domain);
  EXPECT_EQ(moved.freeze().triangles, mesh.freeze().triangles);
  EXPECT_EQ(moved.freeze().vertex_ids, mesh.freeze().vertex_ids);
  EXPECT_EQ(moved.domain(), domain);
  EXPECT_EQ(moved.quick_check(), "");
  EXPECT_EQ(mesh_at(mesh, mesh.domain()).freeze().points, mesh.freeze().points);
  EXPECT_THROW(mesh_at(mesh, airfoil_domain(far, {.points = 60})), TopologyChanged);
  EXPECT_THROW(mesh_at(mesh, airfoil_domain(near, {.points = 62})), TopologyChanged);
}

TEST(MeshAt, OfAHeldMeshIsTheMorphOfItsReference) {
  const CstAirfoil airfoil = named_airfoil("naca:0012", 5);
  Mesh mesh = generate(airfoil_domain(airfoil, {.points = 60}), {.gradation = 1.2}).mesh;
  CstAirfoil now = airfoil, next = airfoil;
  now.upper[2] += 0.02, now.lower[1] -= 0.01;
  next = now, next.upper[1] += 1e-3;
  const Domain design = airfoil_domain(next, {.points = 60});
  const RemodelOptions reference{.strategy = Strategy::reference};
  Mesh own = mesh;
  ASSERT_TRUE(remodel(own, design, reference).held);  // it is a reference itself
  EXPECT_EQ(mesh_at(mesh, design, Strategy::reference).freeze().points, own.freeze().points);
  ASSERT_TRUE(remodel(mesh, airfoil_domain(now, {.points = 60}), reference).held);
  Mesh stepped = mesh;
  ASSERT_TRUE(remodel(stepped, design, reference).held);
  const Mesh at = mesh_at(mesh, design);
  EXPECT_EQ(at.freeze().points, stepped.freeze().points);
  EXPECT_EQ(at.freeze().vertex_keys, mesh.freeze().vertex_keys);
  EXPECT_TRUE(at.held());
  EXPECT_THROW(mesh_at(mesh, airfoil_domain(named_airfoil("naca:6640", 5), {.points = 60})), TopologyChanged);
}

}  // namespace
}  // namespace remodel
