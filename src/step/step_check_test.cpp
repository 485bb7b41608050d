#include "step/step_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

#include "mesh/mesh_data.h"
#include "remodel/generate.h"
#include "remodel/remodel.h"
#include "step/test_designs.h"
#include "support.h"

namespace remodel {
namespace {

// Whether the check of what has changed sees it when this triangle's circle is wrong.
bool sees(Mesh& mesh, const Mark& before, TriangleId t) {
  Triangulation& triangulation = mesh.data().triangulation;
  const Circle circle = triangulation[t].circle;
  triangulation.set_moved(t, {circle.centre, 4.0 * circle.inside, 4.0 * circle.outside},
                          triangulation[t].birth);
  const bool seen = !check_changes(mesh, before).broken.empty();
  triangulation.set_moved(t, circle, triangulation[t].birth);
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
    const Mark before = mesh.mark();
    const RemodelResult step = remodel(mesh, domain, {.strategy = GetParam()});
    ++(step.full_adjustment ? full : partial);
    const StepCheck check = check_changes(mesh, before);
    ASSERT_EQ(check.broken, "");
    of_changes = std::min(of_changes, check.min_angle_deg);
    of_meshes = std::min(of_meshes, mesh.statistics().min_angle_deg);
    ASSERT_EQ(of_changes, of_meshes) << "step " << i;
    const Triangulation& triangulation = mesh.data().triangulation;
    for (std::uint32_t t = 0; t < triangulation.triangle_slots(); ++t) {
      const Triangle& triangle = triangulation[TriangleId{t}];
      if (!triangle.alive() || triangle.birth != mesh.step() || triangle.region != Region::domain) continue;
      ASSERT_TRUE(sees(mesh, before, TriangleId{t})) << "step " << i << ", triangle " << t;
    }
  }
  EXPECT_GT(full, 3);
  EXPECT_GT(partial, 3);
}

INSTANTIATE_TEST_SUITE_P(Strategies, StepCheckOf, testing::Values(Strategy::chain, Strategy::renew),
                         [](const auto& given) { return std::string(name_of(given.param)); });

// The first triangle of the domain that the step made, or any.
TriangleId made_by(const Mesh& mesh, std::uint32_t step) {
  const Triangulation& triangulation = mesh.data().triangulation;
  for (std::uint32_t t = 0; t < triangulation.triangle_slots(); ++t) {
    const Triangle& triangle = triangulation[TriangleId{t}];
    if (triangle.alive() && triangle.birth == step && triangle.region == Region::domain) return TriangleId{t};
  }
  ADD_FAILURE() << "no triangle of step " << step;
  return {};
}

TEST(StepCheck, OfTheGeneralMethodSeesWhatItMade) {
  Mesh mesh = generate(test::with_holes({test::square_hole(0.5, 0.5, 0.1)}), {}).mesh;
  const Mark before = mesh.mark();
  const RemodelResult step =
      remodel(mesh, test::with_holes({test::circle_hole(0.4, 0.5, 0.1), test::star_hole(0.8, 0.8, 0.1)}),
              {.strategy = Strategy::chain});
  ASSERT_EQ(step.method, Method::general);
  EXPECT_EQ(check_changes(mesh, before).broken, "");
  EXPECT_TRUE(sees(mesh, before, made_by(mesh, mesh.step())));
}

TEST(StepCheck, OfOneLoopAmongSeveralSeesWhatItMadeAndLooksAtNoOther) {
  const auto domain = [](double x) {
    return test::with_holes({test::circle_hole(0.25, 0.5, 0.1), test::circle_hole(x, 0.5, 0.1)});
  };
  Mesh mesh = generate(domain(0.7), {}).mesh;
  const Mark before = mesh.mark();
  remodel(mesh, domain(0.75), {.method = Method::specialised, .strategy = Strategy::chain});
  ASSERT_EQ(check_changes(mesh, before).broken, "");
  EXPECT_FALSE(check_changes(mesh, before).whole);
  EXPECT_TRUE(sees(mesh, before, made_by(mesh, mesh.step())));
}

TEST(StepCheck, LooksAtTheWholeMeshWhereNothingMoved) {
  const Domain domain = test::catalogue_domain(0, 60);
  Mesh mesh = generate(domain, {.gradation = 2.0}).mesh;
  remodel(mesh, test::catalogue_domain(1, 60), {.strategy = Strategy::chain});
  const Mark before = mesh.mark();
  remodel(mesh, test::catalogue_domain(1, 60), {.strategy = Strategy::chain});
  const StepCheck check = check_changes(mesh, before);
  EXPECT_EQ(check.broken, "");
  EXPECT_TRUE(check.whole);
  EXPECT_EQ(check.min_angle_deg, mesh.statistics().min_angle_deg);
}

class Cancel : public StepObserver {
 public:
  explicit Cancel(int questions) : left_(questions) {}
  bool cancelled() override { return left_-- <= 0; }

 private:
  int left_;
};

TEST(StepCheck, OfAStepThatWasInterruptedFindsTheMeshAsItWas) {
  Mesh mesh = generate(test::catalogue_domain(0, 60), {.gradation = 2.0}).mesh;
  int interrupted = 0;
  for (int questions = 0; questions < 40; ++questions) {
    Cancel observer(questions);
    const Mark before = mesh.mark();
    const RemodelResult step =
        remodel(mesh, test::catalogue_domain(1, 60), {.strategy = Strategy::chain, .observer = &observer});
    EXPECT_EQ(check_changes(mesh, before).broken, "");
    if (step.stopped == Stopped::done) break;
    ++interrupted;
    EXPECT_TRUE(mesh.data().triangulation.touched().empty());
    EXPECT_TRUE(mesh.data().triangulation.moved_in_place().empty());
  }
  EXPECT_GT(interrupted, 0);
}

TEST(StepCheck, EndsAtALoopThatRunsInCircles) {
  Mesh mesh = generate(test::catalogue_domain(0, 60), {.gradation = 2.0}).mesh;
  const Mark before = mesh.mark();
  remodel(mesh, test::catalogue_domain(1, 60), {.strategy = Strategy::chain});
  MeshData& data = mesh.data();
  const std::uint32_t k = data.at(data.loop_heads[0]).next;
  data.boundary.edit(data.at(k).next).next = k;
  EXPECT_NE(check_changes(mesh, before).broken, "");
}

TEST(StepCheck, SeesABoundaryVertexThatIsNotOnTheNewDesign) {
  Mesh mesh = generate(test::catalogue_domain(0, 60), {.gradation = 2.0}).mesh;
  const Mark before = mesh.mark();
  remodel(mesh, test::catalogue_domain(1, 60), {.strategy = Strategy::chain});
  ASSERT_EQ(check_changes(mesh, before).broken, "");
  MeshData& data = mesh.data();
  const std::uint32_t k = data.loop_heads[0];
  data.boundary.edit(k).t += 1e-3;
  EXPECT_NE(check_changes(mesh, before).broken.find("not on the design"), std::string::npos);
}

}  // namespace
}  // namespace remodel
