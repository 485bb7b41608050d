// The general case: any domain into any other. Loops that move across the mesh, appear, vanish, merge;
// chains, cracks, single points; placed elements; domains that correspond one to one without an airfoil in
// them.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "mesh/mesh_data.h"
#include "remodel/check.h"
#include "remodel/generate.h"
#include "remodel/planar.h"
#include "remodel/remodel.h"
#include "step/test_designs.h"

namespace remodel {
namespace {

using test::circle_hole;
using test::polygon;
using test::rectangle;
using test::square_hole;
using test::star_hole;
using test::with_holes;

void expect_valid(const Mesh& mesh, const std::string& where) {
  ASSERT_EQ(mesh.quick_check(), "") << where;
  const CheckResult checked = check(mesh.freeze(), {.min_angle_deg = mesh.options().min_angle_deg,
                                                    .max_gradation = mesh.options().max_gradation,
                                                    .design = &mesh.domain()});
  for (const Violation& violation : checked.violations)
    ADD_FAILURE() << where << ": " << violation.rule << ": " << violation.detail;
}

RemodelResult step(Mesh& mesh, const Domain& domain, const std::string& where,
                   Method method = Method::automatic) {
  const RemodelResult result = remodel(mesh, domain, {.method = method, .strategy = Strategy::chain});
  EXPECT_EQ(result.stopped, Stopped::done) << where;
  EXPECT_FALSE(result.regenerated) << where << ": " << result.reason;
  expect_valid(mesh, where);
  return result;
}

Loop chain(LoopRole role, std::string name, std::vector<Point> points) {
  const std::size_t pieces = points.size() - 1;
  Loop loop = test::loop(role, std::move(name), Polyline{std::move(points)}, pieces);
  loop.open = true;
  return loop;
}

Loop crack(Point from, Point to) {
  return chain(LoopRole::internal, "crack",
               {from, {0.5 * (from.x + to.x), 0.5 * (from.y + to.y) + 0.01}, to});
}

Loop point(Point p) {
  Loop loop = test::loop(LoopRole::internal, "point", Line{p, p}, 1);
  loop.open = true;
  return loop;
}

Loop placed(Loop loop, const Placement& placement) {
  loop.placement = placement;
  return loop;
}

Domain without_loops_like(Domain domain, const std::string& name) {
  std::erase_if(domain.loops, [&](const Loop& loop) { return loop.curves.front().name == name; });
  return domain;
}

// Domains in the unit square: any of them can follow any other.
std::vector<std::pair<std::string, Domain>> domains() {
  const std::vector<Point> box{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  PlanarGraph graph;
  graph.points = box;
  graph.segments = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  graph.points.insert(graph.points.end(), {{0, 0.4}, {1, 0.6}, {0.3, 0}, {0.6, 1}, {0.45, 0.05}, {0.9, 0.2}});
  graph.segments.insert(graph.segments.end(), {{4, 5, 7}, {6, 7, 8}, {8, 9, 0}});
  const Domain crossed = planar_domain(graph, "graph");
  const Domain one = with_holes({circle_hole(0.3, 0.5, 0.12)});
  const Spline blob =
      spline_through({{0.7, 0.5}, {0.6, 0.7}, {0.4, 0.6}, {0.35, 0.4}, {0.55, 0.3}, {0.7, 0.5}});
  return {
      {"empty", with_holes({})},
      {"circle", one},
      {"two circles", with_holes({circle_hole(0.3, 0.5, 0.12), circle_hole(0.7, 0.5, 0.1)})},
      {"square", with_holes({square_hole(0.5, 0.5, 0.2)})},
      {"star", with_holes({star_hole(0.5, 0.5, 0.3)})},
      {"many", with_holes({square_hole(0.2, 0.2, 0.05), circle_hole(0.8, 0.2, 0.1, 24),
                           star_hole(0.5, 0.75, 0.15, 7), circle_hole(0.2, 0.8, 0.01, 8)})},
      {"crack", with_holes({crack({0.2, 0.5}, {0.8, 0.55})})},
      {"crack and hole", with_holes({crack({0.1, 0.1}, {0.4, 0.2}), circle_hole(0.6, 0.6, 0.2)})},
      {"points", with_holes({point({0.31, 0.47}), point({0.77, 0.7})})},
      {"crossing chains", crossed},
      {"spline", with_holes({test::loop(LoopRole::hole, "blob", blob, 20)})},
      {"island", with_holes({square_hole(0.5, 0.5, 0.35),
                             rectangle(LoopRole::outer, "island", {0.35, 0.35}, {0.65, 0.65}, 2)})},
      {"turned square", with_holes({placed(square_hole(0, 0, 0.2), {1.3, 30.0, {0.5, 0.5}})})},
  };
}

TEST(GeneralCase, EveryDomainIntoEveryOtherAndBack) {
  const auto all = domains();
  for (const auto& [from_name, from] : all) {
    validate(from);
    GenerateResult start = generate(from);
    ASSERT_EQ(start.stopped, Stopped::done) << from_name;
    expect_valid(start.mesh, from_name);
    for (const auto& [to_name, to] : all) {
      const std::string where = from_name + " to " + to_name;
      Mesh mesh = start.mesh;
      const RemodelResult there = step(mesh, to, where);
      if (from_name == to_name) {
        EXPECT_EQ(there.preserved, there.triangles_before) << where;
        EXPECT_TRUE(mesh.state() == start.mesh.state()) << where;
      }
      // The paper's method coarsens only where something is removed.
      const std::size_t fresh = generate(to).mesh.triangle_count();
      EXPECT_LE(mesh.triangle_count(), 2 * std::max(fresh, there.triangles_before) + 200) << where;
      step(mesh, from, where + " and back");
      Mesh by_general = start.mesh;
      step(by_general, to, where + ", general", Method::general);
      const Mesh restored = Mesh::restore(mesh.state(), "state");
      EXPECT_TRUE(restored.state() == mesh.state()) << where;
    }
  }
}

TEST(GeneralCase, ATrialOfEveryDomainReturnsToTheLastBit) {
  const auto all = domains();
  for (const auto& [from_name, from] : all) {
    Mesh mesh = generate(from).mesh;
    const MeshState before = mesh.state();
    for (const auto& [to_name, to] : all) {
      { const Trial trial(mesh, to, {.strategy = Strategy::chain}); }
      ASSERT_TRUE(mesh.state() == before) << from_name << " to " << to_name;
    }
  }
}

TEST(GeneralCase, TwoCirclesSwapPlaces) {
  const auto circles = [](Point a, Point b) {
    Domain domain = with_holes({circle_hole(a.x, a.y, 0.12), circle_hole(b.x, b.y, 0.06)});
    domain.loops[1].curves[0].name = "large";
    domain.loops[2].curves[0].name = "small";
    return domain;
  };
  const Domain before = circles({0.3, 0.5}, {0.7, 0.5}), after = circles({0.7, 0.5}, {0.3, 0.5});
  Mesh mesh = generate(before).mesh;
  step(mesh, after, "at once");
  step(mesh, before, "back");
  for (int i = 1; i <= 20; ++i) {  // and half around each other
    const Point arm = 0.2 * Point{std::cos(std::numbers::pi * i / 20), std::sin(std::numbers::pi * i / 20)};
    step(mesh, circles({0.5 - arm.x, 0.5 - arm.y}, {0.5 + arm.x, 0.5 + arm.y}), "step " + std::to_string(i));
  }
  EXPECT_LT(mesh.triangle_count(), 2 * generate(after).mesh.triangle_count());
}

TEST(GeneralCase, ASquareBecomesAStar) {
  Mesh mesh = generate(with_holes({square_hole(0.5, 0.5, 0.2)})).mesh;
  const RemodelResult result = step(mesh, with_holes({star_hole(0.5, 0.5, 0.3)}), "star");
  EXPECT_EQ(result.method, Method::general);
}

TEST(GeneralCase, LoopsVanishAndAppear) {
  Domain domain = with_holes({circle_hole(0.3, 0.5, 0.1), circle_hole(0.7, 0.5, 0.1)});
  Mesh mesh = generate(domain).mesh;
  domain.loops.pop_back();
  step(mesh, domain, "one hole less");
  step(mesh, without_loops_like(domain, "hole"), "none");
  step(mesh, domain, "one again");
}

// What is far from the change is not touched: these triangles survive with their ids.
TEST(GeneralCase, WhatIsFarFromTheChangeIsNotTouched) {
  const auto design = [](double r) {
    return with_holes({circle_hole(0.2, 0.2, r), circle_hole(0.8, 0.8, 0.1), crack({0.1, 0.9}, {0.4, 0.85})});
  };
  Mesh mesh = generate(design(0.1), {.gradation = 50.0}).mesh;
  const FrozenMesh before = mesh.freeze();
  step(mesh, design(0.07), "a smaller circle");
  const FrozenMesh after = mesh.freeze();
  std::set<std::array<std::uint32_t, 3>> left;
  for (const auto& t : after.triangles)
    left.insert({after.vertex_ids[t[0]], after.vertex_ids[t[1]], after.vertex_ids[t[2]]});
  std::size_t far = 0;
  for (const auto& t : before.triangles) {
    const auto distant = [&](std::uint32_t v) {
      return before.points[v].x > 0.6 || before.points[v].y > 0.6;
    };
    if (!std::all_of(t.begin(), t.end(), distant)) continue;
    ++far;
    EXPECT_TRUE(left.contains({before.vertex_ids[t[0]], before.vertex_ids[t[1]], before.vertex_ids[t[2]]}));
  }
  EXPECT_GT(far, 10U);
}

// ---- one to one without an airfoil: small changes are full adjustments

TEST(OneToOne, ARigidMotionOfOneElementIsAFullAdjustment) {
  const auto design = [](double degrees, double x) {
    return with_holes(
        {placed(star_hole(0, 0, 0.2), {1.0, degrees, {0.4 + x, 0.5}}), circle_hole(0.85, 0.5, 0.05)});
  };
  Mesh mesh = generate(design(0, 0)).mesh;
  const RemodelResult result = step(mesh, design(1e-3, 1e-6), "a little");
  EXPECT_TRUE(result.full_adjustment);
  EXPECT_EQ(result.method, Method::specialised);
  EXPECT_EQ(
      result.moved, 10U + mesh.statistics().steiner_boundary_vertices - [&] {
        std::size_t fixed = 0;  // Steiner vertices of the loops that stay
        for (std::size_t loop : {0U, 2U})
          mesh.data().walk(mesh.data().loop_heads[loop],
                           [&](std::uint32_t k) { fixed += mesh.data().at(k).steiner; });
        return fixed;
      }());
  for (int i = 1; i <= 40; ++i) step(mesh, design(9.0 * i, 0.001 * i), "degrees " + std::to_string(9 * i));
}

TEST(OneToOne, ASplineWhosePointsMoveIsAdjusted) {
  const auto design = [](double bump) {
    const Spline blob = spline_through(
        {{0.7, 0.5}, {0.6 + bump, 0.7}, {0.4, 0.6}, {0.35, 0.4 - bump}, {0.55, 0.3}, {0.7, 0.5}});
    return with_holes({test::loop(LoopRole::hole, "blob", blob, 30)});
  };
  Mesh mesh = generate(design(0.0)).mesh;
  EXPECT_TRUE(step(mesh, design(1e-6), "a little").full_adjustment);
  for (int i = 1; i <= 20; ++i) {
    const RemodelResult result = step(mesh, design(0.004 * i), "step " + std::to_string(i));
    EXPECT_EQ(result.method, Method::specialised);
  }
}

TEST(OneToOne, AFreeCrackMoves) {
  const auto design = [](double y) { return with_holes({crack({0.2, 0.5 + y}, {0.8, 0.55 - y})}); };
  Mesh mesh = generate(design(0.0)).mesh;
  EXPECT_TRUE(step(mesh, design(1e-6), "a little").full_adjustment);
  for (int i = 1; i <= 20; ++i)
    EXPECT_EQ(step(mesh, design(0.01 * i), "step " + std::to_string(i)).method, Method::specialised);
}

// Where all of the old boundary would be gone at once nothing holds the mesh for the specialised method.
TEST(OneToOne, WhereTheWholeBoundaryGoesTheGeneralMethodTakesOver) {
  const auto design = [](double x, double degrees) {
    const Placement placement{1.0, degrees, {x, 0}};
    return Domain{{placed(rectangle(LoopRole::outer, "outer", {-1, -1}, {1, 1}, 3), placement),
                   placed(star_hole(0, 0, 0.5), placement)}};
  };
  Mesh mesh = generate(design(0, 0)).mesh;
  EXPECT_TRUE(step(mesh, design(1e-6, 0), "a little").full_adjustment);
  EXPECT_EQ(step(mesh, design(5, 40), "far").method, Method::general);
  EXPECT_EQ(step(mesh, design(5.3, 50), "less far").method, Method::specialised);
}

// A duct of one loop: inlet, a wall that bulges, outlet and a flat wall.
Domain duct(double bulge, std::size_t wall_stations) {
  const auto curve = [](const char* name, Shape shape, std::size_t stations) {
    return Curve{name, std::move(shape), Parameters::uniform(stations)};
  };
  const Spline wall = spline_through({{0, 0}, {0.7, bulge}, {1.2, 0.3}, {2, 0.25}, {3, 0}});
  return {
      {{LoopRole::outer,
        {curve("inlet", Polyline{{{0, 1}, {0, 0}}}, 5), curve("bulge", wall, wall_stations),
         curve("outlet", Polyline{{{3, 0}, {3, 1}}}, 5), curve("wall", Polyline{{{3, 1}, {0, 1}}}, 12)}}}};
}

// The vertices of each boundary, by its name. Refinement may add some; that none goes means that the curve
// was not replaced.
std::map<std::string, std::set<std::uint32_t>> vertices_of_boundaries(const Mesh& mesh) {
  const FrozenMesh frozen = mesh.freeze();
  std::map<std::string, std::set<std::uint32_t>> vertices;
  for (const FrozenBoundary& boundary : frozen.boundaries)
    for (const auto& edge : boundary.edges)
      for (const std::uint32_t point : edge) vertices[boundary.name].insert(frozen.vertex_ids[point]);
  return vertices;
}

void expect_kept(const std::map<std::string, std::set<std::uint32_t>>& before, const Mesh& mesh) {
  const auto after = vertices_of_boundaries(mesh);
  for (const char* name : {"inlet", "outlet", "wall"})
    EXPECT_TRUE(std::includes(after.at(name).begin(), after.at(name).end(), before.at(name).begin(),
                              before.at(name).end()))
        << name;
}

TEST(OneToOne, AWallOfTheOnlyLoopMovesAndTheOthersKeepTheirTriangles) {
  Mesh mesh = generate(duct(0.05, 24), {.resolution = 4.0}).mesh;
  const auto before = vertices_of_boundaries(mesh);
  const RemodelResult result = step(mesh, duct(0.10, 24), "bulge");
  EXPECT_EQ(result.method, Method::specialised);
  EXPECT_GT(result.preserved_percent(), 50.0);
  expect_kept(before, mesh);
}

TEST(General, CurvesThatStayKeepTheirEdgesAndWhatLiesAtThem) {
  Mesh mesh = generate(duct(0.05, 24), {.resolution = 4.0}).mesh;
  for (const std::size_t stations : {30U, 17U, 24U}) {
    const auto before = vertices_of_boundaries(mesh);
    const RemodelResult result = step(mesh, duct(0.05 + 1e-3 * static_cast<double>(stations), stations),
                                      std::to_string(stations) + " stations");
    EXPECT_EQ(result.method, Method::general);
    EXPECT_FALSE(result.regenerated) << result.reason;
    EXPECT_GT(result.preserved_percent(), 30.0);
    expect_kept(before, mesh);
  }
}

// What joins a chain that moves would be torn off it: the general method replaces both.
TEST(OneToOne, WhatIsJoinedIsReplacedByTheGeneralMethod) {
  const auto design = [](double y) {
    const Loop wake = chain(LoopRole::internal, "wake", {{0.7, 0.5 + y}, {1.0, 0.5 + y}});
    Domain domain{{rectangle(LoopRole::outer, "outer", {0, 0}, {1, 1}, 1)}};
    domain.loops[0] = polygon(LoopRole::outer, "outer", {{0, 0}, {1, 0}, {1, 0.5 + y}, {1, 1}, {0, 1}});
    domain.loops.push_back(polygon(LoopRole::hole, "body", {{0.7, 0.5 + y}, {0.3, 0.6}, {0.3, 0.4}}));
    domain.loops.push_back(wake);
    return domain;
  };
  Mesh mesh = generate(design(0.0)).mesh;
  expect_valid(mesh, "start");
  for (int i = 1; i <= 10; ++i)
    EXPECT_EQ(step(mesh, design(0.01 * i), "step " + std::to_string(i)).method, Method::general);
}

// A flap that turns by 40 degrees and moves by its own chord, at once and in steps.
TEST(GeneralCase, AFlapTurnsAndMovesByItsOwnChord) {
  const CstAirfoil section = airfoil_catalogue()[0].airfoil();
  const auto design = [&](double degrees, double shift) {
    return airfoils_domain({{.name = "main", .airfoil = section},
                            {.name = "flap",
                             .airfoil = section,
                             .placement = {0.3, -degrees, {1.02 + shift, -0.03 - 0.5 * shift}}}},
                           {.points = 60});
  };
  Mesh mesh = generate(design(0, 0)).mesh;
  expect_valid(mesh, "start");
  step(mesh, design(40, 0.3), "at once");
  step(mesh, design(0, 0), "back");
  for (int i = 1; i <= 20; ++i) step(mesh, design(2.0 * i, 0.015 * i), "step " + std::to_string(i));
}

}  // namespace
}  // namespace remodel
