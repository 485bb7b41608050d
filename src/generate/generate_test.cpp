#include "remodel/generate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/mesh_data.h"
#include "mesh/small_angles.h"
#include "remodel/check.h"
#include "remodel/error.h"
#include "remodel/limits.h"
#include "step/test_designs.h"

namespace remodel {
namespace {

using test::polygon;
using test::rectangle;

Domain outer(std::vector<Point> corners, std::size_t pieces = 1) {
  return {{polygon(LoopRole::outer, "outer", std::move(corners), pieces)}};
}

// A mesh that is done and passes every check, the independent one with the design included.
Mesh valid(const Domain& domain, const QualityOptions& options = {}) {
  GenerateResult result = generate(domain, options);
  EXPECT_EQ(result.stopped, Stopped::done);
  EXPECT_EQ(result.exempt_triangles, 0U);
  EXPECT_EQ(result.mesh.quick_check(), "");
  EXPECT_EQ(result.mesh.data().triangulation.check(), "");
  EXPECT_EQ(result.mesh.step(), 0U);
  const MeshStatistics statistics = result.mesh.statistics();
  const MeshCounts counts = counts_of(result.mesh);
  EXPECT_EQ(counts.triangles, statistics.triangles);
  EXPECT_EQ(counts.vertices, statistics.vertices);
  EXPECT_EQ(counts.steiner_boundary_vertices, statistics.steiner_boundary_vertices);
  std::map<std::string, std::size_t> boundary;
  for (const FrozenBoundary& part : result.mesh.freeze().boundaries) boundary[part.name] += part.edges.size();
  EXPECT_EQ(counts.boundary, boundary);
  EXPECT_GE(statistics.min_angle_deg, options.min_angle_deg);
  EXPECT_LE(statistics.max_gradation, 1.0);
  const CheckResult checked = check(result.mesh.freeze(), {.min_angle_deg = options.min_angle_deg,
                                                           .max_gradation = options.max_gradation,
                                                           .design = &domain,
                                                           .max_violations = 1});
  EXPECT_TRUE(checked.valid) << (checked.violations.empty() ? "" : checked.violations[0].detail);
  return std::move(result.mesh);
}

// What must hold of boundary vertices: on their curves, Steiner vertices in the middle of the parameters of
// what they split (so all parameters are stations halved some times), length scales as their rule says or
// lower.
void check_boundary_vertices(const Mesh& mesh) {
  const MeshData& data = mesh.data();
  for (const std::uint32_t head : data.loop_heads) {
    std::uint32_t k = head;
    do {
      const BoundaryVertex& v = data.at(k);
      EXPECT_EQ(data.point(k), data.domain.at({v.curve, v.t}));
      EXPECT_GT(data.length_scale(k), 0.0);
      EXPECT_LE(v.scale_factor, 1.0 + 1e-12);
      EXPECT_NEAR(data.length_scale(k), data.base_length_scale(k) * v.scale_factor,
                  1e-12 * data.length_scale(k));
      if (v.steiner) {
        const BoundaryVertex &before = data.at(data.non_steiner_before(k)),
                             &after = data.at(data.non_steiner_after(k));
        const double t0 = before.curve == v.curve ? before.t : 0.0;
        const double t1 = after.curve == v.curve && after.t > t0 ? after.t : 1.0;
        double low = t0, high = t1;
        while (low < v.t && v.t < high && 0.5 * (low + high) != v.t) {
          const double middle = 0.5 * (low + high);
          (v.t < middle ? high : low) = middle;
          if (high - low < 1e-9) break;
        }
        EXPECT_EQ(0.5 * (low + high), v.t) << "of curve " << v.curve;
      }
      k = v.next;
    } while (k != head);
  }
}

// LS grows by no more than distance / G along an edge that an inner vertex was given its scale over: at its
// birth the vertex had the least of LS(u) + |uv| / G. Of the mesh that is left, a bound holds: it is at least
// the least scale of the boundary, and at most what the boundary's nearest vertex allows.
void check_inner_scales(const Mesh& mesh) {
  const FrozenMesh frozen = mesh.freeze();
  double least = INFINITY;
  for (std::size_t p = 0; p < frozen.points.size(); ++p)
    if (frozen.curve[p] >= 0) least = std::min(least, frozen.length_scale[p]);
  for (std::size_t p = 0; p < frozen.points.size(); ++p)
    EXPECT_GE(frozen.length_scale[p], frozen.curve[p] < 0 ? least : 0.0);
}

struct Case {
  int points;
  double gradation;
};
class Catalogue : public testing::TestWithParam<Case> {};

TEST_P(Catalogue, IsMeshedWithinThePromises) {
  for (std::size_t a = 0; a < airfoil_catalogue().size(); ++a) {
    SCOPED_TRACE(airfoil_catalogue()[a].name);
    QualityOptions options;
    options.gradation = GetParam().gradation;
    const Mesh mesh = valid(test::catalogue_domain(a, GetParam().points), options);
    check_boundary_vertices(mesh);
    check_inner_scales(mesh);
  }
}

INSTANTIATE_TEST_SUITE_P(Paper, Catalogue,
                         testing::Values(Case{50, 1}, Case{100, 2}, Case{200, 4}, Case{50, 0.5}, Case{52, 20},
                                         Case{300, 6}));

// A round hole in a square. Between the hole's polygon and its circle refinement passes a point.
TEST(Generate, RefusesSinglePointsOutsideTheDomain) {
  const auto message = [](Point gauge) {
    const std::vector<Point> square{{-3, -3}, {3, -3}, {3, 3}, {-3, 3}, {-3, -3}};
    try {
      generate(
          {.loops = {{.curves = {{"wall", Polyline{square}, Parameters::uniform(4)}}},
                     {.role = LoopRole::hole, .curves = {{"hole", Arc{{0, 0}, 1.0}, Parameters::uniform(6)}}},
                     {.role = LoopRole::internal,
                      .curves = {{"gauge", Line{gauge, gauge}, Parameters::uniform(1)}},
                      .open = true}}});
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message({1.3, 0.2}), "");
  const double cosine = 0.5 * std::numbers::sqrt3, sine = 0.5;  // in the middle of a side
  for (const Point outside : {Point{0.3, 0.2}, Point{4.0, 0.2}, Point{0.93 * cosine, 0.93 * sine}})
    EXPECT_NE(message(outside).find("'gauge' lies outside the domain"), std::string::npos)
        << message(outside);
}

TEST(Generate, GivesTheSameBytesEachTime) {
  const Domain domain = test::catalogue_domain(3, 100);
  EXPECT_TRUE(generate(domain).mesh.state() == generate(domain).mesh.state());
}

TEST(Generate, ScalesWithPowersOfTwoExactly) {
  const Domain domain = test::with_holes({test::star_hole(0.5, 0.5, 0.3)});
  const MeshState one = generate(domain).mesh.state();
  for (const double factor : {0x1p-20, 2.0, 0x1p30}) {
    Domain scaled = domain;
    for (Loop& loop : scaled.loops)
      for (Point& p : std::get<Polyline>(loop.curves[0].shape).points) p = {factor * p.x, factor * p.y};
    const MeshState other = generate(scaled).mesh.state();
    EXPECT_EQ(other.triangle_vertices, one.triangle_vertices);
    EXPECT_EQ(other.triangle_links, one.triangle_links);
    for (std::size_t i = 0; i < one.coordinates.size(); ++i)
      ASSERT_EQ(other.coordinates[i], factor * one.coordinates[i]);
  }
}

TEST(Generate, MoreResolutionMeansMoreTriangles) {
  std::size_t before = 0;
  for (const double resolution : {0.5, 1.0, 2.0, 4.0}) {
    QualityOptions options;
    options.resolution = resolution;
    const std::size_t count = valid(test::catalogue_domain(0, 100), options).triangle_count();
    EXPECT_GT(count, before);
    before = count;
  }
}

TEST(Generate, LargerGradationMeansMoreTriangles) {
  std::size_t before = 0;
  for (const double gradation : {2.0, 4.0, 8.0, 16.0}) {
    QualityOptions options;
    options.gradation = gradation;
    const std::size_t count = valid(test::catalogue_domain(0, 200), options).triangle_count();
    EXPECT_GT(count, before);
    before = count;
  }
}

TEST(Generate, KeepsTheAnglePromised) {
  for (const double angle : {0.0, 10.0, 20.7, 30.0, 33.0}) {
    SCOPED_TRACE(angle);
    QualityOptions options;
    options.min_angle_deg = angle;
    valid(test::catalogue_domain(6, 100), options);
  }
}

// ---- polygons

TEST(Polygons, AreMeshedWithinThePromises) {
  const Point a{0, 0};
  check_boundary_vertices(valid(outer({a, {1, 0}, {1, 1}, {0, 1}})));
  check_boundary_vertices(valid(outer({a, {1, 0}, {1, 1}, {0, 1}}, 7)));
  check_boundary_vertices(valid(outer({a, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}})));
  check_boundary_vertices(valid(test::with_holes({test::square_hole(0.5, 0.5, 0.2)})));
  check_boundary_vertices(valid(test::with_holes({test::square_hole(0.5, 0.5, 0.49, 1)})));
  check_boundary_vertices(valid(test::with_holes({test::star_hole(0.5, 0.5, 0.3)})));
  check_boundary_vertices(
      valid(test::with_holes({test::circle_hole(0.3, 0.3, 0.2), test::circle_hole(0.7, 0.7, 0.2)})));
}

TEST(Polygons, MayRunEitherWayRound) {
  EXPECT_EQ(valid(outer({{0, 0}, {0, 1}, {1, 1}, {1, 0}})).triangle_count(),
            valid(outer({{0, 0}, {1, 0}, {1, 1}, {0, 1}})).triangle_count());
}

TEST(Polygons, MayBeThin) {
  for (const double height : {0.1, 1e-2, 1e-3}) {
    SCOPED_TRACE(height);
    check_boundary_vertices(valid({{rectangle(LoopRole::outer, "outer", {0, 0}, {1, height})}}));
  }
}

TEST(Polygons, MayHaveAnIslandInAHole) {
  Domain domain = test::with_holes({rectangle(LoopRole::hole, "hole", {0.2, 0.2}, {0.8, 0.8}, 2)});
  domain.loops.push_back(rectangle(LoopRole::outer, "island", {0.4, 0.4}, {0.6, 0.6}));
  valid(domain);
}

// Small input angles cannot be removed. Refinement ends, says how many triangles it left alone, and keeps its
// promise elsewhere.
TEST(SmallInputAngles, EndWithTheirTrianglesCounted) {
  for (const double degrees : {50.0, 40.0, 25.0, 10.0, 5.0, 1.0}) {
    SCOPED_TRACE(degrees);
    const double angle = degrees * std::numbers::pi / 180.0;
    QualityOptions options;
    options.max_vertices = 200000;
    const GenerateResult result =
        generate(outer({{0, 0}, {1, 0}, {std::cos(angle), std::sin(angle)}}), options);
    EXPECT_EQ(result.stopped, Stopped::done);
    EXPECT_EQ(result.mesh.data().triangulation.check(), "");
    EXPECT_EQ(check_boundary(result.mesh.data()), "");
    if (degrees >= 30.0) continue;
    EXPECT_GT(result.exempt_triangles, 0U);
    EXPECT_NEAR(result.mesh.statistics().min_angle_deg, degrees, 0.51 * degrees);
  }
}

TEST(SmallInputAngles, OfStarsWithThinTips) {
  std::vector<Point> corners;
  for (int i = 0; i < 14; ++i) {
    const double angle = std::numbers::pi * i / 7.0, radius = i % 2 == 0 ? 1.0 : 0.2;
    corners.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  QualityOptions options;
  options.max_vertices = 200000;
  const GenerateResult result = generate(outer(corners), options);
  EXPECT_EQ(result.stopped, Stopped::done);
  EXPECT_EQ(check_boundary(result.mesh.data()), "");
  EXPECT_GT(result.exempt_triangles, 0U);
}

// A triangle may be left alone while one of the edges at its small angle is in one piece, which is split
// later.
TEST(SmallInputAngles, StayExemptWhenTheirEdgesAreSplit) {
  const auto line = [](LoopRole role, std::vector<Point> points) {
    Loop chain = test::loop(role, "line", Polyline{points}, points.size() - 1);
    chain.open = true;
    return chain;
  };
  const GenerateResult result =
      generate({{line(LoopRole::left, {{4, 2}, {4, 4}, {0, 4}, {0, 0}, {2, 1}}),
                 line(LoopRole::left, {{2, 1}, {3, 1}, {3, 1.5}}), line(LoopRole::right, {{4, 2}, {3, 1.5}}),
                 line(LoopRole::internal, {{2, 1}, {3, 1.5}}), line(LoopRole::internal, {{3, 3}, {3, 1.5}}),
                 line(LoopRole::internal, {{3, 3}, {1, 3}, {1, 1}, {2, 1}}),
                 line(LoopRole::internal, {{3, 3}, {4, 2}}), line(LoopRole::internal, {{2, 2}, {3, 3}})}});
  EXPECT_EQ(result.stopped, Stopped::done);
  EXPECT_GT(result.exempt_triangles, 0U);
  EXPECT_EQ(result.mesh.quick_check(), "");
}

TEST(LengthScales, OfStationsAreTheDistanceToTheNearestNeighbour) {
  const Domain domain = outer({{0, 0}, {4, 0}, {4, 4}, {1, 4}, {0, 0.5}});
  const Mesh mesh = valid(domain);
  const std::vector<Point> points = domain.points(0);
  std::size_t i = 0;
  mesh.data().walk(mesh.data().loop_heads[0], [&](std::uint32_t k) {
    if (mesh.data().at(k).steiner) return;
    const Point here = points[i], before = points[(i + 4) % 5], after = points[(i + 1) % 5];
    EXPECT_DOUBLE_EQ(mesh.data().base_length_scale(k),
                     std::sqrt(std::min(squared_distance(here, before), squared_distance(here, after))));
    ++i;
  });
  EXPECT_EQ(i, 5U);
}

// ---- limits

// The outline's upper side dents the square between its stations, where a hole touches it: the stations do
// not show that. The split that would is taken back whole.
TEST(Limits, CurvesThatTouchBetweenTheirStationsEndInOrder) {
  Domain domain{{test::loop(LoopRole::outer, "outer",
                            Polyline{{{0, 0}, {1, 0}, {1, 1}, {0.5, 0.75}, {0, 1}, {0, 0}}}, 5),
                 test::polygon(LoopRole::hole, "hole", {{0.84375, 0.921875}, {0.8, 0.5}, {0.7, 0.5}})}};
  std::vector<double> stations = domain.loops[0].curves[0].parameters;
  stations.erase(stations.begin() + 3);
  domain.loops[0].curves[0].parameters = stations;
  const GenerateResult result = generate(domain);
  EXPECT_EQ(result.stopped, Stopped::minimum_edge);
  EXPECT_EQ(result.mesh.data().triangulation.check(), "");
  EXPECT_EQ(check_boundary(result.mesh.data()), "");
  EXPECT_TRUE(Mesh::restore(result.mesh.state(), "state").state() == result.mesh.state());
}

TEST(Limits, TheVertexBudgetEndsInOrder) {
  for (const std::uint32_t budget : {10U, 100U, 150U, 400U}) {
    QualityOptions options;
    options.max_vertices = budget;
    const GenerateResult result = generate(test::catalogue_domain(0, 50), options);
    EXPECT_EQ(result.stopped, Stopped::vertex_budget);
    EXPECT_LE(result.mesh.data().triangulation.vertex_count(), std::max(budget, 100U) + 1U);
    EXPECT_EQ(result.mesh.data().triangulation.check(), "");
    EXPECT_EQ(check_boundary(result.mesh.data()), "");
    EXPECT_TRUE(check(result.mesh.freeze(), {.design = &result.mesh.domain()}).valid);
    EXPECT_TRUE(Mesh::restore(result.mesh.state(), "state").state() == result.mesh.state());
  }
}

TEST(Limits, TheMinimumEdgeEndsInOrder) {
  for (const double edge : {1e-3, 0.1, 1.0}) {
    QualityOptions options;
    options.min_edge = edge;
    options.max_vertices = 100000;
    const GenerateResult result =
        generate(test::with_holes({test::square_hole(0.97, 0.5, 0.029, 1)}), options);
    EXPECT_EQ(result.stopped, edge >= 0.1 ? Stopped::minimum_edge : Stopped::done);
    EXPECT_EQ(result.mesh.data().triangulation.check(), "");
    EXPECT_EQ(check_boundary(result.mesh.data()), "");
  }
}

TEST(Limits, OptionsOutOfRangeAreRefused) {
  const double nan = std::nan("");
  const auto refuse = [](const char* option, QualityOptions options) {
    try {
      generate(test::catalogue_domain(0, 50), options);
      ADD_FAILURE() << option << " was taken";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::argument);
      EXPECT_EQ(std::string(error.what()).rfind(option, 0), 0U) << error.what();
    }
  };
  const auto with = [](double QualityOptions::*member, double value) {
    QualityOptions options;
    options.*member = value;
    return options;
  };
  for (const double value : {-1.0, 34.1, nan})
    refuse("min_angle_deg", with(&QualityOptions::min_angle_deg, value));
  for (const double value : {-1.0, 0.0, nan, static_cast<double>(INFINITY)}) {
    refuse("max_gradation", with(&QualityOptions::max_gradation, value));
    refuse("gradation", with(&QualityOptions::gradation, value));
    refuse("resolution", with(&QualityOptions::resolution, value));
  }
  for (const double value : {-1.0, nan, static_cast<double>(INFINITY)})
    refuse("min_edge", with(&QualityOptions::min_edge, value));
}

TEST(Limits, DomainsThatAreNoneAreRefused) {
  EXPECT_THROW(generate({}), Error);
  EXPECT_THROW(generate(outer({{0, 0}, {1, 1}, {1, 0}, {0, 1}})), Error);
  EXPECT_THROW(generate(outer({{0, 0}, {1, 0}, {2, 0}})), Error);
  EXPECT_THROW(generate(test::with_holes({test::square_hole(0.5, 0.5, 0.6)})), Error);
}

// ---- parts

TEST(SmallAngles, FindsCornersInsideTheDomainOnly) {
  const Domain wedge =
      outer({{0, 0}, {1, 0}, {1, 0.3}});  // 16.7 degrees at the origin, 73.3 and 90 elsewhere
  QualityOptions options;
  options.max_vertices = 1;
  const Mesh mesh = generate(wedge, options).mesh;
  const SmallAngles angles(mesh.data());
  EXPECT_GT(angles.count(), 0);
  for (const std::uint32_t k : {0U, 1U, 2U})
    EXPECT_EQ(angles.is_corner(mesh.data().at(k).vertex), mesh.data().point(k) == (Point{0, 0}));
  const Mesh hole =
      generate(test::with_holes({polygon(LoopRole::hole, "hole", {{0.2, 0.2}, {0.8, 0.2}, {0.8, 0.3}})}),
               options)
          .mesh;
  EXPECT_EQ(SmallAngles(hole.data()).count(), 0);
}

TEST(SmallAngles, ShellsArePowersOfTwoBetweenAThirdAndTwoThirds) {
  for (double length = 1e-6; length < 1e6; length *= 1.37) {
    const double shell = SmallAngles::shell_fraction(length) * length;
    EXPECT_GE(shell, length * 0.333);
    EXPECT_LE(shell, length * 0.667);
    const double exponent = std::log2(shell);
    EXPECT_NEAR(exponent, std::round(exponent), 1e-9);
  }
}

}  // namespace
}  // namespace remodel
