#include "remodel/optimise.h"
#include "remodel/mesh_state.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

#include "design/interpolation.h"
#include "design/test_runs.h"
#include "remodel/error.h"
#include "remodel/io.h"
#include "remodel/shape_files.h"

namespace remodel {
namespace {

namespace fs = std::filesystem;

TEST_F(OptimiseRun, LeavesItsFilesAndFiguresThatAgreeWithTheHistory) {
  const OptimiseOptions given = options("run");
  const OptimiseResult result = optimise(from_, to_, given);
  EXPECT_EQ(result.stopped, OptimiseStopped::done);
  EXPECT_EQ(result.evaluations, 60u);
  EXPECT_EQ(result.invalid_meshes, 0u) << result.detail;
  EXPECT_GE(result.min_angle_deg, 30.0 - 1e-6);
  EXPECT_GT(result.preserved_percent, 50.0);
  EXPECT_LT(result.surplus_percent, 100.0);

  const auto rows = History::open(given.directory / "history.sqlite").records();
  ASSERT_EQ(rows.size(), 60u);
  double best = rows[0].objective;
  std::size_t compared = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    best = std::min(best, rows[i].objective);
    EXPECT_EQ(rows[i].best_objective, best);
    EXPECT_EQ(rows[i].triangles_before, i == 0 ? rows[0].triangles_before : rows[i - 1].triangles);
    EXPECT_LE(rows[i].preserved, rows[i].triangles_before);
    EXPECT_EQ(rows[i].generated_triangles.has_value(), (i + 1) % 10 == 0);
    EXPECT_EQ(rows[i].checked == Checked::full, (i + 1) % 10 == 0);
    compared += rows[i].generate_seconds.has_value();
  }
  EXPECT_EQ(result.objective, best);
  EXPECT_EQ(compared, 6u);

  for (const char* mesh : {"first.vtkhdf", "middle.vtkhdf", "last.vtkhdf"})
    EXPECT_EQ(read_mesh(given.directory / mesh).quick_check(), "") << mesh;
  EXPECT_EQ(load_airfoil((given.directory / "best.json").string(), 5), result.best);
  EXPECT_EQ(read_text(given.directory / "result.json"), optimise_result_to_json(result) + "\n");
}

// Renewal may cost some triangles beyond a chain's, but not the point of remodelling.
TEST_F(OptimiseRun, RenewLosesHardlyMoreTrianglesThanAChain) {
  const auto result_by = [&](MeshStrategy strategy) {
    OptimiseOptions ordinary = options(name_of(strategy), 400);
    ordinary.domain.points = 100;
    ordinary.quality.gradation = 2.0;
    ordinary.strategy = strategy;
    ordinary.compare_every = 0;
    return optimise(from_, to_, ordinary);
  };
  const OptimiseResult chain = result_by(MeshStrategy::chain), renew = result_by(MeshStrategy::renew);
  EXPECT_EQ(renew.refreshes + renew.recoveries, 0U);
  EXPECT_LT(renew.lost_mean, 1.05 * chain.lost_mean);
  EXPECT_LT(renew.triangles_mean, 1.02 * chain.triangles_mean);
}

TEST_F(OptimiseRun, EvaluatesTheSameDesignsWhateverTheMesh) {
  OptimiseOptions other = options("other");
  other.domain.points = 100;
  other.quality.gradation = 3.0;
  other.remodel.distance = 2.0;
  other.compare_every = 0;
  optimise(from_, to_, options("run"));
  optimise(from_, to_, other);
  const auto rows = History::open(root_ / "run" / "history.sqlite").records();
  const auto others = History::open(root_ / "other" / "history.sqlite").records();
  ASSERT_EQ(rows.size(), others.size());
  for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(rows[i].coefficients, others[i].coefficients);
}

TEST_F(OptimiseRun, EvaluatesTheSameDesignsWhateverTheStrategy) {
  OptimiseOptions chain = options("chain"), renew = options("renew");
  chain.strategy = MeshStrategy::chain;
  renew.strategy = MeshStrategy::renew;
  chain.sigma = renew.sigma = 0.25;
  optimise(from_, to_, chain);
  optimise(from_, to_, renew);
  const auto rows = History::open(chain.directory / "history.sqlite").records();
  const auto others = History::open(renew.directory / "history.sqlite").records();
  ASSERT_EQ(rows.size(), others.size());
  bool other_meshes = false;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].coefficients, others[i].coefficients);
    EXPECT_EQ(rows[i].objective, others[i].objective);
    EXPECT_EQ(rows[i].infeasible_samples, others[i].infeasible_samples);
    other_meshes |= rows[i].triangles != others[i].triangles;
  }
  EXPECT_TRUE(other_meshes);
}

TEST_F(OptimiseRun, GoesOnFromAnInterruptToTheSameHistoryAndMesh) {
  optimise(from_, to_, options("whole"));
  OptimiseOptions parts = options("parts");
  for (const std::uint64_t stop : {1, 7, 8, 40}) {
    StopAfter observer(stop, StopAfter::How::cancel);
    const OptimiseResult result = optimise(from_, to_, parts, &observer);
    EXPECT_EQ(result.stopped, OptimiseStopped::interrupted);
    parts.resume = true;
  }
  EXPECT_EQ(optimise(from_, to_, parts).stopped, OptimiseStopped::done);
  expect_same_runs(root_ / "whole", root_ / "parts");
}

TEST_F(OptimiseRun, LeavesNothingWhereItIsEndedBeforeItsFirstMesh) {
  StopAfter observer(0, StopAfter::How::cancel);
  EXPECT_EQ(optimise(from_, to_, options("early"), &observer).stopped, OptimiseStopped::interrupted);
  EXPECT_FALSE(std::filesystem::exists(root_ / "early"));
}

TEST_F(OptimiseRun, GoesOnFromTheLastCheckpointOfAKilledRun) {
  optimise(from_, to_, options("whole"));
  OptimiseOptions killed = options("killed");
  for (const std::uint64_t stop : {3, 24, 26, 51}) {
    StopAfter observer(stop, StopAfter::How::kill);
    EXPECT_THROW(optimise(from_, to_, killed, &observer), std::runtime_error);
    killed.resume = true;
  }
  optimise(from_, to_, killed);
  expect_same_runs(root_ / "whole", root_ / "killed");
}

TEST_F(OptimiseRun, CanBeGivenMoreEvaluationsWhenItIsDone) {
  optimise(from_, to_, options("long", 60));
  OptimiseOptions extended = options("extended", 30);
  optimise(from_, to_, extended);
  extended.resume = true;
  extended.evaluations = 60;
  EXPECT_EQ(optimise(from_, to_, extended).evaluations, 60u);
  const auto rows = History::open(root_ / "long" / "history.sqlite").records();
  const auto others = History::open(root_ / "extended" / "history.sqlite").records();
  ASSERT_EQ(others.size(), 60u);
  EXPECT_EQ(rows.back().coefficients, others.back().coefficients);
  EXPECT_TRUE(read_mesh(root_ / "long" / "last.vtkhdf").state() ==
              read_mesh(root_ / "extended" / "last.vtkhdf").state());
}

TEST_F(OptimiseRun, ReplacesAnotherRunOnlyWhereToldTo) {
  OptimiseOptions again = options("run", 10);
  StopAfter observer(5, StopAfter::How::cancel);
  optimise(from_, to_, again, &observer);
  EXPECT_THROW(optimise(from_, to_, again), Error);
  again.resume = true;
  optimise(from_, to_, again);
  again.resume = false;
  again.evaluations = 5;
  EXPECT_THROW(optimise(from_, to_, again), Error);
  EXPECT_EQ(History::open(root_ / "run" / "history.sqlite").records().size(), 10u);
  again.overwrite = true;
  EXPECT_EQ(optimise(from_, to_, again).evaluations, 5u);
  EXPECT_EQ(History::open(root_ / "run" / "history.sqlite").records().size(), 5u);
}

TEST_F(OptimiseRun, NamesTheOptionsThatDifferFromThoseOfTheRunToBeResumed) {
  OptimiseOptions other = options("run", 5);
  optimise(from_, to_, other);
  other.resume = true;
  other.sigma = 0.25;
  try {
    optimise(from_, to_, other);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::argument);
    EXPECT_NE(std::string(error.what()).find("sigma"), std::string::npos) << error.what();
  }
}

TEST_F(OptimiseRun, RefusesADamagedCheckpoint) {
  OptimiseOptions resumed = options("run", 5);
  optimise(from_, to_, resumed);
  resumed.resume = true;
  const fs::path file = resumed.directory / "checkpoint.json";
  const std::string good = read_text(file);
  std::string bad = good;
  bad.replace(bad.find("\"evaluation\":5"), 14, "\"evaluation\":4");
  write_text_atomically(file, bad);
  EXPECT_THROW(optimise(from_, to_, resumed), Error);
  write_text_atomically(file, good);
  EXPECT_NO_THROW(optimise(from_, to_, resumed));
  for (const char* mesh : {"checkpoint-a.vtkhdf", "checkpoint-b.vtkhdf"}) {
    if (fs::exists(resumed.directory / mesh)) fs::resize_file(resumed.directory / mesh, 100);
  }
  EXPECT_THROW(optimise(from_, to_, resumed), Error);
}

TEST_F(OptimiseRun, RefusesAHistoryThatIsNotItsOwn) {
  OptimiseOptions resumed = options("run", 5), other = options("other", 5);
  other.seed = 2;
  optimise(from_, to_, resumed);
  optimise(from_, to_, other);
  fs::copy_file(other.directory / "history.sqlite", resumed.directory / "history.sqlite",
                fs::copy_options::overwrite_existing);
  resumed.resume = true;
  EXPECT_THROW(optimise(from_, to_, resumed), Error);
}

TEST_F(OptimiseRun, EndsInOrderWhereNoSampleIsFeasible) {
  OptimiseOptions wild = options("run");
  wild.sigma = 1e6;
  wild.max_refused = 50;
  const OptimiseResult result = optimise(from_, to_, wild);
  EXPECT_EQ(result.stopped, OptimiseStopped::infeasible);
  EXPECT_EQ(result.evaluations, 0u);
  EXPECT_EQ(result.infeasible_samples, 50u);
  EXPECT_TRUE(fs::exists(wild.directory / "result.json"));
}

TEST_F(OptimiseRun, EndsInOrderAtTheVertexBudgetAndWritesNothing) {
  OptimiseOptions small = options("run");
  small.quality.max_vertices = 110;
  EXPECT_EQ(optimise(from_, to_, small).stopped, OptimiseStopped::mesh_limit);
  EXPECT_FALSE(fs::exists(small.directory));
}

TEST_F(OptimiseRun, RefusesBadArgumentsBeforeItWritesAnything) {
  const auto refused = [&](const CstAirfoil& from, const CstAirfoil& to, const OptimiseOptions& given) {
    EXPECT_THROW(optimise(from, to, given), Error);
    EXPECT_FALSE(fs::exists(root_ / "run"));
  };
  OptimiseOptions bad = options("run");
  bad.evaluations = 0;
  refused(from_, to_, bad);
  bad = options("run");
  bad.sigma = -1.0;
  refused(from_, to_, bad);
  bad = options("run");
  bad.tolerance = -1.0;
  refused(from_, to_, bad);
  bad = options("run");
  bad.domain.points = 51;
  refused(from_, to_, bad);
  bad = options("run");
  bad.quality.gradation = 0.0;
  refused(from_, to_, bad);
  bad = options("run");
  bad.resume = true;
  refused(from_, to_, bad);
  CstAirfoil open = to_;
  open.te_upper = 0.001;
  refused(from_, open, options("run"));
  CstAirfoil crossing = to_;
  std::swap(crossing.upper, crossing.lower);
  refused(from_, crossing, options("run"));
}

TEST_F(OptimiseRun, EndsWithTheGenerationThatReachesTheToleranceAndKeepsAMeshFromHalfWay) {
  OptimiseOptions given = options("run", 9000);
  given.tolerance = 1e-6;
  const OptimiseResult result = optimise(from_, to_, given);
  EXPECT_EQ(result.stopped, OptimiseStopped::done);
  EXPECT_LE(result.objective, given.tolerance);

  const auto rows = History::open(given.directory / "history.sqlite").records();
  ASSERT_EQ(rows.size(), result.evaluations);
  const auto generation = rows.back().generation;
  for (const EvaluationRecord& row : rows) {
    if (row.generation < generation) {
      EXPECT_GT(row.best_objective, given.tolerance);
    }
  }
  const Mesh middle = read_mesh(given.directory / "middle.vtkhdf");
  EXPECT_GT(middle.step(), 0u);
  EXPECT_LT(middle.step(), rows.size());
  EXPECT_LE(rows[middle.step() - 1].best_objective, 0.25 * InterpolationObjective(to_).mean_square(from_));
  EXPECT_EQ(rows[middle.step()].generation, rows[middle.step() - 1].generation + 1);
}

TEST_F(OptimiseRun, ToleranceEndsWorkersAndResumedRunsAtTheSameDesign) {
  OptimiseOptions whole = options("whole", 9000), workers = options("workers", 9000),
                  parts = options("parts", 9000);
  whole.tolerance = workers.tolerance = parts.tolerance = 1e-6;
  workers.workers = 3;
  const std::uint64_t evaluations = optimise(from_, to_, whole).evaluations;
  EXPECT_EQ(optimise(from_, to_, workers).evaluations, evaluations);
  for (const std::uint64_t stop : {7, 90, 200}) {
    StopAfter observer(stop, StopAfter::How::cancel);
    optimise(from_, to_, parts, &observer);
    parts.resume = true;
  }
  optimise(from_, to_, parts);
  expect_same_runs(root_ / "whole", root_ / "parts");
  EXPECT_EQ(optimise(from_, to_, parts).evaluations, evaluations);  // there is nothing left to do
}

TEST_F(OptimiseRun, ASearchThatHasConvergedIsDoneWhateverTheTolerance) {
  OptimiseOptions given = options("run", 20000);
  given.tolerance = 1e-60;
  given.compare_every = 0;
  const OptimiseResult result = optimise(from_, to_, given);
  EXPECT_EQ(result.stopped, OptimiseStopped::done);
  EXPECT_GT(result.objective, given.tolerance);
  EXPECT_LT(result.evaluations, given.evaluations);
}

TEST_F(OptimiseRun, RaisesTheLowerOfTwoDegrees) {
  const OptimiseResult result = optimise(from_, load_airfoil("naca:4412", 7), options("run", 5));
  EXPECT_EQ(result.best.degree(), 7);
}

}  // namespace
}  // namespace remodel
