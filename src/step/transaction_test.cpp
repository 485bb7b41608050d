// Failures in the middle: allocations that fail, observers that cancel, limits that are reached, trials that
// end. In every case the mesh is as it was, to the last bit, and goes on as if nothing had been. A program of
// its own: it replaces operator new.

#include <gtest/gtest.h>

#include <new>
#include <random>

#include "mesh/mesh_data.h"
#include "remodel/error.h"
#include "remodel/generate.h"
#include "remodel/remodel.h"
#include "step/test_allocations.h"
#include "step/test_designs.h"
#include "support.h"

namespace remodel {
namespace {

using test::allocations;
using test::allocations_left;
using test::catalogue_domain;
using test::fails_for_good;

// The circles are no part of the state, since they follow from it (those outside of the domain only once they
// are needed): where they did not, quick_check() may not see it.
void expect_same(const Mesh& mesh, const MeshState& before, const std::string& where) {
  ASSERT_TRUE(mesh.state() == before) << where;
  ASSERT_EQ(mesh.quick_check(), "") << where;
  const Mesh restored = Mesh::restore(before, "before");
  const Triangulation& now = mesh.data().triangulation;
  ASSERT_EQ(mesh.triangle_count(), restored.triangle_count()) << where;
  for (std::uint32_t i = 0; i < now.triangle_slots(); ++i) {
    const Triangle& t = now[TriangleId{i}];
    if (!t.alive()) continue;
    const Circle circle = restored.data().triangulation[TriangleId{i}].circle;
    if (t.region == Region::domain) {
      ASSERT_EQ(t.circle.inside, circle.inside) << where << ", triangle " << i;
    }
    ASSERT_EQ(t.badness, 0) << where << ", triangle " << i;
  }
}

// The allocation to fail after the n-th: each of the first hundreds, then samples, the denser the more
// effort.
long next_fault(long n) {
  return n + 1 + n / (400L * test::effort());
}

// Fails the n-th allocation of a call for n = 0, 1, 2, ... until the call gets through; says how many failed.
// `after` sees each failure.
template <class Call, class After>
long fail_allocations(Call call, After after) {
  long faults = 0;
  for (long n = 0;; n = next_fault(n)) {
    bool failed = false;
    fails_for_good = faults % 2 == 0;
    allocations_left = n;
    try {
      call();
    } catch (const std::bad_alloc&) {
      failed = true;
    }
    allocations_left = -1;
    if (!failed) break;
    ++faults;
    after(n);
    if (testing::Test::HasFatalFailure()) break;
  }
  test::counted(faults, "faults");
  return faults;
}

// Afterwards the same step gives what it gives a mesh at which nothing ever failed.
void fail_every_allocation(const Mesh& start, const Domain& domain, const RemodelOptions& options) {
  const MeshState before = start.state();
  Mesh untroubled = start;
  remodel(untroubled, domain, options);
  const MeshState after = untroubled.state();
  Mesh mesh = start;
  long failures = 0;
  const long faults = fail_allocations(
      [&] { remodel(mesh, domain, options); },
      [&](long n) {
        ASSERT_NO_FATAL_FAILURE(expect_same(mesh, before, "allocation " + std::to_string(n)));
        if (++failures % 16 != 0) return;
        remodel(mesh, domain, options);
        ASSERT_TRUE(mesh.state() == after) << "the step after allocation " << n << " failed";
        mesh = start;
      });
  EXPECT_TRUE(mesh.state() == after);
  EXPECT_GT(faults, 3);
}

CstAirfoil scaled(CstAirfoil airfoil, double factor) {
  for (double& c : airfoil.upper) c *= factor;
  for (double& c : airfoil.lower) c *= factor;
  return airfoil;
}

TEST(FailedAllocations, RollBackAFullAdjustment) {
  const CstAirfoil airfoil = airfoil_catalogue()[0].airfoil();
  const Mesh mesh = generate(airfoil_domain(airfoil, {.points = 50})).mesh;
  const Domain next = airfoil_domain(scaled(airfoil, 1.0001), {.points = 50});
  Mesh copy = mesh;
  ASSERT_TRUE(remodel(copy, next, {.strategy = Strategy::chain}).full_adjustment);
  fail_every_allocation(mesh, next, {});
  // On a fresh copy each time: with the storage that a failed attempt leaves, the next would need less.
  const MeshState before = mesh.state();
  copy = mesh;
  fail_allocations([&] { remodel(copy, next, {.strategy = Strategy::renew}); },
                   [&](long n) {
                     ASSERT_NO_FATAL_FAILURE(expect_same(copy, before, "allocation " + std::to_string(n)));
                     copy = mesh;
                   });
}

// Lists keep their storage from step to step: once they have been as long as they get, steps need no memory.
// Every now and then one is longer than ever; then its storage doubles.
TEST(Allocations, AreRareInTheSteadyState) {
  const CstAirfoil airfoil = airfoil_catalogue()[0].airfoil();
  const auto seed = test::seed(5);
  SCOPED_TRACE("REMODEL_TEST_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  for (const Strategy strategy : {Strategy::chain, Strategy::renew}) {
    Mesh mesh = generate(airfoil_domain(airfoil, {.points = 100}), {.gradation = 2.0}).mesh;
    int partial = 0, allocating = 0;
    for (int step = 0; step < 400; ++step) {
      const double spread = step % 4 == 0 ? 1e-4 : 0.3;
      const double factor = 1.0 + spread * (static_cast<double>(random() % 2001) / 1000.0 - 1.0);
      const Domain next = airfoil_domain(scaled(airfoil, factor), {.points = 100});
      const long before = allocations;
      const RemodelResult result = remodel(mesh, next, {.strategy = strategy});
      if (step < 200 || result.refreshed || result.regenerated) continue;
      if (!result.full_adjustment) ++partial;
      if (allocations != before) ++allocating;
    }
    EXPECT_GT(partial, 50);
    EXPECT_LE(allocating, 10) << name_of(strategy);
  }
}

TEST(FailedAllocations, RollBackPartialSteps) {
  const Mesh mesh = generate(catalogue_domain(0, 50)).mesh;
  for (const std::size_t to : {1U, 5U, 9U}) fail_every_allocation(mesh, catalogue_domain(to, 50), {});
  // A step that renews, then one that leaves what it makes for later.
  Mesh renewed = mesh;
  for (const std::size_t to : {1U, 5U}) {
    fail_every_allocation(renewed, catalogue_domain(to, 50), {.strategy = Strategy::renew});
    remodel(renewed, catalogue_domain(to, 50), {.strategy = Strategy::renew});
  }
  EXPECT_FALSE(renewed.state().renewal.pending_vertices.empty());
}

TEST(FailedAllocations, RollBackGeneralSteps) {
  const Mesh mesh = generate(catalogue_domain(0, 50)).mesh;
  fail_every_allocation(mesh, catalogue_domain(3, 50), {.method = Method::general});
  fail_every_allocation(mesh, catalogue_domain(3, 64), {});
  const Mesh squares = generate(test::with_holes({test::square_hole(0.3, 0.3, 0.1)})).mesh;
  fail_every_allocation(
      squares, test::with_holes({test::circle_hole(0.6, 0.6, 0.15), test::star_hole(0.3, 0.3, 0.2)}), {});
}

TEST(FailedAllocations, RollBackAStepThatGeneratesAfresh) {
  QualityOptions quality;
  quality.max_vertices = 1500;  // the next design needs more
  const Mesh mesh = generate(catalogue_domain(0, 50), quality).mesh;
  const Domain next = catalogue_domain(5, 200);
  Mesh copy = mesh;
  ASSERT_TRUE(remodel(copy, next, {.strategy = Strategy::chain}).regenerated);
  fail_every_allocation(mesh, next, {});
}

TEST(FailedAllocations, RollBackTrials) {
  const CstAirfoil airfoil = airfoil_catalogue()[0].airfoil();
  Mesh mesh = generate(airfoil_domain(airfoil, {.points = 50})).mesh;
  const MeshState before = mesh.state();
  for (const Domain& domain :
       {airfoil_domain(scaled(airfoil, 1.0001), {.points = 50}), catalogue_domain(4, 50)}) {
    fail_allocations(
        [&] {
          Trial trial(mesh, domain, {.strategy = Strategy::chain});
          trial.keep();
        },
        [&](long n) { expect_same(mesh, before, "allocation " + std::to_string(n)); });
    EXPECT_EQ(mesh.quick_check(), "");
    mesh = Mesh::restore(before, "before");
  }
}

TEST(FailedAllocations, RollBackStepsOfRandomWalks) {
  const auto seed = test::seed(17);
  SCOPED_TRACE("REMODEL_TEST_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  for (int round = 0; round < test::effort(); ++round) {
    test::Walk walk(random() % 10, 0.02, random);
    Mesh mesh = generate(walk.domain(50)).mesh;
    for (int step = 0; step < 3; ++step) {
      const Domain design = airfoil_domain(walk.sample(step == 0 ? 0.0005 : 0.1), {.points = 50});
      const RemodelOptions options{.distance = static_cast<double>(random() % 3),
                                   .method = random() % 3 == 0 ? Method::general : Method::automatic,
                                   .strategy = Strategy::chain};
      ASSERT_NO_FATAL_FAILURE(fail_every_allocation(mesh, design, options));
      remodel(mesh, design, options);
    }
  }
}

TEST(FailedAllocations, LeaveAMeshThatIsReadAsItWas) {
  const Mesh mesh = generate(catalogue_domain(0, 50)).mesh;
  const MeshState before = mesh.state();
  const auto same = [&](long) { ASSERT_TRUE(mesh.state() == before); };
  fail_allocations([&] { (void)mesh.freeze(); }, same);
  fail_allocations([&] { (void)Mesh(mesh); }, same);
  fail_allocations([&] { (void)Mesh::restore(before, "before"); }, same);
}

TEST(FailedAllocations, EndAGenerationThatGivesTheSameMeshAfterwards) {
  const Domain domain = catalogue_domain(7, 50);
  const MeshState expected = generate(domain).mesh.state();
  MeshState found;
  fail_allocations([&] { found = generate(domain).mesh.state(); }, [](long) {});
  EXPECT_TRUE(found == expected);
}

// The hot path of an optimisation: one vector for the loops that differ, whatever the mesh's size.
TEST(AFullAdjustment, AllocatesNothingInProportionToTheMesh) {
  for (const int points : {50, 400}) {
    CstAirfoil airfoil = airfoil_catalogue()[0].airfoil();
    Mesh mesh = generate(airfoil_domain(airfoil, {.points = points})).mesh;
    for (int step = 0; step < 6; ++step) {
      airfoil = scaled(airfoil, 1.000001);
      const Domain domain = airfoil_domain(airfoil, {.points = points});
      const long before = allocations;
      ASSERT_TRUE(remodel(mesh, domain, {.strategy = Strategy::chain}).full_adjustment);
      if (step < 2) continue;
      EXPECT_LE(allocations - before, 2) << "step " << step;
    }
  }
}

// ---- observers

struct Cancelling : StepObserver {
  explicit Cancelling(int after) : left(after) {}
  bool cancelled() override { return ++asked, left-- <= 0; }
  int left, asked = 0;
};
struct Throwing : StepObserver {
  bool cancelled() override { throw std::runtime_error("observer"); }
};

TEST(Observer, CancelsAStepAtAnyPollAndLeavesTheMeshAsItWas) {
  Mesh mesh = generate(catalogue_domain(0, 300)).mesh;
  const MeshState before = mesh.state();
  long faults = 0;
  for (const Method method : {Method::specialised, Method::general}) {
    int polls = 0;
    for (;; ++polls) {
      Cancelling observer(polls);
      const RemodelResult result =
          remodel(mesh, catalogue_domain(6, 300),
                  {.method = method, .strategy = Strategy::chain, .observer = &observer});
      if (result.stopped == Stopped::done) break;
      ASSERT_EQ(result.stopped, Stopped::interrupted);
      EXPECT_EQ(result.method, method);
      EXPECT_EQ(result.preserved, result.triangles);
      EXPECT_FALSE(result.regenerated);
      ASSERT_NO_FATAL_FAILURE(expect_same(mesh, before, "poll " + std::to_string(polls)));
      ++faults;
    }
    EXPECT_GE(polls, 3);
    EXPECT_EQ(mesh.quick_check(), "");
    mesh = Mesh::restore(before, "before");
  }
  test::counted(faults, "faults");
}

TEST(Observer, ThatThrowsLeavesTheMeshAsItWas) {
  Mesh mesh = generate(catalogue_domain(0, 50)).mesh;
  const MeshState before = mesh.state();
  Throwing observer;
  EXPECT_THROW(remodel(mesh, catalogue_domain(6, 50), {.strategy = Strategy::chain, .observer = &observer}),
               std::runtime_error);
  expect_same(mesh, before, "an observer that throws");
}

TEST(Observer, CancelsGenerationWithAValidMesh) {
  Cancelling observer(2);
  const GenerateResult result = generate(catalogue_domain(0, 300), {}, &observer);
  EXPECT_EQ(result.stopped, Stopped::interrupted);
  EXPECT_EQ(observer.asked, 3);
  EXPECT_EQ(result.mesh.data().triangulation.check(), "");
  EXPECT_EQ(check_boundary(result.mesh.data()), "");
}

// ---- limits

// A step that its own budget ends generates afresh and says so, or says where it was stopped: never an
// invalid mesh, and the same again from the same state.
TEST(Limits, ThatAStepReachesLeaveAMeshInOrder) {
  const auto seed = test::seed(19);
  SCOPED_TRACE("REMODEL_TEST_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  long reached = 0;
  for (int round = 0; round < 12 * test::effort(); ++round) {
    QualityOptions quality;
    Mesh mesh = generate(catalogue_domain(random() % 10, 50), quality).mesh;
    // Hardly more vertices than there are, or edges that may not be split.
    MeshState tight = mesh.state();
    if (round % 3 == 0)
      tight.options.min_edge = 0.02;
    else
      tight.options.max_vertices =
          static_cast<std::uint32_t>(mesh.data().triangulation.vertex_count() + random() % 40);
    mesh = Mesh::restore(tight, "tight");
    Mesh again = mesh;
    bool promised = true;
    for (int step = 0; step < 6; ++step) {
      const Domain design = catalogue_domain(random() % 10, 50 + 10 * static_cast<int>(random() % 3));
      const Method method = random() % 2 == 0 ? Method::general : Method::automatic;
      const RemodelResult result = remodel(mesh, design, {.method = method, .strategy = Strategy::chain});
      if (result.stopped != Stopped::done || result.regenerated) ++reached;
      ASSERT_EQ(mesh.data().triangulation.check_topology(), "") << "round " << round << ", step " << step;
      ASSERT_EQ(check_boundary(mesh.data()), "") << "round " << round << ", step " << step;
      promised = result.stopped == Stopped::done && (promised || result.regenerated);
      if (promised) {
        ASSERT_EQ(mesh.quick_check(), "") << "round " << round << ", step " << step;
      }
      remodel(again, design, {.method = method, .strategy = Strategy::chain});
      ASSERT_TRUE(again.state() == mesh.state());
    }
  }
  test::counted(reached, "faults");
  EXPECT_GT(reached, 20);
}

// ---- trials

TEST(Trial, ThatEndsLeavesTheMeshAsItWas) {
  const unsigned long long seed = test::seed(1);
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  for (const Method method : {Method::automatic, Method::general}) {
    test::Walk walk(0, 0.05, random);
    Mesh mesh = generate(walk.domain(60)).mesh, never_tried = mesh;
    for (int step = 0; step < 60; ++step) {
      const MeshState before = mesh.state();
      for (const double sigma : {0.0005, 0.02, 0.2}) {
        const Domain design = airfoil_domain(walk.sample(sigma), {.points = 60});
        Mesh remodelled = mesh;
        const RemodelResult expected =
            remodel(remodelled, design, {.method = method, .strategy = Strategy::chain});
        {
          const Trial trial(mesh, design, {.method = method, .strategy = Strategy::chain});
          EXPECT_EQ(trial.result().preserved, expected.preserved);
          ASSERT_TRUE(mesh.state() == remodelled.state()) << "step " << step << ", sigma " << sigma;
          ASSERT_EQ(mesh.quick_check(), "");
        }
        ASSERT_NO_FATAL_FAILURE(expect_same(mesh, before, "step " + std::to_string(step)));
      }
      walk.next();
      remodel(mesh, walk.domain(60), {.method = method, .strategy = Strategy::chain});
      remodel(never_tried, walk.domain(60), {.method = method, .strategy = Strategy::chain});
      ASSERT_TRUE(mesh.state() == never_tried.state()) << "step " << step;
    }
  }
}

TEST(Trial, OfOtherHolesLeavesTheMeshAsItWas) {
  const std::vector<std::vector<Loop>> designs = {
      {test::square_hole(0.3, 0.3, 0.1)},
      {test::star_hole(0.3, 0.3, 0.2), test::circle_hole(0.7, 0.7, 0.15)},
      {},
      {test::circle_hole(0.5, 0.5, 0.3), test::square_hole(0.1, 0.1, 0.05)},
      {test::circle_hole(0.5, 0.51, 0.3), test::square_hole(0.1, 0.1, 0.05)},
  };
  Mesh mesh = generate(test::with_holes(designs[0])).mesh;
  for (std::size_t step = 0; step < 40; ++step) {
    const MeshState before = mesh.state();
    for (const std::vector<Loop>& holes : designs) {
      const Trial trial(mesh, test::with_holes(holes), {.strategy = Strategy::chain});
      ASSERT_EQ(mesh.quick_check(), "");
      ASSERT_EQ(mesh.domain(), test::with_holes(holes));
    }
    ASSERT_NO_FATAL_FAILURE(expect_same(mesh, before, "step " + std::to_string(step)));
    remodel(mesh, test::with_holes(designs[step * 7 % 5]), {.strategy = Strategy::chain});
  }
}

TEST(Trial, ThatIsKeptIsAStep) {
  Mesh mesh = generate(catalogue_domain(0, 50)).mesh, stepped = mesh;
  for (const std::size_t to : {1U, 4U, 8U}) {
    remodel(stepped, catalogue_domain(to, 50), {.strategy = Strategy::chain});
    Trial trial(mesh, catalogue_domain(to, 50), {.strategy = Strategy::chain});
    trial.keep();
    EXPECT_TRUE(mesh.state() == stepped.state());
  }
}

TEST(Trial, CanBeReadCopiedAndSavedButNotRemodelled) {
  Mesh mesh = generate(catalogue_domain(0, 50)).mesh;
  const MeshState before = mesh.state();
  {
    const Trial trial(mesh, catalogue_domain(4, 50), {.strategy = Strategy::chain});
    EXPECT_THROW(remodel(mesh, catalogue_domain(5, 50), {.strategy = Strategy::chain}), Error);
    EXPECT_THROW(Trial(mesh, catalogue_domain(5, 50), {.strategy = Strategy::chain}), Error);
    Mesh copy = mesh, restored = Mesh::restore(mesh.state(), "trial");
    EXPECT_EQ(copy.freeze().points.size(), mesh.freeze().points.size());
    remodel(copy, catalogue_domain(5, 50), {.strategy = Strategy::chain});
    remodel(restored, catalogue_domain(5, 50), {.strategy = Strategy::chain});
    EXPECT_EQ(copy.quick_check(), "");
    EXPECT_TRUE(copy.state() == restored.state());
  }
  expect_same(mesh, before, "a trial");
}

TEST(Trial, ThatGeneratedAfreshReturnsToo) {
  QualityOptions quality;
  quality.max_vertices = 1500;
  Mesh mesh = generate(catalogue_domain(0, 50), quality).mesh;
  const MeshState before = mesh.state();
  {
    const Trial trial(mesh, catalogue_domain(5, 200), {.strategy = Strategy::chain});
    EXPECT_TRUE(trial.result().regenerated);
    EXPECT_EQ(trial.result().stopped, Stopped::vertex_budget);
  }
  expect_same(mesh, before, "a trial");
}

TEST(Trial, OfARefusedDesignLeavesTheMeshAsItWas) {
  Mesh mesh = generate(catalogue_domain(0, 50)).mesh;
  const MeshState before = mesh.state();
  CstAirfoil crossed = airfoil_catalogue()[0].airfoil();
  crossed.upper.swap(crossed.lower);
  EXPECT_THROW(Trial(mesh, airfoil_domain(crossed, {.points = 50}), {.strategy = Strategy::chain}), Error);
  expect_same(mesh, before, "a refused trial");
}

}  // namespace
}  // namespace remodel
