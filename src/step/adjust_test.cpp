// The cache of the adjustment stage: one that is brought up to date says what a new one says.

#include "step/adjust.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "remodel/generate.h"
#include "remodel/remodel.h"
#include "step/test_designs.h"
#include "support.h"

namespace remodel {
namespace {

using test::Walk;

auto values(const AdjustCache::Moving& m) {
  return std::tuple(m.boundary, m.vertex, m.curve, m.station.x, m.station.upper, m.row, m.basis_size,
                    m.before, m.after, m.star_begin, m.star_end);
}
auto values(const AdjustCache::Affected& a) {
  return std::tuple(a.triangle, a.vertex[0], a.vertex[1], a.vertex[2], a.domain, a.movable);
}
auto values(const AdjustCache::Edge& e) {
  return std::tuple(e.affected, e.across, e.apex);
}
auto values(const AdjustCache::Segment& s) {
  return std::tuple(s.affected, s.a, s.b, s.apex);
}

template <class T>
void expect_same(const std::vector<T>& a, const std::vector<T>& b, const std::string& what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_TRUE(values(a[i]) == values(b[i])) << what << " " << i;
}

void expect_same(const AdjustCache& a, const AdjustCache& b) {
  EXPECT_EQ(a.non_steiner, b.non_steiner);
  EXPECT_EQ(a.non_steiner_basis, b.non_steiner_basis);
  EXPECT_EQ(a.basis, b.basis);
  EXPECT_EQ(a.in_domain, b.in_domain);
  EXPECT_EQ(a.stars, b.stars);
  expect_same(a.moving, b.moving, "moving");
  expect_same(a.affected, b.affected, "affected");
  expect_same(a.edges, b.edges, "edge");
  expect_same(a.segments, b.segments, "segment");
}

// Copies of meshes have no cache.
TEST(AdjustCache, BroughtUpToDateSaysWhatANewOneSays) {
  const std::vector<std::size_t> loops{0};  // the airfoil
  const unsigned long long seed = test::seed(5);
  std::mt19937_64 random(seed);
  for (const Strategy strategy : {Strategy::chain, Strategy::renew}) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + name_of(strategy));
    Walk walk(0, 0.05, random);
    Mesh mesh = std::move(generate(walk.domain(120), {.gradation = 2.4}).mesh);
    std::size_t replaced = 0;
    std::set<std::size_t> steiner;  // how many vertices on the loop that moves
    for (int step = 0; step < 60 * test::effort(); ++step) {
      SCOPED_TRACE("step " + std::to_string(step));
      walk.next();
      if (step % 3 == 0)
        Trial(mesh, airfoil_domain(walk.sample(0.05), {.points = 120}), {.strategy = strategy});
      Mesh copy = mesh;
      replaced += remodel(mesh, walk.domain(120), {.strategy = strategy}).full_adjustment ? 0 : 1;
      remodel(copy, walk.domain(120), {.strategy = strategy});
      ASSERT_TRUE(mesh.state() == copy.state());
      Mesh again = mesh;
      expect_same(adjust_cache(mesh.data(), loops), adjust_cache(again.data(), loops));
      if (HasFailure()) return;
      const AdjustCache& cache = adjust_cache(mesh.data(), loops);
      steiner.insert(cache.moving.size() - cache.non_steiner);
    }
    EXPECT_GT(replaced, 20U);
    EXPECT_GT(steiner.size(), 3U);
  }
}

}  // namespace
}  // namespace remodel
