// Domains of any size, anywhere: meshes that scale with their domain, and refinement that ends by a limit
// where doubles are too coarse for it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mesh/mesh_data.h"
#include "remodel/check.h"
#include "remodel/error.h"
#include "remodel/generate.h"
#include "remodel/planar.h"
#include "remodel/remodel.h"
#include "step/test_designs.h"
#include "support.h"

namespace remodel {
namespace {

// ---- one domain of each kind

Loop chain(LoopRole role, std::string name, std::vector<Point> points) {
  const std::size_t pieces = points.size() - 1;
  Loop result = test::loop(role, std::move(name), Polyline{std::move(points)}, pieces);
  result.open = true;
  return result;
}

Loop point(Point p) {
  Loop result = test::loop(LoopRole::internal, "point", Line{p, p}, 1);
  result.open = true;
  return result;
}

Domain duct() {
  const Spline bump = spline_through({{0, 0}, {0.4, 0.02}, {0.5, 0.1}, {0.6, 0.02}, {1, 0}});
  Loop wall{.role = LoopRole::left, .curves = {{"wall", bump, Parameters::uniform(20)}}, .open = true};
  Loop rest = chain(LoopRole::left, "rest", {{1, 0}, {1, 0.5}, {0, 0.5}, {0, 0}});
  return {{wall, rest}};
}

Domain placed_airfoils() {
  const CstAirfoil section = airfoil_catalogue()[0].airfoil();
  return airfoils_domain({{.name = "main", .airfoil = section},
                          {.name = "flap", .airfoil = section, .placement = {0.3, -20.0, {1.1, -0.1}}}},
                         {.points = 60, .farfield_radius = 8, .farfield_points = 24});
}

std::vector<std::pair<std::string, Domain>> domains() {
  return {
      {"airfoil", test::catalogue_domain(2, 60)},
      {"placed airfoils", placed_airfoils()},
      {"circles", test::with_holes({test::circle_hole(0.3, 0.5, 0.12), test::circle_hole(0.7, 0.5, 0.1)})},
      {"square", test::with_holes({test::square_hole(0.5, 0.5, 0.2)})},
      {"star", test::with_holes({test::star_hole(0.5, 0.5, 0.3)})},
      {"duct", duct()},
      {"crack",
       test::with_holes({chain(LoopRole::internal, "crack", {{0.2, 0.5}, {0.5, 0.53}, {0.8, 0.5}})})},
      {"a point", test::with_holes({point({0.5, 0.5})})},
      {"a point beside a circle", test::with_holes({point({0.46, 0.5}), test::circle_hole(0.3, 0.5, 0.12)})},
      {"points", test::with_holes({point({0.31, 0.47}), point({0.33, 0.47}), point({0.77, 0.7})})},
  };
}

Shape scaled(const Shape& shape, double factor) {
  const auto times = [factor](std::vector<Point> points) {
    for (Point& p : points) p = factor * p;
    return points;
  };
  if (const auto* line = std::get_if<Line>(&shape)) return Line{factor * line->from, factor * line->to};
  if (const auto* polyline = std::get_if<Polyline>(&shape)) return Polyline{times(polyline->points)};
  if (const auto* spline = std::get_if<Spline>(&shape)) return spline_through(times(spline->points));
  if (auto arc = std::get_if<Arc>(&shape)) {
    Arc result = *arc;
    result.centre = factor * arc->centre;
    result.radius = factor * arc->radius;
    return result;
  }
  return shape;
}

// An airfoil has its size from its place; other curves are scaled themselves.
Domain scaled(Domain domain, double factor) {
  for (Loop& loop : domain.loops) {
    if (std::holds_alternative<CstAirfoil>(loop.curves.front().shape)) {
      loop.placement.chord *= factor;
      loop.placement.position = factor * loop.placement.position;
      continue;
    }
    for (Curve& curve : loop.curves) curve.shape = scaled(curve.shape, factor);
  }
  return domain;
}

void expect_scaled(const MeshState& one, const MeshState& other, double factor) {
  ASSERT_EQ(other.triangle_vertices, one.triangle_vertices);
  ASSERT_EQ(other.triangle_links, one.triangle_links);
  ASSERT_EQ(other.vertex_parameters, one.vertex_parameters);
  for (std::size_t v = 1; v < one.vertex_stars.size(); ++v) {
    if (one.vertex_stars[v] == no_index) continue;
    ASSERT_EQ(other.coordinates[2 * v], factor * one.coordinates[2 * v]) << "vertex " << v;
    ASSERT_EQ(other.coordinates[2 * v + 1], factor * one.coordinates[2 * v + 1]) << "vertex " << v;
    ASSERT_EQ(other.length_scales[v], factor * one.length_scales[v]) << "vertex " << v;
  }
}

// Through generation, and a step to the next domain of the list by either strategy.
TEST(Size, EveryKindOfDomainHasTheSameMeshAtEveryPowerOfTwo) {
  const auto all = domains();
  for (std::size_t i = 0; i < all.size(); ++i)
    for (const double factor : {0x1p-30, 0x1p-3, 0x1p5, 0x1p30}) {
      SCOPED_TRACE(all[i].first + " times " + std::to_string(factor));
      const Domain& next = all[(i + 1) % all.size()].second;
      Mesh one = test::generated(all[i].second, {}),
           other = test::generated(scaled(all[i].second, factor), {});
      ASSERT_NO_FATAL_FAILURE(expect_scaled(one.state(), other.state(), factor));
      for (const Strategy strategy : {Strategy::chain, Strategy::renew}) {
        remodel(one, next, {.strategy = strategy});
        remodel(other, scaled(next, factor), {.strategy = strategy});
        ASSERT_NO_FATAL_FAILURE(expect_scaled(one.state(), other.state(), factor));
        ASSERT_EQ(other.quick_check(), "");
      }
    }
}

// Other factors round: the meshes are not the same, but they are as large.
TEST(Size, EveryKindOfDomainHasAsManyTrianglesAtEverySize) {
  for (const auto& [name, domain] : domains()) {
    const auto expected = static_cast<double>(test::generated(domain, {}).triangle_count());
    for (const double factor : {1e-9, 0.1, 3.0, 1e7, 1e9}) {
      const Mesh mesh = test::generated(scaled(domain, factor), {});
      EXPECT_EQ(mesh.quick_check(), "") << name << " times " << factor;
      EXPECT_NEAR(static_cast<double>(mesh.triangle_count()), expected, 0.1 * expected + 10)
          << name << " times " << factor;
    }
  }
}

// The length scale of a single point follows the nearest station, on a fresh mesh and where it is moved to.
TEST(SinglePoint, HasItsLengthScaleFromTheNearestFeature) {
  const double size = 1e4;
  const auto domain = [&](double x) { return scaled(test::with_holes({point({x, 0.5})}), size); };
  for (const Method method : {Method::specialised, Method::general}) {
    Mesh mesh = test::generated(domain(0.5), {});
    for (const double x : {0.5, 0.9, 0.97, 0.4}) {
      const RemodelResult result = remodel(mesh, domain(x), {.method = method, .strategy = Strategy::renew});
      EXPECT_FALSE(result.regenerated) << result.reason;
      const double nearest = size * std::min({x, 1.0 - x, 0.5});  // the middle of a side is a station
      const double found = mesh.data().length_scale(mesh.data().loop_heads[1]);
      EXPECT_NEAR(found, nearest, 0.01 * nearest) << "at " << x;
      EXPECT_EQ(mesh.quick_check(), "");
    }
  }
}

// ---- far from the origin

// A graph at the coordinates of a map, at the vertex and angle limits given to the mesh.
PlanarGraph map_graph() {
  PlanarGraph graph;
  graph.points = {{403218.728, 5492388.775}, {403318.142, 5492388.150}, {403318.758, 5492488.033},
                  {403218.678, 5492488.062}, {403245.139, 5492433.236}, {403254.548, 5492434.749},
                  {403254.458, 5492446.538}, {403296.422, 5492427.209}};
  graph.segments = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 4}, {7, 4}, {8 - 1, 5}};
  return graph;
}

// Valid in all but what a limit may have cost, and within the limits.
void expect_sound(const Mesh& mesh, Stopped stopped) {
  const QualityOptions& options = mesh.options();
  EXPECT_LE(mesh.statistics().vertices, options.max_vertices + 10000);
  const bool done = stopped == Stopped::done;
  const CheckResult checked = check(mesh.freeze(), {.min_angle_deg = done ? options.min_angle_deg : 0.0,
                                                    .max_gradation = done ? options.max_gradation : 0.0,
                                                    .design = &mesh.domain()});
  for (const Violation& violation : checked.violations)
    ADD_FAILURE() << violation.rule << ": " << violation.detail;
  if (done) {
    EXPECT_EQ(mesh.quick_check(), "");
  }
}

TEST(FarFromTheOrigin, TheMeshOfAMapEndsAtEveryAngle) {
  const Domain domain = planar_domain(map_graph(), "map");
  for (const double angle : {20.0, 30.0, 33.0, 34.0}) {
    GenerateResult result = generate(domain, {.min_angle_deg = angle, .max_vertices = 30000});
    SCOPED_TRACE("angle " + std::to_string(angle));
    expect_sound(result.mesh, result.stopped);
    if (angle <= 30.0) {
      EXPECT_EQ(result.stopped, Stopped::done);
    }
  }
}

// A square with a few segments, some of them crossing or joined, and a few points.
PlanarGraph random_graph(std::mt19937_64& random) {
  PlanarGraph graph;
  graph.points = {{0, 0}, {1, 0.01}, {0.99, 1}, {0.01, 0.98}};
  graph.segments = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  const auto inside = [&] { return test::uniform(random, 0.05, 0.95); };
  for (std::uint64_t n = 2 + random() % 6; n > 0; --n) {
    const auto from = static_cast<std::uint32_t>(graph.points.size());
    graph.points.push_back({inside(), inside()});
    if (random() % 4 == 0) continue;
    graph.points.push_back({inside(), inside()});
    graph.segments.push_back({from, from + 1});
    if (random() % 2 == 0)
      graph.segments.push_back({4 + static_cast<std::uint32_t>(random() % (from - 3)), from});
  }
  return graph;
}

PlanarGraph placed(PlanarGraph graph, double size, Point shift) {
  for (Point& p : graph.points) p = shift + size * p;
  return graph;
}

// Sizes from 1e-9 to 1e9, and up to 1e9 times the size away: meshes, and steps to another graph there. What
// is too coarse for a graph is refused as such.
TEST(FarFromTheOrigin, RefinementEndsByALimitWhateverThePlace) {
  const auto seed = test::seed(901);
  SCOPED_TRACE("REMODEL_TEST_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  int done = 0, limited = 0, refused = 0;
  for (int turn = 0; turn < 60 * test::effort(); ++turn) {
    const double size = std::pow(10.0, test::uniform(random, -9.0, 9.0));
    const double away = random() % 4 == 0 ? 0.0 : size * std::pow(10.0, test::uniform(random, 0.0, 9.0));
    const double direction = test::uniform(random, 0.0, 6.28);
    const Point shift{away * std::cos(direction), away * std::sin(direction)};
    const QualityOptions options{.min_angle_deg = test::uniform(random, 20.0, 34.0), .max_vertices = 3000};
    SCOPED_TRACE("turn " + std::to_string(turn));
    try {
      const Domain domain = planar_domain(placed(random_graph(random), size, shift), "graph");
      const Domain next = planar_domain(placed(random_graph(random), size, shift), "graph");
      GenerateResult fresh = generate(domain, options);
      expect_sound(fresh.mesh, fresh.stopped);
      const RemodelResult result = remodel(fresh.mesh, next, {.strategy = Strategy::renew});
      expect_sound(fresh.mesh, result.stopped);
      ++(result.stopped == Stopped::done ? done : limited);
    } catch (const Error&) {
      ++refused;
    }
  }
  std::printf("%d done, %d at a limit, %d refused\n", done, limited, refused);
  EXPECT_GT(done, refused);
}

}  // namespace
}  // namespace remodel
