#include "study/store.h"

#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <utility>

#include "design/figure_columns.h"
#include "remodel/error.h"
#include "remodel/version.h"
#include "study/machine.h"
#include "study/options.h"
#include "study/schema.h"

namespace remodel {
namespace {

namespace fs = std::filesystem;

constexpr const char* file_name = "study.sqlite";
constexpr const char* what = "the study's database";

constexpr std::string_view path_magic = "RMPATH01";

void put(std::string& bytes, std::uint64_t value) {
  for (int shift = 0; shift < 64; shift += 8) bytes.push_back(static_cast<char>(value >> shift & 0xff));
}

std::uint64_t get(std::string_view bytes, std::size_t word) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < 8; ++i)
    value |= std::uint64_t{static_cast<unsigned char>(bytes[8 * word + i])} << 8 * i;
  return value;
}

std::string blob_of(const StudyPath& path) {
  std::string bytes(path_magic);
  put(bytes, path.dimension);
  put(bytes, path.evaluations());
  for (const double value : path.values) put(bytes, std::bit_cast<std::uint64_t>(value));
  return bytes;
}

StudyPath path_of(std::string_view blob, const std::string& source) {
  StudyPath path;
  bool good = blob.size() >= 24 && blob.size() % 8 == 0 && blob.starts_with(path_magic);
  if (good) {
    const std::size_t words = blob.size() / 8 - 3;
    path.dimension = get(blob, 1);
    good = path.dimension <= words && get(blob, 2) <= words && (path.dimension + 2) * get(blob, 2) == words;
  }
  if (!good) throw Error(ErrorCode::format, source, "expected a scenario's path, found something else");
  for (std::size_t word = 3; word < blob.size() / 8; ++word)
    path.values.push_back(std::bit_cast<double>(get(blob, word)));
  return path;
}

void set(const Sqlite& database, const std::string& key, const std::string& value) {
  Statement row(database, "INSERT OR REPLACE INTO study VALUES (?,?)");
  row.bind(key);
  row.bind(value);
  row.run();
}

// Inserts the rows of airfoils and scenarios that the study does not have yet.
void insert_airfoils_and_scenarios(const Sqlite& database, const StudyOptions& options) {
  Statement airfoil(database, "INSERT OR IGNORE INTO airfoils VALUES (?,?)");
  const auto insert = [&](const StudyAirfoil& entry) {
    airfoil.bind(entry.name);
    airfoil.bind(airfoil_to_json(entry.design));
    airfoil.run();
  };
  insert(study_start());
  for (const StudyAirfoil& target : options.airfoils) insert(target);

  Statement scenario(
      database, "INSERT OR IGNORE INTO scenarios (id, airfoil, sigma, scenario, seed) VALUES (?,?,?,?,?)");
  for (JobKey key; key.airfoil < options.airfoils.size(); ++key.airfoil) {
    for (key.sigma = 0; key.sigma < options.sigmas.size(); ++key.sigma) {
      for (key.scenario = 1; key.scenario <= options.scenarios; ++key.scenario) {
        scenario.bind_integer(scenario_id(key));
        scenario.bind(options.airfoils[key.airfoil].name);
        scenario.bind(options.sigmas[key.sigma]);
        scenario.bind_integer(key.scenario);
        scenario.bind_integer(scenario_seed(options, key));
        scenario.run();
      }
    }
  }
}

std::map<std::string, std::string> pairs_of(const Sqlite& database, const char* query) {
  std::map<std::string, std::string> result;
  Statement row(database, query);
  while (row.step()) {
    const std::string key = row.text();
    result[key] = row.text();
  }
  return result;
}

StudyOptions read_options(const Sqlite& database) {
  const std::string source = database.file().string();
  const std::map<std::string, std::string> study = pairs_of(database, "SELECT key, value FROM study");
  const auto value = [&](const char* key) {
    const auto found = study.find(key);
    if (found == study.end())
      throw Error(ErrorCode::format, source, std::string("expected a study, found no ") + key);
    return found->second;
  };
  const auto require = [&](const char* key, const std::string& expected) {
    if (const std::string found = value(key); found != expected)
      throw Error(ErrorCode::format, source,
                  "expected a study of " + std::string(key) + " " + expected + ", found " + found);
  };
  require("schema", study_schema_version);
  require("version", REMODEL_VERSION);
  StudyOptions options = study_options_from_json(value("options"), source);
  const std::map<std::string, std::string> designs = pairs_of(database, "SELECT name, design FROM airfoils");
  for (StudyAirfoil& airfoil : options.airfoils) {
    const auto found = designs.find(airfoil.name);
    if (found == designs.end())
      throw Error(ErrorCode::format, source, "expected the design of " + airfoil.name);
    airfoil.design = airfoil_from_json(found->second, source);
  }
  return options;
}

}  // namespace

bool StudyStore::exists(const fs::path& directory) {
  return fs::exists(directory / file_name);
}

void StudyStore::create(const fs::path& directory, const StudyOptions& options) {
  const std::string part = std::string(".") + file_name + "." + std::to_string(getpid()) + ".tmp";
  const auto drop = [&] {
    std::error_code ignored;
    fs::remove(directory / part, ignored);
    fs::remove(directory / (part + "-journal"), ignored);
  };
  drop();
  try {
    {
      const Sqlite database(directory / part, what, Sqlite::Open::create);
      Transaction transaction(database);
      database.execute(study_schema());
      set(database, "version", REMODEL_VERSION);
      set(database, "schema", study_schema_version);
      set(database, "options", study_options_to_json(options));
      set(database, "machine", machine_json());
      set(database, "created", time_now());
      insert_airfoils_and_scenarios(database, options);
      transaction.commit();
    }
    fs::rename(directory / part, directory / file_name);
  } catch (...) {
    drop();
    throw;
  }
}

StudyStore::StudyStore(const fs::path& directory)
    : database_(directory / file_name, what, Sqlite::Open::existing), options_(read_options(database_)) {
  database_.execute("PRAGMA journal_mode=WAL");
}

void StudyStore::extend(const StudyOptions& options) {
  Transaction transaction(database_);
  set(database_, "options", study_options_to_json(options));
  insert_airfoils_and_scenarios(database_, options);
  transaction.commit();
  options_ = options;
}

std::set<JobKey> StudyStore::finished() const {
  std::map<std::uint64_t, JobKey> scenarios, replays;
  std::map<std::pair<std::uint64_t, std::pair<int, double>>, JobKey> fresh;
  for (const PlannedJob& job : plan(options_)) {
    const std::uint64_t id = scenario_id(job.key);
    const StudyPair& pair = options_.pairs[job.key.pair];
    if (job.key.kind == JobKind::path) scenarios[id] = job.key;
    if (job.key.kind == JobKind::fresh) fresh[{id, {pair.points, pair.gradation}}] = job.key;
    if (job.key.kind == JobKind::replay) replays[replay_id(job.key)] = job.key;
  }
  std::set<JobKey> result;
  const auto take = [&](const auto& jobs, const auto& id) {
    if (const auto job = jobs.find(id); job != jobs.end()) result.insert(job->second);
  };
  Statement scenario(database_, "SELECT id FROM scenarios WHERE evaluations IS NOT NULL");
  while (scenario.step()) take(scenarios, scenario.integer());
  Statement mesh(database_, "SELECT DISTINCT scenario_id, points, gradation FROM fresh");
  while (mesh.step()) {
    const std::uint64_t id = mesh.integer();
    const int points = static_cast<int>(mesh.integer());
    take(fresh, std::pair{id, std::pair{points, mesh.real()}});
  }
  Statement replay(database_, "SELECT id FROM replays");
  while (replay.step()) take(replays, replay.integer());
  return result;
}

StudyPath StudyStore::path(const JobKey& key) const {
  Statement row(database_, "SELECT path FROM scenarios WHERE id = ?");
  row.bind_integer(scenario_id(key));
  row.step();
  return path_of(row.text(), database_.file().string());
}

FreshRows StudyStore::fresh(const JobKey& key) const {
  Statement row(database_,
                "SELECT " + column_names(FreshRow::figures()) +
                    " FROM fresh WHERE scenario_id = ? AND points = ? AND gradation = ? ORDER BY evaluation");
  const StudyPair& pair = options_.pairs[key.pair];
  row.bind_integer(scenario_id(key));
  row.bind_integer(static_cast<std::uint64_t>(pair.points));
  row.bind(pair.gradation);
  FreshRows rows;
  while (row.step()) read_figures(row, FreshRow::figures(), rows.emplace_back());
  return rows;
}

void StudyStore::write(const JobKey& key, const StudyRows& rows) {
  if (rows.index() != static_cast<std::size_t>(key.kind))
    throw Error(ErrorCode::format, "a study's rows", "expected those of another kind of job");
  Transaction transaction(database_);
  switch (key.kind) {
    case JobKind::path:
      write_path(key, std::get<PathRows>(rows));
      break;
    case JobKind::fresh:
      write_fresh(key, std::get<FreshRows>(rows));
      break;
    case JobKind::replay:
      write_replay(key, std::get<ReplayRows>(rows));
      break;
  }
  transaction.commit();
}

void StudyStore::write_path(const JobKey& key, const PathRows& rows) {
  Statement row(database_,
                "UPDATE scenarios SET evaluations = ?, infeasible_samples = ?, objective = ?, max_error = ?, "
                "best = ?, seconds = ?, path = ? WHERE id = ?");
  bind_figures(row, PathRows::figures(), rows);
  row.bind_bytes(blob_of(rows.path));
  row.bind_integer(scenario_id(key));
  row.run();
}

void StudyStore::write_fresh(const JobKey& key, const FreshRows& rows) {
  Statement row(database_, "INSERT INTO fresh VALUES (?,?,?," + placeholders(FreshRow::figures()) + ")");
  const StudyPair& pair = options_.pairs[key.pair];
  for (const FreshRow& fresh : rows) {
    row.bind_integer(scenario_id(key));
    row.bind_integer(static_cast<std::uint64_t>(pair.points));
    row.bind(pair.gradation);
    bind_figures(row, FreshRow::figures(), fresh);
    row.run();
  }
}

void StudyStore::write_replay(const JobKey& key, const ReplayRows& rows) {
  const std::uint64_t id = replay_id(key);
  const StudyPair& pair = options_.pairs[key.pair];
  Statement row(database_,
                "INSERT INTO replays VALUES (?,?,?,?,?,?," + placeholders(ReplayRow::figures()) + ")");
  row.bind_integer(id);
  row.bind_integer(scenario_id(key));
  row.bind_integer(static_cast<std::uint64_t>(pair.points));
  row.bind(pair.gradation);
  row.bind(options_.distances[key.distance]);
  row.bind(options_.strategies[key.strategy]);
  bind_figures(row, ReplayRow::figures(), rows.replay);
  row.run();
  const auto insert = [&](const std::string& table, const auto& figures, const auto& parts) {
    Statement part(database_, "INSERT INTO " + table + " VALUES (?," + placeholders(figures) + ")");
    for (const auto& values : parts) {
      part.bind_integer(id);
      bind_figures(part, figures, values);
      part.run();
    }
  };
  insert("blocks", BlockRow::figures(), rows.blocks);
  insert("comparisons", ComparisonRow::figures(), rows.comparisons);
}

void StudyStore::add_totals(StudyResult& result) const {
  Statement row(
      database_,
      "SELECT (SELECT count(*) FROM scenarios WHERE evaluations IS NOT NULL), count(*), "
      "total(evaluations), total(invalid_meshes), total(recoveries), total(stopped <> 'done'), "
      "total(seconds) + (SELECT total(seconds) FROM scenarios) + (SELECT total(seconds) FROM fresh) "
      "FROM replays");
  row.step();
  result.scenarios = row.integer();
  result.replays = row.integer();
  result.evaluations = row.integer();
  result.invalid_meshes = row.integer();
  result.recoveries = row.integer();
  result.stopped_replays = row.integer();
  result.core_seconds = row.real();
}

StudyPath read_study_path(std::string_view blob, const std::string& source) {
  return path_of(blob, source);
}

}  // namespace remodel
