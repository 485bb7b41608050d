#include "design/finished_design.h"

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "design/record_ranges.h"

namespace remodel {
namespace {

using Json = nlohmann::json;

// JSON has no word for what is not finite: null stands for infinity, the objective of a failed evaluation.
Json json_of(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

template <class Value>
Json json_of(const Value& value) {
  if constexpr (std::is_same_v<Value, Checked>)
    return name_of(value);
  else if constexpr (std::is_same_v<Value, std::optional<double>> ||
                     std::is_same_v<Value, std::optional<std::size_t>>)
    return value ? Json(*value) : Json();
  else
    return value;
}

void read(const Json& json, double& value) {
  value = json.is_null() ? Evaluation::failed : json.get<double>();
}

template <class Value>
void read(const Json& json, Value& value) {
  if constexpr (std::is_same_v<Value, Checked>)
    value = checked_named(json.get<std::string>());
  else if constexpr (std::is_same_v<Value, std::optional<double>> ||
                     std::is_same_v<Value, std::optional<std::size_t>>)
    value = json.is_null() ? Value() : Value(json.get<typename Value::value_type>());
  else if constexpr (std::is_unsigned_v<Value> && !std::is_same_v<Value, bool>)
    value = json.is_number_unsigned() ? json.get<Value>()
                                      : throw std::invalid_argument("a count is " + json.dump());
  else
    json.get_to(value);
}

// Both are there for all variables, or not at all.
void require_gradients(const Evaluation& evaluation, std::size_t variables) {
  const auto fits = [&](const std::vector<double>& gradient) {
    return gradient.empty() || gradient.size() == variables;
  };
  bool good = fits(evaluation.gradient);
  for (const auto& gradient : evaluation.constraint_gradients) good = good && fits(gradient);
  if (!good) throw std::invalid_argument("a gradient has another number of values than the design");
}

}  // namespace

Json to_json(const FinishedDesign& design) {
  Json record = Json::object();
  for_each_figure(evaluation_figures, design.record,
                  [&](const auto& figure, const auto& value) { record[figure.name] = json_of(value); });
  return {{"record", std::move(record)},
          {"gradient", design.evaluation.gradient},
          {"constraint_gradients", design.evaluation.constraint_gradients}};
}

FinishedDesign finished_design_from(const Json& json) {
  FinishedDesign design;
  for_each_figure(evaluation_figures, design.record,
                  [&](const auto& figure, auto& value) { read(json.at("record").at(figure.name), value); });
  if (const std::string problem = out_of_range(design.record); !problem.empty())
    throw std::invalid_argument(problem);
  design.evaluation.objective = design.record.objective;
  design.evaluation.constraints = design.record.constraints;
  design.evaluation.outputs = design.record.outputs;
  json.at("gradient").get_to(design.evaluation.gradient);
  json.at("constraint_gradients").get_to(design.evaluation.constraint_gradients);
  require_gradients(design.evaluation, design.record.coefficients.size());
  return design;
}

}  // namespace remodel
