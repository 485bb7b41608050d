// Runs with several meshes: what depends on the workers, and what must not.

#include "design/workers.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "design/airfoil_space.h"
#include "design/test_runs.h"
#include "design/triangle_snapshot.h"
#include "remodel/check.h"
#include "remodel/error.h"
#include "remodel/generate.h"
#include "remodel/shape_files.h"
#include "step/test_designs.h"
#include "support.h"

namespace remodel {
namespace {

namespace fs = std::filesystem;

struct Use {
  const char* name;
  MeshStrategy strategy;
  std::size_t workers;
};
constexpr Use uses[] = {{"renew", MeshStrategy::renew, 1},
                        {"three", MeshStrategy::renew, 3},
                        {"pool", MeshStrategy::pool, 0},
                        {"hub", MeshStrategy::hub, 1},
                        {"hubs", MeshStrategy::hub, 4},
                        {"regenerate", MeshStrategy::regenerate, 1},
                        {"regenerates", MeshStrategy::regenerate, 2}};

class WorkerRun : public OptimiseRun {
 protected:
  OptimiseOptions options_of(const Use& use, const std::string& name, std::size_t evaluations = 60) const {
    OptimiseOptions result = options(name, evaluations);
    result.sigma = 0.25;
    result.compare_every = 20;
    result.strategy = use.strategy;
    result.workers = use.workers;
    return result;
  }
  std::vector<EvaluationRecord> rows(const std::string& name) const {
    return History::open(root_ / name / "history.sqlite").records();
  }
};

TEST_F(WorkerRun, EvaluatesTheSameDesignsWhateverTheStrategyAndTheWorkers) {
  for (const Use& use : uses) {
    SCOPED_TRACE(use.name);
    const OptimiseResult result = optimise(from_, to_, options_of(use, use.name));
    EXPECT_EQ(result.invalid_meshes, 0u) << result.detail;
    const auto first = rows(uses[0].name), these = rows(use.name);
    ASSERT_EQ(these.size(), first.size());
    bool other_meshes = false;
    for (std::size_t i = 0; i < these.size(); ++i) {
      EXPECT_EQ(these[i].coefficients, first[i].coefficients);
      EXPECT_EQ(these[i].generation, first[i].generation);
      EXPECT_EQ(these[i].sigma, first[i].sigma);
      EXPECT_EQ(these[i].objective, first[i].objective);
      EXPECT_EQ(these[i].best_objective, first[i].best_objective);
      EXPECT_EQ(these[i].infeasible_samples, first[i].infeasible_samples);
      other_meshes |= these[i].triangles != first[i].triangles;
    }
    EXPECT_EQ(other_meshes, &use != &uses[0]);
  }
}

TEST_F(WorkerRun, GivesTheSameBytesOnAnyNumberOfThreads) {
  for (const Use& use : uses) {
    if (use.workers == 1) continue;
    OptimiseOptions given = options_of(use, std::string(use.name) + "1");
    given.threads = 1;
    optimise(from_, to_, given);
    const fs::path alone = given.directory;
    for (const std::size_t threads : {2, 4}) {
      SCOPED_TRACE(std::string(use.name) + ", " + std::to_string(threads) + " threads");
      given.threads = threads;
      given.directory = root_ / (use.name + std::to_string(threads));
      optimise(from_, to_, given);
      expect_same_runs(alone, given.directory);
      EXPECT_EQ(read_text(alone / "last.vtkhdf"), read_text(given.directory / "last.vtkhdf"));
    }
  }
}

TEST_F(WorkerRun, HasTheSameMeshesFromAHubWithAnyNumberOfWorkers) {
  optimise(from_, to_, options_of(uses[3], "one"));
  optimise(from_, to_, options_of(uses[4], "four"));
  const auto one = rows("one"), four = rows("four");
  ASSERT_EQ(one.size(), four.size());
  bool other_losses = false;
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].triangles, four[i].triangles);
    EXPECT_EQ(one[i].full_adjustment, four[i].full_adjustment);
    EXPECT_EQ(one[i].min_angle_deg, four[i].min_angle_deg);
    EXPECT_EQ(one[i].gradation_bias, four[i].gradation_bias);
    other_losses |= one[i].preserved != four[i].preserved;
  }
  EXPECT_TRUE(other_losses);
  EXPECT_TRUE(read_mesh(root_ / "one" / "last.vtkhdf").state() ==
              read_mesh(root_ / "four" / "last.vtkhdf").state());
}

// None of a pool's meshes, and no hub, takes a thousand steps in this run.
TEST_F(WorkerRun, LooksAtMeshesThatShareTheDesignsAsEarlyAsAtOne) {
  for (const Use& use : {uses[2], uses[3]}) {
    SCOPED_TRACE(use.name);
    OptimiseOptions given = options_of(use, use.name, 1200);
    given.sigma = 0.001;
    given.compare_every = 0;
    optimise(from_, to_, given);
    const Mesh last = read_mesh(given.directory / "last.vtkhdf");
    EXPECT_LT(last.step(), 1000U);
    EXPECT_GT(last.state().renewal.samplings, 0U);
  }
}

TEST_F(WorkerRun, GoesOnFromInterruptsAndKillsToTheSameHistoryAndMeshes) {
  for (const Use& use : uses) {
    SCOPED_TRACE(use.name);
    const std::string name = use.name;
    optimise(from_, to_, options_of(use, name + "-whole"));
    OptimiseOptions parts = options_of(use, name + "-parts");
    for (const std::uint64_t stop : {7, 24, 40, 51}) {
      const auto how = stop % 2 == 0 ? StopAfter::How::cancel : StopAfter::How::kill;
      StopAfter observer(stop, how);
      if (how == StopAfter::How::kill)
        EXPECT_THROW(optimise(from_, to_, parts, &observer), std::runtime_error);
      else
        EXPECT_EQ(optimise(from_, to_, parts, &observer).stopped, OptimiseStopped::interrupted);
      parts.resume = true;
    }
    EXPECT_EQ(optimise(from_, to_, parts).stopped, OptimiseStopped::done);
    expect_same_runs(root_ / (name + "-whole"), root_ / (name + "-parts"));
  }
}

TEST_F(WorkerRun, DoesNotDependOnWhereCheckpointsAreAndWhereItIsMadeLonger) {
  for (const Use& use : uses) {
    SCOPED_TRACE(use.name);
    const std::string name = use.name;
    OptimiseOptions often = options_of(use, name + "-often"), longer = options_of(use, name + "-longer", 37);
    optimise(from_, to_, options_of(use, name + "-seldom"));
    often.checkpoint_every = 4;
    optimise(from_, to_, often);
    expect_same_runs(root_ / (name + "-seldom"), often.directory);
    optimise(from_, to_, longer);
    longer.resume = true;
    longer.evaluations = 60;
    optimise(from_, to_, longer);
    EXPECT_TRUE(read_mesh(root_ / (name + "-seldom") / "last.vtkhdf").state() ==
                read_mesh(longer.directory / "last.vtkhdf").state());
  }
}

// From the rows alone: each goes to the worker with the nearest last design that has not had its share.
TEST_F(WorkerRun, HandsDesignsToTheNearestWorkerAndCountsAgainstItsMesh) {
  optimise(from_, to_, options_of(uses[1], "run"));
  constexpr std::size_t population = 11, workers = 3, share = 4;
  std::vector<CstAirfoil> designs(workers, from_);
  std::vector<std::size_t> taken(workers, 0), triangles(workers, 0);
  std::set<std::uint64_t> seen;
  for (const EvaluationRecord& row : rows("run")) {
    SCOPED_TRACE("evaluation " + std::to_string(row.evaluation));
    if ((row.evaluation - 1) % population == 0) taken.assign(workers, 0);
    const CstAirfoil design = with_coefficients(from_, row.coefficients);
    const auto displacement = [&](const CstAirfoil& a) {
      double most = 0.0;
      for (int i = 0; i < 50; ++i) {
        const Point p = a.at(i / 50.0), before = a.at((i + 49) % 50 / 50.0),
                    after = a.at((i + 1) % 50 / 50.0);
        const double scale = std::sqrt(std::min(squared_distance(p, before), squared_distance(p, after)));
        most = std::max(most, std::abs(design.at(i / 50.0).y - p.y) / scale);
      }
      return most;
    };
    const std::size_t chosen = row.worker - 1;
    ASSERT_LT(chosen, workers);
    EXPECT_LT(taken[chosen], share);
    for (std::size_t w = 0; w < workers; ++w) {
      if (taken[w] >= share) continue;
      EXPECT_LE(displacement(designs[chosen]), displacement(designs[w]) * (1 + 1e-12));
    }
    if (triangles[chosen] != 0) {
      EXPECT_EQ(row.triangles_before, triangles[chosen]);
    }
    designs[chosen] = design;
    triangles[chosen] = row.triangles;
    ++taken[chosen];
    seen.insert(row.worker);
  }
  EXPECT_EQ(seen.size(), workers);
}

TEST_F(WorkerRun, HoldsAMeshAWorkerInEachCheckpointAndRefusesADamagedOne) {
  OptimiseOptions resumed = options_of(uses[4], "run", 30);  // a hub with four workers
  optimise(from_, to_, resumed);
  resumed.resume = true;
  std::size_t meshes = 0;
  for (int i = 0; i < 5; ++i) {
    for (const char set : {'a', 'b'}) {
      const std::string name =
          std::string("checkpoint-") + set + (i == 0 ? "" : "-" + std::to_string(i + 1)) + ".vtkhdf";
      meshes += fs::exists(resumed.directory / name);
    }
    EXPECT_FALSE(fs::exists(resumed.directory / "checkpoint-a-6.vtkhdf"));
  }
  EXPECT_EQ(meshes, 10u);
  EXPECT_NO_THROW(optimise(from_, to_, resumed));
  for (const char* name : {"checkpoint-a-3.vtkhdf", "checkpoint-b-3.vtkhdf"})
    fs::resize_file(resumed.directory / name, 100);
  EXPECT_THROW(optimise(from_, to_, resumed), Error);
  // A new run takes them all away.
  resumed.resume = false;
  resumed.overwrite = true;
  resumed.workers = 1;
  optimise(from_, to_, resumed);
  EXPECT_FALSE(fs::exists(resumed.directory / "checkpoint-a-3.vtkhdf"));
}

TEST_F(WorkerRun, NamesWorkersAndStrategyAmongTheOptionsThatDiffer) {
  OptimiseOptions other = options_of(uses[1], "run", 5);
  optimise(from_, to_, other);
  other.resume = true;
  other.threads = 2;  // may differ
  EXPECT_NO_THROW(optimise(from_, to_, other));
  other.workers = 2;
  other.strategy = MeshStrategy::hub;
  try {
    optimise(from_, to_, other);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("strategy, workers"), std::string::npos) << error.what();
  }
}

TEST_F(WorkerRun, EndsAtALimitAfterTheSameRowsOnAnyNumberOfThreads) {
  const OptimiseOptions usual = options("run");
  const Mesh first = generate(airfoil_domain(from_, usual.domain), usual.quality).mesh;
  std::vector<std::vector<EvaluationRecord>> found;
  for (const std::size_t threads : {1, 3}) {
    OptimiseOptions small = options_of(uses[1], "run" + std::to_string(threads));
    small.threads = threads;
    small.quality.max_vertices = static_cast<std::uint32_t>(first.statistics().vertices + 20);
    EXPECT_EQ(optimise(from_, to_, small).stopped, OptimiseStopped::mesh_limit);
    found.push_back(rows("run" + std::to_string(threads)));
  }
  ASSERT_FALSE(found[0].empty());
  ASSERT_EQ(found[0].size(), found[1].size());
  for (std::size_t i = 0; i < found[0].size(); ++i) EXPECT_EQ(found[0][i].triangles, found[1][i].triangles);
}

TEST_F(WorkerRun, RefusesNumbersOutOfRange) {
  OptimiseOptions bad = options("run");
  bad.workers = 1001;
  EXPECT_THROW(optimise(from_, to_, bad), Error);
  bad = options("run");
  bad.threads = 1001;
  EXPECT_THROW(optimise(from_, to_, bad), Error);
  EXPECT_FALSE(fs::exists(root_ / "run"));
}

// The slow way: every triangle of one state looked for among all of the other's, by ids and coordinates.
std::size_t common_by_search(const Mesh& a, const Mesh& b) {
  const auto triangles_of = [](const Mesh& mesh) {
    const FrozenMesh frozen = mesh.freeze();
    std::set<std::set<std::tuple<std::uint32_t, double, double>>> result;
    for (const auto& corners : frozen.triangles) {
      std::set<std::tuple<std::uint32_t, double, double>> triangle;
      for (const std::uint32_t v : corners)
        triangle.insert({frozen.vertex_ids[v], frozen.points[v].x, frozen.points[v].y});
      result.insert(triangle);
    }
    return result;
  };
  const auto first = triangles_of(a), second = triangles_of(b);
  std::size_t common = 0;
  for (const auto& triangle : first) common += second.contains(triangle);
  return common;
}

TEST(TriangleSnapshot, CountsWhatASearchAndAStepCount) {
  const auto seed = test::seed(3);
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  test::Walk walk(0, 0.02, random);
  Mesh mesh = generate(walk.domain(60), {.gradation = 1.2}).mesh;
  const Mesh hub = mesh;
  bool replaced = false;
  for (int i = 0; i < 20; ++i) {
    SCOPED_TRACE("step " + std::to_string(i));
    walk.next();
    const Mesh before = mesh;
    const TriangleSnapshot snapshot(mesh.data());
    EXPECT_EQ(snapshot.size(), mesh.triangle_count());
    EXPECT_EQ(snapshot.common_with(mesh.data()).same, mesh.triangle_count());
    const RemodelResult result = remodel(mesh, walk.domain(60), {.strategy = Strategy::chain});
    EXPECT_EQ(snapshot.common_with(mesh.data()).same, result.preserved);
    EXPECT_EQ(snapshot.common_with(mesh.data()).same, common_by_search(before, mesh));
    // Two states that no step connects.
    EXPECT_EQ(TriangleSnapshot(hub.data()).common_with(mesh.data()).same, common_by_search(hub, mesh));
    replaced |= !result.full_adjustment;
  }
  EXPECT_TRUE(replaced);
}

TEST(Hub, FollowsInPlaceAtOnceAndOtherwiseWhenItPays) {
  const CstAirfoil from = load_airfoil("naca:0012", 5), far = load_airfoil("rae2822", 5);
  CstAirfoil near = from;
  near.upper[2] *= 1.001;
  const OptimiseOptions options{
      .domain = {.points = 60}, .quality = {.gradation = 1.2}, .strategy = MeshStrategy::hub};
  const AirfoilSpace space(from, options.domain);
  const Domain domain = airfoil_domain(from, options.domain);
  const Mesh start = generate(domain, options.quality).mesh;
  Hub hub(options, space, 10, start);
  EXPECT_FALSE(hub.follow(coefficients_of(from), {.evaluated = 11, .full_adjustments = 0}));
  EXPECT_EQ(hub.version(), 1u);  // nothing to do
  hub.follow(coefficients_of(near), {.evaluated = 11, .full_adjustments = 11});
  EXPECT_EQ(hub.version(), 2u);
  EXPECT_TRUE(hub.mesh().domain() == airfoil_domain(near, options.domain));
  const MeshState state = hub.mesh().state();
  hub.follow(coefficients_of(far), {.evaluated = 11, .full_adjustments = 6});
  EXPECT_EQ(hub.version(), 2u);
  EXPECT_TRUE(hub.mesh().state() == state);
  hub.follow(coefficients_of(far), {.evaluated = 11, .full_adjustments = 5});
  EXPECT_EQ(hub.version(), 3u);
  EXPECT_TRUE(hub.mesh().domain() == airfoil_domain(far, options.domain));
  EXPECT_EQ(hub.mesh().quick_check(), "");
}

TEST(RegenerationRule, GeneratesFarAwayAndOnceInARowOfFullAdjustments) {
  EXPECT_FALSE(RegenerationRule::generate(7.9 * 7.9, 0));
  EXPECT_TRUE(RegenerationRule::generate(8.1 * 8.1, 0));
  RegenerationRule::Row row = 0;
  std::size_t generated = 0;
  for (int i = 0; i < 40; ++i) {
    const bool now = RegenerationRule::generate(0.1, row);
    EXPECT_EQ(now, i == 10);
    generated += now;
    row = RegenerationRule::after(row, !now, now);
  }
  EXPECT_EQ(generated, 1u);
  row = RegenerationRule::after(row, false, false);
  for (int i = 0; i < 10; ++i) row = RegenerationRule::after(row, true, false);
  EXPECT_TRUE(RegenerationRule::generate(0.1, row));
}

}  // namespace
}  // namespace remodel
