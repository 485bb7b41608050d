#include "remodel/soak.h"

#include <gtest/gtest.h>

#include "design/soak_cases.h"
#include "remodel/error.h"
#include "remodel/generate.h"

namespace remodel {
namespace {

// Every kind of domain comes up: see soak_cases.h.
TEST(Soak, LeavesNoInvalidMesh) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const SoakResult result = soak({.steps = 1000, .seed = seed, .full_check_every = 100});
    EXPECT_EQ(result.steps, 1000U);
    EXPECT_EQ(result.invalid_meshes, 0U) << result.first_failure;
    EXPECT_GT(result.full_adjustments, 0U);
    EXPECT_GT(result.refused, 0U);
  }
}

TEST(Soak, LeavesNoInvalidMeshWithLayers) {
  const SoakResult result = soak({.steps = 1000, .seed = 1, .full_check_every = 20, .layers = true});
  EXPECT_EQ(result.steps, 1000U);
  EXPECT_EQ(result.invalid_meshes, 0U) << result.first_failure;
  EXPECT_GT(result.full_checks, 25U);
  EXPECT_GT(result.refused, 0U);
}

TEST(Soak, DoesTheSameForTheSameSeed) {
  const SoakResult one = soak({.steps = 300, .seed = 7}), other = soak({.steps = 300, .seed = 7});
  EXPECT_EQ(one.refused, other.refused);
  EXPECT_EQ(one.full_adjustments, other.full_adjustments);
  EXPECT_EQ(one.min_angle_deg, other.min_angle_deg);
}

// The episode in which a mesh by Strategy::reference around slat, airfoil and flap once grew from 13,000 to
// 614,000 triangles: steps that had to replace vertices did not shed what earlier ones had left too dense.
TEST(Soak, MeshesOfSetsThatMoveDoNotGrow) {
  portable::Generator random(portable::Generator::State{15952085631558647039U, 6382075082175451244U,
                                                        171190061788599379U, 10512949784226226080U});
  SoakCase<Mesh> drawn = draw_case(random);
  ASSERT_EQ(drawn.remodel.strategy, Strategy::reference);
  for (int i = 0; i < 70; ++i) {
    try {
      remodel(drawn.mesh, drawn.walk->next(), drawn.remodel);
    } catch (const Error&) {
      continue;  // airfoils touch
    }
    ASSERT_LT(drawn.mesh.triangle_count(), 40000U) << "step " << i;
  }
  const std::size_t fresh = generate(drawn.mesh.domain(), drawn.mesh.options()).mesh.triangle_count();
  EXPECT_LT(drawn.mesh.triangle_count(), 2 * fresh);
}

TEST(Soak, BeginsWithAnyEpisodeAsIfItHadDoneThoseBefore) {
  const SoakResult all = soak({.steps = 600, .seed = 7}), first = soak({.steps = 400, .seed = 7}),
                   last = soak({.steps = 200, .seed = 7, .first_episode = 3});
  EXPECT_EQ(all.refused, first.refused + last.refused);
  EXPECT_EQ(all.full_adjustments, first.full_adjustments + last.full_adjustments);
}

}  // namespace
}  // namespace remodel
