#pragma once

// The figures of a run, accumulated from its history record by record: a resumed run replays what there is
// and so comes to the same sums.

#include "remodel/history.h"
#include "remodel/optimise.h"

namespace remodel {

class Summary {
 public:
  // Constraints may be violated by so much.
  explicit Summary(double constraint_tolerance = 0.0) : constraint_tolerance_(constraint_tolerance) {}
  void add(const EvaluationRecord& record);

  std::uint64_t evaluations() const { return evaluations_; }
  double best_objective() const { return best_objective_; }                  // infinite where there is none
  double best_before_generation() const { return best_before_generation_; }  // before that of the last record
  // Whether it has the smallest objective so far of those within all constraints.
  bool is_better(const EvaluationRecord& record) const;
  // The members of OptimiseResult that the history determines; the others keep their defaults.
  OptimiseResult result() const;

 private:
  // Sum and count of what may not have been measured.
  struct Mean {
    void add(double value) {
      sum += value;
      ++count;
    }
    void add(std::optional<double> value) {
      if (value) add(*value);
    }
    double value() const { return count == 0 ? OptimiseResult::none : sum / static_cast<double>(count); }
    double sum = 0.0;
    std::size_t count = 0;
  };

  double constraint_tolerance_;
  std::uint64_t evaluations_ = 0, infeasible_samples_ = 0, failed_ = 0, full_adjustments_ = 0, invalid_ = 0,
                recoveries_ = 0, refreshes_ = 0;
  double best_objective_ = std::numeric_limits<double>::infinity();
  double best_before_generation_ = best_objective_;
  std::uint64_t generation_ = 0;  // of the last record
  double min_angle_deg_ = std::numeric_limits<double>::infinity();
  std::vector<double> best_design_;
  std::map<std::string, double> best_outputs_;
  Mean preserved_percent_, lost_, connectivity_percent_, connectivity_kept_, changed_, triangles_,
      generated_triangles_, surplus_percent_, remodel_ms_, generate_ms_, gradation_bias_,
      gradation_deviation_, generated_gradation_bias_, generated_gradation_deviation_;
  std::string detail_;
};

}  // namespace remodel
