#pragma once

// What the jobs of a study give: rows of its tables (schema.h), and the optimiser's path. columns() lists the
// members in the order of the table's columns, after its key.

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

namespace remodel {

// The designs of a scenario in the order of their evaluation.
struct StudyPath {
  std::uint64_t dimension = 0;  // coefficients of a design
  // dimension + 2 per evaluation: sigma (of the distribution that it was sampled from), objective, and the
  // coefficients, upper surface first.
  std::vector<double> values;

  std::size_t evaluations() const { return values.size() / (dimension + 2); }
  double sigma(std::size_t index) const { return values[index * (dimension + 2)]; }
  double objective(std::size_t index) const { return values[index * (dimension + 2) + 1]; }
  std::span<const double> coefficients(std::size_t index) const {
    return std::span(values).subspan(index * (dimension + 2) + 2, dimension);
  }
};

inline constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();  // NULL in the database

struct PathRows {
  std::uint64_t evaluations = 0, infeasible_samples = 0;
  double objective = not_measured, max_error = not_measured;
  std::string best;  // CST as JSON
  double seconds = 0.0;
  StudyPath path;
  static auto columns(auto& row) {
    return std::tie(row.evaluations, row.infeasible_samples, row.objective, row.max_error, row.best,
                    row.seconds);
  }
};

struct FreshRow {
  std::uint64_t evaluation = 0, triangles = 0;
  double seconds = 0.0, gradation_bias = not_measured, gradation_deviation = not_measured;
  static auto columns(auto& row) {
    return std::tie(row.evaluation, row.triangles, row.seconds, row.gradation_bias, row.gradation_deviation);
  }
};
using FreshRows = std::vector<FreshRow>;

struct ReplayRow {
  std::uint64_t evaluations = 0, full_adjustments = 0;
  double triangles_mean = not_measured, preserved_percent = not_measured, lost_mean = not_measured;
  double generated_triangles_mean = not_measured, surplus_percent = not_measured;
  double remodel_ms_mean = not_measured, generate_ms_mean = not_measured, speedup = not_measured;
  double min_angle_deg = not_measured;
  std::uint64_t invalid_meshes = 0, recoveries = 0, refreshes = 0;
  double gradation_bias = not_measured, gradation_deviation = not_measured;
  double generated_gradation_bias = not_measured, generated_gradation_deviation = not_measured;
  double seconds = 0.0;
  std::string stopped, detail;
  static auto columns(auto& row) {
    return std::tie(row.evaluations, row.full_adjustments, row.triangles_mean, row.preserved_percent,
                    row.lost_mean, row.generated_triangles_mean, row.surplus_percent, row.remodel_ms_mean,
                    row.generate_ms_mean, row.speedup, row.min_angle_deg, row.invalid_meshes, row.recoveries,
                    row.refreshes, row.gradation_bias, row.gradation_deviation, row.generated_gradation_bias,
                    row.generated_gradation_deviation, row.seconds, row.stopped, row.detail);
  }
};

// Evaluations first to last.
struct BlockRow {
  std::uint64_t first = 0, last = 0;
  double triangles_mean = not_measured, preserved_percent = not_measured, lost_mean = not_measured;
  std::uint64_t full_adjustments = 0;
  double remodel_ms_mean = not_measured, surplus_percent = not_measured;
  static auto columns(auto& row) {
    return std::tie(row.first, row.last, row.triangles_mean, row.preserved_percent, row.lost_mean,
                    row.full_adjustments, row.remodel_ms_mean, row.surplus_percent);
  }
};

struct ComparisonRow {
  std::uint64_t evaluation = 0, triangles = 0;
  double gradation_deviation = not_measured;
  static auto columns(auto& row) { return std::tie(row.evaluation, row.triangles, row.gradation_deviation); }
};

struct ReplayRows {
  ReplayRow replay;
  std::vector<BlockRow> blocks;
  std::vector<ComparisonRow> comparisons;
};

using StudyRows = std::variant<PathRows, FreshRows, ReplayRows>;

}  // namespace remodel
