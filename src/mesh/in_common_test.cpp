#include <gtest/gtest.h>

#include <algorithm>

#include "remodel/frozen_mesh.h"
#include "remodel/generate.h"
#include "remodel/remodel.h"
#include "step/test_designs.h"
#include "support.h"

namespace remodel {
namespace {

TEST(InCommon, AgreesWithWhatAStepSaysOfItself) {
  const auto seed = test::seed(1);
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  for (const Strategy strategy : {Strategy::renew, Strategy::reference}) {
    test::Walk walk(0, 0.003, random);
    Mesh mesh = generate(walk.domain(60), {.refine_angle_deg = 32}).mesh;
    for (int step = 0; step < 10; ++step) {
      const FrozenMesh before = mesh.freeze();
      walk.next();
      const RemodelResult result = remodel(mesh, walk.domain(60), {.strategy = strategy});
      SCOPED_TRACE(std::string(name_of(strategy)) + ", step " + std::to_string(step));
      const InCommon found = in_common(before, mesh.freeze(), before);
      EXPECT_EQ(found.preserved, result.preserved);
      EXPECT_EQ(found.connected, result.connected);
    }
  }
}

TEST(InCommon, TakesNoKeyThatTwoBranchesGaveOutForOneVertex) {
  const Mesh origin = generate(test::catalogue_domain(0, 60)).mesh;
  Mesh one = origin, other = origin;
  remodel(one, test::catalogue_domain(1, 60), {.strategy = Strategy::renew});
  remodel(other, test::catalogue_domain(2, 60), {.strategy = Strategy::renew});
  const FrozenMesh a = one.freeze(), b = other.freeze(), fork = origin.freeze();
  FrozenMesh apart = b;
  const InCommon honest = in_common(a, b, fork);
  for (std::size_t v = 0; v < apart.points.size(); ++v)
    if (std::find(fork.vertex_keys.begin(), fork.vertex_keys.end(), apart.vertex_keys[v]) ==
        fork.vertex_keys.end())
      apart.vertex_keys[v] = (std::uint64_t{1} << 52) + v;
  const InCommon without = in_common(a, apart, fork);
  EXPECT_LE(honest.connected - without.connected, honest.preserved);
  EXPECT_GT(honest.preserved, 0u);
  EXPECT_LT(honest.connected, a.triangles.size());
}

TEST(InCommon, OfAMeshOfAnotherOriginIsWhatStandsAtTheSamePlaces) {
  const FrozenMesh a = generate(test::catalogue_domain(0, 60)).mesh.freeze();
  const FrozenMesh b = generate(test::catalogue_domain(1, 60)).mesh.freeze();
  const InCommon found = in_common(a, b, b);
  EXPECT_EQ(found.moved, 0u);
  EXPECT_EQ(found.connected, found.preserved);
  FrozenMesh no_keys = a;
  no_keys.vertex_keys.clear();
  EXPECT_EQ(in_common(no_keys, a, a).preserved, a.triangles.size());
}

}  // namespace
}  // namespace remodel
