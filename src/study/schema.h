#pragma once

// The database of a study, DIR/study.sqlite, in write-ahead mode. All rows but their times (seconds, *_ms_*,
// speedup) are a function of version, options and seed alone; NULL: not measured, or not computed yet.
//
// study: "version", "schema", "options" (JSON: airfoils[], sigmas[], pairs[{points, gradation}], distances[],
//   scenarios, evaluations, compare_every, strategies[], seed), "machine" (JSON: processor, cores, memory_gb,
//   system, compiler), "created" (ISO 8601, UTC).
// airfoils: all targets and the start, CST as JSON (`remodel fit`).
// scenarios: one optimiser's path each. path: the 8 bytes "RMPATH01", the number of coefficients of a design
//   (n) and the number of evaluations as little-endian 64-bit integers, and for each evaluation n + 2
//   little-endian doubles: sigma of the distribution that it was sampled from, objective, coefficients, upper
//   surface first. seconds: the optimiser's alone.
// fresh: the mesh generated for a compared evaluation; once the optimiser has converged of a design near it,
//   see src/optimise/comparison.cpp. One serves every D and strategy.
// replays: a scenario's path around one living mesh; means are those of remodel/optimise.h, lost is counted
//   against the mesh of the evaluation before. A row is there only when the replay is finished. stopped:
//   "done", "infeasible" (the path ended early), "mesh-limit".
// blocks: the same means over at most 100 parts of a replay, evaluations first to last; surplus_percent over
//   the part's compared evaluations.
// comparisons: the remodelled mesh of a compared evaluation.

namespace remodel {

inline constexpr const char* study_schema_version = "1";
inline constexpr const char* study_schema = R"(
CREATE TABLE study (key TEXT PRIMARY KEY, value TEXT NOT NULL);
CREATE TABLE airfoils (name TEXT PRIMARY KEY, design TEXT NOT NULL);
CREATE TABLE scenarios (
  id INTEGER PRIMARY KEY,
  airfoil TEXT NOT NULL,
  sigma REAL NOT NULL,
  scenario INTEGER NOT NULL,
  seed INTEGER NOT NULL,
  evaluations INTEGER,
  infeasible_samples INTEGER,
  objective REAL,
  max_error REAL,
  best TEXT,
  seconds REAL,
  path BLOB,
  UNIQUE (airfoil, sigma, scenario)
);
CREATE TABLE fresh (
  scenario_id INTEGER NOT NULL,
  points INTEGER NOT NULL,
  gradation REAL NOT NULL,
  evaluation INTEGER NOT NULL,
  triangles INTEGER NOT NULL,
  seconds REAL NOT NULL,
  gradation_bias REAL,
  gradation_deviation REAL,
  PRIMARY KEY (scenario_id, points, gradation, evaluation)
) WITHOUT ROWID;
CREATE TABLE replays (
  id INTEGER PRIMARY KEY,
  scenario_id INTEGER NOT NULL,
  points INTEGER NOT NULL,
  gradation REAL NOT NULL,
  distance REAL NOT NULL,
  strategy TEXT NOT NULL,
  evaluations INTEGER NOT NULL,
  full_adjustments INTEGER NOT NULL,
  triangles_mean REAL,
  preserved_percent REAL,
  lost_mean REAL,
  generated_triangles_mean REAL,
  surplus_percent REAL,
  remodel_ms_mean REAL,
  generate_ms_mean REAL,
  speedup REAL,
  min_angle_deg REAL,
  invalid_meshes INTEGER,
  recoveries INTEGER,
  refreshes INTEGER,
  gradation_bias REAL,
  gradation_deviation REAL,
  generated_gradation_bias REAL,
  generated_gradation_deviation REAL,
  seconds REAL,
  stopped TEXT,
  detail TEXT,
  UNIQUE (scenario_id, points, gradation, distance, strategy)
);
CREATE TABLE blocks (
  replay_id INTEGER NOT NULL,
  first INTEGER NOT NULL,
  last INTEGER NOT NULL,
  triangles_mean REAL,
  preserved_percent REAL,
  lost_mean REAL,
  full_adjustments INTEGER,
  remodel_ms_mean REAL,
  surplus_percent REAL,
  PRIMARY KEY (replay_id, first)
) WITHOUT ROWID;
CREATE TABLE comparisons (
  replay_id INTEGER NOT NULL,
  evaluation INTEGER NOT NULL,
  triangles INTEGER NOT NULL,
  gradation_deviation REAL,
  PRIMARY KEY (replay_id, evaluation)
) WITHOUT ROWID;
)";

}  // namespace remodel
