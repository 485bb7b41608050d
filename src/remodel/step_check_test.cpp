#include "remodel/step_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

#include "mesh/mesh_data.h"
#include "remodel/generate.h"
#include "remodel/test_designs.h"
#include "support.h"

namespace remodel {
namespace {

// Whether the check of the last step sees it when this triangle's circle is wrong.
bool sees(Mesh& mesh, const RemodelResult& step, TriangleId t) {
  Triangulation& triangulation = mesh.data().triangulation;
  const Circle circle = triangulation[t].circle;
  triangulation.set_circle(t, {circle.centre, 4.0 * circle.inside, 4.0 * circle.outside});
  const bool seen = !check_step(mesh, step).broken.empty();
  triangulation.set_circle(t, circle);
  return seen;
}

class StepCheckOf : public testing::TestWithParam<Strategy> {};

// A step sets the birth of every triangle that it makes or moves. The run of smallest angles, of the first
// mesh and then of changes alone, is that of the meshes as a whole.
TEST_P(StepCheckOf, StepsSeesEveryTriangleThatIsNewAndTheSmallestAngle) {
  const unsigned long long seed = test::seed(31);
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  test::Walk walk(random() % 10, 0.05, random);
  Mesh mesh = generate(walk.domain(60), {.gradation = 2.0}).mesh;
  double of_changes = mesh.statistics().min_angle_deg, of_meshes = of_changes;
  int full = 0, partial = 0;
  for (int i = 0; i < 60; ++i) {
    if (i % 3 == 0) walk.next();
    const Domain domain = airfoil_domain(i % 3 == 0 ? walk.airfoil() : walk.sample(1e-5), {.points = 60});
    const RemodelResult step = remodel(mesh, domain, {.strategy = GetParam()});
    ++(step.full_adjustment ? full : partial);
    const StepCheck check = check_step(mesh, step);
    ASSERT_EQ(check.broken, "");
    of_changes = std::min(of_changes, check.min_angle_deg);
    of_meshes = std::min(of_meshes, mesh.statistics().min_angle_deg);
    ASSERT_EQ(of_changes, of_meshes) << "step " << i;
    const Triangulation& triangulation = mesh.data().triangulation;
    for (std::uint32_t t = 0; t < triangulation.triangle_slots(); ++t) {
      const Triangle& triangle = triangulation[TriangleId{t}];
      if (!triangle.alive() || triangle.birth != mesh.step() || triangle.region != Region::domain) continue;
      ASSERT_TRUE(sees(mesh, step, TriangleId{t})) << "step " << i << ", triangle " << t;
    }
  }
  EXPECT_GT(full, 3);
  EXPECT_GT(partial, 3);
}

INSTANTIATE_TEST_SUITE_P(Strategies, StepCheckOf, testing::Values(Strategy::chain, Strategy::renew),
                         [](const auto& given) { return std::string(name_of(given.param)); });

TEST(StepCheck, SeesABoundaryVertexThatIsNotOnTheNewDesign) {
  Mesh mesh = generate(test::catalogue_domain(0, 60), {.gradation = 2.0}).mesh;
  const RemodelResult step = remodel(mesh, test::catalogue_domain(1, 60));
  ASSERT_EQ(check_step(mesh, step).broken, "");
  MeshData& data = mesh.data();
  const std::uint32_t k = data.loop_heads[0];
  data.boundary.edit(k).t += 1e-3;
  EXPECT_NE(check_step(mesh, step).broken.find("not on the design"), std::string::npos);
}

}  // namespace
}  // namespace remodel
