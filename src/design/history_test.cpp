#include "remodel/history.h"

#include <gtest/gtest.h>
#include <sqlite3.h>
#include <unistd.h>

#include <fstream>
#include <limits>

#include "remodel/error.h"
#include "remodel/evaluation.h"

namespace remodel {
namespace {

namespace fs = std::filesystem;

class HistoryFile : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = fs::temp_directory_path() / ("remodel-history-" + std::to_string(getpid()));
    fs::create_directories(directory_);
  }
  void TearDown() override { fs::remove_all(directory_); }
  fs::path file() const { return directory_ / "history.sqlite"; }

  fs::path directory_;
};

EvaluationRecord record_of(std::uint64_t evaluation) {
  EvaluationRecord record;
  record.evaluation = evaluation;
  record.generation = evaluation / 11;
  record.coefficients = {1.0 / 3.0, -0.1, 5e-324, 1e300, static_cast<double>(evaluation)};
  record.objective = 0.1 / static_cast<double>(evaluation);
  record.best_objective = record.objective;
  record.sigma = 0.05;
  record.infeasible_samples = evaluation % 3;
  record.triangles_before = 4600;
  record.triangles = 4601;
  record.preserved = 4200;
  record.preserved_percent = 100.0 * 4200.0 / 4600.0;
  record.moved = 199;
  record.inserted = 2;
  record.removed = 1;
  record.full_adjustment = evaluation % 2 == 0;
  record.min_angle_deg = 30.0000001;
  record.remodel_seconds = 1.25e-4;
  if (evaluation % 5 == 0) {
    record.generated_triangles = 4500 + evaluation;
    record.generate_seconds = 0.002;
  }
  record.checked = static_cast<Checked>(evaluation % 3);
  if (evaluation % 7 == 0) {
    record.valid = false;
    record.regenerated = true;
    record.detail = "delaunay: triangle 12, it's wrong";
    record.objective = Evaluation::failed;
    record.constraints = {-1.0, 1.0 / 3.0};
    record.outputs = {{"cl", 0.1}, {"it's \"cd\"", 1e-300}};
  }
  return record;
}

void expect_equal(const EvaluationRecord& a, const EvaluationRecord& b) {
  for_each_figure(evaluation_figures, a, [&](const auto& figure, const auto& value) {
    EXPECT_EQ(value, b.*(figure.member)) << figure.name;
  });
}

TEST_F(HistoryFile, GivesBackExactlyWhatWasAppendedBeforeAndAfterTheCommit) {
  History history = History::create(file(), {{"seed", "1"}, {"from", "{\"a\": 'quoted'}"}});
  for (std::uint64_t i = 1; i <= 777; ++i) history.append(record_of(i));
  const auto before = history.records();
  history.commit();
  const History reader = History::open(file());
  const auto after = reader.records();
  ASSERT_EQ(before.size(), 777u);
  ASSERT_EQ(after.size(), 777u);
  for (std::uint64_t i = 1; i <= 777; ++i) {
    expect_equal(before[i - 1], record_of(i));
    expect_equal(after[i - 1], record_of(i));
  }
  EXPECT_EQ(reader.run(), (std::map<std::string, std::string>{{"seed", "1"}, {"from", "{\"a\": 'quoted'}"}}));
}

TEST_F(HistoryFile, LosesOnlyWhatWasNotCommitted) {
  {
    History history = History::create(file(), {});
    for (std::uint64_t i = 1; i <= 10; ++i) history.append(record_of(i));
    history.commit();
    history.append(record_of(11));
  }
  EXPECT_EQ(History::open(file()).records().size(), 10u);
}

TEST_F(HistoryFile, IsCutBackToTheCheckpointOnResume) {
  {
    History history = History::create(file(), {});
    for (std::uint64_t i = 1; i <= 20; ++i) history.append(record_of(i));
    history.commit();
  }
  {
    History history = History::resume(file(), 15);
    EXPECT_EQ(history.records().size(), 15u);
    history.append(record_of(16));
    history.commit();
  }
  const auto records = History::open(file()).records();
  ASSERT_EQ(records.size(), 16u);
  expect_equal(records.back(), record_of(16));
}

TEST_F(HistoryFile, IsNotResumedWhereEvaluationsAreMissing) {
  History history = History::create(file(), {});
  for (std::uint64_t i = 1; i <= 5; ++i) history.append(record_of(i));
  history.commit();
  EXPECT_THROW(History::resume(file(), 6), Error);
  EXPECT_NO_THROW(History::resume(file(), 5));
}

TEST_F(HistoryFile, RefusesTheSameEvaluationTwiceAndStaysAsItWas) {
  History history = History::create(file(), {});
  history.append(record_of(1));
  history.commit();
  history.append(record_of(2));
  history.append(record_of(1));
  EXPECT_THROW(history.commit(), Error);
  EXPECT_EQ(History::open(file()).records().size(), 1u);
}

TEST_F(HistoryFile, ReplacesWhatTheFileWasWhenCreated) {
  std::ofstream(file()) << "something else";
  EXPECT_THROW(History::open(file()).records(), Error);
  EXPECT_TRUE(History::create(file(), {}).records().empty());
}

TEST_F(HistoryFile, NamesTheFileThatCannotBeOpened) {
  const fs::path missing = directory_ / "no" / "history.sqlite";
  for (const auto& open :
       {+[](const fs::path& f) { History::open(f); }, +[](const fs::path& f) { History::create(f, {}); },
        +[](const fs::path& f) { History::resume(f, 0); }}) {
    try {
      open(missing);
      FAIL() << "no error";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::file);
      EXPECT_NE(std::string(error.what()).find(missing.string()), std::string::npos) << error.what();
    }
  }
}

TEST_F(HistoryFile, CanBeReadByPlainSql) {
  History history = History::create(file(), {});
  for (std::uint64_t i = 1; i <= 10; ++i) history.append(record_of(i));
  history.commit();
  sqlite3* connection = nullptr;
  ASSERT_EQ(sqlite3_open_v2(file().c_str(), &connection, SQLITE_OPEN_READONLY, nullptr), SQLITE_OK);
  sqlite3_stmt* row = nullptr;
  ASSERT_EQ(sqlite3_prepare_v2(connection,
                               "SELECT sum(full_adjustment), count(generated_triangles), "
                               "sum(json_extract(coefficients, '$[4]')) FROM evaluations",
                               -1, &row, nullptr),
            SQLITE_OK);
  ASSERT_EQ(sqlite3_step(row), SQLITE_ROW);
  EXPECT_EQ(sqlite3_column_int(row, 0), 5);
  EXPECT_EQ(sqlite3_column_int(row, 1), 2);
  EXPECT_EQ(sqlite3_column_double(row, 2), 55.0);
  sqlite3_finalize(row);
  sqlite3_close(connection);
}

}  // namespace
}  // namespace remodel
