// Runs around airfoils with layers on their walls.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "design/test_runs.h"
#include "remodel/check.h"
#include "remodel/error.h"
#include "remodel/io.h"
#include "remodel/layers.h"
#include "remodel/replay.h"

namespace remodel {
namespace {

namespace fs = std::filesystem;

class LayeredRun : public OptimiseRun {
 protected:
  OptimiseOptions layered(const std::string& name, std::size_t evaluations = 40) const {
    OptimiseOptions options = OptimiseRun::options(name, evaluations);
    options.quality.gradation = 4.0;
    options.strategy = MeshStrategy::morph;
    options.compare_every = 0;
    options.checkpoint_every = 15;
    options.layers =
        RunLayers{{.first_height = 1e-4, .growth = 1.4, .thickness = 0.02},
                  WallSpacing{.leading_edge = 0.006, .trailing_edge = 0.006, .most = 0.04, .growth = 0.2}};
    return options;
  }
  // The meshes of two runs, with their layers.
  static void expect_same_layered_runs(const fs::path& a, const fs::path& b) {
    const auto rows = History::open(a / "history.sqlite").records();
    const auto others = History::open(b / "history.sqlite").records();
    ASSERT_EQ(rows.size(), others.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      for_each_figure(evaluation_figures, rows[i], [&](const auto& figure, const auto& value) {
        if (std::string(figure.unit) != "seconds") {
          EXPECT_EQ(value, others[i].*(figure.member)) << figure.name << " of row " << i;
        }
      });
    for (const char* mesh : {"first.vtkhdf", "middle.vtkhdf", "last.vtkhdf"})
      EXPECT_TRUE(read_layered_mesh(a / mesh).state() == read_layered_mesh(b / mesh).state()) << mesh;
  }
};

TEST_F(LayeredRun, LeavesMeshesWithLayersOfItsDesigns) {
  for (const MeshStrategy strategy : {MeshStrategy::morph, MeshStrategy::reference, MeshStrategy::hub}) {
    SCOPED_TRACE(name_of(strategy));
    OptimiseOptions given = layered(name_of(strategy));
    given.strategy = strategy;
    given.full_check_every = 10;
    const OptimiseResult result = optimise(from_, to_, given);
    EXPECT_EQ(result.evaluations, 40U);
    EXPECT_EQ(result.invalid_meshes, 0U) << result.detail;
    const auto rows = History::open(given.directory / "history.sqlite").records();
    const LayeredMesh last = read_layered_mesh(given.directory / "last.vtkhdf");
    EXPECT_EQ(last.quick_check(), "");
    EXPECT_TRUE(check(last.freeze(), {.min_angle_deg = 30.0, .delaunay = false}).valid);
    EXPECT_EQ(last.outer().triangle_count(), rows.back().triangles);
    std::vector<double> walls = coefficients_of(last.domain());
    walls.resize(rows.back().coefficients.size());
    EXPECT_EQ(walls, rows.back().coefficients);
    const LayeredMesh first = read_layered_mesh(given.directory / "first.vtkhdf");
    EXPECT_EQ(first.columns(), last.columns());
    EXPECT_EQ(first.levels(), last.levels());
  }
}

TEST_F(LayeredRun, ResumesToTheSameRowsAndMeshes) {
  const OptimiseOptions whole = layered("whole");
  optimise(from_, to_, whole);
  OptimiseOptions parts = layered("parts");
  StopAfter stop(23, StopAfter::How::cancel), kill(32, StopAfter::How::kill);
  EXPECT_EQ(optimise(from_, to_, parts, &stop).stopped, OptimiseStopped::interrupted);
  parts.resume = true;
  EXPECT_THROW(optimise(from_, to_, parts, &kill), std::runtime_error);
  optimise(from_, to_, parts);
  expect_same_layered_runs(whole.directory, parts.directory);

  OptimiseOptions other = parts;
  other.layers->options.first_height = 2e-4;
  EXPECT_THROW(optimise(from_, to_, other), Error);
  other.layers.reset();
  EXPECT_THROW(optimise(from_, to_, other), Error);
}

TEST_F(LayeredRun, DoesNotDependOnTheNumberOfThreads) {
  OptimiseOptions one = layered("one"), two = layered("two");
  one.workers = two.workers = 3;
  one.threads = 1, two.threads = 2;
  optimise(from_, to_, one);
  optimise(from_, to_, two);
  expect_same_layered_runs(one.directory, two.directory);
}

TEST_F(LayeredRun, IsReplayed) {
  OptimiseOptions given = layered("run");
  given.layers->wake = WakeLine{.length = 0.5, .direction = {1.0, 0.05}};
  optimise(from_, to_, given);
  const std::unique_ptr<DesignSpace> space = replayed_space(given.directory);
  ASSERT_NE(space->layers(), nullptr);
  LayeredMesh last;
  replay(given.directory, 1, [&](const EvaluationRecord& record, const Mesh& mesh) {
    last = space->layers()->around(mesh, space->walls(record.coefficients));
  });
  EXPECT_TRUE(last.state() == read_layered_mesh(given.directory / "last.vtkhdf").state());
  EXPECT_EQ(last.domain().loops.back().curves.at(0).name, "wake");
}

TEST_F(LayeredRun, BeginsWithALayeredMesh) {
  OptimiseOptions made = layered("made", 5);
  optimise(from_, to_, made);
  const LayeredMesh start = read_layered_mesh(made.directory / "last.vtkhdf");
  const auto options = [&](const char* name) {
    OptimiseOptions given = layered(name);
    given.layers = RunLayers{start.options(), std::nullopt};
    given.start = MeshStart{.mesh = start.outer(),
                            .place = find_airfoil(start.domain(), "airfoil", "test"),
                            .walls = start.domain()};
    return given;
  };
  const CstAirfoil from = fit_airfoil(start.domain(), options("x").start->place, 5).airfoil;
  const OptimiseResult result = optimise(from, to_, options("run"));
  EXPECT_EQ(result.invalid_meshes, 0U);
  EXPECT_EQ(read_layered_mesh(root_ / "run" / "last.vtkhdf").columns(),
            read_layered_mesh(root_ / "run" / "first.vtkhdf").columns());
  OptimiseOptions parts = options("parts");
  StopAfter stop(20, StopAfter::How::cancel);
  optimise(from, to_, parts, &stop);
  parts.resume = true;
  optimise(from, to_, parts);
  expect_same_layered_runs(root_ / "run", root_ / "parts");
  std::size_t seen = 0;
  replay(root_ / "run", 1, [&](const EvaluationRecord&, const Mesh&) { ++seen; });
  EXPECT_EQ(seen, 40U);
}

// A program is given the mesh with its layer, and what it leaves there is carried to the next design's
// points.
TEST_F(LayeredRun, ProgramsSeeTheLayerAndTheirStatesAreCarried) {
  const fs::path program = root_ / "solve.sh";
  fs::create_directories(root_);
  std::ofstream(program)
      << "#!/bin/sh\n"
         "quads=$(grep -c '^9 ' \"$1\")\n"
         "points=$(sed -n 's/^NPOIN= *\\([0-9]*\\).*/\\1/p' \"$1\")\n"
         "warm=0; test -e \"$2\" && warm=$(($(wc -l < \"$2\") - 1))\n"
         "{ echo '\"PointID\",\"x\",\"y\",\"T\"'; i=0; while [ $i -lt $points ]; do echo \"$i,0,0,1.5\"; "
         "i=$((i+1)); done; } > \"$2\"\n"
         "echo \"{\\\"objective\\\": 1, \\\"outputs\\\": {\\\"quads\\\": $quads, \\\"warm\\\": $warm, "
         "\\\"points\\\": $points}}\"\n";
  OptimiseOptions given = layered("run", 4);
  given.sigma = 1e-3;
  given.keep_finished = true;
  const auto evaluator = command_evaluator({"sh", program.string(), "{mesh}", "{state}"});
  StopAfter stop(2, StopAfter::How::cancel);
  EXPECT_EQ(optimise(from_, *evaluator, given, &stop).evaluations, 2U);
  given.resume = true;
  const OptimiseResult result = optimise(from_, *evaluator, given);
  ASSERT_EQ(result.failed_evaluations, 0U) << result.detail;
  const auto rows = History::open(given.directory / "history.sqlite").records();
  const LayeredMesh last = read_layered_mesh(given.directory / "last.vtkhdf");
  EXPECT_EQ(rows.back().outputs.at("quads"), static_cast<double>(last.freeze().quads.size()));
  EXPECT_EQ(rows.front().outputs.at("warm"), 0.0);
  for (std::size_t i = 1; i < rows.size(); ++i)
    EXPECT_EQ(rows[i].outputs.at("warm"), rows[i].outputs.at("points")) << i;
}

}  // namespace
}  // namespace remodel
