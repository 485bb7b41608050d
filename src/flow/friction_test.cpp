// Flows with friction: derivatives, orders of errors, and flows whose friction is known.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "flow/living_flow/last_flow.h"
#include "flow/search/friction_search.h"
#include "flow/test_flows.h"
#include "flow/test_grids.h"
#include "remodel/airfoil.h"
#include "remodel/error.h"
#include "remodel/flow.h"
#include "remodel/layers.h"
#include "remodel/mesh_derivative.h"
#include "support.h"

namespace remodel::flow {
namespace {

// A grid with a wall at the bottom: some quadrilaterals are cut in triangles, and all inner vertices are
// moved.
FlowMesh uneven_grid(std::mt19937_64& random) {
  test::QuadGrid grid = test::plate_grid({.start = -0.5,
                                          .length = 1.0,
                                          .height = 1.0,
                                          .first = 0.1,
                                          .at_edge = 0.1,
                                          .before = 3,
                                          .along = 5,
                                          .up = 5});
  for (Point& p : grid.points)
    if (p.y > 0.0 && p.y < 1.0 && p.x > -0.5 && p.x < 1.0)
      p = p + Point{test::uniform(random, -0.02, 0.02), test::uniform(random, -0.02, 0.02)};
  std::vector<Cell> cells;
  for (std::size_t t = 0; t < grid.cells.size(); ++t) {
    const Cell& c = grid.cells[t];
    if (t % 3 > 0) {
      cells.push_back(c);
      continue;
    }
    cells.push_back({{c[0], c[1], c[2], no_index}});
    cells.push_back({{c[0], c[2], c[3], no_index}});
  }
  grid.cells = std::move(cells);
  return grid.dual(
      {{"farfield", FarField{}}, {"symmetry", Symmetry{}}, {"outlet", Outlet{1.0}}, {"wall", NoSlipWall{}}});
}

// Jacobian times a step, augmented rows and columns, against differences of residuals.
template <std::size_t N>
void expect_exact_jacobian(double mach, const std::optional<std::array<double, 2>>& transition = {},
                           std::optional<double> wall_temperature = {}) {
  const unsigned long long seed = test::seed(46);
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  const FlowMesh dual = uneven_grid(random);
  const FrictionMesh mesh(dual, transition);
  const FrictionSystem<N> system(mesh, {.mach = mach, .alpha = 0.05, .wall_temperature = wall_temperature},
                                 {.stream = mach / 300.0});
  BlockState<N> state = system.start(0.2);
  BlockIncrement<N> step = zero_of<N>(dual.size());
  for (std::size_t v = 0; v < dual.size(); ++v)
    for (std::size_t k = 0; k < N; ++k) {
      state.q[v][k] += k < 4 ? test::uniform(random, -0.05, 0.05) : test::uniform(random, -0.1, 0.3);
      step.q[v][k] = test::uniform(random, -1, 1);
    }
  step.augmented = {0.7, -0.4};
  state.augmented = {0.3, 0.06};
  const auto residual_at = [&](double h) {
    BlockState<N> at = state;
    for (std::size_t v = 0; v < dual.size(); ++v)
      for (std::size_t k = 0; k < N; ++k) at.q[v][k] += h * step.q[v][k];
    for (std::size_t z = 0; z < 2; ++z) at.augmented[z] += h * step.augmented[z];
    BlockIncrement<N> result;
    system.residuals(at, result.q, result.augmented);
    return result;
  };
  typename FrictionSystem<N>::Jacobian jacobian;
  system.jacobian(state, jacobian);
  const BlockIncrement<N> product =
      BlockAugmentedMatrix<N>(jacobian.whole, system.augmented_columns(state), jacobian.rows).times(step);
  constexpr double h = 1e-6;
  const BlockIncrement<N> plus = residual_at(h), less = residual_at(-h);
  for (std::size_t v = 0; v < dual.size(); ++v)
    for (std::size_t k = 0; k < N; ++k)
      EXPECT_NEAR(product.q[v][k], (plus.q[v][k] - less.q[v][k]) / (2 * h), 2e-7) << v << " " << k;
  for (std::size_t z = 0; z < 2; ++z)
    EXPECT_NEAR(product.augmented[z], (plus.augmented[z] - less.augmented[z]) / (2 * h), 1e-6) << z;
}

TEST(Friction, LaminarJacobianIsThatOfDifferences) {
  for (const double mach : {0.4, 1.1}) expect_exact_jacobian<4>(mach);
  expect_exact_jacobian<4>(0.4, {}, 1.3);
}
TEST(Friction, TurbulentJacobianIsThatOfDifferences) {
  for (const double mach : {0.4, 1.1}) expect_exact_jacobian<5>(mach);
  expect_exact_jacobian<5>(0.4, {{0.5, 0.5}});
  expect_exact_jacobian<5>(0.4, {}, 0.7);
}

// The viscous terms of linear functions: constant stress, whose sum over an inner dual cell is 0.
TEST(Friction, ConstantStressLeavesInnerCellsInBalance) {
  std::mt19937_64 random(7);
  const FlowMesh dual = uneven_grid(random);
  const FrictionMesh mesh(dual);
  const FrictionTerms terms{.viscosity = {.stream = 0.01, .temperature = 0.0}, .mach = 0.5};
  BlockVector<4> sum(dual.size());
  double area = 0.0;
  for (const CornerTriangle& triangle : mesh.triangles()) {
    std::array<std::array<double, 4>, 3> q;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point p = dual.points()[triangle.corner[i]];
      q[i] = {1.0, 0.3 * p.x + 0.5 * p.y, -0.2 * p.x + 0.1 * p.y, 1.0 / gas_gamma};
    }
    const auto flux = terms.triangle<double, 4>(q, triangle, {true, true, true});
    for (std::size_t i = 0; i < 3; ++i)
      for (const std::size_t k : {std::size_t{1}, std::size_t{2}}) sum[triangle.corner[i]][k] += flux[i][k];
    area += triangle.area;
  }
  EXPECT_NEAR(area, 1.5, 1e-12);
  std::vector<bool> is_inner(dual.size(), true);
  for (const BoundaryEdge& edge : dual.boundary()) is_inner[edge.a] = is_inner[edge.b] = false;
  for (std::size_t v = 0; v < dual.size(); ++v)
    if (is_inner[v]) {
      EXPECT_NEAR(sum[v][1], 0.0, 1e-16) << v;
      EXPECT_NEAR(sum[v][2], 0.0, 1e-16) << v;
    }
}

// Values of the model by hand: where the working variable is in the logarithmic layer, kappa u d, production
// and destruction balance what diffusion brings: fw(1) is 1.
TEST(Friction, TheModelsSourceVanishesWithDiffusionInTheLogarithmicLayer) {
  using Model = SpalartAllmaras;
  const double d = 0.3, u = 1.0, w = Model::karman * u * d, vorticity = u / (Model::karman * d);
  const double made = Model::source<double>(w, 1e-9, vorticity, d, false);
  const double slope = Model::karman * u;
  const double diffused = (1.0 + Model::cb2) / Model::sigma * slope * slope;
  EXPECT_NEAR(made + diffused, 0.0, 1e-6 * diffused);
  // Below zero it is driven back to zero, and its diffusion stays positive.
  EXPECT_GT(Model::source<double>(-w, 1e-9, vorticity, d, false), 0.0);
  // A laminar zone makes none.
  EXPECT_LT(Model::source<double>(w, 1e-9, vorticity, d, true), 0.0);
  for (const double chi : {-100.0, -10.0, -1.0, -0.1, 0.0, 5.0})
    EXPECT_GT(Model::diffusion_ratio(chi), 0.0) << chi;
}

// H. Blasius, Z. Math. Phys. 56 (1908): cf = 0.664115 / sqrt(Re x).
TEST(Friction, ThePlatesLaminarFrictionIsThatOfBlasius) {
  FlowOptions options = test::plate_options(FlowModel::laminar);
  options.temperature_k = 0.0;
  const FrozenMesh mesh = test::laminar_plate().frozen();
  const FlowResult flow = solve_flow(mesh, {.mach = 0.2, .reynolds = 1e5}, options, "plate");
  ASSERT_TRUE(flow.converged()) << flow.reason;
  EXPECT_LE(flow.newton_steps, 20);
  int compared = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const Point p = mesh.points[v];
    if (p.y != 0.0 || p.x < 0.2 || p.x > 1.0) continue;
    EXPECT_NEAR(flow.friction->cf[v] / (0.664115 / std::sqrt(1e5 * p.x)), 1.0, 0.005) << p.x;
    ++compared;
  }
  EXPECT_GT(compared, 10);
  EXPECT_LT(std::fabs(flow.friction->cd_pressure), 1e-12);
}

// A coarse grid around NACA 0012: what friction and pressure do is near what fine grids give
// (docs/viscous.md).
TEST(Friction, LaminarFlowAroundASymmetricSectionHasNoLift) {
  const test::QuadGrid grid = test::c_grid(
      {.half = 40, .wake = 20, .up = 32, .first = 3e-3, .at_nose = 5e-3, .at_edge = 5e-3, .radius = 50.0});
  FlowOptions options;
  options.model = FlowModel::laminar;
  options.tolerance = 1e-9;
  const FlowResult flow = solve_flow(grid.frozen(), {.mach = 0.5, .reynolds = 5000.0}, options, "section");
  ASSERT_TRUE(flow.converged()) << flow.reason;
  EXPECT_NEAR(flow.cl, 0.0, 1e-6);
  EXPECT_NEAR(flow.cd, 0.0553, 0.0025);
  EXPECT_NEAR(flow.friction->cd_pressure + flow.friction->cd_friction, flow.cd, 1e-14);
  EXPECT_NEAR(flow.friction->cd_pressure, 0.0226, 0.003);
}

// Faces as long as a million cells of the wall are high leave residuals that no step makes smaller: a flow is
// found as far as rounding goes.
TEST(Friction, AFlowIsFoundAsFarAsRoundingGoes) {
  FlowOptions options = test::plate_options(FlowModel::laminar);
  options.tolerance = 1e-13;
  const FrozenMesh mesh = test::laminar_plate(1e4, 64).frozen();
  const FlowResult flow = solve_flow(mesh, {.mach = 0.2, .reynolds = 1e5}, options, "plate");
  ASSERT_TRUE(flow.converged()) << flow.reason;
  EXPECT_GT(flow.residual, options.tolerance);
  EXPECT_LT(flow.residual, 1e-8);
}

// Turbulent friction on a plate, Re 5e6 a unit: NASA's Turbulence Modeling Resource has 0.002706 (CFL3D) and
// 0.002705 (FUN3D) on 545 x 385 points. This grid has 2,600, which grow by 1.27.
TEST(Friction, ThePlatesTurbulentFrictionIsNearTheReference) {
  const FrozenMesh mesh = test::turbulent_plate().frozen();
  const FlowResult flow =
      solve_flow(mesh, {.mach = 0.2, .reynolds = 5e6}, test::plate_options(FlowModel::sa), "plate");
  ASSERT_TRUE(flow.converged()) << flow.reason;
  double nearest = 1.0, cf = 0.0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if (mesh.points[v].y == 0.0 && std::fabs(mesh.points[v].x - 0.97) < nearest)
      nearest = std::fabs(mesh.points[v].x - 0.97), cf = flow.friction->cf[v];
  EXPECT_NEAR(cf, 0.002705, 0.01 * 0.002705);
  EXPECT_GT(*std::max_element(flow.friction->viscosity_ratio.begin(), flow.friction->viscosity_ratio.end()),
            50.0);
}

// Blasius's friction ahead of the transition, and more than that of a fully turbulent plate soon behind it:
// the layer is thinner there.
TEST(Friction, APlateIsLaminarAheadOfItsTransition) {
  const FrozenMesh mesh = test::turbulent_plate().frozen();
  const FlowOptions options = test::plate_options(FlowModel::sa);
  const FlowResult turbulent = solve_flow(mesh, {.mach = 0.2, .reynolds = 5e6}, options, "plate");
  const FlowResult flow =
      solve_flow(mesh, {.mach = 0.2, .reynolds = 5e6, .transition = {{0.25, 0.0}}}, options, "plate");
  ASSERT_TRUE(flow.converged()) << flow.reason;
  int ahead = 0, behind = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const Point p = mesh.points[v];
    if (p.y != 0.0) continue;
    if (p.x > 0.05 && p.x < 0.3) {
      EXPECT_NEAR(flow.friction->cf[v] / (0.664115 / std::sqrt(5e6 * p.x)), 1.0, 0.05) << p.x;
      ++ahead;
    }
    if (p.x > 0.8 && p.x < 1.9) {
      EXPECT_GT(flow.friction->cf[v], turbulent.friction->cf[v]) << p.x;
      EXPECT_LT(flow.friction->cf[v], 1.3 * turbulent.friction->cf[v]) << p.x;
      ++behind;
    }
  }
  EXPECT_GT(ahead, 5);
  EXPECT_GT(behind, 5);
}

TEST(Friction, ATransitionWithoutTurbulenceIsRefused) {
  const FrozenMesh mesh = test::turbulent_plate().frozen();
  FlowConditions conditions = {.mach = 0.2, .reynolds = 5e6, .transition = {{0.25, 0.5}}};
  EXPECT_THROW(solve_flow(mesh, conditions, test::plate_options(FlowModel::laminar), "plate"), Error);
  conditions.transition = {{0.25, 1.5}};
  EXPECT_THROW(solve_flow(mesh, conditions, test::plate_options(FlowModel::sa), "plate"), Error);
}

// NACA 0012 with a coarse layer, then two designs on the same stations.
struct LayeredDesigns {
  explicit LayeredDesigns(double reynolds, double first) {
    layer = {.first_height = first, .growth = 1.5, .thickness = 1.2 * boundary_layer_thickness(reynolds)};
    mesh = generate_layered(domain(), layer, {.gradation = 8.0}).mesh;
  }
  Domain domain() const {
    Domain result = airfoil_domain(airfoil);
    space_walls(result, {.leading_edge = 0.006, .trailing_edge = 0.006, .most = 0.04, .growth = 0.2});
    for (std::size_t l = 0; !mesh.empty() && l < result.loops.size(); ++l)
      for (std::size_t c = 0; c < result.loops[l].curves.size(); ++c)
        result.loops[l].curves[c].parameters = mesh.domain().loops[l].curves[c].parameters;
    return result;
  }
  void change(double by) {
    airfoil.upper[1] += by, airfoil.lower[2] += 0.5 * by;
    remodel::remodel(mesh, domain());
  }
  CstAirfoil airfoil = named_airfoil("naca:0012", 5);
  LayerOptions layer;
  LayeredMesh mesh;
};

// What a living flow carries decides how long it takes, and nothing else.
void expect_living_flow(FlowModel model, const FlowConditions& conditions, double first) {
  FlowOptions options;
  options.model = model, options.tolerance = 1e-9;
  LayeredDesigns designs(conditions.reynolds, first);
  LivingFlow living(options);
  const FlowResult start = living.solve(designs.mesh.freeze(), conditions);
  ASSERT_TRUE(start.converged()) << start.reason;
  EXPECT_EQ(start.start, FlowStart::cold);
  EXPECT_LE(start.newton_steps, 40);
  for (const double by : {1e-3, 2e-2}) {
    designs.change(by);
    const FrozenMesh mesh = designs.mesh.freeze();
    const FlowResult flow = living.solve(mesh, conditions);
    const FlowResult cold = solve_flow(mesh, conditions, options);
    ASSERT_TRUE(flow.converged() && cold.converged()) << flow.reason << cold.reason;
    EXPECT_NE(flow.start, FlowStart::cold);
    EXPECT_LE(flow.newton_steps, 2);
    EXPECT_NEAR(flow.cl, cold.cl, 1e-6);
    EXPECT_NEAR(flow.cd, cold.cd, 1e-7);
    EXPECT_GT(std::fabs(flow.cl - start.cl), 1e-4);  // it is another flow
  }
}

TEST(Friction, LaminarFlowsOutliveTheirMesh) {
  expect_living_flow(FlowModel::laminar, {.mach = 0.5, .alpha_deg = 1.0, .reynolds = 5000.0}, 2e-3);
}
TEST(Friction, TurbulentFlowsOutliveTheirMesh) {
  expect_living_flow(FlowModel::sa, {.mach = 0.5, .alpha_deg = 1.0, .reynolds = 1e6}, 2e-5);
}
TEST(Friction, FlowsBesideWarmWallsOutliveTheirMesh) {
  expect_living_flow(FlowModel::laminar,
                     {.mach = 0.5, .alpha_deg = 1.0, .reynolds = 5000.0, .wall_temperature = 1.3}, 2e-3);
}

// The angle is looked for with the flow.
TEST(Friction, AFlowOfAGivenLiftHasTheAngleOfThatLift) {
  FlowOptions options;
  options.model = FlowModel::laminar, options.tolerance = 1e-9;
  const FrozenMesh mesh = LayeredDesigns(500.0, 5e-3).mesh.freeze();
  const FlowResult given = solve_flow(mesh, {.mach = 0.2, .cl = 0.1, .reynolds = 500.0}, options);
  ASSERT_TRUE(given.converged()) << given.reason;
  EXPECT_NEAR(given.cl, 0.1, 1e-8);
  const FlowResult same =
      solve_flow(mesh, {.mach = 0.2, .alpha_deg = given.alpha_deg, .reynolds = 500.0}, options);
  EXPECT_NEAR(same.cl, 0.1, 1e-6);
  EXPECT_GT(given.alpha_deg, 1.0);
  EXPECT_LT(given.alpha_deg, 5.0);
}

// Gradients against differences of whole flows: along a smooth displacement of all points, walls and layers
// too, and by what is given of the stream. Turbulence and distances from walls follow.
void expect_exact_gradients(FlowModel model, const FlowConditions& conditions, double first,
                            double within = 1e-6) {
  FlowOptions options;
  options.model = model, options.tolerance = 1e-12;
  const FrozenMesh mesh = LayeredDesigns(conditions.reynolds, first).mesh.freeze();
  LivingFlow living(options);
  ASSERT_TRUE(living.solve(mesh, conditions).converged());
  std::vector<FlowFunctional> functions(1);  // the mean of pressures squared, which follows density too
  functions[0].pressure.resize(mesh.points.size()), functions[0].points.resize(mesh.points.size());
  functions[0].density.assign(mesh.points.size(), 0.0);
  const auto pick = [](std::size_t v) { return v % 7 == 0; };
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    functions[0].pressure[v] = pick(v) ? 1e-3 : 0.0, functions[0].density[v] = pick(v) ? 2e-3 : 0.0;
  const FlowGradients found = living.gradients(functions);
  const auto value = [&](const FlowResult& flow) {
    std::array<double, 5> values = {flow.cl, flow.cd, flow.cm, flow.friction->cd_pressure, 0.0};
    for (std::size_t v = 0; v < flow.pressure.size(); ++v)
      if (pick(v)) values[4] += 1e-3 * flow.pressure[v] + 2e-3 * flow.density[v];
    return values;
  };
  const FlowGradient* of[] = {&found.cl, &found.cd, &found.cm, &found.cd_pressure, &found.functions[0]};
  const auto direction = [](Point p) {
    const double near = std::exp(-dot(p, p) / 4.0);
    return Point{0.2 * near * std::sin(3.0 * p.y + 1.0), near * std::cos(2.0 * p.x - 0.5)};
  };
  const auto compare = [&](const char* what, double h, auto change, auto slope) {
    const auto at = [&](double step) {
      FrozenMesh moved = mesh;
      FlowConditions changed = conditions;
      change(step, moved, changed);
      const FlowResult flow = living.solve(moved, changed);
      EXPECT_TRUE(flow.converged()) << what << flow.reason;
      return value(flow);
    };
    const auto p1 = at(h), m1 = at(-h), p2 = at(2 * h), m2 = at(-2 * h);
    for (std::size_t i = 0; i < p1.size(); ++i) {
      const double by_flows = (8.0 * (p1[i] - m1[i]) - (p2[i] - m2[i])) / (12.0 * h);
      const double by_adjoint = slope(*of[i]);
      EXPECT_NEAR(by_adjoint, by_flows, within * std::fabs(by_flows) + 1e-8) << what << " " << i;
    }
  };
  compare(
      "points", 1e-5,
      [&](double step, FrozenMesh& moved, FlowConditions&) {
        for (Point& p : moved.points) p = p + step * direction(p);
      },
      [&](const FlowGradient& gradient) {
        double sum = 0.0;
        for (std::size_t v = 0; v < mesh.points.size(); ++v)
          sum += dot(gradient.points[v], direction(mesh.points[v]));
        return sum;
      });
  compare(
      "angle", 0.001, [](double step, FrozenMesh&, FlowConditions& changed) { changed.alpha_deg += step; },
      [](const FlowGradient& gradient) { return gradient.alpha_deg; });
  compare(
      "mach", 1e-4, [](double step, FrozenMesh&, FlowConditions& changed) { changed.mach += step; },
      [](const FlowGradient& gradient) { return gradient.mach; });
  const double reynolds = conditions.reynolds;
  compare(
      "reynolds", 3e-3,
      [&](double step, FrozenMesh&, FlowConditions& changed) { changed.reynolds *= 1.0 + step; },
      [&](const FlowGradient& gradient) { return reynolds * gradient.reynolds; });
}

TEST(Friction, LaminarGradientsAreThoseOfWholeFlows) {
  expect_exact_gradients(FlowModel::laminar, {.mach = 0.5, .alpha_deg = 1.0, .reynolds = 5000.0}, 2e-3);
}
TEST(Friction, GradientsBesideWarmWallsAreThoseOfWholeFlows) {
  expect_exact_gradients(FlowModel::laminar,
                         {.mach = 0.5, .alpha_deg = 1.0, .reynolds = 5000.0, .wall_temperature = 1.3}, 2e-3);
  expect_exact_gradients(FlowModel::sa,
                         {.mach = 0.5, .alpha_deg = 1.0, .reynolds = 1e6, .wall_temperature = 0.8}, 2e-5);
}
// Faster than sound in places: with the limiter.
TEST(Friction, TransonicGradientsAreThoseOfWholeFlows) {
  expect_exact_gradients(FlowModel::laminar, {.mach = 0.85, .alpha_deg = 2.0, .reynolds = 5000.0}, 2e-3,
                         3e-6);
}
TEST(Friction, TurbulentGradientsAreThoseOfWholeFlows) {
  expect_exact_gradients(FlowModel::sa, {.mach = 0.5, .alpha_deg = 1.0, .reynolds = 1e6}, 2e-5);
}

// Gradients by the design's numbers, through the columns: against flows on the meshes that steps lead to.
TEST(Friction, GradientsByTheDesignAreThoseOfFlowsOnTheMeshesOfSteps) {
  FlowOptions options;
  options.model = FlowModel::laminar, options.tolerance = 1e-12;
  const FlowConditions conditions = {.mach = 0.5, .alpha_deg = 1.0, .reynolds = 5000.0};
  LayeredDesigns designs(conditions.reynolds, 2e-3);
  const Domain domain = designs.domain();
  const std::vector<double> coefficients = coefficients_of(domain);
  const std::vector<std::string> names = coefficient_names(domain);
  const auto index = [&](const std::string& end) {
    const auto at =
        std::find_if(names.begin(), names.end(), [&](const auto& name) { return name.ends_with(end); });
    return static_cast<std::size_t>(at - names.begin());
  };
  LivingFlow living(options);
  ASSERT_TRUE(living.solve(designs.mesh.freeze(), conditions).converged());
  const FlowGradients gradients = living.gradients();
  const LayeredMeshDerivative derivative(designs.mesh);
  ASSERT_EQ(derivative.points(), designs.mesh.freeze().points.size());
  const std::vector<double> cl = derivative.vjp(gradients.cl.points),
                            cd = derivative.vjp(gradients.cd.points);
  for (const std::size_t i : {index("upper[1]"), index("lower[3]")}) {
    ASSERT_LT(i, coefficients.size());
    std::vector<FlowResult> flows;
    std::vector<std::vector<Point>> places;
    constexpr double h = 1e-5;
    for (const int times : {-2, -1, 1, 2}) {
      std::vector<double> changed = coefficients;
      changed[i] += times * h;
      LayeredMesh mesh = designs.mesh;
      ASSERT_TRUE(remodel::remodel(mesh, with_coefficients(domain, changed)).full_adjustment);
      places.push_back(mesh.freeze().points);
      flows.push_back(living.solve(mesh.freeze(), conditions));
      ASSERT_TRUE(flows.back().converged());
    }
    const auto difference = [&](auto value) {
      return (value(0) - 8.0 * value(1) + 8.0 * value(2) - value(3)) / (12.0 * h);
    };
    const double by_cl = difference([&](std::size_t k) { return flows[k].cl; });
    const double by_cd = difference([&](std::size_t k) { return flows[k].cd; });
    EXPECT_NEAR(cl[i], by_cl, 1e-6 * std::fabs(by_cl) + 1e-8) << names[i];
    EXPECT_NEAR(cd[i], by_cd, 1e-6 * std::fabs(by_cd) + 1e-8) << names[i];
    std::vector<double> direction(coefficients.size(), 0.0);
    direction[i] = 1.0;
    const std::vector<Point> moved = derivative.jvp(direction);
    for (std::size_t v = 0; v < moved.size(); ++v) {
      EXPECT_NEAR(moved[v].x, difference([&](std::size_t k) { return places[k][v].x; }), 1e-8) << v;
      EXPECT_NEAR(moved[v].y, difference([&](std::size_t k) { return places[k][v].y; }), 1e-8) << v;
    }
  }
}

// Keys of layers count their vertices by themselves: the same index may be another vertex's outside.
TEST(Friction, VerticesOfLayersAreFoundBesideOthersOfTheSameIndex) {
  const std::uint32_t of_layer = 1U << 31;
  const Keys keys = {{{7}, of_layer}, {{8}, of_layer}, {{7}, 3}, {{8}, 0}};
  const KeyTable table(keys);
  for (std::uint32_t i = 0; i < keys.size(); ++i) EXPECT_EQ(table.find(keys[i]), i);
  EXPECT_EQ(table.find({{7}, 4}), no_index);
}

TEST(Friction, AFlowIsGoneOnFromOnAnotherMesh) {
  FlowOptions options;
  options.model = FlowModel::sa, options.tolerance = 1e-9;
  const FlowConditions conditions = {.mach = 0.5, .alpha_deg = 1.0, .reynolds = 1e6};
  LayeredDesigns coarse(1e6, 2e-5), fine(1e6, 1.5e-5);
  const FrozenMesh before = coarse.mesh.freeze(), mesh = fine.mesh.freeze();
  const FlowResult known = solve_flow(before, conditions, options);
  const FlowResult flow = solve_flow_from(before, known, mesh, conditions, options);
  ASSERT_TRUE(flow.converged()) << flow.reason;
  const FlowResult cold = solve_flow(mesh, conditions, options);
  // Turbulence may set in one of these long cells further on (docs/viscous.md).
  EXPECT_NEAR(flow.cl, cold.cl, 2e-5);
  EXPECT_NEAR(flow.cd, cold.cd, 2e-6);
  FlowResult without = known;
  without.friction->working.clear();
  EXPECT_THROW(solve_flow_from(before, without, mesh, conditions, options), Error);
}

TEST(Friction, AColdFlowLedToItsAngleIsTheOneCarriedThere) {
  FlowOptions options;
  options.model = FlowModel::sa, options.tolerance = 1e-9;
  const FlowConditions conditions = {.mach = 0.15, .alpha_deg = -6.0, .reynolds = 1e6};
  const FrozenMesh mesh = LayeredDesigns(1e6, 2e-5).mesh.freeze();
  const FlowResult cold = solve_flow(mesh, conditions, options);
  ASSERT_TRUE(cold.converged()) << cold.reason;
  EXPECT_NEAR(cold.alpha_deg, -6.0, 1e-12);
  EXPECT_EQ(cold.origin, FlowOrigin::undisturbed);
  FlowConditions smaller = conditions;
  smaller.alpha_deg = -4.0;
  const FlowResult known = solve_flow(mesh, smaller, options);
  const FlowResult carried = solve_flow_from(mesh, known, mesh, conditions, options);
  ASSERT_TRUE(carried.converged()) << carried.reason;
  EXPECT_NEAR(carried.cl, cold.cl, 1e-4);
  EXPECT_NEAR(carried.cd, cold.cd, 1e-5);
}

// Newton's method cycles in them, far from the flow.
TEST(Friction, SearchesThatCycleGoOnInTime) {
  struct Section {
    const char* name;
    double shift, mach, alpha_deg, reynolds;
  };
  for (const Section& of :
       {Section{"e376", 0.0, 0.46, -0.4, 1.8e6}, Section{"rae2822", 1.0, 0.7, 6.0, 5e6}}) {
    CstAirfoil airfoil = named_airfoil(of.name, 5);
    double i = 0.0;
    for (auto* surface : {&airfoil.upper, &airfoil.lower})
      for (double& coefficient : *surface) coefficient += 0.012 * std::sin(2.0 * i++ + of.shift);
    Domain walls = airfoil_domain(airfoil);
    space_walls(walls, {.leading_edge = 0.008, .trailing_edge = 0.008, .most = 0.04, .growth = 0.4});
    const LayerOptions layer = {.first_height = first_height(1.0, of.reynolds),
                                .growth = 1.4,
                                .thickness = 1.2 * boundary_layer_thickness(of.reynolds)};
    const FrozenMesh mesh = generate_layered(walls, layer, {.gradation = 2.5}).mesh.freeze();
    const FlowConditions conditions = {.mach = of.mach, .alpha_deg = of.alpha_deg, .reynolds = of.reynolds};
    const FlowResult flow = solve_flow(mesh, conditions, {.tolerance = 1e-8, .model = FlowModel::sa});
    EXPECT_TRUE(flow.converged()) << of.name << ": " << flow.reason;
  }
}

TEST(Friction, ModelsWithFrictionAreRefusedWhereTheyAreNotKnown) {
  FlowOptions options;
  options.model = FlowModel::laminar;
  const FrozenMesh mesh = test::c_grid({.half = 8, .wake = 4, .up = 6, .first = 0.02}).frozen();
  EXPECT_THROW(solve_flow(mesh, {.mach = 0.5}, options), Error);  // without a Reynolds number
}

}  // namespace
}  // namespace remodel::flow
