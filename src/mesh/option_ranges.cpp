#include "mesh/option_ranges.h"

#include <cmath>

namespace remodel {

namespace {

constexpr double largest_angle_deg = 34.0;  // beyond it refinement need not end
constexpr double largest_factor = 1e6;      // of G, R and keep
constexpr double largest_slack_deg = 60.0;

std::optional<OptionProblem> unless(bool holds, const char* option, double found, const char* expected) {
  if (holds) return std::nullopt;
  return OptionProblem{option, "found " + std::to_string(found) + ", expected " + expected};
}

bool is_angle(double value) {
  return value >= 0.0 && value <= largest_angle_deg;
}
bool is_factor(double value) {
  return value > 0.0 && value <= largest_factor;
}

}  // namespace

std::optional<OptionProblem> out_of_range(const QualityOptions& options) {
  constexpr const char* angle = "0 to 34 degrees";
  constexpr const char* factor = "a number above 0 up to 1e6";
  for (const auto& problem :
       {unless(is_angle(options.min_angle_deg), "min_angle_deg", options.min_angle_deg, angle),
        unless(is_angle(options.refine_angle_deg), "refine_angle_deg", options.refine_angle_deg, angle),
        unless(std::isfinite(options.max_gradation) && options.max_gradation > 0.0, "max_gradation",
               options.max_gradation, "a positive number"),
        unless(is_factor(options.gradation), "gradation", options.gradation, factor),
        unless(is_factor(options.resolution), "resolution", options.resolution, factor),
        unless(std::isfinite(options.min_edge) && options.min_edge >= 0.0, "min_edge", options.min_edge,
               "0 or more chords")})
    if (problem) return problem;
  return std::nullopt;
}

std::optional<OptionProblem> keep_out_of_range(double keep) {
  return unless(keep >= 1.0 && keep <= largest_factor, "keep", keep, "a factor from 1 to 1e6");
}

std::optional<OptionProblem> slack_out_of_range(double degrees) {
  return unless(degrees >= 0.0 && degrees <= largest_slack_deg, "delaunay_slack_deg", degrees,
                "0 to 60 degrees");
}

}  // namespace remodel
