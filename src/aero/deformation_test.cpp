// Designs that deform outlines and domains: matrices against formulas, gradients against differences of whole
// flows, searches.

#include "remodel/deformation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <random>

#include "aero/deformed_space.h"
#include "aero/design_mesh.h"
#include "aero/resolved_problem.h"
#include "aero/test_designs.h"
#include "remodel/design_run.h"
#include "remodel/flow_layer.h"
#include "support.h"

namespace remodel {
namespace {

using test::Case;
using test::Flows;
using test::relative;
using test::uniform;

// A section as it is given, with a cove below and a flat back.
Domain coved_section() {
  std::vector<Point> points;
  const auto add = [&](double from, double to, int pieces, const auto& height) {
    for (int i = 0; i < pieces; ++i) {
      const double x = from + (to - from) * i / pieces;
      points.push_back({x, height(x)});
    }
  };
  const auto round = [](double x) { return 0.3 * std::sqrt(x) * (1.0 - 0.85 * x); };
  for (int i = 0; i < 16; ++i) {
    const double x = 0.5 * (1.0 + std::cos(std::numbers::pi * i / 16));
    points.push_back({x, 0.6 * round(x)});
  }
  for (int i = 16; i < 27; ++i) {
    const double x = 0.5 * (1.0 + std::cos(std::numbers::pi * i / 16));
    points.push_back({x, -0.4 * round(x)});
  }
  const double front = points.back().x;
  points.push_back({front + 0.01, 0.01});  // the corner of the cove
  add(front + 0.06, 1.0, 6, [](double x) { return 0.012 - 0.004 * x; });
  points.push_back({1.0, 0.006});
  return airfoils_domain({{.airfoil = {}, .outline = outline_of(points, OutlineCurve::spline, "airfoil")}},
                         {.farfield_radius = 15.0, .farfield_points = 24});
}

Domain naca_outline(const char* digits, int points) {
  const CstAirfoil airfoil = named_airfoil(std::string("naca:") + digits, 5);
  std::vector<Point> outline;
  for (int i = 0; i <= points; ++i) outline.push_back(airfoil.at(static_cast<double>(i) / points));
  return airfoils_domain({{.airfoil = {}, .outline = outline_of(outline, OutlineCurve::spline, "airfoil")}},
                         {.farfield_radius = 20.0, .farfield_points = 24});
}

// The upper half of a nozzle: a spline as its wall, and the axis.
Domain nozzle() {
  const Spline wall = spline_through(
      {{4.0, 0.5}, {3.2, 0.49}, {2.6, 0.45}, {2.0, 0.41}, {1.4, 0.45}, {0.8, 0.49}, {0.0, 0.5}});
  const auto line = [](const char* name, Point from, Point to, std::size_t stations) {
    return Curve{.name = name, .shape = Line{from, to}, .parameters = Parameters::uniform(stations)};
  };
  return {
      {Loop{.curves = {line("axis", {0.0, 0.0}, {4.0, 0.0}, 20), line("outlet", {4.0, 0.0}, {4.0, 0.5}, 4),
                       Curve{.name = "wall", .shape = wall, .parameters = Parameters::uniform(24)},
                       line("inlet", {0.0, 0.5}, {0.0, 0.0}, 4)}}}};
}

DesignProblem problem_of(Domain domain, std::vector<DeformationPart> parts) {
  DesignProblem problem{.deformation = Deformation{std::move(domain), std::move(parts)}};
  problem.domain.points = static_cast<int>(stations_on_walls(problem.deformation->domain));
  problem.gradation = 1.0;
  problem.points = {{.conditions = {.mach = 0.3, .alpha_deg = 1.0}}};
  return problem;
}

DesignProblem nozzle_problem() {
  DesignProblem problem = problem_of(nozzle(), {CurvePoints{.on = "wall", .points = {2, 3, 4}}});
  problem.points = {{.conditions = {.mach = 0.3},
                     .inlets = {{.name = "inlet"}},
                     .outlets = {{.name = "outlet", .pressure = 0.95}}}};
  problem.gradation = 2.0;
  return problem;
}

FreeFormBox rear_box() {
  return {
      .on = "airfoil", .low = {0.35, -0.2}, .high = {1.1, 0.2}, .columns = 5, .rows = 2, .hold = {.left = 2}};
}

std::vector<Point> stations_of(const Domain& domain) {
  return domain.points(0);
}

TEST(Deformation, OfNothingIsTheDomainAsGiven) {
  for (const DesignProblem& problem :
       {problem_of(coved_section(), {rear_box(), HicksHenneBumps{.on = "airfoil", .peaks = {0.3}}}),
        nozzle_problem()}) {
    const std::unique_ptr<FlowSpace> space = design_space(problem);
    EXPECT_EQ(space->domain(space->start()), problem.deformation->domain);
  }
}

// x + sum of B_i(s) B_j(t) dP_ij, for points of a polyline, which are its stations.
TEST(Deformation, BoxMovesPointsByBernsteinPolynomials) {
  std::vector<Point> points{{1.0, 0.0}, {0.8, 0.05}, {0.5, 0.08}, {0.2, 0.06}, {0.0, 0.0}, {0.5, -0.04}};
  const Domain domain =
      airfoils_domain({{.airfoil = {}, .outline = outline_of(points, OutlineCurve::polyline, "airfoil")}});
  const FreeFormBox box{
      .on = "airfoil", .low = {-0.1, -0.1}, .high = {1.1, 0.1}, .columns = 4, .rows = 3, .moves = Moves::xy};
  const DesignProblem problem = problem_of(domain, {box});
  const std::unique_ptr<FlowSpace> space = design_space(problem);
  ASSERT_EQ(space->start().size(), 24u);
  const auto choose = [](int n, int k) {
    return std::tgamma(n + 1) / (std::tgamma(k + 1) * std::tgamma(n - k + 1));
  };
  const auto polynomial = [&](int n, int i, double s) {
    return choose(n, i) * std::pow(s, i) * std::pow(1.0 - s, n - i);
  };
  std::vector<double> design(24);
  for (std::size_t i = 0; i < design.size(); ++i) design[i] = 0.001 * std::cos(3.0 * static_cast<double>(i));
  const std::vector<Point> moved = stations_of(space->domain(design));
  for (std::size_t p = 0; p < points.size(); ++p) {
    const double s = (points[p].x + 0.1) / 1.2, t = (points[p].y + 0.1) / 0.2;
    Point expected = points[p];
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 4; ++i) {
        const double weight = polynomial(3, i, s) * polynomial(2, j, t);
        const auto at = static_cast<std::size_t>(2 * (4 * j + i));
        expected = expected + weight * Point{design[at], design[at + 1]};
      }
    EXPECT_NEAR(moved[p].x, expected.x, 1e-15) << p;
    EXPECT_NEAR(moved[p].y, expected.y, 1e-15) << p;
  }
  EXPECT_EQ(space->named(design).at(9).name, "airfoil.box[0,1].y");
}

// Of a point to the first loop's curves, by small pieces of them.
double distance_to(const Domain& domain, Point p) {
  constexpr int pieces = 20000;
  double least = 1e9;
  for (const Curve& curve : domain.loops[0].curves)
    for (int i = 0; i <= pieces; ++i)
      least = std::min(least, squared_distance(p, point_at(curve.shape, static_cast<double>(i) / pieces)));
  return std::sqrt(least);
}

// Stations slide along a curve whose length changes, but stay on it.
TEST(Deformation, HeldSidesKeepTheCurveBeforeTheBox) {
  const DesignProblem problem = problem_of(coved_section(), {rear_box()});
  const std::unique_ptr<FlowSpace> space = design_space(problem);
  ASSERT_EQ(space->start().size(), 6u);
  const Domain before = space->domain(space->start());
  double moved = 0.0, held = 0.0;
  for (const Point p : stations_of(space->domain(std::vector<double>(6, 0.01)))) {
    if (p.x < 0.3) held = std::max(held, distance_to(before, p));
    moved = std::max(moved, distance_to(before, p));
  }
  EXPECT_LT(held, 1e-4);  // what a spline does beyond its points
  EXPECT_GT(moved, 0.008);
}

TEST(Deformation, BumpsHaveTheirHeightWhereTheirPeakIs) {
  const CstAirfoil airfoil = named_airfoil("naca:2412", 5);
  constexpr double height = 0.001, width = 4.0;
  for (const bool upper : {true, false})
    for (const double peak : {0.1, 0.6}) {
      const DesignProblem problem =
          problem_of(naca_outline("2412", 200),
                     {HicksHenneBumps{.on = "airfoil", .upper = upper, .peaks = {peak}, .width = width}});
      const std::vector<Point> moved = stations_of(design_space(problem)->domain(std::vector{height}));
      double highest = 0.0;
      for (std::size_t i = 0; i < moved.size(); ++i) {
        const bool is_upper = i < moved.size() / 2;
        const double x = moved[i].x;
        if (x < 0.01 || x > 0.99) continue;
        const double t = std::acos(2.0 * x - 1.0) / (2.0 * M_PI);
        const double bump =
            height * std::pow(std::sin(M_PI * std::pow(x, std::log(0.5) / std::log(peak))), width);
        const double by = moved[i].y - airfoil.at(is_upper ? t : 1.0 - t).y;
        EXPECT_NEAR(by, is_upper == upper ? bump : 0.0, 1e-6) << x;
        highest = std::max(highest, by);
      }
      EXPECT_NEAR(highest, height, 2e-6);
    }
}

// The end of one curve is the beginning of the next, and follows.
TEST(Deformation, EndsOfNeighboursFollow) {
  DesignProblem problem = nozzle_problem();
  problem.deformation->parts = {CurvePoints{.on = "wall", .points = {0}}};
  const std::unique_ptr<FlowSpace> space = design_space(problem);
  const Domain moved = space->domain(std::vector<double>{0.1});
  EXPECT_EQ(std::get<Line>(moved.curve(1).shape).to, (Point{4.0, 0.6}));
  EXPECT_EQ(std::get<Spline>(moved.curve(2).shape).points.front(), (Point{4.0, 0.6}));
  EXPECT_NO_THROW(validate(moved));
}

// A spline in the place of an airfoil goes through its stations, and is nowhere far from it.
TEST(Deformation, AirfoilsOfADomainBecomeSplines) {
  CstAirfoil blunt = named_airfoil("naca:2412", 5);
  blunt.te_upper = 0.002, blunt.te_lower = -0.002;
  for (const CstAirfoil& airfoil : {named_airfoil("rae2822", 5), blunt}) {
    const Domain before = airfoil_domain(airfoil, {.points = 60});
    Domain after = before;
    EXPECT_FALSE(splines_for_airfoils(after, "farfield"));
    EXPECT_TRUE(splines_for_airfoils(after, "airfoil"));
    ASSERT_TRUE(std::holds_alternative<Spline>(after.loops[0].curves[0].shape));
    const std::vector<Point> was = stations_of(before), is = stations_of(after);
    ASSERT_EQ(was.size(), is.size());
    for (std::size_t i = 0; i < was.size(); ++i) EXPECT_LT(squared_distance(was[i], is[i]), 1e-24);
    for (int i = 1; i < 1000; ++i) {
      const Point p = point_at(after.loops[0].curves[0].shape, i / 1000.0);
      if (p.x < 0.001 || p.x > 0.999) continue;
      const double t = std::acos(2.0 * p.x - 1.0) / (2.0 * M_PI);
      const double off = std::min(std::fabs(p.y - airfoil.at(t).y), std::fabs(p.y - airfoil.at(1.0 - t).y));
      EXPECT_LT(off, 1e-6) << p.x;
    }
  }
}

// A passage of a row of blades, each of 40 stations.
DesignProblem cascade_problem() {
  std::ifstream file(std::string(REMODEL_SOURCE_DIR) + "/examples/domains/cascade.json");
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  DesignProblem problem = problem_of(
      domain_from_json(text, "cascade.json"),
      {FreeFormBox{.on = "blade", .low = {-0.02, -0.1}, .high = {1.02, 0.2}, .columns = 3, .rows = 2}});
  problem.gradation = 3.0;
  problem.points = {{.conditions = {.mach = 0.4, .alpha_deg = 40.0},
                     .inlets = {{.name = "inlet", .angle_deg = 40.0}},
                     .outlets = {{.name = "outlet", .pressure = 1.03}}}};
  return problem;
}

// Of the objective and of each constraint, at a design beside the start.
void expect_gradients_of_whole_flows(DesignProblem problem, double h,
                                     const std::function<double(const FlowResult&)>& objective) {
  const Case task(problem);
  std::vector<double> about = task.space().start();
  for (std::size_t i = 0; i < about.size(); ++i) about[i] = 0.002 * std::sin(static_cast<double>(i + 1));
  Flows flow(task);
  const Evaluation evaluation = task.evaluate(about);
  const auto value = [&](const std::vector<double>& design) { return objective(flow(design)); };
  EXPECT_NEAR(evaluation.objective, value(about), 1e-8);
  EXPECT_LT(relative(evaluation.gradient, task.differences(value, h, about)), 1e-6);
}

TEST(Deformation, GradientsOfACovedSectionAreThoseOfWholeFlows) {
  expect_gradients_of_whole_flows(problem_of(coved_section(), {rear_box()}), 1e-5,
                                  [](const FlowResult& flow) { return flow.cd; });
}

TEST(Deformation, GradientsByBumpsAreThoseOfWholeFlows) {
  DesignProblem problem =
      problem_of(naca_outline("0012", 50), {HicksHenneBumps{.on = "airfoil", .peaks = {0.2, 0.5, 0.8}}});
  problem.points[0].conditions.mach = 0.7;
  expect_gradients_of_whole_flows(problem, 1e-5, [](const FlowResult& flow) { return flow.cd; });
}

TEST(Deformation, GradientsOfANozzleAreThoseOfWholeFlows) {
  expect_gradients_of_whole_flows(nozzle_problem(), 1e-5, [](const FlowResult& flow) { return flow.cd; });
}

double value_at_outlets(const std::string& kind, const Case& task, Flows& flow,
                        const std::vector<double>& design) {
  const Mesh mesh = task.mesh_of(design);
  const FlowResult result = flow(design);
  return find_flow_kind(kind)->make(std::nullopt)->at({mesh.domain(), mesh.freeze(), result}).value;
}

TEST(Openings, FunctionsOfARowOfBladesHaveTheDerivativesOfWholeFlows) {
  for (const std::string objective : {"flow_angle", "pressure_loss", "lift"}) {
    DesignProblem problem = cascade_problem();
    problem.objective = objective;
    const Case task(problem);
    const std::vector<double> start = task.space().start();
    const Evaluation evaluation = task.evaluate(start);
    Flows flow(task);
    const double sign = find_flow_kind(objective)->objective;
    const auto value = [&](const std::vector<double>& design) {
      return sign * value_at_outlets(objective, task, flow, design);
    };
    EXPECT_NEAR(evaluation.objective, value(start), 1e-8);
    EXPECT_LT(relative(evaluation.gradient, task.differences(value, 1e-5)), 1e-6) << objective;
    if (objective == "flow_angle") {
      EXPECT_NEAR(evaluation.objective, flow(start).openings.at(1).flow_angle_deg, 1e-9);
    }
  }
}

// What leaves through the outlet is what the scheme says to its order; derivatives are its own, with a shock
// as well.
TEST(Openings, FunctionsHaveTheDerivativesOfWholeFlows) {
  for (const double pressure : {0.95, 0.75})
    for (const char* objective : {"mass_flow", "total_pressure"}) {
      DesignProblem problem = nozzle_problem();
      problem.objective = objective;
      problem.points[0].outlets[0].pressure = pressure;
      const Case task(problem);
      const std::vector<double> start = task.space().start();
      const Evaluation evaluation = task.evaluate(start);
      Flows flow(task);
      const auto value = [&](const std::vector<double>& design) {
        return -value_at_outlets(objective, task, flow, design);
      };
      const FlowResult result = flow(start);
      EXPECT_NEAR(evaluation.objective, value(start), 1e-8);
      if (problem.objective == "mass_flow")
        EXPECT_NEAR(-evaluation.objective, -result.openings.at(1).mass_flow, 2e-3);
      else
        EXPECT_NEAR(-evaluation.objective, pressure > 0.9 ? 1.0 : 0.935, 2e-3);
      EXPECT_LT(relative(evaluation.gradient, task.differences(value, 1e-5)), 1e-6) << objective;
    }
}

TEST(LoopSizes, AreThoseOfThePolygonWithTheirDerivatives) {
  DesignProblem problem = problem_of(naca_outline("2412", 100), {rear_box()});
  problem.constraints = {{.kind = "area", .of_start = 1.0},
                         {.kind = "thickness", .at_least = 0.05, .x = {{0.45, 0.8}}}};
  const ResolvedProblem parts = resolved(problem, "problem");
  const std::vector<double> start = parts.space->start();
  const auto values_at = [&](const std::vector<double>& design) {
    const Domain domain = parts.space->domain(design);
    std::vector<DesignValue> values;
    for (const auto& limit : parts.domain)
      for (DesignValue& value : limit.constraint->at({*parts.space, design, domain}))
        values.push_back(std::move(value));
    return values;
  };
  const std::vector<DesignValue> values = values_at(start);
  ASSERT_EQ(values.size(), 3u);
  EXPECT_NEAR(values[0].value, 0.0, 1e-15);
  const CstAirfoil airfoil = named_airfoil("naca:2412", 5);
  const auto thickness = [&](double x) {
    const double t = std::acos(2.0 * x - 1.0) / (2.0 * M_PI);
    return airfoil.at(t).y - airfoil.at(1.0 - t).y;
  };
  EXPECT_NEAR(values[1].value, 0.05 - thickness(0.45), 2e-4);
  EXPECT_NEAR(values[2].value, 0.05 - thickness(0.8), 2e-4);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto value = [&](const std::vector<double>& design) {
      return i == 0 ? -signed_area(parts.space->domain(design), 0) : values_at(design)[i].value;
    };
    EXPECT_LT(relative(values[i].by_design, test::differences(start, value, 1e-4)), 1e-7) << i;
  }
}

void expect_drag_gradients_with_friction(const DesignProblem& problem, double h) {
  const Case task(problem);
  const std::vector<double> start = task.space().start();
  const Evaluation evaluation = task.evaluate(start);
  FlowOptions options = design_flow_options(task.space(), problem.points[0]);
  options.tolerance = 1e-11;
  LivingFlow living(options);
  const auto drag = [&](const std::vector<double>& design) {
    const Mesh mesh = task.mesh_of(design);
    const FlowResult flow =
        DesignMesh(task.space(), mesh, design).solve(living, problem.points[0].conditions);
    EXPECT_TRUE(flow.converged()) << flow.reason;
    return flow.cd;
  };
  EXPECT_LT(relative(evaluation.gradient, task.differences(drag, h)), 2e-6);
}

TEST(Deformation, WithFrictionGradientsAreThoseOfWholeFlows) {
  DesignProblem problem =
      problem_of(coved_section(), {HicksHenneBumps{.on = "airfoil", .peaks = {0.3, 0.7}}});
  problem.domain.points = 150;
  problem.gradation = 2.5;
  problem.layer = LayerOptions{.first_height = 3e-3, .growth = 1.3, .thickness = 0.03};
  problem.points = {
      {.conditions = {.mach = 0.4, .alpha_deg = 1.0, .reynolds = 2000.0}, .model = FlowModel::laminar}};
  expect_drag_gradients_with_friction(problem, 1e-4);
}

// The layer ends at the inlet and the outlet.
TEST(Deformation, WithFrictionGradientsOfANozzleAreThoseOfWholeFlows) {
  DesignProblem problem = nozzle_problem();
  problem.domain.points = 150;
  problem.gradation = 4.0;
  problem.layer = LayerOptions{.first_height = 4e-3, .growth = 1.3, .thickness = 0.05};
  problem.points[0].conditions.reynolds = 1000.0, problem.points[0].model = FlowModel::laminar;
  problem.points[0].symmetry = {"axis"};
  expect_drag_gradients_with_friction(problem, 2e-5);
  problem.points.push_back(problem.points[0]);
  problem.points[1].symmetry.clear();  // the axis would be a wall
  try {
    validate(problem);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("points of flow with other walls than the first"),
              std::string::npos)
        << error.what();
  }
}

// With a layer of few cells.
void make_laminar(DesignProblem& problem) {
  problem.domain.points = 150;
  problem.gradation = 3.0;
  problem.layer = LayerOptions{.first_height = 3e-3, .growth = 1.3, .thickness = 0.03};
  problem.points[0].conditions.reynolds = 2000.0, problem.points[0].model = FlowModel::laminar;
}

TEST(Deformation, WithFrictionGradientsOfARowOfBladesAreThoseOfWholeFlows) {
  DesignProblem problem = cascade_problem();
  make_laminar(problem);
  expect_drag_gradients_with_friction(problem, 2e-5);
}

// Each point turns the walls beside it by its move over their distance; of a smooth move little is left of
// that.
TEST(Deformation, LayersFollowPointsThatLieCloseTogether) {
  const DesignProblem row = cascade_problem();
  DesignProblem problem =
      problem_of(airfoils_domain({{.airfoil = {}, .outline = {row.deformation->domain.loops[1].curves}}},
                                 {.farfield_radius = 15.0, .farfield_points = 24}),
                 row.deformation->parts);
  make_laminar(problem);
  const Case task(problem);
  const std::vector<double> start = task.space().start();
  std::mt19937_64 random(7);
  std::vector<Point> weight;
  const auto weighted = [&](const std::vector<double>& design) {
    const Mesh mesh = task.mesh_of(design);
    const DesignMesh at(task.space(), mesh, design);
    double sum = 0.0;
    for (std::size_t v = 0; v < weight.size(); ++v) sum += dot(weight[v], at.frozen().points[v]);
    return sum;
  };
  const Mesh mesh = task.mesh_of(start);
  const DesignMesh at(task.space(), mesh, start);
  for (std::size_t v = 0; v < at.frozen().points.size(); ++v)
    weight.push_back({uniform(random, -1, 1), uniform(random, -1, 1)});
  const std::vector<double> gradient = DesignDerivative(task.space(), at).vjp(weight);
  EXPECT_LT(relative(gradient, task.differences(weighted, 1e-5)), 1e-7);
}

// Walls are what is neither far field nor opening, whatever their names are.
TEST(Deformation, WallsOfAFlowAreThoseOfItsOptions) {
  const auto line = [](const char* name, Point from, Point to) {
    return Curve{.name = name, .shape = Line{from, to}, .parameters = Parameters::uniform(4)};
  };
  const Domain half = {{{.role = LoopRole::outer,
                         .curves = {line("hull", {0, 0}, {1, 0}), line("open", {1, 0}, {1, 1}),
                                    line("open", {1, 1}, {0, 1}), line("open", {0, 1}, {0, 0})}}}};
  EXPECT_EQ(walls_of_flow(half, {.farfield = {"open"}}), std::vector<std::string>{"hull"});
  EXPECT_TRUE(walls_of_flow(airfoil_domain(named_airfoil("naca:0012", 5)), {}).empty());
}

TEST(Deformation, SpaceIsToldFromItsDescription) {
  DesignProblem problem = problem_of(
      coved_section(),
      {rear_box(),
       HicksHenneBumps{.on = "airfoil", .peaks = {0.3}, .range = {.bounds = {{-0.01, 0.02}}, .scale = 0.1}}});
  const std::unique_ptr<FlowSpace> space = design_space(problem);
  const DeformedSpace again = DeformedSpace::from_description(space->description(), "history");
  std::vector<double> design(7, 0.01);
  EXPECT_EQ(again.domain(design), space->domain(design));
  EXPECT_EQ(again.named(design).back().value, 0.001);
  EXPECT_DOUBLE_EQ(again.bounds(0.05).low.back(), -0.1);
  EXPECT_EQ(again.bounds(0.05).high.front(), 0.05);
  EXPECT_TRUE(again.feasible(design));
  design.back() = 0.21;
  EXPECT_FALSE(again.feasible(design));
}

// The best objective over the start's.
double lowered(const DesignProblem& problem) {
  const auto directory =
      std::filesystem::temp_directory_path() / ("remodel-design-" + std::to_string(std::random_device{}()));
  const DesignResult result = run_design(problem, {.directory = directory});
  std::filesystem::remove_all(directory);
  EXPECT_TRUE(result.start_objective.has_value());
  return result.search.objective / result.start_objective.value_or(1.0);
}

TEST(DeformedSearch, LowersDragByABoxAndByBumps) {
  DesignProblem problem = problem_of(naca_outline("0012", 50), {});
  problem.points = {{.conditions = {.mach = 0.8}}};
  problem.constraints = {{.kind = "area", .of_start = 1.0}};
  problem.evaluations = 12;
  problem.deformation->parts = {FreeFormBox{.on = "airfoil",
                                            .low = {-0.001, -0.07},
                                            .high = {1.001, 0.07},
                                            .columns = 6,
                                            .rows = 2,
                                            .hold = {.left = 1, .right = 1}}};
  EXPECT_LT(lowered(problem), 0.7);
  const std::vector<double> peaks = {0.15, 0.3, 0.45, 0.6, 0.75};
  problem.deformation->parts = {HicksHenneBumps{.on = "airfoil", .peaks = peaks},
                                HicksHenneBumps{.on = "airfoil", .upper = false, .peaks = peaks}};
  EXPECT_LT(lowered(problem), 0.7);
}

// Choked: the throat decides how much gas leaves, and the shock behind it what is lost.
DesignProblem choked_nozzle() {
  DesignProblem problem = nozzle_problem();
  problem.points[0].outlets[0].pressure = 0.75;
  problem.evaluations = 8;
  problem.bounds = 0.04;
  return problem;
}

TEST(DeformedSearch, WidensAThroatForMoreMassFlow) {
  DesignProblem problem = choked_nozzle();
  problem.objective = "mass_flow";
  EXPECT_GT(lowered(problem), 1.05);
}

TEST(DeformedSearch, LosesLessTotalPressureInANozzle) {
  DesignProblem problem = choked_nozzle();
  problem.objective = "total_pressure";
  EXPECT_GT(lowered(problem), 1.02);
}

}  // namespace
}  // namespace remodel
