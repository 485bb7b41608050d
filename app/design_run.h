#pragma once

// A run of `remodel design` as its history has it.

#include <filesystem>
#include <vector>

#include "remodel/flow.h"
#include "remodel/history.h"
#include "report.h"
#include "section_space.h"

namespace remodel::app {

struct DesignRun {
  Json options;  // of the history; "problem" is the file's, but for designer and verification
  std::vector<EvaluationRecord> rows;
  std::size_t best = 0;  // row
  CstAirfoil start;
  std::vector<FlowConditions> conditions;  // of the points
  SectionSpaceOptions space;

  SectionSpace section_space() const { return {start, space}; }
  bool with_gradients() const { return rows.front().outputs.contains("gradient_seconds"); }
  double sum(const char* output) const;  // over all rows that have it
};

// Whether the directory holds a run of `remodel design`, rather than of `remodel optimise`.
bool holds_design_run(const std::filesystem::path& directory);
// Throws Error (file, format) for a directory that holds no such run.
DesignRun read_design_run(const std::filesystem::path& directory);

}  // namespace remodel::app
