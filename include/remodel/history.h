#pragma once

// The history of an optimisation run: one SQLite file, one row an evaluation. Every figure of a run's result
// is derived from it.
//
// Table run(key, value): "version", "options" (JSON), of optimise() from an airfoil "seed" and "from" (CST as
// JSON), between two of them "to", and with a start mesh "place" (the airfoil's, as JSON). Table evaluations:
// `evaluation_figures`, a column each; lists as JSON arrays, outputs as a JSON object; NULL for what was not
// measured or is empty.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "remodel/living_mesh.h"

namespace remodel {

struct EvaluationRecord : MeshStep {
  std::uint64_t evaluation = 0;          // from 1
  std::uint64_t generation = 0;          // of the designer, from 0
  std::vector<double> coefficients{};    // the design; of an airfoil: upper surface, then lower
  double objective = 0.0;                // infinite: the evaluation failed, and `detail` says why
  double best_objective = 0.0;           // so far, this evaluation included, of those within all constraints
  double sigma = 0.0;                    // Designer::step_size() when it was asked for
  std::uint64_t infeasible_samples = 0;  // refused since the evaluation before
  std::uint64_t worker = 1;              // whose mesh it was, from 1
  std::vector<double> constraints{};     // as evaluated
  std::map<std::string, double> outputs{};  // likewise
};

// The columns in their order.
inline constexpr std::tuple evaluation_figures = std::tuple_cat(
    std::tuple{Figure{"evaluation", "evaluation", "", &EvaluationRecord::evaluation},
               Figure{"generation", "generation", "", &EvaluationRecord::generation},
               Figure{"coefficients", "design", "", &EvaluationRecord::coefficients},
               Figure{"objective", "objective", "", &EvaluationRecord::objective},
               Figure{"best_objective", "best objective so far", "", &EvaluationRecord::best_objective},
               Figure{"sigma", "step size", "", &EvaluationRecord::sigma},
               Figure{"infeasible_samples", "infeasible samples before it", "",
                      &EvaluationRecord::infeasible_samples},
               Figure{"worker", "worker", "", &EvaluationRecord::worker}},
    mesh_step_figures,
    std::tuple{Figure{"constraints", "constraints", "", &EvaluationRecord::constraints},
               Figure{"outputs", "outputs", "", &EvaluationRecord::outputs}});

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
