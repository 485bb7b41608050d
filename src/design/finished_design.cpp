#include "design/finished_design.h"

#include <cmath>
#include <optional>
#include <string>
#include <type_traits>

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
  else
    json.get_to(value);
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
  design.evaluation.objective = design.record.objective;
  design.evaluation.constraints = design.record.constraints;
  design.evaluation.outputs = design.record.outputs;
  json.at("gradient").get_to(design.evaluation.gradient);
  json.at("constraint_gradients").get_to(design.evaluation.constraint_gradients);
  return design;
}

}  // namespace remodel
