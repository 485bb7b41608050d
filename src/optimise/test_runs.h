#pragma once

// What tests of whole runs share.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "remodel/io.h"
#include "remodel/optimise.h"

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
    EXPECT_EQ(rows[i].evaluation, others[i].evaluation);
    EXPECT_EQ(rows[i].generation, others[i].generation);
    EXPECT_EQ(rows[i].coefficients, others[i].coefficients);
    EXPECT_EQ(rows[i].objective, others[i].objective);
    EXPECT_EQ(rows[i].sigma, others[i].sigma);
    EXPECT_EQ(rows[i].infeasible_samples, others[i].infeasible_samples);
    EXPECT_EQ(rows[i].worker, others[i].worker);
    EXPECT_EQ(rows[i].triangles_before, others[i].triangles_before);
    EXPECT_EQ(rows[i].triangles, others[i].triangles);
    EXPECT_EQ(rows[i].preserved, others[i].preserved);
    EXPECT_EQ(rows[i].moved, others[i].moved);
    EXPECT_EQ(rows[i].inserted, others[i].inserted);
    EXPECT_EQ(rows[i].removed, others[i].removed);
    EXPECT_EQ(rows[i].full_adjustment, others[i].full_adjustment);
    EXPECT_EQ(rows[i].refreshed, others[i].refreshed);
    EXPECT_EQ(rows[i].min_angle_deg, others[i].min_angle_deg);
    EXPECT_EQ(rows[i].generated_triangles, others[i].generated_triangles);
    EXPECT_EQ(rows[i].detail, others[i].detail);
  }
  for (const char* mesh : {"first.vtkhdf", "middle.vtkhdf", "last.vtkhdf"})
    EXPECT_TRUE(read_mesh(a / mesh).state() == read_mesh(b / mesh).state()) << mesh;
}

}  // namespace remodel
