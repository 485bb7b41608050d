// Which vertices go: those that coarsening removes, and those in the regions of vertices that cannot be
// moved.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "generate/refine.h"
#include "step/adjust.h"
#include "step/coarsen.h"
#include "step/replace.h"
#include "step/strategy.h"
#include "step/test_designs.h"
#include "support.h"

namespace remodel {
namespace {

using test::generated;
using test::Walk;

void touch_all(Triangulation& triangulation) {
  for (std::uint32_t i = 0; i < triangulation.triangle_slots(); ++i)
    if (triangulation[TriangleId{i}].alive()) triangulation.touch(TriangleId{i});
}

// How many vertices refinement inserts where a triangle was touched.
std::size_t inserted_by_refinement(MeshData& data) {
  const std::size_t vertices = data.triangulation.vertex_count();
  Refiner refiner(data);
  for (const TriangleId t : data.triangulation.touched()) refiner.consider(t);
  EXPECT_EQ(refiner.run(), Stopped::done);
  return data.triangulation.vertex_count() - vertices;
}

// A mesh made to a smaller H has vertices that can go.
TEST(Coarsening, KeepsItsBudgetAndLeavesRefinementNothingToDo) {
  Mesh mesh = generated(test::catalogue_domain(0, 100), {.max_gradation = 0.5, .gradation = 4.0});
  MeshData& data = mesh.data();
  data.options.max_gradation = 0.8;
  for (const std::size_t budget : {0U, 1U, 40U, 100000U}) {
    data.triangulation.begin();
    touch_all(data.triangulation);
    const std::size_t vertices = data.triangulation.vertex_count();
    const std::size_t removed = coarsen_touched(data, {}, budget);
    EXPECT_LE(removed, budget);
    EXPECT_GE(removed, std::min<std::size_t>(budget, 40));
    EXPECT_EQ(data.triangulation.vertex_count(), vertices - removed);
    EXPECT_EQ(inserted_by_refinement(data), 0U);
    EXPECT_EQ(data.triangulation.vertex_count(), vertices - removed);
    data.domain_triangles = data.count_domain_triangles();
    data.triangulation.commit();
    EXPECT_EQ(mesh.quick_check(), "");
  }
}

// The least (r / (H mean LS))^2 of a vertex' triangles in the domain; infinity on the boundary and elsewhere.
std::vector<double> least_ratios(const MeshData& mesh) {
  const Triangulation& t = mesh.triangulation;
  std::vector<double> least(t.vertex_slots(), INFINITY);
  for (std::uint32_t i = 0; i < t.triangle_slots(); ++i) {
    const Triangle& triangle = t[TriangleId{i}];
    if (!triangle.alive() || triangle.region != Region::domain) continue;
    double sum = 0.0;
    for (const VertexId v : triangle.vertex) sum += t[v].length_scale;
    const double bound = mesh.options.max_gradation * sum / 3.0;
    for (const VertexId v : triangle.vertex)
      if (t[v].boundary == no_index)
        least[v.index] = std::min(least[v.index], triangle.circle.squared_radius() / (bound * bound));
  }
  return least;
}

bool leaves_refinement_nothing_to_do(Mesh mesh, VertexId without) {
  MeshData& data = mesh.data();
  data.triangulation.begin();
  data.triangulation.remove(without);
  const bool nothing = inserted_by_refinement(data) == 0;
  data.triangulation.commit();
  return nothing;
}

TEST(Coarsening, RemovesTheDensestThatCanGoFirst) {
  Mesh mesh = generated(test::catalogue_domain(0, 50), {.max_gradation = 0.5, .gradation = 4.0});
  MeshData& data = mesh.data();
  data.options.max_gradation = 0.8;
  for (int i = 0; i < 20; ++i) {
    const Mesh before = mesh;
    const std::vector<double> ratios = least_ratios(data);
    data.triangulation.begin();
    touch_all(data.triangulation);
    ASSERT_EQ(coarsen_touched(data, {}, 1), 1U);
    data.domain_triangles = data.count_domain_triangles();
    data.triangulation.commit();
    std::uint32_t gone = 0;
    for (std::uint32_t v = 1; v < ratios.size(); ++v)
      if (std::isfinite(ratios[v]) && !data.triangulation[VertexId{v}].alive()) gone = v;
    for (std::uint32_t v = 1; v < ratios.size(); ++v)
      if (ratios[v] < ratios[gone] * (1.0 - 1e-12)) {
        EXPECT_FALSE(leaves_refinement_nothing_to_do(before, VertexId{v})) << v << " before " << gone;
      }
  }
}

TEST(LostVertices, HaveThePapersRegionUnlessRenewing) {
  const Point centre{1.0, 2.0}, at_two{3.0, 2.0}, at_three{1.0, -1.0};
  const auto radius = [&](bool renews, double distance, double pair) {
    return lost_vertex_radius({.distance = distance, .renewing = renews}, pair, centre, at_two, at_three);
  };
  for (const double pair : {0.0, 0.01, 0.5, 1.0, 2.9}) EXPECT_EQ(radius(false, 1.0, pair), 3.0);
  for (const double pair : {0.61, 1.0, 1.9}) EXPECT_EQ(radius(true, 1.0, pair), 2.0);
  for (const bool renews : {false, true}) EXPECT_EQ(radius(renews, 1.0, 4.0), 4.0);
  // It failed although it hardly moves.
  for (const double pair : {0.0, 0.01, 0.59}) EXPECT_DOUBLE_EQ(radius(true, 1.0, pair), std::sqrt(8.0));
  for (const double pair : {0.0, 0.59}) EXPECT_DOUBLE_EQ(radius(true, 0.0, pair), std::sqrt(8.0));
  EXPECT_EQ(radius(true, 10.0, 0.5), 5.0);
}

// How many interior vertices lie within `reach` of the least radius of a vertex that cannot be moved in place
// although it hardly moves.
std::size_t interior_near_lost(Mesh mesh, const Domain& domain, double reach) {
  MeshData& data = mesh.data();
  const std::size_t airfoil = 0;
  data.triangulation.begin();
  AdjustCache& cache = adjust_cache(data, {&airfoil, 1});
  EXPECT_FALSE(adjust_all(data, cache, domain));
  adjust_some(data, cache);
  std::size_t near = 0;
  for (std::uint32_t v = 1; v < data.triangulation.vertex_slots(); ++v) {
    const Vertex& vertex = data.triangulation[VertexId{v}];
    if (!vertex.alive() || vertex.boundary != no_index) continue;
    bool inside = false;
    for (std::size_t i = 0; i < cache.non_steiner; ++i) {
      const AdjustCache::Moving& m = cache.moving[i];
      const Point p = cache.new_points[i];
      const double pair = std::sqrt(squared_distance(p, cache.old_points[i]));
      const double least =
          least_radius({.renewing = true}, p, cache.new_points[m.before], cache.new_points[m.after]);
      const double radius = reach * least - pair;  // about the old place too
      inside |=
          !cache.accepted[i] && pair < 0.2 * least && squared_distance(p, vertex.point) < radius * radius;
    }
    near += inside ? 1 : 0;
  }
  data.triangulation.rollback();
  return near;
}

TEST(LostVertices, ThatHardlyMoveTakeMoreOfTheInteriorWithThem) {
  const auto seed = test::seed(5);
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  Walk designs(0, 0.003, random);
  Mesh mesh = generated(designs.domain(100), {.gradation = 2.0});
  std::size_t within_the_least = 0, within_more = 0, removed = 0;
  for (int i = 0; i < 4000; ++i) {
    designs.next();
    const Domain domain = designs.domain(100);
    const Mesh before = mesh;
    const RemodelResult result = remodel(mesh, domain, {.strategy = Strategy::renew});
    if (result.full_adjustment || result.refreshed || renewal_is_due(before.data())) continue;
    within_the_least += interior_near_lost(before, domain, 1.0);
    within_more += interior_near_lost(before, domain, 1.4);
    removed += result.removed;
  }
  EXPECT_GT(2 * within_more, 3 * within_the_least);  // some lie between
  EXPECT_GE(removed, within_more);
}

}  // namespace
}  // namespace remodel
