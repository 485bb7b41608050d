#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include "flow/scheme/friction_system.h"
#include "flow/test_flows.h"
#include "remodel/error.h"
#include "remodel/flow.h"
#include "remodel/generate.h"
#include "remodel/layers.h"
#include "support.h"

namespace remodel::flow {
namespace {

constexpr double pi = std::numbers::pi;

// One passage of a row of blocks, of uneven cells: `rows` of them from period to period, of which the cut
// leaves the one of this number at the bottom. Whatever the cut is, the row of passages is the same.
class Passage {
 public:
  static constexpr std::uint32_t rows = 12, columns = 14;
  explicit Passage(std::uint32_t cut, double moved_by = 0.0) : cut_(cut) {
    std::mt19937_64 random(3);
    std::vector<Point> of_row((columns + 1) * rows);
    for (Point& p : of_row) p = {test::uniform(random, -0.02, 0.02), test::uniform(random, -0.02, 0.02)};
    for (std::uint32_t j = 0; j <= rows; ++j)
      for (std::uint32_t i = 0; i <= columns; ++i) {
        const double dx = i == 0 || i == columns ? 0.0 : of_row[node(i, j)].x;
        const Point p = {0.1 * i + dx, 0.1 * (cut + j) + 0.05 * i + of_row[node(i, j)].y};
        mesh.points.push_back(p + (j == 0 && i == 3 ? Point{moved_by, 0.0} : Point{}));
      }
    for (std::uint32_t j = 0; j < rows; ++j)
      for (std::uint32_t i = 0; i < columns; ++i) {
        const std::uint32_t row = (cut + j) % rows;
        if (i >= 5 && i < 8 && row >= 4 && row < 7) continue;  // the block
        const std::uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
        if (row == 0 || row >= 10)  // a layer, which the lowest cut goes through
          mesh.quads.push_back({a, b, c, d});
        else
          test::add_cell(mesh, a, b, c, d, (i + row) % 2 == 0);
      }
    mesh.boundaries = {{"below", {}}, {"above", {}}, {"in", {}}, {"out", {}}, {"block", {}}};
    const auto add = [&](std::size_t boundary, std::uint32_t a, std::uint32_t b) {
      mesh.boundaries[boundary].edges.push_back({a, b});
    };
    for (std::uint32_t i = 0; i < columns; ++i)
      add(0, at(i, 0), at(i + 1, 0)), add(1, at(i + 1, rows), at(i, rows));
    for (std::uint32_t j = 0; j < rows; ++j)
      add(2, at(0, j + 1), at(0, j)), add(3, at(columns, j), at(columns, j + 1));
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t bottom = (4 + rows - cut) % rows;
      add(4, at(6 + k, bottom), at(5 + k, bottom)), add(4, at(5 + k, bottom + 3), at(6 + k, bottom + 3));
      add(4, at(5, bottom + k), at(5, bottom + k + 1)), add(4, at(8, bottom + k + 1), at(8, bottom + k));
    }
    drop_unused();
  }
  FlowMesh dual() const {
    return {mesh,
            {{"below", Periodic{"above"}},
             {"above", Periodic{}},
             {"in", Inlet{1.05, 1.0, 0.4}},
             {"out", Outlet{0.98}}},
            "passage"};
  }
  // The node of the row that a point is, from 0.
  std::vector<std::uint32_t> node_of;
  FrozenMesh mesh;

 private:
  static std::uint32_t at(std::uint32_t i, std::uint32_t j) { return j * (columns + 1) + i; }
  std::uint32_t node(std::uint32_t i, std::uint32_t j) const { return (cut_ + j) % rows * (columns + 1) + i; }
  // Points inside the block are of no cell.
  void drop_unused() {
    std::vector<bool> used(mesh.points.size(), false);
    for (std::size_t c = 0; c < mesh.cell_count(); ++c)
      for (const std::uint32_t v : mesh.cell(c)) used[v] = true;
    std::vector<std::uint32_t> number(mesh.points.size(), no_index);
    std::vector<Point> points;
    for (std::uint32_t v = 0; v < used.size(); ++v) {
      if (!used[v]) continue;
      number[v] = static_cast<std::uint32_t>(points.size());
      points.push_back(mesh.points[v]);
      node_of.push_back(node(v % (columns + 1), v / (columns + 1)));
    }
    mesh.points = points;
    for (auto& cell : mesh.triangles)
      for (std::uint32_t& v : cell) v = number[v];
    for (auto& cell : mesh.quads)
      for (std::uint32_t& v : cell) v = number[v];
    for (FrozenBoundary& boundary : mesh.boundaries)
      for (auto& edge : boundary.edges) edge = {number[edge[0]], number[edge[1]]};
  }

  std::uint32_t cut_;
};

// A state of the row, a few percent about a stream at an angle.
template <std::size_t N>
BlockState<N> state_of(const Passage& passage, double spread = 0.05) {
  std::mt19937_64 random(11);
  BlockVector<N> nodes(Passage::rows * (Passage::columns + 1));
  for (auto& q : nodes) {
    q[0] = 1.0, q[1] = 0.4, q[2] = 0.15, q[3] = 1.0 / gas_gamma;
    if constexpr (N == 5) q[4] = 1.0;
    for (double& value : q) value += test::uniform(random, -spread, spread);
  }
  BlockState<N> state{.q = {}, .augmented = {0.0, 0.3}};
  for (const std::uint32_t node : passage.node_of) state.q.push_back(nodes[node]);
  return state;
}

template <std::size_t N>
std::unique_ptr<BlockSystem<N>> friction_system(const FrictionMesh& mesh) {
  return std::make_unique<FrictionSystem<N>>(mesh, Stream{.mach = 0.4, .alpha = 0.3, .length = 0.3},
                                             Viscosity{.stream = 0.4 / 300.0});
}

// Residuals by node of the row, and the residual's derivative along a move of nodes.
template <std::size_t N>
BlockVector<N> by_node(const Passage& passage, const FlowMesh& dual, const BlockVector<N>& of_vertices) {
  BlockVector<N> nodes(Passage::rows * (Passage::columns + 1));
  for (std::uint32_t v = 0; v < of_vertices.size(); ++v)
    for (std::size_t k = 0; k < N; ++k) {
      if (dual.is_image(v))
        EXPECT_EQ(of_vertices[v][k], 0.0) << v;
      else
        nodes[passage.node_of[v]][k] = of_vertices[v][k];
    }
  return nodes;
}

template <std::size_t N>
void expect_alike(const BlockVector<N>& a, const BlockVector<N>& b) {
  for (std::size_t v = 0; v < a.size(); ++v)
    for (std::size_t k = 0; k < N; ++k) EXPECT_NEAR(a[v][k], b[v][k], 1e-12) << v << " " << k;
}

TEST(Periodic, ResidualsDoNotDependOnWhereARowIsCut) {
  const Passage low(0), high(8);
  const FlowMesh dual[2] = {low.dual(), high.dual()};
  EXPECT_TRUE(dual[0].has_images());
  Vector gas[2];
  BlockVector<4> laminar[2];
  BlockVector<5> turbulent[2];
  for (int i = 0; i < 2; ++i) {
    const Passage& passage = i == 0 ? low : high;
    Augmented augmented;
    Vector q;
    FlowSystem(dual[i], {.mach = 0.4, .alpha = 0.3, .length = 0.3})
        .residuals(state_of<4>(passage), q, augmented);
    gas[i] = by_node(passage, dual[i], q);
    FlowMesh sticking = dual[i];
    sticking.stick_to_walls();
    const FrictionMesh mesh(sticking);
    friction_system<4>(mesh)->residuals(state_of<4>(passage), q, augmented);
    laminar[i] = by_node(passage, dual[i], q);
    BlockVector<5> q5;
    friction_system<5>(mesh)->residuals(state_of<5>(passage), q5, augmented);
    turbulent[i] = by_node(passage, dual[i], q5);
  }
  expect_alike<4>(gas[0], gas[1]);
  expect_alike<4>(laminar[0], laminar[1]);
  expect_alike<5>(turbulent[0], turbulent[1]);
}

TEST(Periodic, UniformFlowAtTheInletsAngleHasNoResidual) {
  Passage passage(2);
  passage.mesh.boundaries[4].name = "out";  // of a block that gas passes
  const double mach = 0.5, angle = 0.4;
  const FlowMesh dual(passage.mesh,
                      {{"below", Periodic{"above"}},
                       {"above", Periodic{}},
                       {"in", Inlet{1.0, 1.0, angle}},
                       {"out", Outlet{}}},
                      "passage");
  const FlowSystem system(dual, {.mach = mach, .alpha = angle, .length = 1.0});
  Vector residual;
  system.residual(system.undisturbed(), residual);
  for (std::size_t v = 0; v < dual.size(); ++v)
    for (const double value : residual[v]) EXPECT_NEAR(value, 0.0, 1e-13) << v;
}

// Jacobian times a step against differences of residuals, images included.
template <std::size_t N>
void expect_exact_jacobian(const BlockSystem<N>& system, BlockState<N> state) {
  std::mt19937_64 random(5);
  for (auto& q : state.q)
    for (double& value : q) value += test::uniform(random, -0.01, 0.01);  // copies differ
  BlockVector<N> step(state.q.size());
  for (auto& q : step)
    for (double& value : q) value = test::uniform(random, -1, 1);
  const auto residual_at = [&](double h) {
    BlockState<N> at = state;
    for (std::size_t v = 0; v < step.size(); ++v)
      for (std::size_t k = 0; k < N; ++k) at.q[v][k] += h * step[v][k];
    BlockVector<N> result;
    Augmented augmented;
    system.residuals(at, result, augmented);
    return result;
  };
  BlockMatrix<N> matrix = system.pattern();
  system.jacobian(state, matrix);
  BlockVector<N> product(step.size());
  add_product(matrix, 1.0, step, product);
  constexpr double h = 1e-6;
  const BlockVector<N> plus = residual_at(h), less = residual_at(-h);
  for (std::size_t v = 0; v < step.size(); ++v)
    for (std::size_t k = 0; k < N; ++k)
      EXPECT_NEAR(product[v][k], (plus[v][k] - less[v][k]) / (2 * h), 3e-7) << v << " " << k;
}

TEST(Periodic, JacobiansAreThoseOfDifferences) {
  const Passage passage(2);
  FlowMesh dual = passage.dual();
  expect_exact_jacobian<4>(FlowSystem(dual, {.mach = 0.4, .alpha = 0.3, .length = 0.3}),
                           state_of<4>(passage));
  dual.stick_to_walls();
  const FrictionMesh mesh(dual);
  expect_exact_jacobian<4>(*friction_system<4>(mesh), state_of<4>(passage));
  expect_exact_jacobian<5>(*friction_system<5>(mesh), state_of<5>(passage));
}

// The weighted residual at meshes whose points are moved along `step` by h.
template <std::size_t N, class Weighted>
void expect_shape_slope(const Passage& passage, const std::vector<Point>& by_points, Weighted weighted) {
  std::mt19937_64 random(17);
  std::vector<Point> of_node(Passage::rows * (Passage::columns + 1)), step;
  for (Point& p : of_node) p = {test::uniform(random, -1, 1), test::uniform(random, -1, 1)};
  const FlowMesh dual = passage.dual();
  const Point of_period = {0.4, -0.7};  // images move with their originals, and with the period
  double along = 0.0;
  for (std::size_t v = 0; v < by_points.size(); ++v) {
    step.push_back(of_node[passage.node_of[v]] + (dual.is_image(v) ? of_period : Point{}));
    along += dot(by_points[v], step[v]);
  }
  const auto at = [&](double h) {
    Passage moved = passage;
    for (std::size_t v = 0; v < step.size(); ++v) moved.mesh.points[v] = moved.mesh.points[v] + h * step[v];
    return weighted(moved);
  };
  constexpr double h = 1e-6;
  EXPECT_NEAR(along, (at(h) - at(-h)) / (2 * h), 1e-6 * (1.0 + std::fabs(along)));
}

TEST(Periodic, DerivativesByPlacesAreThoseOfDifferences) {
  const Passage passage(2);
  const Stream stream = {.mach = 0.4, .alpha = 0.3, .length = 0.3};
  const BlockState<4> state = state_of<4>(passage);
  Vector weight = state_of<4>(passage, 1.0).q;
  FlowMesh dual = passage.dual();
  for (std::uint32_t v = 0; v < dual.size(); ++v)
    if (dual.is_image(v)) weight[v] = {};
  const auto gas = [&](const Passage& moved) {
    const FlowMesh mesh = moved.dual();
    Vector residual;
    FlowSystem(mesh, stream).residual(state, residual);
    return inner<4>(weight, residual);
  };
  expect_shape_slope<4>(passage, FlowSystem(dual, stream).residual_slopes(state, {{weight}})[0].points, gas);
  dual.stick_to_walls();
  const FrictionMesh mesh(dual);
  const BlockState<5> turbulent = state_of<5>(passage);
  BlockVector<5> weight5 = state_of<5>(passage, 1.0).q;
  for (std::uint32_t v = 0; v < dual.size(); ++v)
    if (dual.is_image(v)) weight5[v] = {};
  const FrictionSystem<5> system(mesh, stream, {.stream = 0.4 / 300.0});
  const auto friction = [&](const Passage& moved) {
    FlowMesh of = moved.dual();
    of.stick_to_walls();
    const FrictionMesh friction_mesh(of);
    BlockVector<5> residual;
    FrictionSystem<5>(friction_mesh, stream, {.stream = 0.4 / 300.0}).unbalanced(turbulent, residual);
    return inner<5>(weight5, residual);
  };
  expect_shape_slope<5>(passage, system.slopes_of_unbalanced(turbulent, {{weight5}})[0].points, friction);
}

// Beside walls that lie periods away as in the passage's own cut.
TEST(Periodic, DistancesAreThoseFromTheWholeRow) {
  for (const std::uint32_t cut : {0u, 8u}) {
    const Passage passage(cut);
    FlowMesh dual = passage.dual();
    dual.stick_to_walls();
    const FrictionMesh mesh(dual);
    const Point period = dual.periodic_pairs().at(0).period;
    for (std::uint32_t v = 0; v < dual.size(); ++v) {
      double nearest = 1e9;
      for (int k = -5; k <= 5; ++k)
        for (const BoundaryEdge& edge : dual.boundary()) {
          if (!dual.patch(edge).sticks()) continue;
          const Point p = dual.points()[v] + k * period, a = dual.points()[edge.a], b = dual.points()[edge.b];
          const Point d = p - (a + nearest_part(p, a, b) * (b - a));
          nearest = std::min(nearest, std::sqrt(dot(d, d)));
        }
      EXPECT_NEAR(mesh.distances()[v], nearest, 1e-12) << v;
    }
  }
}

// A mesh that moves keeps its pairs while these fit.
TEST(Periodic, MovedMeshesHaveTheirOwnPeriodOrAreRefused) {
  const Passage passage(2);
  FlowMesh dual = passage.dual();
  std::vector<Point> points = passage.mesh.points;
  for (std::uint32_t v = 0; v < points.size(); ++v)
    if (dual.is_image(v)) points[v].y += 0.02;
  dual.move(points);
  EXPECT_NEAR(dual.periodic_pairs().at(0).period.y, 1.22, 1e-12);
  for (std::uint32_t v = 0; v < points.size(); ++v)
    if (dual.is_image(v)) {
      points[v].y += 0.01;
      break;
    }
  EXPECT_THROW(dual.move(points), Error);
}

std::string error_of(const FrozenMesh& mesh, std::vector<Patch> patches) {
  try {
    FlowMesh(mesh, std::move(patches), "passage");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Periodic, BoundariesThatDoNotFitAreRefusedWithTheirNames) {
  const std::vector<Patch> patches = {
      {"below", Periodic{"above"}}, {"above", Periodic{}}, {"in", Inlet{}}, {"out", Outlet{}}};
  EXPECT_EQ(error_of(Passage(0).mesh, patches), "");
  EXPECT_NE(error_of(Passage(0, 0.01).mesh, patches).find("'below' and 'above' differ"), std::string::npos);
  EXPECT_NE(error_of(Passage(0).mesh, {{"below", Periodic{"roof"}}, {"in", Inlet{}}, {"out", Outlet{}}})
                .find("no boundary 'roof'"),
            std::string::npos);
  EXPECT_NE(error_of(Passage(0).mesh, {{"below", Periodic{"block"}}, {"in", Inlet{}}, {"out", Outlet{}}})
                .find("15 and 12 vertices"),
            std::string::npos);
  Passage walled(0);
  walled.mesh.boundaries[2].name = "block";
  EXPECT_NE(error_of(walled.mesh, {{"below", Periodic{"above"}}, {"above", Periodic{}}, {"out", Outlet{}}})
                .find("meets a periodic boundary"),
            std::string::npos);
}

// Flow of an incompressible fluid through a row of blades, exact, by a conformal map of the outside of a
// circle: z = s / (2 pi) (e^-il ln((t + k) / (k - t)) + e^il ln((t + 1/k) / (t - 1/k))), in which t = -k and
// k are the two ends of the row. Circles around the unit circle, through the point of it where dz/dt = 0, are
// blades with a cusp, as Joukowski's are. Sources: W. Merchant and A. R. Collar, ARC R&M 1893, 1941, who made
// ovals by it; the circle theorem of L. M. Milne-Thomson, Proc. Camb. Phil. Soc. 36, 1940.
class ExactRow {
 public:
  using Complex = std::complex<double>;
  // offset: of the circle's centre along the chord, and across it.
  ExactRow(double k, double stagger, Complex offset) : k_(k), l_(stagger) {
    trailing_ = critical(1.0);
    centre_ = offset * trailing_;
    radius_ = std::abs(trailing_ - centre_);
  }
  // The direction of what leaves, for what comes at this angle with speed 1; and the force on a blade over
  // density times pitch.
  struct Flow {
    double angle;
    Point force;
  };
  Flow flow(double angle) const {
    const Complex i(0.0, 1.0);
    const Complex in = std::exp(-i * angle), before = mirrored(-k_), behind = mirrored(k_);
    const auto slope = [&](Complex out) {
      const Complex t = trailing_;
      return in / (t + k_) + std::conj(in) * (1.0 / (t - before) - 1.0 / (t - centre_)) - out / (t - k_) -
             std::conj(out) * (1.0 / (t - behind) - 1.0 / (t - centre_)) + (out - in) / (t - centre_);
    };
    // Along the circle, where the velocity is 0 at the cusp.
    const Complex along = i * (trailing_ - centre_);
    const double none = (slope(in.real()) * along).real(), one = (slope(in.real() + i) * along).real();
    const Complex out = in.real() - i * (none / (one - none));
    const double x = in.real(), y1 = -in.imag(), y2 = -out.imag();
    return {std::atan2(y2, x), {0.5 * (y2 * y2 - y1 * y1), x * (y1 - y2)}};
  }
  // Of a pitch of 1, along y, counter-clockwise from the cusp to it.
  std::vector<Point> blade(int points) const {
    std::vector<Point> result;
    const Complex i(0.0, 1.0), turn = std::exp(i * l_);
    Complex last[2];
    for (int n = 0; n <= points; ++n) {
      const Complex t = centre_ + (trailing_ - centre_) * std::exp(i * (2.0 * pi * n / points));
      Complex term[2] = {std::log((t + k_) / (k_ - t)), std::log((t + 1.0 / k_) / (t - 1.0 / k_))};
      for (int m = 0; m < 2; ++m) {
        if (n > 0) term[m] -= i * (2.0 * pi * std::round((term[m] - last[m]).imag() / (2.0 * pi)));
        last[m] = term[m];
      }
      const Complex z = (term[0] + turn * turn * term[1]) / (2.0 * pi);
      result.push_back({z.real(), z.imag()});
    }
    result.back() = result.front();
    return result;
  }

 private:
  Complex slope(Complex t) const {
    const Complex turn = std::exp(Complex(0.0, l_));
    return std::conj(turn) * (1.0 / (t + k_) - 1.0 / (t - k_)) +
           turn * (1.0 / (t + 1.0 / k_) - 1.0 / (t - 1.0 / k_));
  }
  Complex critical(Complex t) const {
    for (int n = 0; n < 50; ++n) {
      const double h = 1e-5;
      t -= slope(t) * (2.0 * h) / (slope(t + h) - slope(t - h));
    }
    return t;
  }
  Complex mirrored(double p) const { return centre_ + radius_ * radius_ / std::conj(p - centre_); }

  double k_, l_;
  Complex centre_, trailing_;
  double radius_;
};

// A passage around one blade: periodic curves half a pitch below and above its ends.
Domain passage_of(const std::vector<Point>& blade, std::size_t stations) {
  const auto [nose, rear] =
      std::minmax_element(blade.begin(), blade.end(), [](Point a, Point b) { return a.x < b.x; });
  const Polyline below{{{nose->x - 1.2, nose->y - 0.5},
                        {nose->x, nose->y - 0.5},
                        {rear->x, rear->y - 0.5},
                        {rear->x + 1.5, rear->y - 0.5}}};
  Polyline above = below;
  for (Point& p : above.points) p.y += 1.0;
  std::reverse(above.points.begin(), above.points.end());
  Loop hole{.role = LoopRole::hole, .curves = outline_of(blade, OutlineCurve::spline, "blade")};
  return {.loops = {{.curves = {{"below", below, Parameters::uniform(3 * stations)},
                                {"outlet", Line{below.points.back(), above.points.front()},
                                 Parameters::uniform(stations)},
                                {"above", above, Parameters::uniform(3 * stations)},
                                {"inlet", Line{above.points.back(), below.points.front()},
                                 Parameters::uniform(stations)}}},
                    hole},
          .periodic = {{"below", "above"}}};
}

FlowOptions cascade_options(double angle_deg, double pressure) {
  FlowOptions options;
  options.inlets = {{.name = "inlet", .angle_deg = angle_deg}};
  options.outlets = {{.name = "outlet", .pressure = pressure}};
  return options;
}

// At a Mach number at which the density hardly changes. The pressure behind is that of the exact flow.
TEST(Periodic, FlowTurnsInARowAsTheoryHasIt) {
  constexpr double degree = pi / 180.0, mach = 0.05;
  struct Case {
    double k, stagger_deg, angle_deg;
    std::complex<double> offset;
  };
  for (const Case& row : {Case{1.35, 30.0, 45.0, {-0.04, -0.05}}, Case{1.3, -40.0, -25.0, {-0.08, 0.05}}}) {
    const ExactRow exact(row.k, row.stagger_deg * degree, row.offset);
    const ExactRow::Flow theory = exact.flow(row.angle_deg * degree);
    const Point along = {std::cos(row.angle_deg * degree), std::sin(row.angle_deg * degree)};
    const double lift = 2.0 * cross(along, theory.force);
    double error[2], lift_error[2];
    for (int fine = 0; fine < 2; ++fine) {
      const Domain domain = passage_of(exact.blade(100 << fine), 10u << fine);
      const Mesh mesh = generate(domain, {.gradation = 2.0 * (1 << fine)}).mesh;
      // Bernoulli: p2 - p1 = rho (V1^2 - V2^2) / 2, over p = 1 / gamma.
      const double pressure = 1.0 - gas_gamma * mach * mach * theory.force.x;
      const FlowResult flow = solve_flow(mesh, {.mach = mach, .alpha_deg = row.angle_deg},
                                         cascade_options(row.angle_deg, pressure));
      ASSERT_TRUE(flow.converged()) << flow.reason;
      EXPECT_EQ(flow.warnings.size(), fine == 0 ? 1u : 0u);  // of total pressure that the coarse mesh loses
      EXPECT_EQ(flow.openings.size(), 2u);
      EXPECT_NEAR(flow.openings[0].mach, mach, 0.03 * mach);
      EXPECT_NEAR(flow.openings[1].pressure, pressure, 1e-3);
      EXPECT_NEAR(loss_coefficient(flow).value(), 0.0, fine == 0 ? 0.06 : 0.02);
      EXPECT_NEAR(flow.openings[0].mass_flow + flow.openings[1].mass_flow, 0.0, 1e-9);
      error[fine] = std::fabs(flow.openings[1].flow_angle_deg - theory.angle / degree);
      lift_error[fine] = std::fabs(flow.cl / lift - 1.0);
    }
    // The curvature of the nose shows where there are few stations; at 400 it is .04 degrees and .1 %.
    EXPECT_LT(error[0], 0.6) << row.stagger_deg;
    EXPECT_LT(error[1], 0.2) << row.stagger_deg;
    EXPECT_LT(lift_error[0], 0.08) << row.stagger_deg;
    EXPECT_LT(lift_error[1], 0.5 * lift_error[0]) << row.stagger_deg;
  }
}

// Whoever forgets the angle or the pressure gets coefficients of another stream than the one that enters.
TEST(Periodic, ARowWhoseGasEntersOtherwiseSaysSo) {
  const ExactRow exact(1.35, 30.0 * pi / 180.0, {-0.04, -0.05});
  const Mesh mesh = generate(passage_of(exact.blade(100), 10), {.gradation = 2.0}).mesh;
  const auto warnings = [&](double alpha_deg, double inlet_angle_deg, double pressure) {
    const FlowResult flow =
        solve_flow(mesh, {.mach = 0.2, .alpha_deg = alpha_deg}, cascade_options(inlet_angle_deg, pressure));
    EXPECT_TRUE(flow.converged()) << flow.reason;
    std::string text;
    for (const std::string& warning : flow.warnings) text += warning + "\n";
    return text;
  };
  EXPECT_EQ(warnings(45.0, 45.0, 1.008).find("gas enters"), std::string::npos);
  EXPECT_NE(warnings(0.0, 45.0, 1.008).find("gas enters by 'inlet' at 45 degrees"), std::string::npos);
  EXPECT_NE(warnings(45.0, 45.0, 0.99).find("and coefficients are by a stream of Mach 0.2"),
            std::string::npos);
}

}  // namespace
}  // namespace remodel::flow
