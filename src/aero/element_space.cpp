#include "aero/element_space.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "remodel/mesh_derivative.h"

namespace remodel {

namespace {

using SpaceJson = nlohmann::ordered_json;

constexpr std::size_t placement_numbers = 4;

}  // namespace

LoopNumbers numbers_of_loop(const Domain& domain, std::size_t loop) {
  LoopNumbers result;
  for (std::size_t l = 0;; ++l) {
    const std::size_t count = coefficients_of(Domain{{domain.loops[l]}}).size();
    result.placement = result.curves + count - placement_numbers;
    if (l == loop) return result;
    result.curves += count;
  }
}

ElementSpace::ElementSpace(Domain start, std::vector<ElementVariable> variables)
    : start_(std::move(start)), variables_(std::move(variables)), numbers_(coefficients_of(start_)) {}

std::vector<double> ElementSpace::start() const {
  std::vector<double> design;
  for (const ElementVariable& variable : variables_)
    design.push_back(numbers_[variable.number] / variable.scale);
  return design;
}

Domain ElementSpace::domain(std::span<const double> design) const {
  std::vector<double> numbers = numbers_;
  for (std::size_t i = 0; i < variables_.size(); ++i)
    numbers[variables_[i].number] = design[i] * variables_[i].scale;
  return with_coefficients(start_, numbers);
}

Domain ElementSpace::domain_with(std::span<const double> design, int points) const {
  Domain result = domain(design);
  for (std::size_t l = 0; l < sections(); ++l)
    result.loops[l].curves[0].parameters = Parameters::uniform(static_cast<std::size_t>(points));
  return result;
}

DesignBounds ElementSpace::bounds(double coefficients) const {
  DesignBounds result;
  for (const ElementVariable& variable : variables_) {
    const double start = numbers_[variable.number];
    const double low = variable.is_coefficient ? start - coefficients : variable.low;
    const double high = variable.is_coefficient ? start + coefficients : variable.high;
    result.low.push_back(low / variable.scale), result.high.push_back(high / variable.scale);
  }
  return result;
}

CstAirfoil ElementSpace::section(std::span<const double> design, std::size_t index) const {
  return std::get<CstAirfoil>(domain(design).loops[index].curves[0].shape);
}

Placement ElementSpace::placement(std::span<const double> design, std::size_t index) const {
  return domain(design).loops[index].placement;
}

std::vector<NamedNumber> ElementSpace::named(std::span<const double> design) const {
  std::vector<NamedNumber> result;
  for (std::size_t i = 0; i < variables_.size(); ++i)
    result.push_back({variables_[i].name, design[i] * variables_[i].scale});
  return result;
}

std::vector<double> ElementSpace::gradient_of_domain(std::span<const double> by_numbers) const {
  std::vector<double> result;
  for (const ElementVariable& variable : variables_)
    result.push_back(by_numbers[variable.number] * variable.scale);
  return result;
}

std::vector<double> ElementSpace::gradient_of_section(std::size_t index,
                                                      std::span<const double> by_coefficients) const {
  std::vector<double> by_numbers(numbers_.size(), 0.0);
  std::copy(by_coefficients.begin(), by_coefficients.end(),
            by_numbers.begin() + static_cast<std::ptrdiff_t>(numbers_of_loop(start_, index).curves));
  return gradient_of_domain(by_numbers);
}

bool ElementSpace::feasible(std::span<const double> design) const {
  constexpr double rounding = 1e-12;  // of numbers that are divided and multiplied by their scale
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    const ElementVariable& variable = variables_[i];
    const double value = design[i] * variable.scale;
    const double slack =
        rounding * std::max({variable.scale, std::fabs(variable.low), std::fabs(variable.high)});
    if (!variable.is_coefficient && !(value >= variable.low - slack && value <= variable.high + slack))
      return false;
  }
  return DesignSpace::feasible(design);
}

std::string ElementSpace::text(std::span<const double> design) const {
  return domain_to_json(domain(design));
}

std::string ElementSpace::description() const {
  SpaceJson variables = SpaceJson::array();
  for (const ElementVariable& variable : variables_)
    variables.push_back({{"name", variable.name},
                         {"number", variable.number},
                         {"scale", variable.scale},
                         {"coefficient", variable.is_coefficient},
                         {"low", variable.low},
                         {"high", variable.high}});
  return SpaceJson{
      {"elements", {{"domain", SpaceJson::parse(domain_to_json(start_))}, {"variables", variables}}}}
      .dump();
}

ElementSpace ElementSpace::from_description(const std::string& text, const std::string& source) {
  const SpaceJson elements = SpaceJson::parse(text).at("elements");
  Domain start = domain_from_json(elements.at("domain").dump(), source);
  const std::size_t numbers = coefficients_of(start).size();
  std::vector<ElementVariable> variables;
  for (const SpaceJson& entry : elements.at("variables")) {
    variables.push_back({.name = entry.at("name"),
                         .number = entry.at("number"),
                         .scale = entry.at("scale"),
                         .is_coefficient = entry.at("coefficient"),
                         .low = entry.at("low"),
                         .high = entry.at("high")});
    if (variables.back().number >= numbers)
      throw Error(ErrorCode::format, source, "found a variable that the domain has not");
  }
  return {std::move(start), std::move(variables)};
}

}  // namespace remodel
