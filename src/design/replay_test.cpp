#include "remodel/replay.h"

#include <gtest/gtest.h>

#include <map>

#include "design/test_runs.h"
#include "remodel/design_space.h"
#include "remodel/error.h"
#include "remodel/generate.h"

namespace remodel {
namespace {

using Replay = OptimiseRun;

// The last mesh that a worker has, and how many were shown.
std::pair<MeshState, std::uint64_t> last_of(const std::filesystem::path& run, std::uint64_t worker) {
  MeshState last;
  std::uint64_t shown = 0;
  replay(run, worker, [&](const EvaluationRecord& record, const Mesh& mesh) {
    EXPECT_EQ(record.worker, worker);
    last = mesh.state();
    ++shown;
  });
  return {last, shown};
}

TEST_F(Replay, EndsWithTheRunsLastMeshToTheLastBit) {
  for (const MeshStrategyInfo& info : mesh_strategies()) {
    if (info.strategy == MeshStrategy::pool) continue;  // of several workers
    SCOPED_TRACE(info.name);
    OptimiseOptions given = options(info.name);
    given.strategy = info.strategy;
    optimise(from_, to_, given);
    const auto [last, shown] = last_of(given.directory, 1);
    EXPECT_EQ(shown, 60u);
    EXPECT_TRUE(last == read_mesh(given.directory / "last.vtkhdf").state());
  }
}

// A design whose mesh meets a limit has failed, and the next one goes on from the mesh before it.
TEST_F(Replay, OfARunWhoseMeshesMeetALimitGoesOnBehindThem) {
  for (const MeshStrategy strategy : {MeshStrategy::renew, MeshStrategy::chain}) {
    OptimiseOptions given = options(info_of(strategy).name);
    given.strategy = strategy;
    const Mesh first = generate(airfoil_domain(from_, given.domain), given.quality).mesh;
    given.quality.max_vertices = static_cast<std::uint32_t>(first.statistics().vertices + 20);
    given.keep_finished = given.fail_at_limits = true, given.compare_every = 0;
    const OptimiseResult result = optimise(from_, to_, given);
    ASSERT_EQ(result.stopped, OptimiseStopped::done) << result.detail;
    EXPECT_EQ(result.evaluations, 60u);
    EXPECT_GT(result.failed_evaluations, 0u);
    EXPECT_LT(result.failed_evaluations, 60u);
    EXPECT_NE(result.detail.find("its limit, vertex-budget"), std::string::npos) << result.detail;
    const auto [last, shown] = last_of(given.directory, 1);
    EXPECT_EQ(shown, 60u);
    EXPECT_TRUE(last == read_mesh(given.directory / "last.vtkhdf").state());
  }
}

TEST_F(Replay, HasEachWorkersMeshes) {
  OptimiseOptions given = options("run", 44);
  given.workers = 3;
  optimise(from_, to_, given);
  std::uint64_t shown = 0;
  bool found = false;
  const MeshState last = read_mesh(given.directory / "last.vtkhdf").state();
  for (const std::uint64_t worker : {1, 2, 3}) {
    const auto [state, count] = last_of(given.directory, worker);
    shown += count;
    found |= state == last;
  }
  EXPECT_EQ(shown, 44u);
  EXPECT_TRUE(found);
}

TEST_F(Replay, OfARunFromAMesh) {
  const Domain domain = airfoil_domain(from_, {.points = 50});
  const Mesh generated = generate(domain, {.gradation = 1.0}).mesh;
  OptimiseOptions given = options("run");
  given.start = {.mesh = generated, .place = find_airfoil(domain, "airfoil", "test")};
  optimise(from_, to_, given);
  const auto [last, shown] = last_of(given.directory, 1);
  EXPECT_EQ(shown, 60u);
  EXPECT_TRUE(last == read_mesh(given.directory / "last.vtkhdf").state());
}

TEST_F(Replay, OfAHubHasTheSameMeshesForAnyNumberOfWorkers) {
  OptimiseOptions alone = options("alone", 44), several = options("several", 44);
  alone.strategy = several.strategy = MeshStrategy::hub;
  several.workers = 3;
  optimise(from_, to_, alone);
  optimise(from_, to_, several);
  std::map<std::uint64_t, MeshState> meshes;
  replay(alone.directory, 1, [&](const EvaluationRecord& record, const Mesh& mesh) {
    meshes.emplace(record.evaluation, mesh.state());
  });
  ASSERT_EQ(meshes.size(), 44u);
  for (const std::uint64_t worker : {1, 2, 3})
    replay(several.directory, worker, [&](const EvaluationRecord& record, const Mesh& mesh) {
      EXPECT_TRUE(mesh.state() == meshes.at(record.evaluation)) << "evaluation " << record.evaluation;
    });
}

TEST_F(Replay, RefusesWhatItCannotRepeat) {
  const auto refused = [](const std::filesystem::path& run, std::uint64_t worker) {
    EXPECT_THROW(replay(run, worker, [](const auto&, const auto&) { FAIL() << "a mesh is shown"; }), Error);
  };
  refused(root_ / "nothing", 1);
  OptimiseOptions given = options("run", 5);
  optimise(from_, to_, given);
  refused(given.directory, 0);
  refused(given.directory, 2);
  std::filesystem::copy_file(given.directory / "last.vtkhdf", given.directory / "first.vtkhdf",
                             std::filesystem::copy_options::overwrite_existing);
  refused(given.directory, 1);
  std::filesystem::remove(given.directory / "first.vtkhdf");
  refused(given.directory, 1);

  // A hub follows its designer, which a design space alone does not tell.
  OptimiseOptions hub = options("hub", 22);
  hub.strategy = MeshStrategy::hub;
  optimise(from_, to_, hub);
  const AirfoilSpace space(from_, hub.domain);
  EXPECT_THROW(replay(hub.directory, space, 1, [](const auto&, const auto&) { FAIL() << "a mesh is shown"; }),
               Error);
}

}  // namespace
}  // namespace remodel
