#include "study/study.h"
#include "remodel/shape_files.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <fstream>
#include <map>
#include <stdexcept>

#include "design/airfoil_space.h"
#include "design/sqlite.h"
#include "remodel/error.h"
#include "remodel/optimise.h"
#include "study/plan.h"
#include "study/store.h"
#include "study/work.h"

namespace remodel {
namespace {

namespace fs = std::filesystem;

// The content that has to be reproducible: everything but times.
const std::map<std::string, const char*> promised = {
    {"scenarios",
     "SELECT id, airfoil, sigma, scenario, seed, evaluations, infeasible_samples, objective, max_error, "
     "best, "
     "hex(path) FROM scenarios ORDER BY id"},
    {"fresh",
     "SELECT scenario_id, points, gradation, evaluation, triangles, gradation_bias, gradation_deviation FROM "
     "fresh ORDER BY scenario_id, points, evaluation"},
    {"replays",
     "SELECT id, scenario_id, points, gradation, distance, strategy, evaluations, full_adjustments, "
     "triangles_mean, preserved_percent, lost_mean, generated_triangles_mean, surplus_percent, "
     "min_angle_deg, "
     "invalid_meshes, recoveries, refreshes, gradation_bias, gradation_deviation, generated_gradation_bias, "
     "generated_gradation_deviation, stopped, detail FROM replays ORDER BY id"},
    {"blocks",
     "SELECT replay_id, first, last, triangles_mean, preserved_percent, lost_mean, full_adjustments, "
     "surplus_percent FROM blocks ORDER BY replay_id, first"},
    {"comparisons",
     "SELECT replay_id, evaluation, triangles, gradation_deviation FROM comparisons ORDER BY replay_id, "
     "evaluation"},
};
constexpr int most_columns = 23;

using Tables = std::map<std::string, std::vector<std::vector<std::string>>>;

Tables tables_of(const fs::path& directory) {
  const Sqlite database(directory / "study.sqlite", "the study", Sqlite::Open::existing);
  Tables tables;
  for (const auto& [name, query] : promised) {
    Statement row(database, query);
    while (row.step()) {
      std::vector<std::string>& values = tables[name].emplace_back();
      for (int column = 0; column < most_columns; ++column) values.push_back(row.text());
    }
  }
  return tables;
}

// Meshes of about a thousand triangles.
class Study : public testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::temp_directory_path() / ("remodel-study-" + std::to_string(getpid()));
    fs::remove_all(root_);
    fs::create_directory(root_);
  }
  void TearDown() override { fs::remove_all(root_); }

  static StudyOptions tiny() {
    StudyOptions options;
    options.airfoils = {{"rae2822", load_airfoil("rae2822", 5)}};
    options.sigmas = {0.25};
    options.pairs = {{50, 1}, {40, 0.8}};
    options.distances = {1.0, 2.0};
    options.evaluations = 30;
    options.compare_every = 10;
    return options;
  }

  StudyResult begin(const std::string& name, const StudyOptions& options, std::size_t threads = 1) {
    ThreadCrew crew(threads);
    return study(root_ / name, options, StudyMode::begin, crew);
  }
  StudyResult resume(const std::string& name, const StudyOptions& options,
                     StudyObserver* observer = nullptr) {
    ThreadCrew crew(2);
    return study(root_ / name, options, StudyMode::resume, crew, observer);
  }
  // Whole, on one thread.
  Tables expected(const StudyOptions& options) {
    begin("expected", options);
    return tables_of(root_ / "expected");
  }

  fs::path root_;
};

struct CancelAfter : StudyObserver {
  explicit CancelAfter(std::size_t jobs) : last(jobs) {}
  void finished(const StudyProgress&) override { ++seen; }
  bool cancelled() override { return seen >= last; }
  std::size_t last;
  std::atomic<std::size_t> seen = 0;
};

TEST_F(Study, GivesTheSameRowsOnAnyNumberOfThreads) {
  const Tables one = expected(tiny());
  for (const std::size_t threads : {2U, 5U}) {
    const std::string name = std::to_string(threads);
    begin(name, tiny(), threads);
    EXPECT_EQ(tables_of(root_ / name), one) << threads << " threads";
  }
}

TEST_F(Study, CountsWhatItDid) {
  const StudyResult result = begin("a", tiny(), 2);
  EXPECT_EQ(result.stopped, StudyStopped::done);
  EXPECT_EQ(result.cells, 8U);
  EXPECT_EQ(result.replays, 8U);
  EXPECT_EQ(result.jobs, 1U + 2U + 8U);
  EXPECT_EQ(result.done, result.jobs);
  EXPECT_EQ(result.before, 0U);
  EXPECT_EQ(result.evaluations, 8U * 30U);
  EXPECT_EQ(result.invalid_meshes, 0U);
  EXPECT_EQ(result.stopped_replays, 0U);
  EXPECT_GT(result.core_seconds, 0.0);
  const Tables tables = tables_of(root_ / "a");
  EXPECT_EQ(tables.at("fresh").size(), 2U * 3U);
  EXPECT_EQ(tables.at("comparisons").size(), 8U * 3U);
  EXPECT_EQ(tables.at("blocks").size(), 8U * 30U);
}

TEST_F(Study, GoesOnFromWhereverItWasInterrupted) {
  const Tables whole = expected(tiny());
  for (const std::size_t jobs : {1U, 2U, 4U, 9U}) {
    const std::string name = "after-" + std::to_string(jobs);
    CancelAfter observer(jobs);
    ThreadCrew crew(1);
    const StudyResult first = study(root_ / name, tiny(), StudyMode::begin, crew, &observer);
    EXPECT_EQ(first.stopped, StudyStopped::interrupted);
    EXPECT_EQ(first.done, jobs);
    const StudyResult second = resume(name, tiny());
    EXPECT_EQ(second.before, jobs);
    EXPECT_EQ(second.stopped, StudyStopped::done);
    EXPECT_EQ(tables_of(root_ / name), whole);
  }
}

TEST_F(Study, DropsABegunJobWhenItIsCancelled) {
  StudyOptions options = tiny();
  options.evaluations = 1'000'000;  // minutes
  options.compare_every = 0;
  struct : StudyObserver {
    void finished(const StudyProgress&) override { ADD_FAILURE() << "no job can end so soon"; }
    bool cancelled() override { return ++asked > 20; }
    std::atomic<int> asked = 0;
  } observer;
  ThreadCrew crew(2);
  const StudyResult result = study(root_ / "a", options, StudyMode::begin, crew, &observer);
  EXPECT_EQ(result.stopped, StudyStopped::interrupted);
  EXPECT_EQ(result.done, 0U);
}

TEST_F(Study, GrowsIntoTheStudyThatItWouldHaveBeen) {
  StudyOptions small = tiny(), large = tiny();
  small.pairs = large.pairs = {{40, 0.8}};
  small.distances = {1.0};
  small.strategies = {"chain"};
  large.sigmas = {0.25, 0.05};
  large.airfoils.push_back({"goe459", load_airfoil("goe459", 5)});
  large.scenarios = 2;
  begin("grown", small);
  const StudyResult result = resume("grown", large);
  EXPECT_EQ(result.before, 3U);
  EXPECT_EQ(tables_of(root_ / "grown"), expected(large));
  // A study that is resumed with fewer scenarios and shorter lists keeps its own.
  EXPECT_EQ(resume("grown", small).before, result.jobs);
}

TEST_F(Study, RefusesToGoOnWithOtherOptions) {
  begin("a", tiny());
  const std::map<std::string, std::function<void(StudyOptions&)>> changes = {
      {"pairs", [](StudyOptions& options) { options.pairs.pop_back(); }},
      {"evaluations", [](StudyOptions& options) { options.evaluations = 40; }},
      {"compare_every", [](StudyOptions& options) { options.compare_every = 5; }},
      {"check_every", [](StudyOptions& options) { options.check_every = 5; }},
      {"validate_every", [](StudyOptions& options) { options.validate_every = 7; }},
      {"seed", [](StudyOptions& options) { options.seed = 2; }},
      {"the design of rae2822", [](StudyOptions& options) { options.airfoils[0].design.upper[1] *= 1.01; }},
  };
  const Tables before = tables_of(root_ / "a");
  for (const auto& [name, change] : changes) {
    StudyOptions options = tiny();
    change(options);
    try {
      resume("a", options);
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  }
  EXPECT_EQ(tables_of(root_ / "a"), before);
}

TEST_F(Study, KeepsItsOptions) {
  begin("a", tiny());
  const StudyOptions options = read_study_options(root_ / "a");
  EXPECT_EQ(options.airfoils, tiny().airfoils);
  EXPECT_EQ(options.sigmas, tiny().sigmas);
  EXPECT_EQ(options.pairs, tiny().pairs);
  EXPECT_EQ(options.distances, tiny().distances);
  EXPECT_EQ(options.strategies, tiny().strategies);
  EXPECT_EQ(options.scenarios, 1U);
  EXPECT_EQ(options.evaluations, 30U);
  EXPECT_EQ(options.compare_every, 10U);
  EXPECT_EQ(options.seed, 1U);
}

// With one pair, feasibility is that of a run: then path and replays are those of optimise().
TEST_F(Study, ReplaysWhatOptimiseDoes) {
  StudyOptions options = tiny();
  options.pairs = {{50, 1}};
  options.distances = {2.0};
  options.evaluations = 60;
  options.seed = 3;
  begin("study", options);
  StudyStore store(root_ / "study");
  const StudyPath path = store.path(JobKey{});
  const auto replays = tables_of(root_ / "study").at("replays");
  ASSERT_EQ(replays.size(), 2U);
  for (const MeshStrategy strategy : {MeshStrategy::chain, MeshStrategy::renew}) {
    const fs::path directory = root_ / name_of(strategy);
    const OptimiseResult run = optimise(study_start().design, options.airfoils[0].design,
                                        {.domain = {.points = 50},
                                         .quality = {.gradation = 1.0},
                                         .remodel = {.distance = 2.0},
                                         .strategy = strategy,
                                         .sigma = 0.25,
                                         .seed = 3,
                                         .evaluations = 60,
                                         .compare_every = 10,
                                         .directory = directory});
    const auto records = History::open(directory / "history.sqlite").records();
    ASSERT_EQ(path.evaluations(), records.size());
    for (std::size_t i = 0; i < records.size(); ++i) {
      const auto coefficients = path.coefficients(i);
      EXPECT_EQ(std::vector<double>(coefficients.begin(), coefficients.end()), records[i].coefficients);
      EXPECT_EQ(path.sigma(i), records[i].sigma);
      EXPECT_EQ(path.objective(i), records[i].objective);
    }
    const Sqlite database(root_ / "study" / "study.sqlite", "the study", Sqlite::Open::existing);
    Statement row(database,
                  "SELECT triangles_mean, preserved_percent, lost_mean, generated_triangles_mean, "
                  "surplus_percent, min_angle_deg, gradation_deviation, generated_gradation_deviation, "
                  "full_adjustments, infeasible_samples, objective, max_error FROM replays "
                  "JOIN (SELECT infeasible_samples, objective, max_error FROM scenarios) WHERE strategy = ?");
    row.bind(std::string(name_of(strategy)));
    // The expressions below read the columns of SQLite one after the other.
    Statement& value = row;
    ASSERT_TRUE(row.step());
    for (const double figure :
         {run.triangles_mean, run.preserved_percent, run.lost_mean, run.generated_triangles_mean,
          run.surplus_percent, run.min_angle_deg, run.gradation_deviation, run.generated_gradation_deviation})
      EXPECT_EQ(value.real(), figure);
    EXPECT_EQ(value.integer(), run.full_adjustments);
    EXPECT_EQ(value.integer(), run.infeasible_samples);
    EXPECT_EQ(value.real(), run.objective);
    EXPECT_EQ(value.real(), run.max_error);
  }
}

// Polygons of 8 points may touch where those of 50 do not: designs must be feasible for both.
TEST_F(Study, ItsPathsAreFeasibleForEveryPair) {
  StudyOptions options = tiny();
  options.sigmas = {0.5};
  options.pairs = {{200, 4}, {50, 1}, {8, 1}};
  StudyWork work;
  work.from = study_start().design;
  work.to = options.airfoils[0].design;
  work.evaluations = 300;
  work.sigma = 0.5;
  work.seed = 1;
  work.points = {200, 50, 8};
  const PathRows rows = compute_path(work, {});
  ASSERT_EQ(rows.path.evaluations(), 300U);
  EXPECT_GT(rows.infeasible_samples, 0U);
  for (const int points : work.points) {
    const Feasibility feasible(work.from, {.points = points});
    for (std::size_t i = 0; i < rows.path.evaluations(); ++i) {
      const auto coefficients = rows.path.coefficients(i);
      EXPECT_TRUE(feasible(with_coefficients(work.from, {coefficients.begin(), coefficients.end()})));
    }
  }
}

// A crew that takes all jobs it can get and does the last one first, returns each once and does some twice.
struct ContraryCrew : Crew {
  void work(CrewJobs& jobs, const CrewWork& work) override {
    std::map<std::size_t, bool> given_back;
    while (!jobs.ended()) {
      std::vector<CrewJobs::Job> taken;
      while (auto job = jobs.next(0)) taken.push_back(std::move(*job));
      ASSERT_FALSE(taken.empty());
      for (; !taken.empty(); taken.pop_back()) {
        const std::size_t number = taken.back().number;
        if (!std::exchange(given_back[number], true)) {
          jobs.give_back(number);
          continue;
        }
        const std::string rows = *work(taken.back().work, {});
        jobs.finish(number, rows);
        jobs.give_back(number);
        jobs.finish(number, rows);
      }
    }
  }
};

TEST_F(Study, DoesNotDependOnTheOrderOfItsJobs) {
  ContraryCrew crew;
  study(root_ / "contrary", tiny(), StudyMode::begin, crew);
  EXPECT_EQ(tables_of(root_ / "contrary"), expected(tiny()));
}

TEST_F(Study, PassesOnWhatAnObserverThrows) {
  struct : StudyObserver {
    void finished(const StudyProgress&) override { throw std::runtime_error("enough"); }
  } observer;
  ThreadCrew crew(3);
  EXPECT_THROW(study(root_ / "a", tiny(), StudyMode::begin, crew, &observer), std::runtime_error);
  EXPECT_EQ(resume("a", tiny()).stopped, StudyStopped::done);
  EXPECT_EQ(tables_of(root_ / "a"), expected(tiny()));
}

TEST_F(Study, TakesADirectoryOnlyIfItIsItsOwn) {
  begin("a", tiny());
  EXPECT_THROW(begin("a", tiny()), Error);  // the directory has a study, but --resume was not given
  EXPECT_THROW(resume("nowhere", tiny()), Error);
  EXPECT_FALSE(fs::exists(root_ / "nowhere"));
  fs::create_directory(root_ / "thesis");
  std::ofstream(root_ / "thesis" / "chapter1.tex") << "years of work";
  EXPECT_THROW(begin("thesis", tiny()), Error);
  EXPECT_THROW(resume("thesis", tiny()), Error);
  // Temporary files of a killed process are no obstacle.
  fs::create_directory(root_ / "killed");
  std::ofstream(root_ / "killed" / ".study.sqlite.123.tmp") << "half";
  EXPECT_NO_THROW(begin("killed", tiny()));
  EXPECT_FALSE(fs::exists(root_ / "killed" / ".study.sqlite.123.tmp"));
}

TEST_F(Study, RefusesADatabaseThatIsNone) {
  fs::create_directory(root_ / "a");
  std::ofstream(root_ / "a" / "study.sqlite")
      << "no database, but long enough to be looked at: " << std::string(2000, 'x');
  EXPECT_THROW(resume("a", tiny()), Error);
  History::create(root_ / "a" / "study.sqlite", {});
  EXPECT_THROW(resume("a", tiny()), Error);
}

TEST_F(Study, RefusesTheStudyOfAnotherVersion) {
  begin("a", tiny());
  {
    const Sqlite database(root_ / "a" / "study.sqlite", "the study", Sqlite::Open::existing);
    database.execute("UPDATE study SET value = '0.0.1' WHERE key = 'version'");
  }
  EXPECT_THROW(resume("a", tiny()), Error);
}

TEST_F(Study, RefusesADamagedPath) {
  begin("a", tiny());
  {
    const Sqlite database(root_ / "a" / "study.sqlite", "the study", Sqlite::Open::existing);
    database.execute("UPDATE scenarios SET path = substr(path, 1, 100); DELETE FROM replays");
  }
  EXPECT_THROW(resume("a", tiny()), Error);
}

TEST_F(Study, RefusesOptionsOutOfRange) {
  const std::vector<std::function<void(StudyOptions&)>> changes = {
      [](StudyOptions& options) { options.airfoils.clear(); },
      [](StudyOptions& options) { options.airfoils.push_back(options.airfoils[0]); },
      [](StudyOptions& options) { options.airfoils[0].design.upper[2] = -3.0; },
      [](StudyOptions& options) { options.sigmas = {0.0}; },
      [](StudyOptions& options) {
        options.sigmas = {0.1, 0.1};
      },
      [](StudyOptions& options) {
        options.pairs = {{51, 1}};
      },
      [](StudyOptions& options) {
        options.pairs = {{50, 0}};
      },
      [](StudyOptions& options) { options.distances = {-1}; },
      [](StudyOptions& options) { options.distances.assign(100, 1); },
      [](StudyOptions& options) { options.strategies = {"hope"}; },
      [](StudyOptions& options) { options.scenarios = 0; },
      [](StudyOptions& options) { options.evaluations = 0; },
  };
  for (std::size_t i = 0; i < changes.size(); ++i) {
    StudyOptions options = tiny();
    changes[i](options);
    EXPECT_THROW(begin("a", options), Error) << "change " << i;
    EXPECT_FALSE(fs::exists(root_ / "a")) << "change " << i;
  }
}

TEST_F(Study, DoesWithoutComparisons) {
  StudyOptions options = tiny();
  options.compare_every = 0;
  EXPECT_EQ(begin("a", options).jobs, 1U + 8U);
  const Sqlite database(root_ / "a" / "study.sqlite", "the study", Sqlite::Open::existing);
  Statement row(database, "SELECT count(*), count(surplus_percent), count(speedup) FROM replays");
  row.step();
  EXPECT_EQ(row.integer(), 8U);
  EXPECT_EQ(row.integer(), 0U);
  EXPECT_EQ(row.integer(), 0U);
}

TEST(StudyPlan, NamesEveryRowOnceAndEveryNeedBeforeItsJob) {
  const StudyOptions options = full_study();
  ASSERT_EQ(options.airfoils.size(), 9U);
  const std::vector<PlannedJob> jobs = plan(options);
  EXPECT_EQ(jobs.size(), 810U * (1 + 6 + 6 * 4 * options.strategies.size()));
  std::set<std::uint64_t> scenarios, replays;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    for (const std::size_t needed : jobs[i].needs) EXPECT_LT(needed, i);
    const JobKey& key = jobs[i].key;
    EXPECT_TRUE(key.kind != JobKind::path || scenarios.insert(scenario_id(key)).second);
    EXPECT_TRUE(key.kind != JobKind::replay || replays.insert(replay_id(key)).second);
  }
}

TEST(StudyWorkBytes, KeepEveryNumber) {
  StudyWork work;
  work.kind = JobKind::replay;
  work.from = work.to = study_start().design;
  work.pair = {50, 1.0 / 3.0};
  work.path = {2, {0.1, 1e-300, -0.0, 1.0 / 3.0}};
  work.strategy = "chain";
  work.fresh = {{10, 1234, 0.5, 0.1, not_measured}};
  const StudyWork back = decode_work(encode(work));
  EXPECT_EQ(back.from, work.from);
  EXPECT_EQ(back.pair, work.pair);
  EXPECT_EQ(back.path.values, work.path.values);
  EXPECT_TRUE(std::signbit(back.path.values[2]));
  EXPECT_EQ(back.strategy, "chain");
  EXPECT_EQ(back.fresh.at(0).triangles, 1234U);
  EXPECT_TRUE(std::isnan(back.fresh.at(0).gradation_deviation));
}

TEST(StudyWorkBytes, AreRefusedWhereTheyAreDamaged) {
  StudyWork work;
  work.from = work.to = study_start().design;
  work.evaluations = 3;
  work.sigma = 0.1;
  work.points = {50};
  const std::string good = encode(work);
  ASSERT_TRUE(run_study_job(good, {}).has_value());
  EXPECT_THROW(run_study_job("", {}), Error);
  EXPECT_THROW(run_study_job("nonsense", {}), Error);
  for (std::size_t size = 0; size < good.size(); size += 7)
    EXPECT_THROW(run_study_job(good.substr(0, size), {}), Error) << size;
  EXPECT_THROW(decode_rows(good), Error);
}

}  // namespace
}  // namespace remodel
