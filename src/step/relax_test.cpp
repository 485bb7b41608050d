#include "step/relax.h"

#include <gtest/gtest.h>

#include <random>

#include "remodel/predicates.h"
#include "step/test_designs.h"

namespace remodel {
namespace {

// A mesh of which every tenth vertex of the interior was pushed aside at random, by at most this share of its
// shortest edge, and the triangles around those.
struct Pushed {
  Mesh mesh;
  std::vector<TriangleId> triangles;
  explicit Pushed(double share, std::uint64_t seed)
      : mesh(test::generated(test::catalogue_domain(0, 60), {.gradation = 1.2})) {
    std::mt19937_64 random(seed);
    Triangulation& t = mesh.data().triangulation;
    for (std::uint32_t i = 1; i < t.vertex_slots(); i += 10) {
      const VertexId v{i};
      if (!t[v].alive() || t[v].boundary != no_index) continue;
      double shortest = 1e300;
      t.for_each_corner(v, [&](Corner c) {
        shortest = std::min(shortest, squared_distance(t.point(v), t.point(t.following(c))));
      });
      const auto aside = [&] {
        return share * std::sqrt(shortest) * (1e-3 * static_cast<double>(random() % 2001) - 1.0);
      };
      const Point old = t.point(v);
      t.move(v, old + Point{aside(), aside()}, t[v].length_scale);
      if (t.any_corner(v, [&](Corner c) { return turned_over(t[c.triangle]); }))
        t.move(v, old, t[v].length_scale);
    }
    t.for_each_domain_triangle([&](TriangleId id, const Triangle&) {
      t.set_moved(id, 0);
      triangles.push_back(id);
    });
  }
  bool turned_over(const Triangle& triangle) const {
    const Triangulation& t = mesh.data().triangulation;
    return orient2d(t.point(triangle.vertex[0]), t.point(triangle.vertex[1]), t.point(triangle.vertex[2])) <=
           0;
  }
  bool relax(const QualityBounds& bounds) {
    List<TriangleId> list(&mesh.data().arena);
    list.assign(triangles.begin(), triangles.end());
    return remodel::relax(mesh.data(), bounds, list);
  }
};

TEST(Relax, MendsWhatWasPushedAsideWithEveryTriangleJoinedAsItWas) {
  const std::uint64_t seed = 4'211;
  SCOPED_TRACE(seed);
  Pushed pushed(0.15, seed);
  MeshData& mesh = pushed.mesh.data();
  ASSERT_NE(pushed.mesh.quick_check(), "");
  EXPECT_TRUE(pushed.relax(mesh.promised_bounds()));
  mesh.triangulation.begin();
  mesh.triangulation.restore_delaunay(pushed.triangles);
  EXPECT_EQ(mesh.triangulation.edges_flipped(), 0U);
  mesh.triangulation.commit();
  EXPECT_EQ(pushed.mesh.quick_check(), "");
}

TEST(Relax, SaysWhereABoundCannotBeMetAndTurnsNothingOver) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    SCOPED_TRACE(seed);
    Pushed pushed(0.45, seed);
    QualityBounds bounds = pushed.mesh.data().promised_bounds();
    bounds.squared_radius_edge = 0.34;  // 59 degrees
    EXPECT_FALSE(pushed.relax(bounds));
    pushed.mesh.data().triangulation.for_each_domain_triangle(
        [&](TriangleId, const Triangle& t) { EXPECT_FALSE(pushed.turned_over(t)); });
  }
}

TEST(Relax, LeavesAGoodMeshAsItIs) {
  Pushed still(0.0, 1);
  const MeshState before = still.mesh.state();
  EXPECT_TRUE(still.relax(still.mesh.data().promised_bounds()));
  EXPECT_EQ(still.mesh.state(), before);
}

}  // namespace
}  // namespace remodel
