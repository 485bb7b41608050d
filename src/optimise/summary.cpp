#include "optimise/summary.h"

#include <algorithm>
#include <nlohmann/json.hpp>

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

const char* name_of(MeshUse use) {
  switch (use) {
    case MeshUse::chain:
      return "chain";
    case MeshUse::hub:
      return "hub";
    case MeshUse::regenerate:
      return "regenerate";
  }
  return "unknown";
}

void Summary::add(const EvaluationRecord& record) {
  ++evaluations_;
  infeasible_samples_ += record.infeasible_samples;
  full_adjustments_ += record.full_adjustment;
  invalid_ += !record.valid;
  recoveries_ += record.regenerated;
  refreshes_ += record.refreshed;
  if (record.objective < best_objective_) {
    best_objective_ = record.objective;
    best_coefficients_ = record.coefficients;
  }
  min_angle_deg_ = std::min(min_angle_deg_, record.min_angle_deg);
  if (detail_.empty() && !record.detail.empty())
    detail_ = "evaluation " + std::to_string(record.evaluation) + ": " + record.detail;

  const double triangles = static_cast<double>(record.triangles);
  preserved_percent_.add(record.preserved_percent);
  lost_.add(static_cast<double>(record.triangles_before) - static_cast<double>(record.preserved));
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
  result.full_adjustments = full_adjustments_;
  if (evaluations_ > 0) {
    result.objective = best_objective_;
    result.min_angle_deg = min_angle_deg_;
  }
  result.preserved_percent = preserved_percent_.value();
  result.lost_mean = lost_.value();
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
  return result;
}

std::string optimise_result_to_json(const OptimiseResult& result) {
  // nlohmann writes NaN as null.
  const nlohmann::ordered_json json = {
      {"evaluations", result.evaluations},
      {"infeasible_samples", result.infeasible_samples},
      {"full_adjustments", result.full_adjustments},
      {"objective", result.objective},
      {"max_error", result.max_error},
      {"preserved_percent", result.preserved_percent},
      {"lost_mean", result.lost_mean},
      {"triangles_mean", result.triangles_mean},
      {"generated_triangles_mean", result.generated_triangles_mean},
      {"surplus_percent", result.surplus_percent},
      {"gradation_bias", result.gradation_bias},
      {"gradation_deviation", result.gradation_deviation},
      {"generated_gradation_bias", result.generated_gradation_bias},
      {"generated_gradation_deviation", result.generated_gradation_deviation},
      {"remodel_ms_mean", result.remodel_ms_mean},
      {"generate_ms_mean", result.generate_ms_mean},
      {"speedup", result.speedup},
      {"min_angle_deg", result.min_angle_deg},
      {"invalid_meshes", result.invalid_meshes},
      {"recoveries", result.recoveries},
      {"refreshes", result.refreshes},
      {"seconds", result.seconds},
      {"workers", result.workers},
      {"stopped", name_of(result.stopped)},
      {"detail", result.detail},
      {"seed", result.seed},
      {"best", nlohmann::ordered_json::parse(airfoil_to_json(result.best))},
  };
  return json.dump();
}

}  // namespace remodel
