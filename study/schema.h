#pragma once

// The database of a study, DIR/study.sqlite, in write-ahead mode. All rows but their times (seconds, *_ms_*,
// speedup) are a function of version, options and seed alone. NULL means not measured, or not computed yet.
//
// study: "version", "schema", "options" (JSON: airfoils[], sigmas[], pairs[{points, gradation}], distances[],
//   scenarios, evaluations, compare_every, strategies[], seed), "machine" (JSON: processor, cores, memory_gb,
//   system, compiler), "created" (ISO 8601, UTC).
// airfoils: all targets and the start, CST as JSON (`remodel fit`).
// scenarios: one row per optimiser's path. path: the 8 bytes "RMPATH01", the number of coefficients of a
// design
//   (n) and the number of evaluations as little-endian 64-bit integers, and for each evaluation n + 2
//   little-endian doubles: sigma of the distribution that it was sampled from, objective, coefficients, upper
//   surface first. seconds: of the optimiser alone.
// fresh: the mesh generated for a compared evaluation. Once the optimiser has converged it is that of a
// nearby design,
//   see src/design/comparison.cpp. One row serves every D and strategy.
// replays: a scenario's path around one living mesh; means are those of remodel/optimise.h, lost is counted
//   against the mesh of the evaluation before. A row is there only when the replay is finished. stopped:
//   "done", "infeasible" (the path ended early), "mesh-limit".
// blocks: the same means over at most 100 parts of a replay, evaluations first to last; surplus_percent over
//   the part's compared evaluations.
// comparisons: the remodelled mesh of a compared evaluation.

#include <string>

#include "design/figure_columns.h"
#include "study/rows.h"

namespace remodel {

inline constexpr const char* study_schema_version = "1";

// Keys, then the figures of rows.h.
inline std::string study_schema() {
  return R"(
CREATE TABLE study (key TEXT PRIMARY KEY, value TEXT NOT NULL);
CREATE TABLE airfoils (name TEXT PRIMARY KEY, design TEXT NOT NULL);
CREATE TABLE scenarios (id INTEGER PRIMARY KEY, airfoil TEXT NOT NULL, sigma REAL NOT NULL,
  scenario INTEGER NOT NULL, seed INTEGER NOT NULL, )" +
         column_definitions(PathRows::figures(), Missing::at_first) + R"(, path BLOB,
  UNIQUE (airfoil, sigma, scenario));
CREATE TABLE fresh (scenario_id INTEGER NOT NULL, points INTEGER NOT NULL, gradation REAL NOT NULL, )" +
         column_definitions(FreshRow::figures(), Missing::at_first) + R"(,
  PRIMARY KEY (scenario_id, points, gradation, evaluation)) WITHOUT ROWID;
CREATE TABLE replays (id INTEGER PRIMARY KEY, scenario_id INTEGER NOT NULL, points INTEGER NOT NULL,
  gradation REAL NOT NULL, distance REAL NOT NULL, strategy TEXT NOT NULL, )" +
         column_definitions(ReplayRow::figures(), Missing::at_first) + R"(,
  UNIQUE (scenario_id, points, gradation, distance, strategy));
CREATE TABLE blocks (replay_id INTEGER NOT NULL, )" +
         column_definitions(BlockRow::figures(), Missing::at_first) + R"(,
  PRIMARY KEY (replay_id, first)) WITHOUT ROWID;
CREATE TABLE comparisons (replay_id INTEGER NOT NULL, )" +
         column_definitions(ComparisonRow::figures(), Missing::at_first) + R"(,
  PRIMARY KEY (replay_id, evaluation)) WITHOUT ROWID;
)";
}

}  // namespace remodel
