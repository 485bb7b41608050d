#include "design/summary.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <type_traits>

namespace remodel {

const char* name_of(OptimiseStopped stopped) {
  switch (stopped) {
    case OptimiseStopped::done:
      return "done";
    case OptimiseStopped::interrupted:
      return "interrupted";
    case OptimiseStopped::infeasible:
      return "infeasible";
    case OptimiseStopped::mesh_limit:
      return "mesh-limit";
  }
  return "unknown";
}

bool Summary::is_better(const EvaluationRecord& record) const {
  return record.objective < best_objective_ && violation_of(record.constraints) <= constraint_tolerance_;
}

void Summary::add(const EvaluationRecord& record) {
  ++evaluations_;
  infeasible_samples_ += record.infeasible_samples;
  failed_ += !std::isfinite(record.objective);
  full_adjustments_ += record.full_adjustment;
  invalid_ += !record.valid;
  recoveries_ += record.regenerated;
  refreshes_ += record.refreshed;
  if (record.generation != generation_) best_before_generation_ = best_objective_;
  generation_ = record.generation;
  if (is_better(record)) {
    best_objective_ = record.objective;
    best_design_ = record.coefficients;
    best_outputs_ = record.outputs;
  }
  min_angle_deg_ = std::min(min_angle_deg_, record.min_angle_deg);
  if (detail_.empty() && !record.detail.empty())
    detail_ = "evaluation " + std::to_string(record.evaluation) + ": " + record.detail;

  const double triangles = static_cast<double>(record.triangles);
  preserved_percent_.add(record.preserved_percent);
  lost_.add(static_cast<double>(record.triangles_before) - static_cast<double>(record.preserved));
  connectivity_percent_.add(record.connectivity_percent);
  connectivity_kept_.add(record.changed() == 0 ? 1.0 : 0.0);
  changed_.add(static_cast<double>(record.changed()));
  triangles_.add(triangles);
  remodel_ms_.add(1e3 * record.remodel_seconds);
  if (record.generated_triangles) {
    const double generated = static_cast<double>(*record.generated_triangles);
    generated_triangles_.add(generated);
    surplus_percent_.add(100.0 * (triangles - generated) / generated);
  }
  gradation_bias_.add(record.gradation_bias);
  gradation_deviation_.add(record.gradation_deviation);
  generated_gradation_bias_.add(record.generated_gradation_bias);
  generated_gradation_deviation_.add(record.generated_gradation_deviation);
  if (record.generate_seconds) generate_ms_.add(1e3 * *record.generate_seconds);
}

OptimiseResult Summary::result() const {
  OptimiseResult result;
  result.evaluations = evaluations_;
  result.infeasible_samples = infeasible_samples_;
  result.failed_evaluations = failed_;
  result.full_adjustments = full_adjustments_;
  if (evaluations_ > 0) {
    if (std::isfinite(best_objective_)) result.objective = best_objective_;
    result.min_angle_deg = min_angle_deg_;
  }
  result.preserved_percent = preserved_percent_.value();
  result.lost_mean = lost_.value();
  result.connectivity_percent = connectivity_percent_.value();
  result.connectivity_kept_steps = connectivity_kept_.value();
  result.changed_triangles_mean = changed_.value();
  result.triangles_mean = triangles_.value();
  result.generated_triangles_mean = generated_triangles_.value();
  result.surplus_percent = surplus_percent_.value();
  result.remodel_ms_mean = remodel_ms_.value();
  result.generate_ms_mean = generate_ms_.value();
  result.speedup = result.generate_ms_mean / result.remodel_ms_mean;
  result.invalid_meshes = invalid_;
  result.recoveries = recoveries_;
  result.refreshes = refreshes_;
  result.gradation_bias = gradation_bias_.value();
  result.gradation_deviation = gradation_deviation_.value();
  result.generated_gradation_bias = generated_gradation_bias_.value();
  result.generated_gradation_deviation = generated_gradation_deviation_.value();
  result.detail = detail_;
  result.best_design = best_design_;
  result.outputs = best_outputs_;
  return result;
}

std::string optimise_result_to_json(const OptimiseResult& result) {
  using OrderedJson = nlohmann::ordered_json;  // writes NaN as null
  OrderedJson json = OrderedJson::object();
  for_each_figure(optimise_figures, result, [&]<class Value>(const auto& figure, const Value& value) {
    if constexpr (std::is_same_v<Value, OptimiseStopped>)
      json[figure.name] = name_of(value);
    else
      json[figure.name] = value;
  });
  if (!result.outputs.empty()) json["outputs"] = result.outputs;
  json["best"] = result.best.upper.empty() ? OrderedJson(result.best_design)
                                           : OrderedJson::parse(airfoil_to_json(result.best));
  return json.dump();
}

}  // namespace remodel
