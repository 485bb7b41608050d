#include "remodel/history.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "design/figure_columns.h"
#include "design/record_ranges.h"
#include "design/sqlite.h"
#include "remodel/error.h"

namespace remodel {
namespace {

constexpr std::uint64_t table_version = 5;
constexpr std::size_t batch = 250;  // records a transaction

std::string schema() {
  return "PRAGMA user_version = " + std::to_string(table_version) +
         "; CREATE TABLE run (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;"
         "CREATE TABLE evaluations (" +
         column_definitions(evaluation_figures, Missing::never) + ", PRIMARY KEY (evaluation));";
}

std::string insert_row() {
  return "INSERT INTO evaluations VALUES (" + placeholders(evaluation_figures) + ")";
}

}  // namespace

struct History::Database {
  Database(std::filesystem::path path, Sqlite::Open how)
      : sqlite(std::move(path), "the run's history", how) {}
  Sqlite sqlite;
  std::vector<EvaluationRecord> pending;
};

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
  database->sqlite.execute(schema());
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
  Statement row(database, "PRAGMA user_version");
  row.step();
  if (const std::uint64_t found = row.integer(); found != table_version)
    throw Error(ErrorCode::format, database.file().string(),
                "expected the history of a run, version " + std::to_string(table_version) +
                    ", found version " + std::to_string(found));
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
  Statement row(database_->sqlite, insert_row());
  for (const EvaluationRecord& record : database_->pending) {
    bind_figures(row, evaluation_figures, record);
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
      read_figures(row, evaluation_figures, record);
    } catch (const nlohmann::json::exception&) {
      refuse("expected lists of numbers as JSON");
    } catch (const std::invalid_argument& problem) {
      refuse(problem.what());
    }
    if (const std::string problem = out_of_range(record); !problem.empty()) refuse(problem);
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
