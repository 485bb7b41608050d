// Manufactured flows with friction: flows that are written down, with the sources that make them steady (P.
// J. Roache, J. Fluids Eng. 124 (2002)), on layers of quadrilaterals and on triangles. The wall below is the
// scheme's own, strong and warm; at the other sides the vertices have the written values.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "flow/linear/direct_solver.h"
#include "flow/scheme/friction_system.h"
#include "flow/test_grids.h"

namespace remodel::flow {
namespace {

constexpr double wall_warmth = 1.2;

// A function of the place with its first and second derivatives.
struct Jet {
  double value = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;

  // f(*this), by the function's value and derivatives there.
  Jet chain(double f, double f1, double f2) const {
    return {f, f1 * x, f1 * y, f1 * xx + f2 * x * x, f1 * xy + f2 * x * y, f1 * yy + f2 * y * y};
  }
  friend Jet operator+(const Jet& a, const Jet& b) {
    return {a.value + b.value, a.x + b.x, a.y + b.y, a.xx + b.xx, a.xy + b.xy, a.yy + b.yy};
  }
  friend Jet operator*(double f, const Jet& a) { return a.chain(f * a.value, f, 0.0); }
  friend Jet operator+(double f, const Jet& a) { return a.chain(f + a.value, 1.0, 0.0); }
  friend Jet operator-(double f, const Jet& a) { return a.chain(f - a.value, -1.0, 0.0); }
  friend Jet operator*(const Jet& a, const Jet& b) {
    return {a.value * b.value,
            a.x * b.value + a.value * b.x,
            a.y * b.value + a.value * b.y,
            a.xx * b.value + 2.0 * a.x * b.x + a.value * b.xx,
            a.xy * b.value + a.x * b.y + a.y * b.x + a.value * b.xy,
            a.yy * b.value + 2.0 * a.y * b.y + a.value * b.yy};
  }
  friend Jet operator/(const Jet& a, const Jet& b) {
    const double i = 1.0 / b.value;
    return a * b.chain(i, -i * i, 2.0 * i * i * i);
  }
  friend Jet sin(const Jet& a) { return a.chain(std::sin(a.value), std::cos(a.value), -std::sin(a.value)); }
  friend Jet cos(const Jet& a) { return a.chain(std::cos(a.value), -std::sin(a.value), -std::cos(a.value)); }
  friend Jet exp(const Jet& a) { return a.chain(std::exp(a.value), std::exp(a.value), std::exp(a.value)); }

  // What derivatives of a flux are made of.
  using Number = Dual<2>;
  static Number number(double value, double by_x, double by_y) {
    Number result(value);
    result.slope = {by_x, by_y};
    return result;
  }
  Number here() const { return number(value, x, y); }
  Number along_x() const { return number(x, xx, xy); }
  Number along_y() const { return number(y, xy, yy); }
};

// Above a wall at y = 0 that is as warm everywhere.
std::array<Jet, 5> written_at(Point p) {
  const Jet x = {.value = p.x, .x = 1.0}, y = {.value = p.y, .y = 1.0};
  const Jet rise = 1.0 - exp(-3.0 * y);
  const Jet pressure = (1.0 / gas_gamma) * (1.0 + 0.1 * cos(1.5 * x + 1.5 * y));
  const Jet warmth = wall_warmth + 0.2 * rise * (sin(2.0 * x + y) + -1.5 * y);
  return {gas_gamma * pressure / warmth, rise * (0.4 + 0.1 * sin(1.5 * x + -1.0 * y)),
          y * rise * (0.1 + 0.1 * cos(x + 2.0 * y)), pressure, 0.2 * rise * (1.0 + 0.3 * sin(2.0 * x + y))};
}

template <std::size_t N>
std::array<double, N> values_at(Point p) {
  const std::array<Jet, 5> of = written_at(p);
  std::array<double, N> values;
  for (std::size_t k = 0; k < N; ++k) values[k] = of[k].value;
  return values;
}

// The equations in the strong form: the divergence of all fluxes, less what turbulence makes.
template <std::size_t N>
std::array<double, N> source_at(const FrictionTerms& terms, Point p) {
  using T = Jet::Number;
  const auto [jet_rho, jet_u, jet_v, jet_p, jet_w] = written_at(p);
  const Jet jet_warmth = gas_gamma * jet_p / jet_rho;
  const T rho = jet_rho.here(), u = jet_u.here(), v = jet_v.here(), pressure = jet_p.here(), w = jet_w.here();
  const T molecular = terms.viscosity.at(jet_warmth.here());
  T viscosity = molecular, conduction = (1.0 / terms.viscosity.prandtl) * molecular;
  const double unit = FrictionTerms::working_unit * terms.viscosity.stream;
  const T chi = unit * rho * w / molecular;
  if (N == 5) {
    const T turbulent = molecular * SpalartAllmaras::turbulent_ratio(chi);
    viscosity = viscosity + turbulent;
    conduction = conduction + (1.0 / terms.viscosity.turbulent_prandtl) * turbulent;
  }
  conduction = (1.0 / (gas_gamma - 1.0)) * conduction;
  const T spread = (2.0 / 3.0) * (jet_u.along_x() + jet_v.along_y());
  const T xx = viscosity * (2.0 * jet_u.along_x() - spread),
          yy = viscosity * (2.0 * jet_v.along_y() - spread);
  const T xy = viscosity * (jet_u.along_y() + jet_v.along_x());
  const T enthalpy = pressure * (gas_gamma / (gas_gamma - 1.0)) + 0.5 * rho * (u * u + v * v);
  const T along_x[4] = {rho * u, rho * u * u + pressure - xx, rho * u * v - xy,
                        enthalpy * u - u * xx - v * xy - conduction * jet_warmth.along_x()};
  const T along_y[4] = {rho * v, rho * u * v - xy, rho * v * v + pressure - yy,
                        enthalpy * v - u * xy - v * yy - conduction * jet_warmth.along_y()};
  std::array<double, N> sum;
  for (std::size_t k = 0; k < 4; ++k) sum[k] = along_x[k].slope[0] + along_y[k].slope[1];
  if constexpr (N == 5) {
    const T diffusion = molecular * SpalartAllmaras::diffusion_ratio(chi);
    const double turn = jet_v.x - jet_u.y, rounding = FrictionTerms::kinks * terms.mach;
    const double kinematic = molecular.value / rho.value;
    double made = 0.0;  // on walls it does not matter
    if (p.y > 0.0)
      made =
          SpalartAllmaras::source<double>(unit * w.value, kinematic, std::hypot(turn, rounding), p.y, false) /
          unit;
    made += SpalartAllmaras::cb2 / SpalartAllmaras::sigma * unit * (jet_w.x * jet_w.x + jet_w.y * jet_w.y);
    made -= diffusion.value / (rho.value * rho.value) * (jet_rho.x * jet_w.x + jet_rho.y * jet_w.y);
    sum[4] = (rho * u * w - diffusion * jet_w.along_x()).slope[0] +
             (rho * v * w - diffusion * jet_w.along_y()).slope[1] - rho.value * made;
  }
  return sum;
}

// The unit square, n cells across, above a wall. Rows of quadrilaterals that grow from the wall, their
// columns leaning; or cells that are moved and cut at random; or these above those.
enum class Cells { layers, triangles, both };
FlowMesh square(std::uint32_t n, Cells kind) {
  std::mt19937 random(n);
  const auto uniform = [&] { return static_cast<double>(random()) * 0x1p-32; };
  test::QuadGrid grid;
  const std::uint32_t quads = kind == Cells::layers ? n : kind == Cells::both ? n / 2 : 0;
  constexpr double growth = 2.0;  // of a cell at the top over one at the wall: e^2
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i) {
      const bool is_inside = i % n != 0 && j % n != 0;
      const double reach = is_inside && j > quads ? 0.4 : 0.0, s = double(i) / n, t = double(j) / n;
      const double x = s + reach * (uniform() - 0.5) / n + 0.1 * std::sin(M_PI * s) * t;
      const bool is_even = kind == Cells::triangles;
      const double y = is_even ? t : std::expm1(growth * t) / std::expm1(growth);
      grid.points.push_back(
          {x, y + reach * (is_even ? 1.0 : std::min(1.0, 2.0 * t)) * (uniform() - 0.5) / n});
    }
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return j * (n + 1) + i; };
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      if (j < quads) {
        grid.cells.push_back({{a, b, c, d}});
      } else if (random() % 2 == 0) {
        grid.cells.push_back({{a, b, c, no_index}}), grid.cells.push_back({{a, c, d, no_index}});
      } else {
        grid.cells.push_back({{a, b, d, no_index}}), grid.cells.push_back({{b, c, d, no_index}});
      }
    }
  grid.boundaries = {{"wall", {}}, {"farfield", {}}};
  for (std::uint32_t i = 0; i < n; ++i) {
    grid.boundaries[0].edges.push_back({at(i, 0), at(i + 1, 0)});
    grid.boundaries[1].edges.push_back({at(n, i), at(n, i + 1)});
    grid.boundaries[1].edges.push_back({at(i + 1, n), at(i, n)});
    grid.boundaries[1].edges.push_back({at(0, i + 1), at(0, i)});
  }
  return grid.dual({{"farfield", FarField{}}, {"wall", NoSlipWall{}}});
}

// The flow with these sources, from the written one.
template <std::size_t N>
class Manufactured {
 public:
  Manufactured(const FlowMesh& dual, double viscosity)
      : dual_(dual),
        mesh_(dual),
        system_(mesh_, {.mach = 0.5, .wall_temperature = wall_warmth, .vortex = false},
                {.stream = viscosity}),
        fixed_(dual.size(), false) {
    for (const BoundaryEdge& edge : dual.boundary())
      if (dual.patch(edge).is_farfield()) fixed_[edge.a] = fixed_[edge.b] = true;
    for (std::size_t v = 0; v < dual.size(); ++v) {
      state_.q.push_back(values_at<N>(dual.points()[v]));
      sources_.push_back(source_at<N>(system_.terms(), dual.points()[v]));
      for (double& source : sources_.back()) source *= dual.areas()[v];
    }
    solve();
  }

  // The errors of all unknowns in the mean square over the area, and of what acts on the wall, in the mean
  // square over its vertices: friction and heat.
  std::array<double, N + 2> errors() const {
    std::array<double, N + 2> errors = {};
    double area = 0.0;
    for (std::size_t v = 0; v < dual_.size(); ++v) {
      const std::array<double, N> expected = values_at<N>(dual_.points()[v]);
      area += dual_.areas()[v];
      for (std::size_t k = 0; k < N; ++k) {
        const double e = state_.q[v][k] - expected[k];
        errors[k] += dual_.areas()[v] * e * e;
      }
    }
    for (std::size_t k = 0; k < N; ++k) errors[k] = std::sqrt(errors[k] / area);
    add_wall_errors(errors);
    return errors;
  }

 private:
  BlockVector<N> unbalanced() const {
    BlockVector<N> flux;
    system_.unbalanced(state_, flux);
    for (std::size_t v = 0; v < flux.size(); ++v)
      for (std::size_t k = 0; k < N; ++k) flux[v][k] -= sources_[v][k];
    return flux;
  }
  void solve() {
    BlockMatrix<N> matrix = system_.pattern();
    DirectSolver<N> lu;
    double size = 1.0;
    for (int i = 0; i < 30 && size > 1e-13; ++i) {
      BlockVector<N> rest = unbalanced();
      system_.make_walls_strong(state_, rest);
      system_.jacobian(state_, matrix);
      size = 0.0;
      for (std::size_t v = 0; v < rest.size(); ++v) {
        if (fixed_[v]) fix(matrix, v), rest[v] = {};
        for (double& r : rest[v]) size = std::max(size, std::fabs(r)), r = -r;
      }
      ASSERT_EQ(lu.factor(matrix, 4096.0), Factored::done);
      lu.solve(rest, 1);
      for (std::size_t v = 0; v < rest.size(); ++v)
        for (std::size_t k = 0; k < N; ++k) state_.q[v][k] += rest[v][k];
    }
    EXPECT_LE(size, 1e-13);
  }
  static void fix(BlockMatrix<N>& matrix, std::size_t v) {
    for (std::uint32_t i = matrix.start[v]; i < matrix.start[v + 1]; ++i)
      for (std::size_t z = 0; z < N * N; ++z)
        matrix.block[i][z] = matrix.column[i] == v && z / N == z % N ? 1.0 : 0.0;
  }
  void add_wall_errors(std::array<double, N + 2>& errors) const {
    const BlockVector<N> flux = unbalanced();
    std::vector<double> length(dual_.size(), 0.0);
    for (const BoundaryEdge& edge : dual_.boundary())
      for (const std::uint32_t v : {edge.a, edge.b})
        length[v] += 0.5 * std::sqrt(squared_distance(dual_.points()[edge.a], dual_.points()[edge.b]));
    int count = 0;
    for (std::size_t v = 0; v < dual_.size(); ++v) {
      if (!mesh_.sticks(v) || fixed_[v]) continue;
      const std::array<Jet, 5> of = written_at(dual_.points()[v]);
      const double viscosity = system_.terms().viscosity.at(wall_warmth);
      const Jet warmth = gas_gamma * of[3] / of[0];
      const double friction = viscosity * of[1].y;
      const double heat = viscosity / system_.terms().viscosity.prandtl / (gas_gamma - 1.0) * warmth.y;
      const double by_friction = system_.friction_force(flux, v).x / length[v] / friction - 1.0;
      const double by_heat = system_.heat(flux, v) / length[v] / heat - 1.0;
      errors[N] += by_friction * by_friction, errors[N + 1] += by_heat * by_heat, ++count;
    }
    errors[N] = std::sqrt(errors[N] / count), errors[N + 1] = std::sqrt(errors[N + 1] / count);
  }

  const FlowMesh& dual_;
  FrictionMesh mesh_;
  FrictionSystem<N> system_;
  BlockState<N> state_;
  BlockVector<N> sources_;
  std::vector<bool> fixed_;
};

// Over two halvings of the spacing. Where a wall has layers, what acts on it is asked for too: one-sided
// triangles have friction and heat of an order between 1 and 2.
template <std::size_t N>
void expect_second_order(Cells kind) {
  constexpr double viscosity = 1e-3;  // a Reynolds number of 500
  const auto errors_on = [&](std::uint32_t n) {
    const FlowMesh dual = square(n, kind);
    return Manufactured<N>(dual, viscosity).errors();
  };
  const std::array<double, N + 2> coarse = errors_on(16), fine = errors_on(64);
  const std::size_t asked = kind == Cells::triangles ? N : N + 2;
  for (std::size_t k = 0; k < asked; ++k) {
    EXPECT_GT(0.5 * std::log2(coarse[k] / fine[k]), 1.8) << k;
    ::testing::Test::RecordProperty("order_" + std::to_string(k),
                                    std::to_string(0.5 * std::log2(coarse[k] / fine[k])));
  }
}

TEST(FrictionVerification, AManufacturedLaminarFlowOnLayers) {
  expect_second_order<4>(Cells::layers);
}
TEST(FrictionVerification, AManufacturedLaminarFlowOnTriangles) {
  expect_second_order<4>(Cells::triangles);
}
TEST(FrictionVerification, AManufacturedLaminarFlowOnTrianglesAboveLayers) {
  expect_second_order<4>(Cells::both);
}
TEST(FrictionVerification, AManufacturedTurbulentFlowOnLayers) {
  expect_second_order<5>(Cells::layers);
}
TEST(FrictionVerification, AManufacturedTurbulentFlowOnTriangles) {
  expect_second_order<5>(Cells::triangles);
}
TEST(FrictionVerification, AManufacturedTurbulentFlowOnTrianglesAboveLayers) {
  expect_second_order<5>(Cells::both);
}

}  // namespace
}  // namespace remodel::flow
