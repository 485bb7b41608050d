#include "design/summary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace remodel {
namespace {

EvaluationRecord record_of(std::uint64_t evaluation, double objective) {
  EvaluationRecord record;
  record.evaluation = evaluation;
  record.coefficients = {objective, -objective};
  record.objective = objective;
  record.triangles_before = 1000;
  record.triangles = 1100;
  record.preserved = 900;
  record.preserved_percent = 90.0;
  record.min_angle_deg = 31.0;
  record.remodel_seconds = 0.001;
  return record;
}

TEST(Summary, HasNoFiguresWithoutEvaluations) {
  const OptimiseResult result = Summary().result();
  EXPECT_EQ(result.evaluations, 0u);
  for (const double figure :
       {result.objective, result.preserved_percent, result.lost_mean, result.triangles_mean,
        result.generated_triangles_mean, result.surplus_percent, result.remodel_ms_mean,
        result.generate_ms_mean, result.speedup, result.min_angle_deg})
    EXPECT_TRUE(std::isnan(figure));
}

TEST(Summary, TakesComparedFiguresFromComparedEvaluationsAlone) {
  Summary summary;
  summary.add(record_of(1, 3.0));
  EXPECT_TRUE(std::isnan(summary.result().surplus_percent));
  EvaluationRecord compared = record_of(2, 2.0);
  compared.generated_triangles = 1000;
  compared.generate_seconds = 0.02;
  compared.remodel_seconds = 0.003;
  summary.add(compared);
  const OptimiseResult result = summary.result();
  EXPECT_DOUBLE_EQ(result.surplus_percent, 10.0);
  EXPECT_DOUBLE_EQ(result.generated_triangles_mean, 1000.0);
  EXPECT_DOUBLE_EQ(result.remodel_ms_mean, 2.0);
  EXPECT_DOUBLE_EQ(result.generate_ms_mean, 20.0);
  EXPECT_DOUBLE_EQ(result.speedup, 10.0);
  EXPECT_DOUBLE_EQ(result.lost_mean, 100.0);
}

TEST(Summary, CountsWhatIsBornAndGone) {
  Summary summary;
  EvaluationRecord changed = record_of(1, 3.0), kept = record_of(2, 2.0);
  changed.connected = 950, changed.connectivity_percent = 95.0;
  kept.triangles_before = kept.triangles = kept.connected = 1100, kept.connectivity_percent = 100.0;
  summary.add(changed);
  summary.add(kept);
  const OptimiseResult result = summary.result();
  EXPECT_DOUBLE_EQ(result.connectivity_percent, 97.5);
  EXPECT_DOUBLE_EQ(result.connectivity_kept_steps, 0.5);
  EXPECT_DOUBLE_EQ(result.changed_triangles_mean, 100.0);
}

TEST(Summary, KeepsTheFirstBestDesignAndTheFirstTrouble) {
  Summary summary;
  for (const double objective : {3.0, 1.0, 2.0, 1.0}) {
    EvaluationRecord record = record_of(summary.evaluations() + 1, objective);
    record.valid = objective != 2.0;
    record.regenerated = objective == 2.0;
    if (!record.valid) record.detail = "delaunay";
    record.coefficients.push_back(static_cast<double>(record.evaluation));
    record.min_angle_deg = 30.0 + objective;
    record.infeasible_samples = record.evaluation;
    summary.add(record);
  }
  const OptimiseResult result = summary.result();
  EXPECT_EQ(result.best_design, (std::vector<double>{1.0, -1.0, 2.0}));
  EXPECT_EQ(result.objective, 1.0);
  EXPECT_EQ(result.invalid_meshes, 1u);
  EXPECT_EQ(result.recoveries, 1u);
  EXPECT_EQ(result.infeasible_samples, 10u);
  EXPECT_EQ(result.min_angle_deg, 31.0);
  EXPECT_EQ(result.detail, "evaluation 3: delaunay");
}

TEST(Summary, TakesNoDesignForTheBestThatViolatesAConstraintOrFailed) {
  Summary summary;
  EvaluationRecord violating = record_of(1, 1.0), failed = record_of(2, Evaluation::failed),
                   good = record_of(3, 2.0);
  violating.constraints = {-1.0, 0.1};
  summary.add(violating);
  summary.add(failed);
  EXPECT_TRUE(std::isnan(summary.result().objective));
  EXPECT_TRUE(summary.result().best_design.empty());
  good.constraints = {-1.0, 0.0};
  good.outputs = {{"cl", 0.7}};
  summary.add(good);
  EXPECT_EQ(summary.result().objective, 2.0);
  EXPECT_EQ(summary.result().outputs, good.outputs);
  EXPECT_EQ(summary.result().failed_evaluations, 1u);
}

TEST(OptimiseResult, IsWrittenAsJsonWithNullForWhatWasNotMeasured) {
  Summary summary;
  summary.add(record_of(1, 0.1));
  OptimiseResult result = summary.result();
  result.best = {.upper = {0.1, 0.2}, .lower = {-0.1, -0.2}};
  const auto json = nlohmann::json::parse(optimise_result_to_json(result));
  for (const char* key : {"evaluations",
                          "infeasible_samples",
                          "full_adjustments",
                          "objective",
                          "max_error",
                          "preserved_percent",
                          "lost_mean",
                          "connectivity_percent",
                          "connectivity_kept_steps",
                          "changed_triangles_mean",
                          "triangles_mean",
                          "generated_triangles_mean",
                          "surplus_percent",
                          "remodel_ms_mean",
                          "generate_ms_mean",
                          "speedup",
                          "min_angle_deg",
                          "invalid_meshes",
                          "recoveries",
                          "seconds",
                          "stopped"})
    EXPECT_TRUE(json.contains(key)) << key;
  EXPECT_TRUE(json.at("surplus_percent").is_null());
  EXPECT_EQ(json.at("objective").get<double>(), 0.1);
  EXPECT_EQ(json.at("stopped"), "done");
  EXPECT_EQ(json.at("best").at("upper").get<std::vector<double>>(), result.best.upper);
}

}  // namespace
}  // namespace remodel
