#pragma once

// The history of an optimisation run: one SQLite file, one row an evaluation. Every figure of a run's result
// is derived from it.
//
// Table run(key, value): "version", "options" (JSON), "seed", "from" and "to" (CST as JSON).
// Table evaluations: the members of EvaluationRecord under their names; coefficients as a JSON array, upper
// surface first; NULL for what was not measured.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace remodel {

// How a remodelled mesh was validated: by the rules of Mesh::quick_check() where the step changed it, which
// is enough if the mesh before was valid; by quick_check(); by check() of check.h as well.
enum class Checked { changes, quick, full };
const char* name_of(Checked checked);

struct EvaluationRecord {
  std::uint64_t evaluation = 0;          // from 1
  std::uint64_t generation = 0;          // of the CMA-ES, from 0
  std::vector<double> coefficients;      // upper surface, then lower
  double objective = 0.0;                // mean square distance in y, square chords
  double best_objective = 0.0;           // so far, this evaluation included
  double sigma = 0.0;                    // of the distribution that it was sampled from
  std::uint64_t infeasible_samples = 0;  // refused since the evaluation before
  std::uint64_t worker = 1;              // whose mesh it was, from 1

  std::size_t triangles_before = 0;  // of the mesh that the same worker had for its evaluation before
  std::size_t triangles = 0;
  std::size_t preserved = 0;
  double preserved_percent = 0.0;
  std::size_t moved = 0;
  std::size_t inserted = 0;
  std::size_t removed = 0;
  bool full_adjustment = false;
  bool refreshed = false;      // the strategy generated the mesh afresh
  bool regenerated = false;    // the mesh had to be regenerated: a recovery
  double min_angle_deg = 0.0;  // of the mesh; where its changes were checked, of these
  // Making the domain and remodel(), the recovery too if there was one: processor time of the thread.
  double remodel_seconds = 0.0;

  std::optional<std::size_t>
      generated_triangles;  // compared evaluations only: a fresh mesh of the same design
  std::optional<double> gradation_bias, gradation_deviation;  // of the remodelled mesh: GradationError
  std::optional<double> generated_gradation_bias, generated_gradation_deviation;  // of the fresh one
  std::optional<double> generate_seconds;  // making the domain and generate(): likewise

  Checked checked = Checked::quick;
  bool valid = true;   // what the remodelled mesh was before any recovery
  std::string detail;  // the broken rule, or why the mesh was regenerated; empty (NULL) otherwise
};

// One open history file. Every SQLite error is an Error (file). Records are buffered and written in one
// transaction a batch; what was not committed when the process ends is not in the file.
class History {
 public:
  // Replaces what the file was.
  static History create(const std::filesystem::path& file, const std::map<std::string, std::string>& run);
  // Opens an existing one to go on after `last`: later rows are deleted. Error (format) if the rows 1 to last
  // are not all there.
  static History resume(const std::filesystem::path& file, std::uint64_t last);
  // Opens one to read.
  static History open(const std::filesystem::path& file);
  ~History();  // does not commit
  History(History&&) noexcept;
  History& operator=(History&&) noexcept;

  void append(const EvaluationRecord& record);
  void commit();

  std::map<std::string, std::string> run() const;
  // Calls visit for every row in order, those not yet committed too.
  void each(const std::function<void(const EvaluationRecord&)>& visit) const;
  std::vector<EvaluationRecord> records() const;

 private:
  struct Database;
  explicit History(std::unique_ptr<Database> database);
  std::unique_ptr<Database> database_;
};

}  // namespace remodel
