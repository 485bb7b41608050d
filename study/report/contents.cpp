// Reads the store of a study as means over its scenarios.

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "design/airfoil_space.h"
#include "design/sqlite.h"
#include "remodel/error.h"
#include "study/report/names.h"
#include "study/store.h"
#include "study/study_report.h"

namespace remodel {

namespace {

using OptionsJson = nlohmann::json;

constexpr const char* store_version = "1";

void read_study_table(const Sqlite& database, StudyContents& study) {
  std::map<std::string, std::string> values;
  for (Statement row(database, "SELECT key, value FROM study"); row.step();) {
    const std::string key = row.text();
    values[key] = row.text();
  }
  if (const std::string& found = values["schema"]; found != store_version)
    throw Error(
        ErrorCode::format, database.file().string(),
        "found schema '" + found + "', expected the store of a study, schema '" + store_version + "'");
  study.version = values["version"];
  study.created = values["created"];
  study.options = values["options"];
  study.machine = values["machine"];
}

std::size_t size_of(const OptionsJson& options, const char* key) {
  return options.contains(key) && options[key].is_array() ? options[key].size() : 0;
}

// Reads how much the options ask for; an unfinished study holds less.
void read_options(const Sqlite& database, StudyContents& study) {
  const OptionsJson options = OptionsJson::parse(study.options, nullptr, false);
  const auto number = [&](const char* key) -> std::size_t {
    const auto found = options.find(key);
    return found != options.end() && found->is_number_unsigned() ? found->get<std::size_t>() : 0;
  };
  if (!options.is_object())
    throw Error(ErrorCode::format, database.file().string(),
                "options: found no JSON object, expected a study's options");
  study.evaluations = number("evaluations");
  study.expected_scenarios = size_of(options, "airfoils") * size_of(options, "sigmas") * number("scenarios");
  study.expected_replays = study.expected_scenarios * size_of(options, "pairs") *
                           size_of(options, "distances") * size_of(options, "strategies");
}

void read_airfoils(const Sqlite& database, StudyContents& study) {
  for (Statement row(database, "SELECT name, design FROM airfoils"); row.step();) {
    StudyOutline airfoil;
    airfoil.name = row.text();
    airfoil.title = report::title_of(airfoil.name);
    try {
      airfoil.design = airfoil_from_json(row.text(), airfoil.name);
    } catch (const Error&) {
      // A table without an outline is still a table.
    }
    study.airfoils.push_back(std::move(airfoil));
  }
  std::ranges::sort(study.airfoils, report::before_by_name, &StudyOutline::name);
}

void read_scenarios(const Sqlite& database, StudyContents& study) {
  Statement count(database, "SELECT count(*) FROM scenarios WHERE evaluations IS NOT NULL");
  count.step();
  study.scenarios = static_cast<std::size_t>(count.integer());
  for (const char* table : {"scenarios", "fresh", "replays"}) {
    Statement seconds(database, std::string("SELECT total(seconds) FROM ") + table);
    seconds.step();
    study.seconds += seconds.real();
  }
}

// The mesh figures show the paper's own case if the study has it.
void read_pictured(const Sqlite& database, StudyContents& study) {
  constexpr std::size_t most_designs = 1001;
  Statement row(database,
                "SELECT airfoil, sigma, seed, path FROM scenarios WHERE path IS NOT NULL "
                "ORDER BY scenario, airfoil = 'rae2822' DESC, sigma DESC, id LIMIT 1");
  if (!row.step()) return;
  StudyPictured& pictured = study.pictured;
  pictured.airfoil = row.text();
  pictured.sigma = row.real();
  pictured.seed = row.integer();
  const StudyPath path = read_study_path(row.text(), database.file().string());
  const auto degree = static_cast<int>(path.dimension / 2) - 1;
  const CstAirfoil start = study_start().design;
  if (degree < start.degree() || path.dimension % 2 != 0) return;  // not a path of this start
  pictured.designs.push_back(raise_degree(start, degree));
  for (std::size_t i = 0; i < path.evaluations() && pictured.designs.size() < most_designs; ++i) {
    const auto coefficients = path.coefficients(i);
    pictured.designs.push_back(
        with_coefficients(pictured.designs.front(), {coefficients.begin(), coefficients.end()}));
  }
}

// The figures of one row, one value per scenario.
struct Samples {
  std::array<std::vector<double>, study_figure_count> figures;
  std::vector<std::int64_t> replays;
};

using RowKey = std::pair<StudyCase, std::string>;
struct RowOrder {
  bool operator()(const RowKey& a, const RowKey& b) const {
    if (a.first.airfoil != b.first.airfoil) return report::before_by_name(a.first.airfoil, b.first.airfoil);
    return a < b;
  }
};

StudyCase read_case(Statement& row) {
  StudyCase at;
  at.airfoil = row.text();
  at.sigma = row.real();
  at.points = static_cast<int>(row.integer());
  at.gradation = row.real();
  at.distance = row.real();
  return at;
}

constexpr const char* replay_columns =
    "SELECT r.id, s.airfoil, s.sigma, r.points, r.gradation, r.distance, r.strategy, r.evaluations, "
    "r.full_adjustments, r.generated_triangles_mean, r.generate_ms_mean, r.triangles_mean, "
    "r.remodel_ms_mean, "
    "r.preserved_percent, r.surplus_percent, r.speedup, r.lost_mean, r.gradation_deviation, "
    "r.generated_gradation_deviation, r.min_angle_deg, r.invalid_meshes, r.recoveries, r.refreshes, "
    "r.stopped "
    "FROM replays r JOIN scenarios s ON s.id = r.scenario_id ORDER BY s.scenario, r.id";

// Returns the row of each replay.
std::map<std::uint64_t, std::size_t> read_rows(const Sqlite& database, StudyContents& study) {
  std::map<RowKey, std::pair<StudyRow, Samples>, RowOrder> rows;
  for (Statement row(database, replay_columns); row.step();) {
    const std::uint64_t id = row.integer();
    const StudyCase at = read_case(row);
    const std::string strategy = row.text();
    auto& [sum, samples] = rows[{at, strategy}];
    const std::uint64_t evaluations = row.integer();
    const std::uint64_t full = row.integer();
    using enum StudyFigure;
    for (const StudyFigure figure :
         {generated_triangles, generate_ms, triangles, remodel_ms, preserved_percent, surplus_percent,
          speedup, lost, gradation_deviation, generated_gradation_deviation})
      samples.figures[static_cast<std::size_t>(figure)].push_back(row.real());
    if (evaluations > 0)
      samples.figures[static_cast<std::size_t>(full_adjustments_percent)].push_back(
          100.0 * static_cast<double>(full) / static_cast<double>(evaluations));
    sum.min_angle_deg = std::fmin(sum.min_angle_deg, row.real());
    sum.evaluations += evaluations;
    sum.invalid_meshes += row.integer();
    sum.recoveries += row.integer();
    sum.refreshes += row.integer();
    const std::string stopped = row.text();
    sum.stopped_early += !stopped.empty() && stopped != "done";
    samples.replays.push_back(id);
  }
  std::map<std::uint64_t, std::size_t> row_of;
  for (auto& [key, value] : rows) {
    auto& [row, samples] = value;
    row.at = key.first;
    row.strategy = key.second;
    row.scenarios = samples.replays.size();
    for (std::size_t i = 0; i < study_figure_count; ++i) row.figures[i] = study_mean(samples.figures[i]);
    for (const std::uint64_t id : samples.replays) row_of[id] = study.rows.size();
    study.replays += row.scenarios;
    study.rows.push_back(std::move(row));
  }
  return row_of;
}

void read_blocks(const Sqlite& database, const std::map<std::uint64_t, std::size_t>& row_of,
                 StudyContents& study) {
  struct Values {
    std::vector<double> triangles, preserved, surplus;
  };
  std::map<std::tuple<std::size_t, std::uint64_t, std::uint64_t>, Values> blocks;
  for (Statement row(
           database,
           "SELECT replay_id, first, last, triangles_mean, preserved_percent, surplus_percent FROM blocks");
       row.step();) {
    const auto found = row_of.find(row.integer());
    if (found == row_of.end()) continue;
    const auto first = row.integer();
    const auto last = row.integer();
    Values& values = blocks[{found->second, first, last}];
    values.triangles.push_back(row.real());
    values.preserved.push_back(row.real());
    values.surplus.push_back(row.real());
  }
  for (const auto& [key, values] : blocks)
    study.blocks.push_back({.row = std::get<0>(key),
                            .first = std::get<1>(key),
                            .last = std::get<2>(key),
                            .triangles = study_mean(values.triangles),
                            .preserved_percent = study_mean(values.preserved),
                            .surplus_percent = study_mean(values.surplus)});
}

void find_gaps(StudyContents& study) {
  const OptionsJson options = OptionsJson::parse(study.options, nullptr, false);
  if (study.expected_scenarios == 0 || study.finished()) return;
  const std::size_t groups = size_of(options, "airfoils") * size_of(options, "sigmas");
  for (const OptionsJson& airfoil : options["airfoils"]) {
    for (const OptionsJson& sigma : options["sigmas"]) {
      if (!airfoil.is_string() || !sigma.is_number()) continue;
      StudyGap gap{airfoil.get<std::string>(), sigma.get<double>(), 0, study.expected_replays / groups};
      for (const StudyRow& row : study.rows)
        if (row.at.airfoil == gap.airfoil && row.at.sigma == gap.sigma) gap.replays += row.scenarios;
      if (gap.replays < gap.expected) study.gaps.push_back(std::move(gap));
    }
  }
}

}  // namespace

StudyMean study_mean(const std::vector<double>& values) {
  StudyMean result;
  double sum = 0.0;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    sum += value;
    ++result.count;
  }
  if (result.count == 0) return result;
  result.mean = sum / static_cast<double>(result.count);
  if (result.count == 1) return result;
  double squares = 0.0;
  for (const double value : values)
    if (!std::isnan(value)) squares += (value - result.mean) * (value - result.mean);
  result.deviation = std::sqrt(squares / static_cast<double>(result.count - 1));
  return result;
}

StudyContents read_study(const std::filesystem::path& directory) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(directory, ignored))
    throw Error(ErrorCode::file, directory.string(),
                "found no such directory, expected that of a study (remodel study)");
  const std::filesystem::path file = directory / "study.sqlite";
  if (!std::filesystem::is_regular_file(file, ignored))
    throw Error(ErrorCode::file, file.string(),
                "found no such file, expected the store of a study (remodel study)");
  const Sqlite database(file, "the store of the study", Sqlite::Open::to_read);
  StudyContents study;
  study.directory = directory;
  // One transaction reads a consistent state while a running study goes on writing.
  database.execute("BEGIN");
  read_study_table(database, study);
  read_options(database, study);
  read_airfoils(database, study);
  read_scenarios(database, study);
  read_pictured(database, study);
  read_blocks(database, read_rows(database, study), study);
  if (study.rows.empty())
    throw Error(ErrorCode::format, database.file().string(),
                "found no finished replay, expected at least one");
  find_gaps(study);
  return study;
}

}  // namespace remodel
