#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "remodel/airfoil.h"
#include "remodel/check.h"
#include "remodel/error.h"
#include "test_layers.h"

namespace remodel::test {
namespace {

const QualityOptions quality{.gradation = 8.0};

// Both views are meshes of the walls, the outer mesh keeps its promises by the independent validator, and no
// column had to give way.
LayerStatistics expect_valid(const Domain& domain, const LayerOptions& options, const std::string& what) {
  const LayeredMesh mesh = generate_layered(domain, options, quality).mesh;
  EXPECT_EQ(mesh.quick_check(), "") << what;
  EXPECT_EQ(why_no_mesh(mesh.freeze(), domain), "") << what;
  EXPECT_EQ(why_no_mesh(mesh.freeze(LayerCells::triangles), domain), "") << what;
  EXPECT_EQ(mesh.shrunk(), 0) << what;
  const CheckResult outside =
      check(mesh.outer().freeze(), {.min_angle_deg = 30.0, .max_gradation = 0.70710678118654752});
  EXPECT_TRUE(outside.valid) << what;
  return mesh.statistics();
}

Domain spaced(Domain domain, const WallSpacing& spacing = {}) {
  space_walls(domain, spacing);
  return domain;
}

CstAirfoil with_base(double gap) {
  CstAirfoil airfoil = named_airfoil("naca:0012", 8);
  airfoil.te_upper = gap / 2, airfoil.te_lower = -gap / 2;
  return airfoil;
}

// NACA 0012 with a flap across its lower surface at the trailing edge.
Domain with_gurney_flap(double height) {
  const CstAirfoil airfoil = named_airfoil("naca:0012", 8);
  std::vector<Point> outline;
  for (int i = 1; i < 200; ++i) {
    const Point p = airfoil.at(i / 200.0);
    if (p.x < 0.992 || p.y > 0.0) outline.push_back(p);
  }
  for (const Point p : {Point{0.996, -0.0006}, {0.997, -height}, {1.0, -height}, {1.0, 0.0}})
    outline.push_back(p);
  Domain domain;
  domain.loops = {{.role = LoopRole::hole, .curves = outline_of(outline, OutlineCurve::spline, "airfoil")},
                  box(20)};
  return domain;
}

Domain with_flap(double gap) {
  return airfoils_domain({{.name = "main", .airfoil = named_airfoil("naca:4412", 8)},
                          {.name = "flap",
                           .airfoil = named_airfoil("naca:0012", 8),
                           .placement = {.chord = 0.3, .position = {0.97, -0.0215 - gap}}}});
}

TEST(Columns, StudyAirfoilsAreAsGoodAsTheGuidePromises) {
  for (const CatalogueEntry& entry : airfoil_catalogue()) {
    const std::string name(entry.name);
    const LayerStatistics s = expect_valid(spaced(airfoil_domain(entry.airfoil())), layer_options(), name);
    EXPECT_GT(s.corner_min_deg, 56.0) << name;
    EXPECT_LT(s.area_jump_median, 1.5) << name;
    EXPECT_LT(s.area_jump_max, 5.0) << name;
    EXPECT_EQ(s.thickness.least, 0.02) << name;
    EXPECT_LE(s.growth.most, 1.2) << name;
  }
}

TEST(Columns, HeightsThicknessesAndGrowthsAreFree) {
  const Domain domain = spaced(airfoil_domain(named_airfoil("rae2822", 8)));
  for (const double height : {3e-7, 1.3e-4, 1e-3})
    expect_valid(domain, layer_options(height), std::to_string(height));
  for (const double thickness : {0.01, 0.05, 0.1})
    expect_valid(domain, {.first_height = 4.5e-6, .thickness = thickness}, std::to_string(thickness));
  for (const double growth : {1.1, 1.5})
    expect_valid(domain, {.first_height = 1e-5, .growth = growth}, "growth");
  expect_valid(domain, {.first_height = 0.01, .thickness = 0.01}, "a single cell");
}

// Also by less than any spacing: the tops over such a base are as far apart as those beside it.
TEST(Columns, EdgesMayBeBlunt) {
  for (const double gap : {1e-5, 1e-4, 0.0025, 0.02}) {
    const std::string what = "base of " + std::to_string(gap);
    const LayerStatistics s = expect_valid(spaced(airfoil_domain(with_base(gap))), layer_options(), what);
    EXPECT_LT(s.area_jump_max, 5.5) << what;
    EXPECT_GT(s.corner_min_deg, 65.0) << what;
  }
}

TEST(Columns, StationsMayLieAnyhow) {
  for (const int points : {40, 200, 800})
    expect_valid(airfoil_domain(named_airfoil("rae2822", 8), {.points = points}), layer_options(), "cosine");
}

TEST(Columns, GurneyFlapsAndCovesHaveThinColumnsInTheirCorners) {
  const LayerStatistics gurney = expect_valid(spaced(with_gurney_flap(0.02)), layer_options(), "Gurney flap");
  EXPECT_LT(gurney.thickness.least, 0.002);
  EXPECT_EQ(gurney.thickness.most, 0.02);
  const std::vector<Point> cove{{0, 0}, {1, 0}, {1, .1}, {.7, .1}, {.7, .05}, {.4, .05}, {.4, .1}, {0, .1}};
  Domain domain{{polygon(cove), box(10)}};
  for (const double height : {4.5e-6, 1e-4}) expect_valid(spaced(domain), layer_options(height), "cove");
}

TEST(Columns, InAGapTwoLayersLeaveRoomBetweenThem) {
  for (const double gap : {0.01, 0.003}) {
    const Domain domain = spaced(with_flap(gap));
    double apart = 1.0;
    for (const Point p : domain.points(0))
      for (const Point q : domain.points(1)) apart = std::min(apart, distance(p, q));
    const LayerStatistics s = expect_valid(domain, layer_options(), std::to_string(gap));
    EXPECT_LT(s.thickness.least, 0.35 * apart);
    EXPECT_GT(s.thickness.least, 0.1 * apart);
  }
}

TEST(Columns, AWallMayBeAnyClosedLoop) {
  Domain cavity{{box(0.5, "wall")}};
  const LayerOptions options{.first_height = 1e-4, .walls = {"wall"}};
  space_walls(cavity, {}, options.walls);
  expect_valid(cavity, options, "cavity");
  // Backwards.
  Domain domain = spaced(airfoil_domain(with_base(0.01)));
  std::vector<Point> points = domain.points(0);
  std::reverse(points.begin(), points.end());
  domain.loops[0] = polygon(points);
  expect_valid(domain, layer_options(), "backwards");
}

TEST(Columns, RefuseWhatIsNoWall) {
  const Domain domain = spaced(airfoil_domain(named_airfoil("rae2822", 8)));
  const auto message = [&](const Domain& walls, const LayerOptions& options) -> std::string {
    try {
      generate_layered(walls, options, quality);
      return "accepted";
    } catch (const Error& error) {
      return error.what();
    }
  };
  EXPECT_EQ(message(domain, {.first_height = 1e-5, .walls = {"wing"}}),
            "walls: found 'wing', expected a boundary of the domain");
  EXPECT_EQ(
      message(Domain{{box(1)}}, layer_options()),
      "walls: found a domain without holes, and without an outer loop of which some curves are called inlet, "
      "outlet, symmetry or farfield, expected a wall for the layer, or the names of walls");
  EXPECT_NE(message(domain, {}).find("first layer height"), std::string::npos);
  EXPECT_NE(message(domain, {.first_height = 1e-5, .growth = 1.0}).find("growth"), std::string::npos);
  EXPECT_NE(message(domain, {.first_height = 0.1}).find("layer thickness"), std::string::npos);
  Domain joined = domain;
  joined.loops.push_back(
      {.role = LoopRole::internal,
       .curves = {{.name = "wake", .shape = Line{domain.points(0)[0], {3, 0}}, .parameters = {0.0}}},
       .open = true});
  EXPECT_NE(message(joined, layer_options()).find("an open line that ends on loop 0"), std::string::npos);
}

}  // namespace
}  // namespace remodel::test
