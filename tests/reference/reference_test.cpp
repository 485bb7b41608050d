// Compares the library's hard steps with their reference versions.

#include "reference/reference.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/mesh_data.h"
#include "reference/designs.h"
#include "reference/kernel_walk.h"
#include "remodel/generate.h"
#include "remodel/remodel.h"
#include "step/replace.h"
#include "support.h"

namespace remodel {
namespace {

using test::Family;

class OnFamily : public testing::TestWithParam<Family> {};
INSTANTIATE_TEST_SUITE_P(Families, OnFamily, testing::ValuesIn(test::families),
                         [](const auto& param_info) { return std::string(test::name_of(param_info.param)); });

std::string trace(unsigned long long seed) {
  return "REMODEL_TEST_SEED=" + std::to_string(seed);
}

TEST_P(OnFamily, PredicatesHaveTheSignsOfTheDeterminants) {
  const auto seed = test::seed(101 + static_cast<unsigned long long>(GetParam()));
  SCOPED_TRACE(trace(seed));
  std::mt19937_64 random(seed);
  const int tuples = 3000 * test::effort();
  for (int i = 0; i < tuples; ++i) {
    Point p[4];
    for (Point& q : p) q = test::random_point(random, GetParam());
    const int side = reference::orient(p[0], p[1], p[2]);
    ASSERT_EQ(orient2d(p[0], p[1], p[2]), side);
    ASSERT_EQ(incircle(p[0], p[1], p[2], p[3]), reference::incircle(p[0], p[1], p[2], p[3]));
    if (side <= 0 || p[3] == p[0] || p[3] == p[1] || p[3] == p[2]) continue;
    ASSERT_EQ(incircle_sos(p[0], p[1], p[2], p[3]), reference::incircle_lifted(p[0], p[1], p[2], p[3]));
  }
  test::counted(tuples, "tuples of points");
}

TEST_P(OnFamily, TrianglesAreThoseWithEmptyCircles) {
  const auto seed = test::seed(111 + static_cast<unsigned long long>(GetParam()));
  SCOPED_TRACE(trace(seed));
  std::mt19937_64 random(seed);
  const int rounds = 12 * test::effort();
  for (int round = 0; round < rounds; ++round) {
    test::KernelWalk walk(random, GetParam());
    for (int i = 0; i < 60; ++i) walk.step(16);
    for (const auto& edge : walk.constraints())
      walk.triangulation.release(walk.vertices[edge[0]], walk.vertices[edge[1]]);
    ASSERT_EQ(walk.faces(), reference::delaunay(walk.points())) << "round " << round;
  }
  test::counted(rounds, "differential cases");
}

TEST_P(OnFamily, ConstrainedTrianglesAreThoseOfGreedyEdgesAndFlips) {
  const auto seed = test::seed(121 + static_cast<unsigned long long>(GetParam()));
  SCOPED_TRACE(trace(seed));
  std::mt19937_64 random(seed);
  std::size_t constraints = 0;
  const int rounds = 25 * test::effort();
  for (int round = 0; round < rounds; ++round) {
    test::KernelWalk walk(random, GetParam());
    for (int i = 0; i < 70; ++i) walk.step(18);
    const auto present = walk.constraints();
    constraints += present.size();
    ASSERT_EQ(walk.faces(), reference::constrained_delaunay(walk.points(), present)) << "round " << round;
  }
  EXPECT_GT(constraints, 25U);
  test::counted(rounds, "differential cases");
}

TEST_P(OnFamily, CavitiesAreTheConnectedTrianglesInConflict) {
  const auto seed = test::seed(131 + static_cast<unsigned long long>(GetParam()));
  SCOPED_TRACE(trace(seed));
  std::mt19937_64 random(seed);
  std::size_t compared = 0;
  test::KernelWalk walk(random, GetParam());
  const Triangulation& t = walk.triangulation;
  for (int step = 0; step < 1200 * test::effort(); ++step) {
    walk.step(40);
    const Point p = test::random_point(random, GetParam());
    const Location where = t.locate(p, t.star(walk.vertices.front()).triangle);
    if (where.kind == Location::Kind::on_vertex) continue;
    // The conflict of p with a triangle, from exact signs; ghosts hold what lies beyond their hull edge or on
    // it.
    const auto conflicts = [&](TriangleId id) {
      const Triangle& triangle = t[id];
      for (int k = 0; k < 3; ++k) {
        if (triangle.vertex[k] != infinite_vertex) continue;
        const Point a = t.point(triangle.vertex[next3(k)]), b = t.point(triangle.vertex[previous3(k)]);
        const int side = reference::orient(a, b, p);
        return side > 0 || (side == 0 && ((a.x < p.x && p.x < b.x) || (b.x < p.x && p.x < a.x) ||
                                          (a.y < p.y && p.y < b.y) || (b.y < p.y && p.y < a.y)));
      }
      return reference::incircle_lifted(t.point(triangle.vertex[0]), t.point(triangle.vertex[1]),
                                        t.point(triangle.vertex[2]), p) > 0;
    };
    std::set<std::uint32_t> expected{where.triangle.index};
    for (bool grown = true; grown;) {
      grown = false;
      for (const std::uint32_t index : std::set<std::uint32_t>(expected))
        for (const Link link : t[TriangleId{index}].link)
          if (!link.constrained() && conflicts(link.triangle()))
            grown |= expected.insert(link.triangle().index).second;
    }
    Cavity cavity;
    ASSERT_TRUE(t.find_cavity(p, where.triangle, cavity));
    std::set<std::uint32_t> found;
    for (const TriangleId id : cavity.triangles) ASSERT_TRUE(found.insert(id.index).second) << "found twice";
    ASSERT_EQ(found, expected) << "step " << step;
    ASSERT_EQ(cavity.ring.size(), cavity.triangles.size() + 2);
    for (std::size_t k = 0; k < cavity.ring.size(); ++k) {
      const RingEdge& edge = cavity.ring[k];
      const VertexId to = cavity.ring[(k + 1) % cavity.ring.size()].from;
      const auto inner = t.find_edge(edge.from, to);
      ASSERT_TRUE(inner && found.contains(inner->triangle.index))
          << "ring edge " << k << " is none of the cavity's";
      ASSERT_EQ(t.link(*inner), edge.outer);
      ASSERT_TRUE(edge.outer.constrained() || !found.contains(edge.outer.triangle().index));
    }
    ++compared;
  }
  EXPECT_GT(compared, 100U);
  test::counted(static_cast<long long>(compared), "differential cases");
}

Mesh mesh_of(const CstAirfoil& airfoil, int points, double gradation) {
  return generate(airfoil_domain(airfoil, {.points = points}), {.gradation = gradation}).mesh;
}

TEST(RemovalRegions, HoldEveryInteriorVertexInsideAndNoOther) {
  const auto seed = test::seed(141);
  SCOPED_TRACE(trace(seed));
  std::mt19937_64 random(seed);
  std::size_t vertices = 0;
  const int rounds = 10 * test::effort();
  for (int round = 0; round < rounds; ++round) {
    Mesh mesh = mesh_of(test::random_design(random, 0.1), 100, 2.0);
    MeshData& data = mesh.data();
    for (int i = 0; i < 200; ++i) {
      // Centres on the airfoil, anywhere in the farfield, and beyond it; radii from far below to far above an
      // edge.
      const double far = i % 3 == 0 ? 60.0 : i % 3 == 1 ? 2.0 : 0.2;
      const Point centre{0.5 + far * (test::unit(random) - 0.5), far * (test::unit(random) - 0.5)};
      const double radius = std::ldexp(test::unit(random), static_cast<int>(random() % 12) - 8) * far;
      std::uint32_t hint = 1 + static_cast<std::uint32_t>(random() % (data.triangulation.vertex_slots() - 1));
      while (!data.triangulation[VertexId{hint}].alive()) hint = hint % 50 + 1;
      // Sometimes there are more discs than are searched together; a vertex in several of them is reported
      // once.
      std::vector<RemovalRegion> regions{{centre, radius, data.triangulation.star(VertexId{hint}).triangle}};
      const std::size_t more = i % 50 == 0 ? 1000 + random() % 500 : i % 4 == 0 ? random() % 80 : 0;
      for (std::size_t k = more; k > 0; --k) {
        const Point offset{radius * (4.0 * test::unit(random) - 2.0),
                           radius * (4.0 * test::unit(random) - 2.0)};
        regions.push_back({centre + offset, radius * test::unit(random), regions.front().hint});
      }
      const auto held = [&](Point p) {
        return std::any_of(regions.begin(), regions.end(), [&](const RemovalRegion& region) {
          return squared_distance(p, region.centre) < region.radius * region.radius;
        });
      };
      const Arena::Scope scope(data.arena);
      List<VertexId> found = vertices_inside(data, regions);
      std::sort(found.begin(), found.end());  // the order is arbitrary
      List<VertexId> expected(&data.arena);
      for (std::uint32_t v = 1; v < data.triangulation.vertex_slots(); ++v) {
        const Vertex& vertex = data.triangulation[VertexId{v}];
        if (vertex.alive() && vertex.boundary == no_index && held(vertex.point))
          expected.push_back(VertexId{v});
      }
      ASSERT_EQ(found, expected) << "round " << round << ", region " << i;
      vertices += found.size();
    }
  }
  EXPECT_GT(vertices, 1000U);
  test::counted(200LL * rounds, "differential cases");
}

// A disc that reaches a vertex across an edge alone: its centre lies just behind the edge opposite an obtuse
// corner, whose vertex is nearer than the edge's ends.
TEST(RemovalRegions, ReachAVertexBehindAnEdgeWhoseEndsAreOutside) {
  const auto seed = test::seed(142);
  SCOPED_TRACE(trace(seed));
  std::mt19937_64 random(seed);
  Mesh mesh = mesh_of(test::random_design(random, 0.1), 100, 2.0);
  MeshData& data = mesh.data();
  const Triangulation& t = data.triangulation;
  int reached = 0;
  for (std::uint32_t i = 0; i < t.triangle_slots(); ++i) {
    const Triangle& triangle = t[TriangleId{i}];
    if (!triangle.alive() || triangle.ghost() || triangle.region != Region::domain) continue;
    for (int k = 0; k < 3; ++k) {
      const VertexId v = triangle.vertex[k];
      const Point d = t.point(v), a = t.point(triangle.vertex[next3(k)]),
                  b = t.point(triangle.vertex[previous3(k)]);
      if (t[v].boundary != no_index || dot(a - d, b - d) >= 0.0) continue;
      const Point edge = b - a, foot = a + (dot(d - a, edge) / dot(edge, edge)) * edge;
      const Point centre = d + 1.01 * (foot - d);
      const double radius = 1.001 * std::sqrt(squared_distance(centre, d));
      const Location where = t.locate(centre, TriangleId{i});
      const Triangle& behind = t[where.triangle];
      if (where.triangle != triangle.link[k].triangle() || behind.ghost()) continue;
      if (std::any_of(std::begin(behind.vertex), std::end(behind.vertex), [&](VertexId corner) {
            return squared_distance(t.point(corner), centre) < radius * radius;
          }))
        continue;
      const Arena::Scope scope(data.arena);
      const std::vector<RemovalRegion> region{{centre, radius, where.triangle}};
      const List<VertexId> found = vertices_inside(data, region);
      ASSERT_TRUE(std::find(found.begin(), found.end(), v) != found.end()) << "vertex " << v.index;
      ++reached;
    }
  }
  EXPECT_GT(reached, 10);
}

TEST(RemodelResult, CountsWhatACountOfAllTrianglesCounts) {
  const auto seed = test::seed(151);
  SCOPED_TRACE(trace(seed));
  std::mt19937_64 random(seed);
  int full = 0, partial = 0;
  for (int round = 0; round < 6 * test::effort(); ++round) {
    const CstAirfoil base = test::random_design(random, 0.05);
    const int points = round % 2 == 0 ? 50 : 100;
    Mesh mesh = mesh_of(base, points, 2.0);
    for (int step = 0; step < 40; ++step) {
      const double sigma = std::array{0.003, 0.02, 0.1, 0.25}[random() % 4];
      const FrozenMesh before = mesh.freeze();
      const MeshState old_state = mesh.state();
      const RemodelResult result =
          remodel(mesh, airfoil_domain(test::random_variant(random, base, sigma), {.points = points}),
                  {.distance = static_cast<double>(random() % 4),
                   .method = random() % 4 == 0 ? Method::general : Method::automatic,
                   .strategy = Strategy::chain});
      const FrozenMesh after = mesh.freeze();
      ASSERT_EQ(result.triangles_before, before.triangles.size());
      ASSERT_EQ(result.triangles, after.triangles.size());
      ASSERT_EQ(mesh.triangle_count(), after.triangles.size());
      if (result.regenerated) continue;
      ASSERT_EQ(result.preserved, reference::preserved(before, after))
          << "round " << round << " step " << step;
      (result.full_adjustment ? full : partial) += 1;
      // A slot is not reused within a step, so that its generation counts one insertion.
      const MeshState state = mesh.state();
      std::size_t inserted = 0, alive_before = 0, alive_after = 0;
      for (std::size_t v = 1; v < state.vertex_stars.size(); ++v) {
        const bool old_slot = v < old_state.vertex_stars.size();
        inserted += state.vertex_generations[v] - (old_slot ? old_state.vertex_generations[v] : 0);
        alive_before += old_slot && old_state.vertex_stars[v] != no_index ? 1 : 0;
        alive_after += state.vertex_stars[v] != no_index ? 1 : 0;
      }
      ASSERT_EQ(result.inserted, inserted);
      ASSERT_EQ(result.removed, alive_before + inserted - alive_after);
    }
  }
  EXPECT_GT(full, 5);
  EXPECT_GT(partial, 20);
  test::counted(full + partial, "differential cases");
}

}  // namespace
}  // namespace remodel
