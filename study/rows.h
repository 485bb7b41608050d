#pragma once

// The results of a study's jobs: rows of its tables (schema.h) and the optimiser's path. figures() lists the
// table's columns in their order, after the key.

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include "remodel/figures.h"

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
  static constexpr auto figures() {
    using Row = PathRows;
    return std::tuple{Figure{"evaluations", "", "", &Row::evaluations},
                      Figure{"infeasible_samples", "", "", &Row::infeasible_samples},
                      Figure{"objective", "", "", &Row::objective},
                      Figure{"max_error", "", "", &Row::max_error},
                      Figure{"best", "", "", &Row::best},
                      Figure{"seconds", "", "", &Row::seconds}};
  }
};

struct FreshRow {
  std::uint64_t evaluation = 0, triangles = 0;
  double seconds = 0.0, gradation_bias = not_measured, gradation_deviation = not_measured;
  static constexpr auto figures() {
    using Row = FreshRow;
    return std::tuple{Figure{"evaluation", "", "", &Row::evaluation},
                      Figure{"triangles", "", "", &Row::triangles}, Figure{"seconds", "", "", &Row::seconds},
                      Figure{"gradation_bias", "", "", &Row::gradation_bias},
                      Figure{"gradation_deviation", "", "", &Row::gradation_deviation}};
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
  static constexpr auto figures() {
    using Row = ReplayRow;
    return std::tuple{Figure{"evaluations", "", "", &Row::evaluations},
                      Figure{"full_adjustments", "", "", &Row::full_adjustments},
                      Figure{"triangles_mean", "", "", &Row::triangles_mean},
                      Figure{"preserved_percent", "", "", &Row::preserved_percent},
                      Figure{"lost_mean", "", "", &Row::lost_mean},
                      Figure{"generated_triangles_mean", "", "", &Row::generated_triangles_mean},
                      Figure{"surplus_percent", "", "", &Row::surplus_percent},
                      Figure{"remodel_ms_mean", "", "", &Row::remodel_ms_mean},
                      Figure{"generate_ms_mean", "", "", &Row::generate_ms_mean},
                      Figure{"speedup", "", "", &Row::speedup},
                      Figure{"min_angle_deg", "", "", &Row::min_angle_deg},
                      Figure{"invalid_meshes", "", "", &Row::invalid_meshes},
                      Figure{"recoveries", "", "", &Row::recoveries},
                      Figure{"refreshes", "", "", &Row::refreshes},
                      Figure{"gradation_bias", "", "", &Row::gradation_bias},
                      Figure{"gradation_deviation", "", "", &Row::gradation_deviation},
                      Figure{"generated_gradation_bias", "", "", &Row::generated_gradation_bias},
                      Figure{"generated_gradation_deviation", "", "", &Row::generated_gradation_deviation},
                      Figure{"seconds", "", "", &Row::seconds},
                      Figure{"stopped", "", "", &Row::stopped},
                      Figure{"detail", "", "", &Row::detail}};
  }
};

// Means over the evaluations first to last, both included.
struct BlockRow {
  std::uint64_t first = 0, last = 0;
  double triangles_mean = not_measured, preserved_percent = not_measured, lost_mean = not_measured;
  std::uint64_t full_adjustments = 0;
  double remodel_ms_mean = not_measured, surplus_percent = not_measured;
  static constexpr auto figures() {
    using Row = BlockRow;
    return std::tuple{Figure{"first", "", "", &Row::first},
                      Figure{"last", "", "", &Row::last},
                      Figure{"triangles_mean", "", "", &Row::triangles_mean},
                      Figure{"preserved_percent", "", "", &Row::preserved_percent},
                      Figure{"lost_mean", "", "", &Row::lost_mean},
                      Figure{"full_adjustments", "", "", &Row::full_adjustments},
                      Figure{"remodel_ms_mean", "", "", &Row::remodel_ms_mean},
                      Figure{"surplus_percent", "", "", &Row::surplus_percent}};
  }
};

struct ComparisonRow {
  std::uint64_t evaluation = 0, triangles = 0;
  double gradation_deviation = not_measured;
  static constexpr auto figures() {
    using Row = ComparisonRow;
    return std::tuple{Figure{"evaluation", "", "", &Row::evaluation},
                      Figure{"triangles", "", "", &Row::triangles},
                      Figure{"gradation_deviation", "", "", &Row::gradation_deviation}};
  }
};

struct ReplayRows {
  ReplayRow replay;
  std::vector<BlockRow> blocks;
  std::vector<ComparisonRow> comparisons;
};

using StudyRows = std::variant<PathRows, FreshRows, ReplayRows>;

}  // namespace remodel
