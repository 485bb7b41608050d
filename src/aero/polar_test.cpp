#include "remodel/polar.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/test_meshes.h"
#include "remodel/airfoil.h"
#include "remodel/domain.h"
#include "remodel/flow_layer.h"
#include "remodel/generate.h"

namespace remodel {
namespace {

using test::error_of;
using Numbers = std::vector<double>;

Mesh section_mesh(const char* name) {
  return generate(airfoil_domain(named_airfoil(name, 5), {.points = 40, .farfield_radius = 10.0}),
                  {.gradation = 1.0})
      .mesh;
}

TEST(Ranges, AreTheNumbersThatTheySayAndRoundOnes) {
  EXPECT_EQ(parse_range("--alpha", "0:8:4", {-90, 90}), (Numbers{0, 4, 8}));
  EXPECT_EQ(parse_range("--alpha", "0:1:0.1", {-90, 90}),
            (Numbers{0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1}));
  EXPECT_EQ(parse_range("--alpha", "-3:4:2", {-90, 90}), (Numbers{-3, -1, 1, 3}));  // the last one is not hit
  EXPECT_EQ(parse_range("--alpha", "2:2:1", {-90, 90}), Numbers{2});
  EXPECT_EQ(parse_range("--mach", "0.15", {0.01, 3}), Numbers{0.15});
  EXPECT_EQ(parse_range("--alpha", "0:0.999:0.001", {-90, 90}).size(), most_polar_values);
}

TEST(Ranges, AreRefusedInASentence) {
  const auto refusal = [](const char* text) {
    return error_of([&] { parse_range("--alpha", text, {-90, 90}); });
  };
  const auto expect = [&](const char* text, const std::string& expected) {
    EXPECT_EQ(refusal(text), "--alpha: found '" + std::string(text) + "', expected " + expected);
  };
  for (const char* text : {"", "a", "1:2", "1:2:3:4", "1:2:", ":", "1:x:1", "nan", "0:1:inf", "1 "})
    expect(text, "a number, or FIRST:LAST:STEP");
  expect("0:8:0", "a step above 0");
  expect("0:8:-1", "a step above 0");
  expect("8:0:1", "a last value that is not below the first one");
  expect("8:0:-1", "a last value that is not below the first one");
  expect("0:1:0.001", "at most 1000 values");
  expect("0:90:1e-300", "at most 1000 values");
  expect("89:91:1", "numbers from -90 to 90");
  expect("100", "numbers from -90 to 90");
  expect("1:1.00000000000001:1e-15", "a step that 12 digits can show");
}

TEST(Polars, HaveFlowsThatAreThoseFoundCold) {
  const Mesh mesh = section_mesh("naca:2412");
  PolarOptions options;
  options.machs = {0.4, 0.5}, options.alphas_deg = {-2, 0, 2};
  const std::vector<PolarCurve> curves = find_polar(mesh, "section", options).curves;
  ASSERT_EQ(curves.size(), 2U);
  for (const PolarCurve& curve : curves) {
    ASSERT_EQ(curve.points.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      const PolarPoint& point = curve.points[i];
      EXPECT_TRUE(point.converged && point.asked);
      EXPECT_EQ(point.alpha_deg, options.alphas_deg[i]);
      const FlowResult cold = solve_flow(mesh, {.mach = curve.mach, .alpha_deg = point.alpha_deg});
      EXPECT_NEAR(point.cl, cold.cl, 1e-8);
      EXPECT_NEAR(point.cd, cold.cd, 1e-8);
      EXPECT_NEAR(point.cm, cold.cm, 1e-8);
      EXPECT_EQ(point.cd_friction, 0.0);
    }
  }
  // One flow begins from nothing.
  int cold = 0;
  for (const PolarCurve& curve : curves)
    for (const PolarPoint& point : curve.points) cold += point.start == FlowStart::cold;
  EXPECT_EQ(cold, 1);
}

TEST(Polars, FindAnglesForLifts) {
  PolarOptions options;
  options.machs = {0.4}, options.lifts = {0.2, 0.4};
  const PolarCurve curve = find_polar(section_mesh("naca:2412"), "section", options).curves.front();
  ASSERT_EQ(curve.points.size(), 2U);
  EXPECT_NEAR(curve.points[0].cl, 0.2, 1e-8);
  EXPECT_NEAR(curve.points[1].cl, 0.4, 1e-8);
  EXPECT_LT(curve.points[0].alpha_deg, curve.points[1].alpha_deg);
  EXPECT_EQ(curve.points[0].start, FlowStart::cold);
  EXPECT_NE(curve.points[1].start, FlowStart::cold);
}

TEST(Polars, SayWhatIsNotFound) {
  PolarOptions options;
  options.machs = {0.4}, options.alphas_deg = {0, 1, 2, 3}, options.flow.max_steps = 1;
  const PolarCurve curve = find_polar(section_mesh("naca:0012"), "section", options).curves.front();
  ASSERT_EQ(curve.points.size(), 4U);
  EXPECT_EQ(curve.points[0].status, FlowStatus::step_limit);
  EXPECT_FALSE(curve.points[0].reason.empty());
  EXPECT_EQ(curve.points[3].status, std::nullopt);
  EXPECT_TRUE(std::isnan(curve.points[0].cl));
  EXPECT_EQ(curve.points[0].alpha_deg, 0.0);
  EXPECT_FALSE(largest_lift(curve));
  EXPECT_TRUE(polar_plots({curve}).empty());
}

TEST(Polars, EndAtAnInterrupt) {
  struct Third : StepObserver {
    int searches = 0;
    bool cancelled() override { return searches > 2; }
  } observer;
  PolarOptions options;
  options.machs = {0.4, 0.5}, options.alphas_deg = {0, 1, 2, 3}, options.flow.observer = &observer;
  options.on_search = [&](double, double) { ++observer.searches; };
  const PolarResult result = find_polar(section_mesh("naca:0012"), "section", options);
  EXPECT_TRUE(result.interrupted);
  ASSERT_EQ(result.curves.size(), 1U);
  EXPECT_EQ(result.curves[0].points.size(), 2U);
}

TEST(Polars, GoThroughMeshesOfOtherPrograms) {
  FrozenMesh mesh = section_mesh("naca:0012").freeze();
  PolarOptions options;
  options.machs = {0.4}, options.alphas_deg = {0, 1};
  const PolarPoint ours = find_polar(mesh, "section", options).curves[0].points[1];
  mesh.vertex_keys.clear();
  const PolarPoint theirs = find_polar(mesh, "section", options).curves[0].points[1];
  EXPECT_EQ(ours.cl, theirs.cl);
}

TEST(Polars, RefuseWhatIsNoRow) {
  const Mesh mesh = section_mesh("naca:0012");
  const auto refusal = [&](const auto& change) {
    PolarOptions options;
    options.machs = {0.4}, options.alphas_deg = {0, 1};
    change(options);
    return error_of([&] { find_polar(mesh, "section", options); });
  };
  EXPECT_EQ(refusal([](PolarOptions& o) { o.machs.clear(); }), "machs: found none, expected a Mach number");
  EXPECT_EQ(refusal([](PolarOptions& o) { o.lifts = {1}; }),
            "alphas_deg: found angles and lifts, expected one of them");
  EXPECT_EQ(refusal([](PolarOptions& o) { o.alphas_deg.clear(); }),
            "alphas_deg: found neither angles nor lifts, expected one of them");
  EXPECT_EQ(refusal([](PolarOptions& o) {
              o.alphas_deg = {1, 1};
            }),
            "alphas_deg: found values that do not ascend, expected each to be above the one before");
  EXPECT_EQ(refusal([](PolarOptions& o) { o.halvings = -1; }), "halvings: found -1, expected 0 to 20");
  EXPECT_EQ(refusal([](PolarOptions& o) { o.misses = 0; }), "misses: found 0, expected 1 or more");
}

PolarCurve curve_of(const std::string& name, const std::vector<std::pair<double, double>>& lifts) {
  PolarCurve curve;
  curve.name = name, curve.model = FlowModel::sa, curve.mach = 0.15, curve.reynolds = 6e6;
  for (const auto& [alpha, cl] : lifts) {
    PolarPoint& point = curve.points.emplace_back();
    point.alpha_deg = alpha;
    if (std::isnan(cl)) {
      point.reason = "stalled, \"really\"";
      continue;
    }
    point.converged = true, point.status = FlowStatus::converged;
    point.cl = cl, point.cd = 0.01, point.cm = -0.1, point.cd_pressure = 0.004, point.cd_friction = 0.006;
  }
  return curve;
}

TEST(Polars, NameTheLargestLift) {
  const LargestLift passed = *largest_lift(curve_of("a", {{14, 1.4}, {16, 1.6}, {18, 1.5}}));
  EXPECT_EQ(passed.cl, 1.6);
  EXPECT_EQ(passed.alpha_deg, 16.0);
  EXPECT_TRUE(passed.passed);
  EXPECT_FALSE(largest_lift(curve_of("a", {{14, 1.4}, {16, 1.6}, {18, PolarPoint::none}}))->passed);
}

TEST(Polars, AreTables) {
  EXPECT_EQ(
      polar_table({curve_of("a,b", {{0.3, 0.1}, {18, PolarPoint::none}})}),
      "shape,mach,reynolds,asked,alpha_deg,cl,cd,cm,cd_pressure,cd_friction,y_plus_max,converged,status,"
      "newton_steps,residual,reason,warnings\n"
      "\"a,b\",0.15,6e+06,1,0.3,0.1,0.01,-0.1,0.004,0.006,,1,converged,0,,,\n"
      "\"a,b\",0.15,6e+06,1,18,,,,,,,0,not-looked-for,0,,\"stalled, \"\"really\"\"\",\n");
}

TEST(Polars, ArePlotsThatNameWhatDiffers) {
  const PolarCurve a = curve_of("a", {{0, 0.1}, {4, 0.5}, {8, 0.4}}), b = curve_of("b", {{0, 0.2}, {4, 0.6}});
  const std::vector<Plot> plots = polar_plots({a, b, curve_of("c", {{0, PolarPoint::none}})});
  ASSERT_EQ(plots.size(), 4U);
  EXPECT_EQ(plots[0].caption, "M 0.15, Re 6e+06, sa");
  ASSERT_EQ(plots[0].curves.size(), 2U);
  EXPECT_EQ(plots[0].curves[0].name, "a: CL max 0.5 at 4\u00b0");
  EXPECT_EQ(plots[0].curves[1].name, "b: CL up to 0.6 at 4\u00b0");
  EXPECT_EQ(plots[1].curves[1].name, "b");
  EXPECT_EQ(plots[1].curves[1].points, (std::vector<Point>{{0.01, 0.2}, {0.01, 0.6}}));
  EXPECT_EQ(polar_plots({a})[0].caption, "a, M 0.15, Re 6e+06, sa");
  PolarCurve inviscid = a;
  inviscid.model = FlowModel::euler;
  EXPECT_EQ(polar_plots({inviscid}).size(), 3U);  // lift over a drag that should be 0 means nothing
}

TEST(Polars, SayEachKindOfWarningOnce) {
  PolarCurve curve = curve_of("a", {{0, 0.1}, {4, 0.5}});
  curve.points[0].warnings = {"y+ is up to 2.5", "no layer"};
  curve.points[1].warnings = {"y+ is up to 3.1"};
  EXPECT_EQ(polar_warnings(curve),
            (std::vector<std::string>{"y+ is up to 2.5 (2 flows, the first at 0 degrees)",
                                      "no layer (1 flow, at 0 degrees)"}));
}

TEST(LayersOfFlows, FollowTheReynoldsNumberAndTheModel) {
  const LayerOptions turbulent = layer_for_flow(FlowModel::sa, 6e6);
  EXPECT_DOUBLE_EQ(turbulent.thickness, 1.2 * boundary_layer_thickness(6e6));
  EXPECT_DOUBLE_EQ(turbulent.first_height, first_height(1.0, 6e6));
  EXPECT_DOUBLE_EQ(layer_for_flow(FlowModel::sa, 1e4).first_height, 0.05 / 150.0);
  const LayerOptions laminar = layer_for_flow(FlowModel::laminar, 100);
  EXPECT_DOUBLE_EQ(laminar.thickness, 1.2 * 0.5);
  EXPECT_DOUBLE_EQ(laminar.first_height, 0.001);
  EXPECT_NE(error_of([] { layer_for_flow(FlowModel::euler, 6e6); }).find("expected a model with friction"),
            std::string::npos);
}

}  // namespace
}  // namespace remodel
