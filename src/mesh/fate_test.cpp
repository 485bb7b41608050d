#include <gtest/gtest.h>

#include <algorithm>

#include "remodel/error.h"
#include "remodel/frozen_mesh.h"
#include "remodel/generate.h"
#include "remodel/remodel.h"
#include "step/test_designs.h"
#include "support.h"

namespace remodel {
namespace {

std::size_t count(const std::vector<Fate>& all, Fate fate) {
  return static_cast<std::size_t>(std::count(all.begin(), all.end(), fate));
}

TEST(Fates, AgreeWithWhatEachStepSaysOfItself) {
  const auto seed = test::seed(1);
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  bool replaced = false, adjusted = false;
  for (const Strategy strategy : {Strategy::chain, Strategy::renew}) {
    for (const double sigma : {0.0002, 0.01}) {
      test::Walk walk(0, sigma, random);
      Mesh mesh = generate(walk.domain(60)).mesh;
      for (int step = 0; step < 40; ++step) {
        const FrozenMesh before = mesh.freeze();
        walk.next();
        const RemodelResult result = remodel(mesh, walk.domain(60), {.strategy = strategy});
        const std::vector<Fate> all = fates(before, mesh.freeze());
        ASSERT_EQ(all.size(), result.triangles);
        ASSERT_EQ(count(all, Fate::kept), result.preserved) << "step " << step;
        ASSERT_TRUE(!result.full_adjustment || count(all, Fate::made) == 0) << "step " << step;
        adjusted |= result.full_adjustment;
        replaced |= count(all, Fate::made) > 0;
      }
    }
  }
  EXPECT_TRUE(adjusted);
  EXPECT_TRUE(replaced);
}

TEST(Fates, OfAnUnchangedMeshAreAllKeptAndOfAnotherMeshAllMade) {
  const FrozenMesh mesh = generate(test::catalogue_domain(0, 50)).mesh.freeze();
  const std::vector<Fate> same = fates(mesh, mesh);
  EXPECT_EQ(count(same, Fate::kept), mesh.triangles.size());

  FrozenMesh other = mesh;
  for (std::uint32_t& birth : other.birth) birth = 7;
  EXPECT_EQ(count(fates(mesh, other), Fate::moved), mesh.triangles.size());
  // Vertices of the interior are known by their keys, wherever they have moved; without keys by their places.
  FrozenMesh morphed = other;
  for (std::size_t i = 0; i < morphed.points.size(); ++i)
    if (morphed.curve[i] < 0) morphed.points[i].x += 1e-9;
  EXPECT_EQ(count(fates(mesh, morphed), Fate::moved), mesh.triangles.size());
  for (std::uint64_t& key : other.vertex_keys) key += std::uint64_t{1} << 32;
  for (double& parameter : other.parameter) parameter += 1e-9;
  EXPECT_EQ(count(fates(mesh, other), Fate::made), mesh.triangles.size());
  for (std::size_t i = 0; i < other.points.size(); ++i)
    if (other.curve[i] < 0) other.points[i].x += 1e-9;
  other.vertex_keys.clear();
  EXPECT_EQ(count(fates(mesh, other), Fate::made), mesh.triangles.size());
}

TEST(Fates, NeedIdsAndBirths) {
  const FrozenMesh mesh = generate(test::catalogue_domain(0, 50)).mesh.freeze();
  FrozenMesh without = mesh;
  without.birth.clear(), without.vertex_keys.clear();
  EXPECT_THROW(fates(without, mesh), Error);
  EXPECT_THROW(fates(mesh, without), Error);
}

}  // namespace
}  // namespace remodel
