#include "design/record_ranges.h"

#include <cstdint>
#include <initializer_list>
#include <optional>

#include "base/checked_json.h"

namespace remodel {

namespace {

constexpr std::uint64_t most = std::uint64_t{1} << 53;  // a count beyond it is a negative one, or no count
constexpr double rounding = 1e-9;

struct Number {
  const char* name;
  std::optional<double> value;
  double low, high;
};
struct Count {
  const char* name;
  std::optional<std::uint64_t> value;
  std::uint64_t low = 0;
};

std::string text_of(double value) {
  return nlohmann::json(value).dump();
}

}  // namespace

std::string out_of_range(const EvaluationRecord& r) {
  for (const Count& count : std::initializer_list<Count>{{"evaluation", r.evaluation, 1},
                                                         {"generation", r.generation},
                                                         {"infeasible_samples", r.infeasible_samples},
                                                         {"worker", r.worker, 1},
                                                         {"triangles_before", r.triangles_before},
                                                         {"triangles", r.triangles},
                                                         {"preserved", r.preserved},
                                                         {"connected", r.connected},
                                                         {"moved", r.moved},
                                                         {"inserted", r.inserted},
                                                         {"removed", r.removed},
                                                         {"flipped", r.flipped},
                                                         {"generated_triangles", r.generated_triangles}})
    if (count.value && (*count.value < count.low || *count.value > most))
      return std::string(count.name) + ": found " + std::to_string(static_cast<std::int64_t>(*count.value)) +
             ", expected " + std::to_string(count.low) + " or more";
  const double percent = 100.0 * (1.0 + rounding), angle = 60.0 * (1.0 + rounding);
  for (const Number& number :
       std::initializer_list<Number>{{"preserved_percent", r.preserved_percent, 0.0, percent},
                                     {"connectivity_percent", r.connectivity_percent, 0.0, percent},
                                     {"sigma", r.sigma, 0.0, 1e100},
                                     {"min_angle_deg", r.min_angle_deg, 0.0, angle},
                                     {"remodel_seconds", r.remodel_seconds, 0.0, most_seconds},
                                     {"generate_seconds", r.generate_seconds, 0.0, most_seconds}})
    if (number.value && (*number.value < number.low || *number.value > number.high))
      return std::string(number.name) + ": found " + text_of(*number.value) + ", expected " +
             text_of(number.low) + " to " + text_of(number.high);
  return {};
}

}  // namespace remodel
