// Gradients by the adjoint against differences of whole flows.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "flow/test_flows.h"
#include "remodel/flow.h"
#include "remodel/mesh_derivative.h"
#include "remodel/remodel.h"
#include "support.h"

namespace remodel {
namespace {

struct Coefficients3 {
  double cl, cd, cm, alpha;
};

// Central differences of fourth order of f at 0.
Coefficients3 difference(const std::function<Coefficients3(double)>& f, double h) {
  const Coefficients3 a = f(-2 * h), b = f(-h), c = f(h), d = f(2 * h);
  const auto slope = [&](double Coefficients3::*x) {
    return (a.*x - 8 * (b.*x) + 8 * (c.*x) - d.*x) / (12 * h);
  };
  return {slope(&Coefficients3::cl), slope(&Coefficients3::cd), slope(&Coefficients3::cm),
          slope(&Coefficients3::alpha)};
}

class Case {
 public:
  Case(const Domain& domain, const FlowConditions& conditions, const QualityOptions& quality,
       const FlowOptions& options = {.tolerance = 1e-12})
      : mesh_(generate(domain, quality).mesh), conditions_(conditions), living_(options) {}

  Mesh& mesh() { return mesh_; }
  LivingFlow& living() { return living_; }
  Coefficients3 flow(const Mesh& mesh, const FlowConditions& conditions) {
    const FlowResult flow = living_.solve(mesh, conditions);
    EXPECT_TRUE(flow.converged()) << flow.reason;
    return {flow.cl, flow.cd, flow.cm, flow.alpha_deg};
  }
  FlowGradients gradients() {
    flow(mesh_, conditions_);
    return living_.gradients();
  }
  Coefficients3 along(std::span<const double> direction, double h) {
    const std::vector<double> at = coefficients_of(mesh_.domain());
    return difference(
        [&](double s) {
          std::vector<double> there = at;
          for (std::size_t i = 0; i < at.size(); ++i) there[i] += s * direction[i];
          return flow(mesh_at(mesh_, with_coefficients(mesh_.domain(), there)), conditions_);
        },
        h);
  }
  Coefficients3 along_mach(double h) {
    return difference(
        [&](double s) {
          FlowConditions there = conditions_;
          there.mach += s;
          return flow(mesh_, there);
        },
        h);
  }
  Coefficients3 along_condition(double h) {
    return difference(
        [&](double s) {
          FlowConditions there = conditions_;
          if (there.cl)
            *there.cl += s;
          else
            there.alpha_deg += s;
          return flow(mesh_, there);
        },
        h);
  }
  // The relative error of the gradients in the coefficients of the first loop's first curve, as vectors.
  double error(const FlowGradients& gradients, double h) {
    const MeshDerivative derivative(mesh_);
    const std::vector<double> cl = derivative.vjp(gradients.cl.points),
                              cd = derivative.vjp(gradients.cd.points),
                              cm = derivative.vjp(gradients.cm.points),
                              alpha = derivative.vjp(gradients.alpha_deg.points);
    std::array<double, 4> wrong = {}, size = {};
    for (std::size_t i = 0; i < 12; i += 2) {
      std::vector<double> direction(derivative.coefficients(), 0.0);
      direction[i] = 1.0;
      const Coefficients3 d = along(direction, h);
      const double found[4] = {cl[i], cd[i], cm[i], alpha[i]}, expected[4] = {d.cl, d.cd, d.cm, d.alpha};
      for (std::size_t k = 0; k < 4; ++k) {
        wrong[k] += (found[k] - expected[k]) * (found[k] - expected[k]);
        size[k] += expected[k] * expected[k];
      }
    }
    double worst = 0.0;
    for (std::size_t k = 0; k < 4; ++k)
      worst = std::max(worst, size[k] < 1e-16 ? std::sqrt(wrong[k]) : std::sqrt(wrong[k] / size[k]));
    return worst;
  }

 private:
  Mesh mesh_;
  FlowConditions conditions_;
  LivingFlow living_;
};

Domain section(const std::string& name, int points) {
  return airfoil_domain(named_airfoil(name, 5), {.points = points});
}

TEST(Adjoint, GradientsAreThoseOfWholeFlows) {
  Case subsonic(section("naca:2412", 100), {.mach = 0.5, .alpha_deg = 1.25}, {.gradation = 2});
  EXPECT_LT(subsonic.error(subsonic.gradients(), 1e-5), 1e-7);
  Case transonic(section("naca:0012", 100), {.mach = 0.8, .alpha_deg = 1.25}, {.gradation = 2});
  EXPECT_LT(transonic.error(transonic.gradients(), 1e-6), 1e-6);
}

// A nozzle, its wall the first curve: without a shock, choked with one, and with an outlet faster than sound.
TEST(Adjoint, GradientsThroughInletsAndOutletsAreThoseOfWholeFlows) {
  const auto line = [](const char* name, Point from, Point to, std::size_t stations) {
    return Curve{.name = name, .shape = Line{from, to}, .parameters = Parameters::uniform(stations)};
  };
  const Curve wall{
      .name = "wall",
      .shape = spline_through({{4.0, 0.5}, {3.0, 0.46}, {2.0, 0.41}, {1.0, 0.46}, {0.4, 0.5}, {0.0, 0.5}}),
      .parameters = Parameters::uniform(40)};
  const Domain nozzle{{Loop{.curves = {wall, line("inlet", {0.0, 0.5}, {0.0, 0.0}, 6),
                                       line("axis", {0.0, 0.0}, {4.0, 0.0}, 32),
                                       line("outlet", {4.0, 0.0}, {4.0, 0.5}, 6)}}}};
  for (const double pressure : {0.95, 0.75, 0.2}) {
    Case task(nozzle, {.mach = 0.3}, {.gradation = 2},
              {.tolerance = 1e-12,
               .inlets = {{.name = "inlet", .total_pressure = 1.02, .total_temperature = 1.1}},
               .outlets = {{.name = "outlet", .pressure = pressure}},
               .symmetry = {"axis"}});
    EXPECT_LT(task.error(task.gradients(), 1e-5), 1e-7) << pressure;
  }
}

TEST(Adjoint, LiftThatIsGivenStays) {
  Case task(section("naca:2412", 60), {.mach = 0.5, .alpha_deg = 1.0, .cl = 0.4}, {.gradation = 1.2});
  const FlowGradients gradients = task.gradients();
  EXPECT_LT(task.error(gradients, 1e-5), 1e-7);
  const Coefficients3 by_lift = task.along_condition(1e-4);
  EXPECT_NEAR(gradients.cl.cl, 1.0, 1e-9);
  EXPECT_NEAR(gradients.cd.cl, by_lift.cd, 1e-7 * std::fabs(by_lift.cd));
  EXPECT_NEAR(gradients.alpha_deg.cl, by_lift.alpha, 1e-7 * by_lift.alpha);
}

TEST(Adjoint, MachNumberAndAngleOfAttack) {
  Case task(section("naca:2412", 60), {.mach = 0.6, .alpha_deg = 1.25}, {.gradation = 1.2});
  const FlowGradients gradients = task.gradients();
  const Coefficients3 by_mach = task.along_mach(1e-5), by_angle = task.along_condition(1e-4);
  EXPECT_NEAR(gradients.cl.mach, by_mach.cl, 1e-7 * std::fabs(by_mach.cl));
  EXPECT_NEAR(gradients.cd.mach, by_mach.cd, 1e-7 * std::fabs(by_mach.cd));
  EXPECT_NEAR(gradients.cm.mach, by_mach.cm, 1e-7 * std::fabs(by_mach.cm));
  EXPECT_NEAR(gradients.cl.alpha_deg, by_angle.cl, 1e-7 * std::fabs(by_angle.cl));
  EXPECT_NEAR(gradients.cd.alpha_deg, by_angle.cd, 1e-7 * std::fabs(by_angle.cd));
  EXPECT_NEAR(gradients.cm.alpha_deg, by_angle.cm, 1e-7 * std::fabs(by_angle.cm));
  EXPECT_NEAR(gradients.alpha_deg.alpha_deg, 1.0, 1e-12);
}

// A flap is moved and turned beside another section.
TEST(Adjoint, PlacementsOfSeveralElements) {
  const CstAirfoil airfoil = named_airfoil("naca:2412", 5);
  const Domain domain =
      airfoils_domain({{.name = "main", .airfoil = airfoil},
                       {.name = "flap", .airfoil = airfoil, .placement = {0.3, -20.0, {1.02, -0.05}}}},
                      {.points = 40});
  Case task(domain, {.mach = 0.2, .alpha_deg = 2.0}, {.gradation = 1.2});
  const FlowGradients gradients = task.gradients();
  const MeshDerivative derivative(task.mesh());
  const std::vector<double> cl = derivative.vjp(gradients.cl.points),
                            cd = derivative.vjp(gradients.cd.points);
  const std::size_t placement = 2 * 18 - 4;  // of the flap, behind two sections and one placement
  for (std::size_t i = placement; i < placement + 4; ++i) {
    std::vector<double> direction(derivative.coefficients(), 0.0);
    direction[i] = 1.0;
    const Coefficients3 d = task.along(direction, i == placement + 1 ? 3e-4 : 3e-6);  // degrees: chords
    EXPECT_NEAR(cl[i], d.cl, 1e-6 * std::fabs(d.cl)) << i;
    EXPECT_NEAR(cd[i], d.cd, 1e-6 * std::fabs(d.cd)) << i;
  }
}

// The gradients in all places of slat and flap, as vectors. The limit is that of the differences: longer
// steps bend too much in the gaps, shorter ones drown in the flows' residuals.
TEST(Adjoint, PlacesOfThreeElements) {
  const CstAirfoil thin = named_airfoil("naca:2415", 5), main = named_airfoil("naca:4412", 5);
  const Domain domain =
      airfoils_domain({{.name = "slat", .airfoil = thin, .placement = {0.2, 35.0, {-0.18, -0.09}}},
                       {.name = "main", .airfoil = main},
                       {.name = "flap", .airfoil = thin, .placement = {0.3, -8.0, {0.99, -0.035}}}},
                      {.points = 48});
  Case task(domain, {.mach = 0.3, .alpha_deg = 4.0}, {.gradation = 2});
  const FlowGradients gradients = task.gradients();
  const MeshDerivative derivative(task.mesh());
  const std::vector<double> cl = derivative.vjp(gradients.cl.points),
                            cd = derivative.vjp(gradients.cd.points),
                            cm = derivative.vjp(gradients.cm.points);
  double wrong[3] = {}, size[3] = {};
  constexpr std::size_t section = 14;  // coefficients and ordinates of the trailing edge
  for (const std::size_t element : {0u, 2u})
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t number = element * (section + 4) + section + i;
      std::vector<double> direction(derivative.coefficients(), 0.0);
      direction[number] = i == 1 ? 50.0 : 1.0;  // degrees
      const Coefficients3 d = task.along(direction, 1e-6);
      const double found[3] = {cl[number], cd[number], cm[number]}, expected[3] = {d.cl, d.cd, d.cm};
      for (std::size_t k = 0; k < 3; ++k) {
        const double error = direction[number] * found[k] - expected[k];
        wrong[k] += error * error, size[k] += expected[k] * expected[k];
      }
    }
  for (std::size_t k = 0; k < 3; ++k) EXPECT_LT(std::sqrt(wrong[k] / size[k]), 1e-6) << k;
}

// What is not wanted changes nothing of what is, and where a step replaced vertices the older factors serve.
TEST(Adjoint, OnlyWhatIsWantedAfterPartialSteps) {
  std::mt19937_64 random(test::seed(43));
  CstAirfoil airfoil = named_airfoil("naca:2412", 5);
  Case task(airfoil_domain(airfoil, {.points = 60}), {.mach = 0.5, .alpha_deg = 1.0, .cl = 0.3},
            {.gradation = 1.2});
  task.gradients();
  int partial = 0;
  for (int i = 0; i < 40 && partial == 0; ++i) {
    for (auto* surface : {&airfoil.upper, &airfoil.lower})
      for (double& c : *surface) c += test::uniform(random, -1e-3, 1e-3);
    partial += !remodel(task.mesh(), airfoil_domain(airfoil, {.points = 60}), {.strategy = Strategy::chain})
                    .full_adjustment;
  }
  ASSERT_EQ(partial, 1);
  const FlowGradients all = task.gradients();
  const FlowGradients drag = task.living().gradients({}, {.lift = false, .moment = false, .angle = false});
  EXPECT_TRUE(drag.cl.points.empty() && drag.cm.points.empty() && drag.alpha_deg.points.empty());
  double wrong = 0.0, size = 0.0;
  for (std::size_t p = 0; p < all.cd.points.size(); ++p) {
    const Point difference = drag.cd.points.at(p) - all.cd.points[p];
    wrong += dot(difference, difference), size += dot(all.cd.points[p], all.cd.points[p]);
  }
  EXPECT_LT(std::sqrt(wrong / size), 1e-8);
  EXPECT_NEAR(drag.cd.cl, all.cd.cl, 1e-8 * std::fabs(all.cd.cl));
  EXPECT_LT(task.error(all, 1e-5), 1e-6);
}

TEST(Adjoint, OldFactorsServeUntilTheyDoNot) {
  std::mt19937_64 random(test::seed(41));
  CstAirfoil airfoil = named_airfoil("naca:2412", 5);
  Case task(airfoil_domain(airfoil, {.points = 60}), {.mach = 0.5, .alpha_deg = 1.25}, {.gradation = 1.2});
  EXPECT_EQ(task.gradients().factorisations, 1);  // the flow was found by GMRES
  EXPECT_EQ(task.gradients().factorisations, 0);
  int partial = 0;
  for (int i = 0; i < 20 && partial < 2; ++i) {
    for (auto* surface : {&airfoil.upper, &airfoil.lower})
      for (double& c : *surface) c += test::uniform(random, -1e-2, 1e-2);
    partial += !remodel(task.mesh(), airfoil_domain(airfoil, {.points = 60}), {.strategy = Strategy::chain})
                    .full_adjustment;
    task.gradients();
  }
  EXPECT_EQ(partial, 2);
  EXPECT_LT(task.error(task.gradients(), 1e-6), 1e-6);
}

// Of all unknowns at the far field, which moves here too.
TEST(Adjoint, EntropyDragFollowsTheMeshTheMachNumberAndTheAngle) {
  const Mesh mesh = generate(section("naca:2412", 60), {.gradation = 1.2}).mesh;
  const FlowConditions conditions = {.mach = 0.75, .alpha_deg = 1.25};
  const FlowOptions options = {.tolerance = 1e-12};
  LivingFlow living(options);
  const FlowResult flow = living.solve(mesh, conditions);
  ASSERT_TRUE(flow.converged()) << flow.reason;
  EXPECT_NEAR(flow.entropy_drag.value(), flow.cd, 5e-3 * flow.cd);
  WantedGradients wanted;
  wanted.entropy_drag = true;
  const FlowGradients gradients = living.gradients({}, wanted);
  EXPECT_TRUE(living.gradients().entropy_drag.points.empty());
  FrozenMesh frozen = mesh.freeze();
  const auto slope = [&](double h, const std::function<FlowResult(double)>& at) {
    const double a = *at(-2 * h).entropy_drag, b = *at(-h).entropy_drag, c = *at(h).entropy_drag,
                 d = *at(2 * h).entropy_drag;
    return (a - 8 * b + 8 * c - d) / (12 * h);
  };
  const double by_mach = slope(1e-5, [&](double s) {
    return solve_flow(frozen, {.mach = conditions.mach + s, .alpha_deg = conditions.alpha_deg}, options);
  });
  const double by_angle = slope(1e-4, [&](double s) {
    return solve_flow(frozen, {.mach = conditions.mach, .alpha_deg = conditions.alpha_deg + s}, options);
  });
  EXPECT_NEAR(gradients.entropy_drag.mach, by_mach, 1e-6 * std::fabs(by_mach));
  EXPECT_NEAR(gradients.entropy_drag.alpha_deg, by_angle, 1e-6 * std::fabs(by_angle));
  std::size_t wall = 0, far = 0;  // a point of the upper surface, and the farthest one downstream
  for (std::size_t v = 0; v < frozen.points.size(); ++v) {
    const Point crest = {0.4, 0.1};
    if (squared_distance(frozen.points[v], crest) < squared_distance(frozen.points[wall], crest)) wall = v;
    if (frozen.points[v].x > frozen.points[far].x) far = v;
  }
  for (const std::size_t v : {wall, far}) {
    const double y = frozen.points[v].y, h = v == wall ? 1e-6 : 1e-2;
    const double by_y = slope(h, [&](double s) {
      frozen.points[v].y = y + s;
      return solve_flow(frozen, conditions, options);
    });
    frozen.points[v].y = y;
    // What a far point does is little beside the flows' residuals.
    const double part = v == wall ? 1e-5 : 1e-4;
    EXPECT_NEAR(gradients.entropy_drag.points[v].y, by_y, part * std::fabs(by_y)) << v;
  }
}

TEST(Adjoint, FunctionsOfPressureAndBadCalls) {
  Case task(section("naca:2412", 60), {.mach = 0.5, .alpha_deg = 1.25}, {.gradation = 1.2});
  EXPECT_THROW(task.living().gradients(), Error);
  const FlowGradients lift = task.gradients();
  EXPECT_THROW(task.living().gradients({FlowFunctional{}}), Error);
  // The mean square of the pressure at all points, by itself.
  const FrozenMesh frozen = task.mesh().freeze();
  const auto value = [&](const Mesh& mesh) {
    const FlowResult flow = task.living().solve(mesh, {.mach = 0.5, .alpha_deg = 1.25});
    double sum = 0.0;
    for (std::size_t p = 0; p < frozen.points.size(); ++p)
      if (frozen.curve[p] == 0) sum += flow.pressure[p] * flow.pressure[p];
    return sum;
  };
  const FlowResult flow = task.living().solve(task.mesh(), {.mach = 0.5, .alpha_deg = 1.25});
  FlowFunctional square{.pressure = std::vector<double>(frozen.points.size(), 0.0),
                        .points = std::vector<Point>(frozen.points.size())};
  for (std::size_t p = 0; p < frozen.points.size(); ++p)
    if (frozen.curve[p] == 0) square.pressure[p] = 2.0 * flow.pressure[p];
  const FlowGradients gradients = task.living().gradients({square});
  const std::vector<double> slope = MeshDerivative(task.mesh()).vjp(gradients.functions.at(0).points);
  const std::vector<double> at = coefficients_of(task.mesh().domain());
  for (const std::size_t i : {1u, 8u}) {
    const auto there = [&](double s) {
      std::vector<double> numbers = at;
      numbers[i] += s;
      return value(mesh_at(task.mesh(), with_coefficients(task.mesh().domain(), numbers)));
    };
    const double h = 1e-5;
    const double expected = (there(-2 * h) - 8 * there(-h) + 8 * there(h) - there(2 * h)) / (12 * h);
    EXPECT_NEAR(slope[i], expected, 1e-7 * std::fabs(expected));
  }
  EXPECT_EQ(lift.cl.points.size(), frozen.points.size());
}

}  // namespace
}  // namespace remodel
