#include "remodel/history.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "optimise/sqlite.h"
#include "remodel/error.h"

namespace remodel {
namespace {

constexpr const char* checked_names[] = {"changes", "quick", "full"};

Checked checked_named(const std::string& name) {
  const auto* found = std::find(std::begin(checked_names), std::end(checked_names), name);
  if (found == std::end(checked_names))
    throw std::invalid_argument("expected changes, quick or full under `checked`");
  return static_cast<Checked>(found - std::begin(checked_names));
}

constexpr std::size_t batch = 250;  // records a transaction

// The order of the columns is that of bind() and read_row().
constexpr const char* schema = R"(
PRAGMA user_version = 3;
CREATE TABLE run (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE evaluations (
  evaluation INTEGER PRIMARY KEY,
  generation INTEGER NOT NULL,
  coefficients TEXT NOT NULL,
  objective REAL NOT NULL,
  best_objective REAL NOT NULL,
  sigma REAL NOT NULL,
  infeasible_samples INTEGER NOT NULL,
  worker INTEGER NOT NULL,
  triangles_before INTEGER NOT NULL,
  triangles INTEGER NOT NULL,
  preserved INTEGER NOT NULL,
  preserved_percent REAL NOT NULL,
  moved INTEGER NOT NULL,
  inserted INTEGER NOT NULL,
  removed INTEGER NOT NULL,
  full_adjustment INTEGER NOT NULL,
  refreshed INTEGER NOT NULL,
  regenerated INTEGER NOT NULL,
  min_angle_deg REAL NOT NULL,
  remodel_seconds REAL NOT NULL,
  generated_triangles INTEGER,
  gradation_bias REAL,
  gradation_deviation REAL,
  generated_gradation_bias REAL,
  generated_gradation_deviation REAL,
  generate_seconds REAL,
  checked TEXT NOT NULL,
  valid INTEGER NOT NULL,
  detail TEXT
);)";
constexpr const char* insert_row =
    "INSERT INTO evaluations VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)";

std::string coefficients_to_json(const std::vector<double>& coefficients) {
  return nlohmann::json(coefficients).dump();  // nlohmann writes doubles so that they read back exactly
}

}  // namespace

const char* name_of(Checked checked) {
  return checked_names[static_cast<std::size_t>(checked)];
}

struct History::Database {
  Database(std::filesystem::path path, Sqlite::Open how)
      : sqlite(std::move(path), "the run's history", how) {}
  Sqlite sqlite;
  std::vector<EvaluationRecord> pending;
};

namespace {

void bind(Statement& row, const EvaluationRecord& record) {
  row.bind_integer(record.evaluation);
  row.bind_integer(record.generation);
  row.bind(coefficients_to_json(record.coefficients));
  row.bind(record.objective);
  row.bind(record.best_objective);
  row.bind(record.sigma);
  row.bind_integer(record.infeasible_samples);
  row.bind_integer(record.worker);
  row.bind_integer(record.triangles_before);
  row.bind_integer(record.triangles);
  row.bind_integer(record.preserved);
  row.bind(record.preserved_percent);
  row.bind_integer(record.moved);
  row.bind_integer(record.inserted);
  row.bind_integer(record.removed);
  row.bind_integer(record.full_adjustment);
  row.bind_integer(record.refreshed);
  row.bind_integer(record.regenerated);
  row.bind(record.min_angle_deg);
  row.bind(record.remodel_seconds);
  row.bind_integer(record.generated_triangles);
  row.bind(record.gradation_bias);
  row.bind(record.gradation_deviation);
  row.bind(record.generated_gradation_bias);
  row.bind(record.generated_gradation_deviation);
  row.bind(record.generate_seconds);
  row.bind(std::string(name_of(record.checked)));
  row.bind_integer(record.valid);
  if (record.detail.empty()) return row.bind_null();
  row.bind(record.detail);
}

void read_row(Statement& row, EvaluationRecord& record) {
  record.evaluation = row.integer();
  record.generation = row.integer();
  record.coefficients = nlohmann::json::parse(row.text()).get<std::vector<double>>();
  record.objective = row.real();
  record.best_objective = row.real();
  record.sigma = row.real();
  record.infeasible_samples = row.integer();
  record.worker = row.integer();
  record.triangles_before = row.integer();
  record.triangles = row.integer();
  record.preserved = row.integer();
  record.preserved_percent = row.real();
  record.moved = row.integer();
  record.inserted = row.integer();
  record.removed = row.integer();
  record.full_adjustment = row.integer() != 0;
  record.refreshed = row.integer() != 0;
  record.regenerated = row.integer() != 0;
  record.min_angle_deg = row.real();
  record.remodel_seconds = row.real();
  record.generated_triangles = row.optional_integer();
  record.gradation_bias = row.optional_real();
  record.gradation_deviation = row.optional_real();
  record.generated_gradation_bias = row.optional_real();
  record.generated_gradation_deviation = row.optional_real();
  record.generate_seconds = row.optional_real();
  record.checked = checked_named(row.text());
  record.valid = row.integer() != 0;
  record.detail = row.text();
}

}  // namespace

History::History(std::unique_ptr<Database> database) : database_(std::move(database)) {}
History::~History() = default;
History::History(History&&) noexcept = default;
History& History::operator=(History&&) noexcept = default;

// The rollback journal, not write-ahead logging: there is one writer and a commit every few seconds, so that
// readers hardly wait; the run is one file that can be copied at any time between commits; and it works on
// network file systems, which write-ahead logging does not.
History History::create(const std::filesystem::path& file, const std::map<std::string, std::string>& run) {
  std::error_code ignored;
  std::filesystem::remove(file, ignored);
  std::filesystem::path journal = file;
  journal += "-journal";  // of a killed run: it would be rolled back into the new file
  std::filesystem::remove(journal, ignored);

  auto database = std::make_unique<Database>(file, Sqlite::Open::create);
  Transaction transaction(database->sqlite);
  database->sqlite.execute(schema);
  Statement row(database->sqlite, "INSERT INTO run VALUES (?,?)");
  for (const auto& [key, value] : run) {
    row.bind(key);
    row.bind(value);
    row.run();
  }
  transaction.commit();
  return History(std::move(database));
}

namespace {

void require_version(const Sqlite& database) {
  Statement version(database, "PRAGMA user_version");
  version.step();
  if (const std::uint64_t found = version.integer(); found != 3)
    throw Error(ErrorCode::format, database.file().string(),
                "expected the history of a run, version 3, found version " + std::to_string(found));
}

}  // namespace

History History::open(const std::filesystem::path& file) {
  auto database = std::make_unique<Database>(file, Sqlite::Open::existing);
  // A killed run may have left a transaction half written, which only a writer can take back. Where the file
  // cannot be written SQLite opens it to read.
  require_version(database->sqlite);
  return History(std::move(database));
}

History History::resume(const std::filesystem::path& file, std::uint64_t last) {
  auto database = std::make_unique<Database>(file, Sqlite::Open::existing);
  require_version(database->sqlite);
  {
    Statement later(database->sqlite, "DELETE FROM evaluations WHERE evaluation > ?");
    later.bind_integer(last);
    later.step();
  }
  Statement count(database->sqlite, "SELECT count(*) FROM evaluations WHERE evaluation >= 1");
  count.step();
  if (const std::uint64_t found = count.integer(); found != last)
    throw Error(ErrorCode::format, file.string(),
                "expected the first " + std::to_string(last) + " evaluations of the run, found " +
                    std::to_string(found));
  return History(std::move(database));
}

void History::append(const EvaluationRecord& record) {
  database_->pending.push_back(record);
  if (database_->pending.size() >= batch) commit();
}

void History::commit() {
  if (database_->pending.empty()) return;
  Transaction transaction(database_->sqlite);
  Statement row(database_->sqlite, insert_row);
  for (const EvaluationRecord& record : database_->pending) {
    bind(row, record);
    row.run();
  }
  transaction.commit();
  database_->pending.clear();
}

std::map<std::string, std::string> History::run() const {
  std::map<std::string, std::string> result;
  Statement row(database_->sqlite, "SELECT key, value FROM run");
  while (row.step()) {
    const std::string key = row.text();
    result[key] = row.text();
  }
  return result;
}

void History::each(const std::function<void(const EvaluationRecord&)>& visit) const {
  Statement row(database_->sqlite, "SELECT * FROM evaluations ORDER BY evaluation");
  while (row.step()) {
    EvaluationRecord record;
    const auto refuse = [&](const std::string& problem) {
      throw Error(ErrorCode::format, database_->sqlite.file().string(),
                  "evaluation " + std::to_string(record.evaluation) + ": " + problem);
    };
    try {
      read_row(row, record);
    } catch (const nlohmann::json::exception&) {
      refuse("expected coefficients as a JSON array");
    } catch (const std::invalid_argument& problem) {
      refuse(problem.what());
    }
    visit(record);
  }
  for (const EvaluationRecord& record : database_->pending) visit(record);
}

std::vector<EvaluationRecord> History::records() const {
  std::vector<EvaluationRecord> result;
  each([&](const EvaluationRecord& record) { result.push_back(record); });
  return result;
}

}  // namespace remodel
