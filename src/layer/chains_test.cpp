// Walls that end at openings: their layers, and what is left of the openings.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "layer/walls.h"
#include "remodel/airfoil.h"
#include "remodel/check.h"
#include "remodel/error.h"
#include "support.h"
#include "test_layers.h"

namespace remodel::test {
namespace {

const QualityOptions chain_quality{.gradation = 8.0};
const QualityOptions steady_quality{.gradation = 8.0, .refine_angle_deg = 32.0};

Curve line(const std::string& name, Point from, Point to, std::size_t pieces) {
  return {.name = name, .shape = Line{from, to}, .parameters = Parameters::uniform(pieces)};
}

Curve bulge(const std::string& name, double length, double height, std::size_t pieces) {
  std::vector<Point> points;
  for (int i = 0; i <= 24; ++i) {
    const double t = i / 24.0, s = std::sin(std::numbers::pi * t);
    points.push_back({length * t, height * s * s});
  }
  return {.name = name, .shape = spline_through(points), .parameters = Parameters::uniform(pieces)};
}

// Counter-clockwise from the lower left corner; the lower wall bulges.
Domain channel(double height = 0.1, double gap = 1.0, std::size_t pieces = 120) {
  return {{{.role = LoopRole::outer,
            .curves = {bulge("bottom", 3.0, height, pieces), line("outlet", {3, 0}, {3, gap}, 5),
                       line("top", {3, gap}, {0, gap}, 60), line("inlet", {0, gap}, {0, 0}, 5)}}}};
}

// A plate between two lines of symmetry.
Domain plate() {
  return {{{.role = LoopRole::outer,
            .curves = {line("symmetry", {-2, 0}, {0, 0}, 20), line("plate", {0, 0}, {1, 0}, 60),
                       line("symmetry", {1, 0}, {2, 0}, 20), line("outlet", {2, 0}, {2, 2}, 4),
                       line("farfield", {2, 2}, {-2, 2}, 8), line("inlet", {-2, 2}, {-2, 0}, 4)}}}};
}

// The half of a body in a half circle: the circle is an arc, met at right angles.
Domain half_circle() {
  constexpr double radius = 2.0;
  return {
      {{.role = LoopRole::outer,
        .curves = {line("symmetry", {-radius, 0}, {0, 0}, 40),
                   bulge("body", 1.0, 0.05, 60),
                   line("symmetry", {1, 0}, {radius, 0}, 40),
                   {.name = "farfield",
                    .shape = Arc{.centre = {0, 0}, .radius = radius, .start = 0.0, .sweep = std::numbers::pi},
                    .parameters = Parameters::uniform(24)}}}}};
}

// A channel whose openings lean: so many degrees between them and the lower wall, at both ends.
Domain leaning(double degrees) {
  const double shift = 1.0 / std::tan(degrees * std::numbers::pi / 180.0);
  return {
      {{.role = LoopRole::outer,
        .curves = {line("wall", {0, 0}, {4, 0}, 400), line("outlet", {4, 0}, {4 - shift, 1}, 5),
                   line("farfield", {4 - shift, 1}, {shift, 1}, 20), line("inlet", {shift, 1}, {0, 0}, 5)}}}};
}

Domain backwards(Domain domain) {
  for (Loop& loop : domain.loops) {
    std::reverse(loop.curves.begin(), loop.curves.end());
    for (Curve& curve : loop.curves) {
      if (auto* of = std::get_if<Line>(&curve.shape)) std::swap(of->from, of->to);
      if (auto* of = std::get_if<Arc>(&curve.shape)) of->start += of->sweep, of->sweep = -of->sweep;
      if (auto* of = std::get_if<Spline>(&curve.shape)) {
        std::reverse(of->points.begin(), of->points.end());
        *of = spline_through(of->points);
      }
    }
  }
  return domain;
}

Domain rotated(Domain domain, std::ptrdiff_t by) {
  std::vector<Curve>& curves = domain.loops[0].curves;
  std::rotate(curves.begin(), curves.begin() + by, curves.end());
  return domain;
}

LayeredMesh expect_whole(const Domain& domain, const LayerOptions& options, const std::string& what) {
  LayeredMesh mesh = generate_layered(domain, options, chain_quality).mesh;
  EXPECT_EQ(mesh.quick_check(), "") << what;
  EXPECT_EQ(why_no_mesh(mesh.freeze(), domain), "") << what;
  EXPECT_EQ(why_no_mesh(mesh.freeze(LayerCells::triangles), domain), "") << what;
  const CheckResult outside = check(mesh.outer().freeze(), {.min_angle_deg = 30.0});
  EXPECT_TRUE(outside.valid) << what;
  // All points of boundaries are where their curves and parameters say, but for rounding.
  const Domain design = mesh.meshed_domain();
  const CheckResult whole =
      check(mesh.freeze(), {.min_angle_deg = 30.0, .design = &design, .design_rounding = 1e-14});
  EXPECT_TRUE(whole.valid) << what;
  for (std::size_t i = 0; i < std::min<std::size_t>(whole.violations.size(), 3); ++i)
    ADD_FAILURE() << whole.violations[i].detail;
  return mesh;
}

// The edges of a name are one row from an end to the other.
std::size_t rows_of(const FrozenMesh& view, const std::string& name) {
  std::set<std::uint32_t> begins, ends;
  for (const FrozenBoundary& boundary : view.boundaries)
    if (boundary.name == name)
      for (const auto& edge : boundary.edges) begins.insert(edge[0]), ends.insert(edge[1]);
  std::size_t rows = 0;
  for (const std::uint32_t point : begins) rows += !ends.contains(point);
  return rows;
}

double length_of(const FrozenMesh& view, const std::string& name) {
  double length = 0.0;
  for (const FrozenBoundary& boundary : view.boundaries)
    if (boundary.name == name)
      for (const auto& edge : boundary.edges) length += distance(view.points[edge[0]], view.points[edge[1]]);
  return length;
}

TEST(Chains, WallsOfDuctsEndAtOpenings) {
  for (const Domain& domain :
       {channel(), channel(0.3), backwards(channel()), rotated(channel(), 1), rotated(channel(), 3)}) {
    const LayeredMesh mesh = expect_whole(domain, layer_options(1e-4), "channel");
    const FrozenMesh view = mesh.freeze();
    for (const char* name : {"bottom", "outlet", "top", "inlet"}) EXPECT_EQ(rows_of(view, name), 1) << name;
    EXPECT_NEAR(length_of(view, "inlet"), 1.0, 1e-12);
    EXPECT_NEAR(length_of(view, "outlet"), 1.0, 1e-12);
    EXPECT_EQ(mesh.shrunk(), 0);
    EXPECT_EQ(mesh.columns(), 121 + 61);
    EXPECT_EQ(mesh.statistics().thickness.most, 0.02);
  }
}

TEST(Chains, ColumnsAtTheEndsStandOnTheOpenings) {
  const LayeredMesh mesh = expect_whole(channel(), layer_options(1e-4), "channel");
  const FrozenMesh view = mesh.freeze();
  const LayerTopology topology = mesh.topology();
  std::size_t ends = 0;
  for (std::uint32_t c = 0; c < mesh.columns(); ++c) {
    const Point foot = view.points[topology.wall[c]];
    if (foot.x > 0.0 && foot.x < 3.0) continue;
    ++ends;
    for (std::uint32_t level = 0; level <= mesh.levels(); ++level)
      EXPECT_NEAR(view.points[topology.point(c, level)].x, foot.x, 1e-15);
  }
  EXPECT_EQ(ends, 4);
}

TEST(Chains, ALayerGoesOnWhereAnOpeningIsStraightAhead) {
  const LayeredMesh mesh = expect_whole(plate(), layer_options(1e-4), "plate");
  EXPECT_EQ(mesh.columns(), 101);
  const FrozenMesh view = mesh.freeze();
  EXPECT_EQ(rows_of(view, "plate"), 1);
  EXPECT_NEAR(length_of(view, "plate"), 1.0, 1e-12);
  EXPECT_NEAR(length_of(view, "symmetry"), 3.0, 1e-12);
  Domain spaced = plate();
  space_walls(spaced, {.trailing_edge = 0.002, .most = 0.02, .growth = 0.2});
  const Loop& loop = spaced.loops[0];
  EXPECT_NEAR(loop.curves[1].parameters[1], 0.002, 4e-4);
  EXPECT_NEAR(2.0 * (1.0 - loop.curves[0].parameters.values().back()), 0.002, 4e-4);
  // It grows without a bound on the line of symmetry, and to the largest distance on the plate.
  EXPECT_GT(2.0 * loop.curves[0].parameters[1], 0.2);
  EXPECT_LT(loop.curves[1].parameters.size(), 110);
  EXPECT_EQ(loop.curves[3].parameters, plate().loops[0].curves[3].parameters);
  expect_whole(spaced, layer_options(1e-5), "plate with spacings");
}

TEST(Chains, OpeningsMayBeArcsAndPolylines) {
  for (const Domain& domain : {half_circle(), backwards(half_circle()), rotated(half_circle(), 3)})
    expect_whole(domain, {.first_height = 1e-4, .thickness = 0.1}, "half circle");
  Domain bent = channel();
  bent.loops[0].curves[1].shape = Polyline{{{3, 0}, {3, 0.5}, {3.2, 0.75}, {3, 1}}};
  bent.loops[0].curves[1].parameters = Parameters::uniform(6);
  bent.loops[0].curves[2] = line("farfield", {3, 1}, {0, 1}, 20);
  expect_whole(bent, layer_options(1e-4), "polyline");
}

TEST(Chains, OpeningsMayLean) {
  for (const double degrees : {60.0, 60.5, 61.0, 75.0, 90.0, 105.0, 120.0}) {
    const std::string what = std::to_string(degrees);
    for (const double thickness : {0.02, 0.1}) {
      const LayeredMesh mesh =
          expect_whole(leaning(degrees), {.first_height = 1e-4, .thickness = thickness}, what);
      EXPECT_EQ(mesh.shrunk(), 0) << what;
      EXPECT_EQ(mesh.statistics().thickness.least, thickness) << what;
      EXPECT_GT(mesh.statistics().corner_min_deg, 45.0) << what;
    }
  }
}

TEST(Chains, ClosedWallsStandBesideThem) {
  Domain domain = channel();
  Loop strut{.role = LoopRole::hole,
             .curves = {{.name = "strut", .shape = named_airfoil("naca:0012", 8), .parameters = {}}},
             .placement = {.chord = 0.5, .position = {1.2, 0.5}}};
  domain.loops.push_back(strut);
  space_walls(domain, {.leading_edge = 0.004, .trailing_edge = 0.004, .most = 0.03, .growth = 0.2});
  const LayeredMesh mesh = expect_whole(domain, layer_options(1e-4), "strut");
  EXPECT_EQ(rows_of(mesh.freeze(), "strut"), 0);
  EXPECT_EQ(rows_of(mesh.freeze(), "bottom"), 1);
}

TEST(Chains, NarrowDuctsHaveThinLayers) {
  const LayeredMesh mesh = expect_whole(channel(0.02, 0.05, 600), layer_options(1e-5), "narrow");
  const LayerStatistics s = mesh.statistics();
  EXPECT_LT(s.thickness.most, 0.3 * 0.05);
  EXPECT_GT(s.thickness.least, 0.1 * 0.03);
}

TEST(Chains, OpeningsMayBeNumberedAndInUpperCase) {
  const auto walls_with = [](const char* inlet, const char* outlet) {
    Domain domain = channel();
    domain.loops[0].curves[1].name = outlet;
    domain.loops[0].curves[3].name = inlet;
    return layered_walls(domain, layer_options(1e-4)).size();
  };
  for (const auto& [inlet, outlet] :
       {std::pair{"Inlet", "OUTLET"}, {"inlet1", "outlet_2"}, {"inflow-01", "Outflow 2"}})
    EXPECT_EQ(walls_with(inlet, outlet), 2) << inlet << ", " << outlet;
  // What only begins like one is a wall: the whole loop but the inlet.
  EXPECT_EQ(walls_with("inlet", "outlet_lip"), 1);
}

TEST(Chains, TheNamesOfWallsMayBeGiven) {
  const LayeredMesh mesh =
      expect_whole(channel(), {.first_height = 1e-4, .walls = {"bottom"}}, "the lower wall alone");
  EXPECT_EQ(mesh.columns(), 121);
  const LayeredMesh corner = expect_whole(
      channel(), {.first_height = 1e-4, .walls = {"bottom", "outlet", "top"}}, "a duct with a back");
  EXPECT_EQ(corner.columns(), 121 + 60 + 5);
}

std::string refusal(const Domain& domain, const LayerOptions& options = layer_options(1e-4)) {
  try {
    generate_layered(domain, options, chain_quality);
    return "accepted";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(Chains, RefuseHostileOpenings) {
  EXPECT_EQ(refusal(leaning(50)),
            "layers: found an angle of 50 degrees between the wall and loop 0, curve \"inlet\", at (0, 0), "
            "expected 60 to "
            "120 where a layer ends, or 150 to 210 where it goes on");
  EXPECT_NE(refusal(leaning(130)).find("an angle of 130 degrees"), std::string::npos);
  Domain curved = channel();
  curved.loops[0].curves[1].shape = spline_through({{3, 0}, {3.1, 0.5}, {3, 1}});
  EXPECT_NE(refusal(curved).find("a spline or an airfoil, loop 0, curve \"outlet\""), std::string::npos);
  Domain placed = channel();
  placed.loops[0].placement.chord = 2.0;
  EXPECT_NE(refusal(placed).find("found a placement"), std::string::npos);
  Domain joined = channel();
  joined.loops.push_back(
      {.role = LoopRole::internal, .curves = {line("probe", {3, 0.6}, {2, 0.5}, 4)}, .open = true});
  EXPECT_NE(refusal(joined).find("an open line that ends on loop 0, curve \"outlet\""), std::string::npos);
}

// The wake leaves the trailing edge of a closed wall.
TEST(Chains, HaveNoWake) {
  Domain duct = channel();
  EXPECT_THROW(add_wake(duct, {}, layer_options(1e-4)), Error);
  EXPECT_EQ(duct.loops.size(), 1U);
}

TEST(Chains, LiveWithTheirShape) {
  for (const Strategy strategy : {Strategy::renew, Strategy::morph, Strategy::reference}) {
    LayeredMesh mesh = generate_layered(channel(0.1), layer_options(1e-4), steady_quality).mesh;
    const LayerMark mark = mesh.mark();
    const FrozenMesh before = mesh.freeze();
    for (const double height : {0.1005, 0.102, 0.1}) {
      const Domain domain = channel(height);
      const LayeredRemodelResult step = remodel(mesh, domain, {.strategy = strategy});
      EXPECT_FALSE(step.abandoned || step.regenerated) << height;
      EXPECT_TRUE(step.same_columns) << height;
      EXPECT_EQ(mesh.quick_check(), "") << height;
      EXPECT_EQ(why_no_mesh(mesh.freeze(), domain), "") << height;
      EXPECT_EQ(step.triangles, mesh.cells());
    }
    EXPECT_EQ(mesh.changes_since(mark).layer_born, 0);
    if (strategy == Strategy::reference) {
      EXPECT_TRUE(mesh.freeze().points == before.points);
      EXPECT_TRUE(mesh.freeze().quads == before.quads);
    }
  }
}

// A nearly straight wall bulges in and out: triangles between it and the convex hull turn over.
TEST(Chains, DuctsKeepTheirConnectivity) {
  const auto seed = test::seed(2207);
  SCOPED_TRACE("REMODEL_TEST_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  for (const Strategy strategy : {Strategy::morph, Strategy::reference}) {
    LayeredMesh mesh = generate_layered(channel(1e-3), layer_options(1e-4), steady_quality).mesh;
    const auto triangles = mesh.outer().freeze().triangles;
    for (int i = 0; i < 10; ++i) {
      const Domain domain = channel(test::uniform(random, -1e-3, 1e-3));
      const LayeredRemodelResult step = remodel(mesh, domain, {.strategy = strategy});
      EXPECT_TRUE(step.morphed || step.full_adjustment) << name_of(strategy);
      EXPECT_EQ(step.held, strategy == Strategy::reference);
      EXPECT_EQ(why_no_mesh(mesh.freeze(), domain), "");
      if (step.held) {
        EXPECT_EQ(mesh.outer().freeze().triangles, triangles);
      }
      const LayeredState here = mesh.state();
      EXPECT_EQ(LayeredMesh::restore(here, "state").state(), here);
      { const LayeredTrial trial(mesh, channel(-0.01), {.strategy = strategy}); }
      EXPECT_EQ(mesh.state(), here);
    }
    remodel(mesh, channel(0.1), {.strategy = Strategy::renew});  // replaces what is at the walls
    EXPECT_EQ(mesh.quick_check(), "");
    EXPECT_EQ(why_no_mesh(mesh.freeze(), channel(0.1)), "");
  }
}

TEST(Chains, TrialsAndStatesReturn) {
  LayeredMesh mesh = generate_layered(channel(0.1), layer_options(1e-4), steady_quality).mesh;
  const LayeredState state = mesh.state();
  {
    const LayeredTrial trial(mesh, channel(0.2), {.strategy = Strategy::morph});
    EXPECT_EQ(why_no_mesh(mesh.freeze(), channel(0.2)), "");
  }
  EXPECT_EQ(mesh.state(), state);
  const LayeredMesh restored = LayeredMesh::restore(state, "state");
  EXPECT_EQ(restored.state(), state);
  EXPECT_EQ(restored.freeze().points, mesh.freeze().points);
  const LayeredMesh at = mesh_at(mesh, channel(0.1005));
  EXPECT_EQ(why_no_mesh(at.freeze(), channel(0.1005)), "");
  EXPECT_EQ(at.freeze().quads, mesh.freeze().quads);
}

// The lower corner at the outlet moves along it, and the wall with it.
TEST(Chains, DerivativesFollowWallsAndOpenings) {
  const Domain base = channel(0.1, 1.0, 60);
  const auto design = [&](double by) {
    Domain domain = base;
    Curve& bottom = domain.loops[0].curves[0];
    std::vector<Point> points = std::get<Spline>(bottom.shape).points;
    for (Point& p : points) p.y += by * p.x;
    bottom.shape = spline_through(points);
    std::get<Line>(domain.loops[0].curves[1].shape).from.y = points.back().y;
    return domain;
  };
  // The first cells are much lower than the steps of the derivative's differences.
  const LayeredMesh mesh = generate_layered(base, layer_options(1e-6), chain_quality).mesh;
  const LayeredMeshDerivative derivative(mesh);
  const double step = 1e-4;
  const std::vector<double> plus = coefficients_of(design(step)), minus = coefficients_of(design(-step));
  std::vector<double> direction(plus.size());
  for (std::size_t i = 0; i < plus.size(); ++i) direction[i] = (plus[i] - minus[i]) / (2 * step);
  const std::vector<Point> moved = derivative.jvp(direction);
  const FrozenMesh there = mesh_at(mesh, design(step)).freeze(), back = mesh_at(mesh, design(-step)).freeze();
  const LayerTopology topology = mesh.topology();
  ASSERT_EQ(moved.size(), there.points.size());
  for (std::size_t p = 0; p < topology.column.size(); ++p)
    EXPECT_LT(distance(moved[p], (0.5 / step) * (there.points[p] - back.points[p])), 1e-6) << p;
}

}  // namespace
}  // namespace remodel::test
