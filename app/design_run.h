#pragma once

// A run of `remodel design` as its history has it.

#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "flow_space.h"
#include "remodel/flow.h"
#include "remodel/history.h"
#include "report.h"

namespace remodel::app {

struct DesignRun {
  Json options;  // of the history; "problem" is the file's, but for designer and verification
  std::vector<std::string> constraint_names;  // of each function that an evaluation has
  double constraint_tolerance = 0.0;
  std::vector<EvaluationRecord> rows;
  std::size_t best = 0;   // row; without a best design the least violated one's, or the first
  bool has_flow = false;  // of that row; otherwise none of any design was found
  std::vector<FlowConditions> conditions;  // of the points
  std::unique_ptr<const FlowSpace> space;

  const std::vector<double>& best_design() const { return rows[best].coefficients; }
  bool has_best() const { return std::isfinite(rows[best].best_objective); }
  // Of the start, where the search evaluated it and found its flows.
  std::optional<double> start_objective() const;
  bool with_gradients() const { return rows.front().outputs.contains("gradient_seconds"); }
  double sum(const char* output) const;  // over all rows that have it
  // By how much the design of `best` violates each constraint at its worst, by name.
  Json violations() const;
  // Without a best design: which constraint is violated most at the least violated design, or that no flow
  // was found.
  std::string why_no_design() const;
};

// Whether the directory holds a run of `remodel design`, rather than of `remodel optimise`.
bool holds_design_run(const std::filesystem::path& directory);
// Throws Error (file, format) for a directory that holds no such run.
DesignRun read_design_run(const std::filesystem::path& directory);

// Closed polygons of the sections of a design, where they lie.
std::vector<std::vector<Point>> outlines(const FlowSpace& space, std::span<const double> design);
// x0, y0, x1, y1 of what is worth seeing around the sections of the start and of the best design: `beside`
// and `above` parts of their common width more on each side. What is given for one section.
std::array<double, 4> window_of(const DesignRun& run, const std::array<double, 4>& of_one, double beside,
                                double above);

}  // namespace remodel::app
