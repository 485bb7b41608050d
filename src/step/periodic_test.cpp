// Periodic curves: whatever a step does, every vertex on one of them has its counterpart on the other.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "mesh/mesh_data.h"
#include "remodel/check.h"
#include "remodel/error.h"
#include "remodel/generate.h"
#include "remodel/remodel.h"
#include "step/test_designs.h"
#include "support.h"

namespace remodel {
namespace {

// The passage of a blade of a row with a pitch of 0.7, which comes near to one of the periodic curves.
Domain passage(const CstAirfoil& blade, double y = 0.2, double rotation_deg = 25.0) {
  const auto wave = [](double offset) {
    return std::vector<Point>{{-1.0, offset}, {0.0, offset}, {0.9, offset + 0.42}, {2.2, offset + 0.6}};
  };
  std::vector<Point> above = wave(0.35);
  std::reverse(above.begin(), above.end());
  const Shape below = spline_through(wave(-0.35)), moved = spline_through(above);
  const Domain alone = airfoil_domain(blade, {.points = 60});
  Loop hole = alone.loops.front();
  hole.placement = {.rotation_deg = rotation_deg, .position = {0.0, y}};
  return {.loops = {{.curves = {{"below", below, Parameters::uniform(8)},
                                {"outlet", Line{{2.2, 0.25}, {2.2, 0.95}}, Parameters::uniform(2)},
                                {"above", moved, Parameters::uniform(8)},
                                {"inlet", Line{{-1.0, 0.35}, {-1.0, -0.35}}, Parameters::uniform(2)}}},
                    std::move(hole)},
          .periodic = {{"below", "above"}}};
}

std::vector<double> parameters_on(const FrozenMesh& mesh, std::int32_t curve) {
  std::vector<double> result;
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if (mesh.curve[v] == curve) result.push_back(mesh.parameter[v]);
  std::sort(result.begin(), result.end());
  return result;
}

// How many vertices the curve `below` has, all of them with a counterpart.
std::size_t matched(const Mesh& mesh) {
  EXPECT_EQ(mesh.quick_check(), "");
  const FrozenMesh frozen = mesh.freeze();
  EXPECT_EQ(frozen.periodic, (std::vector<std::array<std::string, 2>>{{"below", "above"}}));
  const CheckResult checked = check(frozen, {.design = &mesh.domain(), .max_violations = 1});
  EXPECT_TRUE(checked.valid) << checked.violations[0].detail;
  std::vector<double> below = parameters_on(frozen, 0), above = parameters_on(frozen, 2);
  // Each curve has its beginning, not its end.
  below.push_back(1.0), above.push_back(1.0);
  std::reverse(above.begin(), above.end());
  EXPECT_EQ(below.size(), above.size());
  for (std::size_t i = 0; i < std::min(below.size(), above.size()); ++i)
    EXPECT_NEAR(below[i], 1.0 - above[i], 1e-12);
  return below.size();
}

TEST(PeriodicCurves, AreSplitAlikeFromGenerationOnUnderEveryStrategy) {
  const unsigned long long seed = test::seed(47);
  SCOPED_TRACE("seed " + std::to_string(seed));
  for (const Strategy strategy : {Strategy::chain, Strategy::renew, Strategy::morph, Strategy::reference}) {
    std::mt19937_64 random(seed);
    test::Walk walk(0, 0.03, random);
    Mesh mesh = test::generated(passage(walk.airfoil()), {});
    std::size_t least = matched(mesh), most = least;
    EXPECT_GT(least, 10u);  // refinement has split them
    for (int step = 0; step < 30; ++step) {
      walk.next();
      // Up and down the passage, far enough for replacements.
      const Domain design =
          passage(walk.airfoil(), 0.2 * std::sin(0.4 * step), 25.0 + 5.0 * std::sin(0.3 * step));
      const RemodelResult result = remodel(mesh, design, {.strategy = strategy});
      EXPECT_EQ(result.stopped, Stopped::done) << result.reason;
      const std::size_t count = matched(mesh);
      least = std::min(least, count), most = std::max(most, count);
      if (HasFailure()) return;
    }
    if (strategy != Strategy::reference) {
      EXPECT_GT(most, least) << name_of(strategy);
    }
  }
}

// A passage along the flow, whose inlet and outlet make sharp corners with one of both curves each.
Domain staggered(double angle_deg, std::size_t along, std::size_t across, bool periodic = true) {
  const double slope = std::tan(angle_deg * std::numbers::pi / 180.0);
  const auto line = [](const char* name, Point from, Point to, std::size_t stations) {
    return Curve{name, Line{from, to}, Parameters::uniform(stations)};
  };
  const Point a = {-1.0, -slope - 0.5}, b = {2.0, 2.0 * slope - 0.5}, up = {0.0, 1.0};
  Domain domain = {
      .loops = {{.curves = {line("below", a, b, along), line("outlet", b, b + up, across),
                            line("above", b + up, a + up, along), line("inlet", a + up, a, across)}},
                test::circle_hole(0.5, 0.5 * slope, 0.1)}};
  if (periodic) domain.periodic = {{"below", "above"}};
  return domain;
}

TEST(PeriodicCurves, AreSplitAlikeAtSharpCorners) {
  for (const double angle_deg : {45.0, 58.0, 62.0, 66.0, 70.0, 75.0})
    for (const std::size_t along : {24u, 31u}) {
      SCOPED_TRACE(std::to_string(angle_deg) + " degrees, " + std::to_string(along));
      const Mesh mesh = test::generated(staggered(angle_deg, along, 8), {});
      matched(mesh);
      const Mesh alone = test::generated(staggered(angle_deg, along, 8, false), {});
      EXPECT_LT(mesh.statistics().triangles, 4 * alone.statistics().triangles);
    }
}

TEST(PeriodicCurves, AreSplitAlikeWhereLoopsComeAndGo) {
  const CstAirfoil blade = airfoil_catalogue()[0].airfoil();
  const Domain one = passage(blade);
  Domain two = one;
  two.loops.push_back(test::circle_hole(1.6, 0.6, 0.05));
  Mesh mesh = test::generated(one, {});
  for (const Domain& domain : {two, one, two}) {
    const RemodelResult result = remodel(mesh, domain);
    EXPECT_FALSE(result.regenerated) << result.reason;
    matched(mesh);
  }
}

TEST(PeriodicCurves, OtherPairsMakeAMeshAfresh) {
  Domain domain = passage(airfoil_catalogue()[0].airfoil());
  Domain without = domain;
  without.periodic.clear();
  Mesh mesh = test::generated(without, {});
  EXPECT_TRUE(remodel(mesh, domain).regenerated);
  matched(mesh);
}

std::string error_of(const Domain& domain) {
  try {
    validate(domain);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(PeriodicCurves, HaveToBeEachOtherMoved) {
  const Domain good = passage(airfoil_catalogue()[0].airfoil());
  EXPECT_EQ(error_of(good), "");
  EXPECT_EQ(domain_from_json(domain_to_json(good), "text"), good);
  Domain other = good;
  other.periodic = {{"below", "roof"}};
  EXPECT_NE(error_of(other).find("found no curve \"roof\""), std::string::npos);
  other = good;
  other.loops[0].curves[2].parameters = Parameters::uniform(9);
  EXPECT_NE(error_of(other).find("stations (8 and 9)"), std::string::npos) << error_of(other);
  other = good;
  auto& spline = std::get<Spline>(other.loops[0].curves[2].shape);
  std::vector<Point> points = spline.points;
  points[1].y += 0.01;
  spline = spline_through(points);
  EXPECT_NE(error_of(other).find("the first one moved by"), std::string::npos) << error_of(other);
  other = good;
  other.periodic = {{"below", "below"}};
  EXPECT_NE(error_of(other).find("found one name twice"), std::string::npos);
  // One point of many that is off.
  other = staggered(45.0, 24, 8);
  std::vector<Point> below, above;
  for (int i = 0; i <= 48; ++i) {
    const double t = i / 48.0;
    below.push_back({-1.0 + 3.0 * t, -1.5 + 3.0 * t}), above.push_back({-1.0 + 3.0 * t, -0.5 + 3.0 * t});
  }
  above[13].y += 0.02;
  std::reverse(above.begin(), above.end());
  other.loops[0].curves[0].shape = Polyline{below}, other.loops[0].curves[2].shape = Polyline{above};
  EXPECT_NE(error_of(other).find("the first one moved by"), std::string::npos) << error_of(other);
  // Two holes have the domain on the same side.
  const Loop hole = test::rectangle(LoopRole::hole, "a", {0.2, 0.2}, {0.4, 0.4});
  Loop same = test::rectangle(LoopRole::hole, "b", {0.6, 0.2}, {0.8, 0.4});
  other = test::with_holes({hole, same});
  other.periodic = {{"a", "b"}};
  EXPECT_NE(error_of(other).find("on the same side"), std::string::npos) << error_of(other);
}

// A loop may begin in the middle of a periodic curve's name.
TEST(PeriodicCurves, MayBeginAnywhereInALoop) {
  Domain domain = staggered(45.0, 24, 8);
  std::vector<Curve>& curves = domain.loops[0].curves;
  const Point middle = {0.5, 0.0};
  const Point a = {-1.0, -1.5}, b = {2.0, 1.5}, up = {0.0, 1.0};
  const auto line = [](const char* name, Point from, Point to) {
    return Curve{name, Line{from, to}, Parameters::uniform(12)};
  };
  curves = {line("below", middle, b),           curves[1], line("above", b + up, middle + up),
            line("above", middle + up, a + up), curves[3], line("below", a, middle)};
  domain.loops.pop_back();
  EXPECT_EQ(periodic_curves(domain).size(), 2u);
}

}  // namespace
}  // namespace remodel
