#pragma once

// A study: the paper's section 5. The optimiser's path of a scenario (airfoil, sigma, number) is computed
// once, without a mesh, and replayed around one living mesh for every (I, G), D and strategy. The
// work is a list of jobs, each a pure function of bytes: the rows in the study's database are the same,
// except for their times, whoever does the jobs and in whatever order.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "remodel/airfoil.h"
#include "remodel/crew.h"

namespace remodel {

struct StudyAirfoil {
  std::string name;  // the argument of load_airfoil(), such as a catalogue name
  CstAirfoil design;
  friend bool operator==(const StudyAirfoil&, const StudyAirfoil&) = default;
};

// The paper's pair (I, G): the number of vertices on the airfoil, and the gradation.
struct StudyPair {
  int points = 200;        // even, 8 to 100000
  double gradation = 4.0;  // above 0
  friend bool operator==(const StudyPair&, const StudyPair&) = default;
};

// Each list has 1 to 99 different values. The rows of a study are a function of these options alone.
struct StudyOptions {
  std::vector<StudyAirfoil> airfoils;            // targets
  std::vector<double> sigmas{0.01, 0.05, 0.25};  // initial standard deviations of the coefficients; > 0
  // A sample must be feasible for every pair, so that all pairs replay the same designs.
  std::vector<StudyPair> pairs{{50, 1}, {100, 2}, {200, 4}, {300, 6}, {400, 8}, {700, 14}};
  std::vector<double> distances{0.5, 1, 2, 4};            // D: at least 0
  std::vector<std::string> strategies{"chain", "renew"};  // of study_strategies()
  std::size_t scenarios = 1;  // of each airfoil and sigma: 1 to 9999. Scenario k has the seed `seed` + k - 1
  std::size_t evaluations = 9000;   // feasible samples of a scenario: at least 1
  std::size_t compare_every = 100;  // every K-th evaluation is compared with a fresh mesh; 0: never
  // Every mesh is checked where the step changed it. Every K-th goes through quick_check(), which takes
  // longer than most steps, and through check(), which takes hundreds of times as long: at least 1.
  std::size_t check_every = 100;
  std::size_t validate_every = 3000;
  std::uint64_t seed = 1;
};

// Names of the strategies that a study can replay with.
std::vector<std::string> study_strategies();
// The paper's whole study: nine airfoils, three sigmas, six pairs, four D, thirty scenarios of 9000
// evaluations.
StudyOptions full_study();
// One JSON object with the members under their names. Airfoils have names only; the store has their designs
// in a table.
std::string study_options_to_json(const StudyOptions& options);
// The airfoil at which every scenario starts: NACA 0012.
StudyAirfoil study_start();

// The progress of a study. Core seconds are estimated from the kind and the size of each job.
struct StudyProgress {
  std::size_t jobs = 0, done = 0;
  double core_seconds = 0.0, core_seconds_done = 0.0;  // estimated, of all jobs and of those done
  double core_seconds_before = 0.0;                    // of those done before this session
  std::string job;                                     // the job that has just ended, in words
  double job_seconds = 0.0;                            // its time
};

// Called from one thread at a time, not always the same.
class StudyObserver {
 public:
  virtual ~StudyObserver() = default;
  virtual void finished(const StudyProgress& progress) { static_cast<void>(progress); }
  // True ends the study in order: finished jobs are in the database, unfinished ones are dropped. Called
  // often, from any thread, also concurrently.
  virtual bool cancelled() { return false; }
};

// Does one job of a study: the CrewWork of study(). `cancelled` is called at least once per mesh.
std::optional<std::string> run_study_job(const std::string& work, const std::function<bool()>& cancelled);

enum class StudyStopped { done, interrupted };
const char* name_of(StudyStopped stopped);  // "done", "interrupted"

struct StudyResult {
  std::size_t jobs = 0;
  std::size_t done = 0;                    // in the database now
  std::size_t before = 0;                  // of these, before this session
  std::size_t cells = 0;                   // (airfoil, sigma, I, G, D, strategy)
  std::size_t scenarios = 0, replays = 0;  // finished
  std::uint64_t evaluations = 0;           // remodellings of the finished replays
  std::uint64_t invalid_meshes = 0, recoveries = 0;
  std::size_t stopped_replays = 0;  // ended early by a limit
  double seconds = 0.0;             // wall time of this session
  double core_seconds = 0.0;        // of all finished jobs
  StudyStopped stopped = StudyStopped::done;
};

// Reads the options of the study in the directory. Throws Error (file, format).
StudyOptions read_study_options(const std::filesystem::path& directory);

enum class StudyMode { begin, resume };

// Runs a study, whose results are in DIR/study.sqlite; study/schema.h describes the tables. One process at a
// time holds the directory, by flock.
//
// begin: the directory is missing or empty. resume: it holds a study whose pairs, evaluations, compare_every,
// check_every, validate_every and seed are the same; airfoils, sigmas, distances, strategies and scenarios
// may be more than the study had (its own are kept), and only what is missing is done.
//
// Throws Error (argument, file, format, geometry).
StudyResult study(const std::filesystem::path& directory, const StudyOptions& options, StudyMode mode,
                  Crew& crew, StudyObserver* observer = nullptr);

}  // namespace remodel
