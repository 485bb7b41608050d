#pragma once

// What tests of whole runs share.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "remodel/io.h"
#include "remodel/mesh_state.h"
#include "remodel/optimise.h"
#include "remodel/shape_files.h"

namespace remodel {

// Runs of 50 boundary points: a mesh of about a thousand triangles.
class OptimiseRun : public testing::Test {
 protected:
  void SetUp() override {
    root_ = std::filesystem::temp_directory_path() / ("remodel-optimise-" + std::to_string(getpid()));
    std::filesystem::remove_all(root_);
  }
  void TearDown() override { std::filesystem::remove_all(root_); }

  OptimiseOptions options(const std::string& name, std::size_t evaluations = 60) const {
    return {.domain = {.points = 50},
            .quality = {.gradation = 1.0},
            .evaluations = evaluations,
            .compare_every = 10,
            .checkpoint_every = 25,
            .directory = root_ / name};
  }

  std::filesystem::path root_;
  CstAirfoil from_ = load_airfoil("naca:0012", 5);
  CstAirfoil to_ = load_airfoil("rae2822", 5);
};

// Stops the run in order, or as if it were killed, after some evaluations.
struct StopAfter : OptimiseObserver {
  enum class How { cancel, kill };
  StopAfter(std::uint64_t evaluations, How stop) : last(evaluations), how(stop) {}
  void evaluated(const EvaluationRecord& record) override {
    seen = record.evaluation;
    if (how == How::kill && seen == last) throw std::runtime_error("killed");
  }
  bool cancelled() override { return how == How::cancel && seen >= last; }
  std::uint64_t last, seen = 0;
  How how;
};

// All that is promised to be the same: the seconds are not.
inline void expect_same_runs(const std::filesystem::path& a, const std::filesystem::path& b) {
  const auto rows = History::open(a / "history.sqlite").records();
  const auto others = History::open(b / "history.sqlite").records();
  ASSERT_EQ(rows.size(), others.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    SCOPED_TRACE("row " + std::to_string(i));
    for_each_figure(evaluation_figures, rows[i], [&](const auto& figure, const auto& value) {
      if (std::string(figure.unit) != "seconds") {
        EXPECT_EQ(value, others[i].*(figure.member)) << figure.name;
      }
    });
  }
  for (const char* mesh : {"first.vtkhdf", "middle.vtkhdf", "last.vtkhdf"})
    EXPECT_TRUE(read_mesh(a / mesh).state() == read_mesh(b / mesh).state()) << mesh;
}

}  // namespace remodel
