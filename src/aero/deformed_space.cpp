#include "aero/deformed_space.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "aero/stations_derivative.h"
#include "remodel/error.h"

namespace remodel {
namespace {

using DeformedJson = nlohmann::ordered_json;

bool is_wall(const Curve& curve) {
  return curve.name != "farfield";
}

// `factor` times as many stations, as close to each other as they were; of a polyline whole numbers of them
// on each piece, so that its points stay stations.
Parameters with_more(const Curve& curve, double factor) {
  const Parameters& old = curve.parameters;
  const std::size_t n = old.size();
  const bool in_pieces = std::holds_alternative<Polyline>(curve.shape);
  const double wanted = in_pieces ? static_cast<double>(n) * std::max(1.0, std::round(factor))
                                  : std::max(1.0, std::round(static_cast<double>(n) * factor));
  const auto count = static_cast<std::size_t>(wanted);
  if (count == n) return old;
  std::vector<double> result;
  for (std::size_t i = 0; i < count; ++i) {
    const double along = static_cast<double>(i) * static_cast<double>(n) / wanted;
    const std::size_t at = std::min(static_cast<std::size_t>(along), n - 1);
    const double next = at + 1 < n ? old[at + 1] : 1.0;
    result.push_back(old[at] + (along - static_cast<double>(at)) * (next - old[at]));
  }
  return {std::move(result)};
}

Domain with_stations(Domain domain, const Domain& start, int points) {
  const double factor = static_cast<double>(points) / static_cast<double>(stations_on_walls(start));
  for (Loop& loop : domain.loops)
    for (Curve& curve : loop.curves)
      if (is_wall(curve)) curve.parameters = with_more(curve, factor);
  return domain;
}

[[noreturn]] void no_section() {
  throw Error(ErrorCode::argument, "section",
              "found a deformed domain, which has no section by coefficients");
}

}  // namespace

std::size_t stations_on_walls(const Domain& domain) {
  std::size_t count = 0;
  for (const Loop& loop : domain.loops)
    for (const Curve& curve : loop.curves)
      if (is_wall(curve)) count += curve.parameters.size();
  return count;
}

DeformedSpace::DeformedSpace(Domain start, std::vector<DeformationVariable> variables, int points)
    : start_(std::move(start)),
      variables_(std::move(variables)),
      points_(points),
      numbers_(coefficients_of(start_)) {}

Domain DeformedSpace::domain_with(std::span<const double> design, int points) const {
  std::vector<double> numbers = numbers_;
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    const double value = design[i] * variables_[i].range.scale;
    for (const MovedNumber& moved : variables_[i].moves) numbers[moved.number] += value * moved.by;
  }
  return with_stations(with_coefficients(start_, numbers), start_, points);
}

Domain DeformedSpace::domain(std::span<const double> design) const {
  return domain_with(design, points_);
}

DesignBounds DeformedSpace::bounds(double coefficients) const {
  DesignBounds result;
  for (const DeformationVariable& variable : variables_) {
    const auto [low, high] = variable.range.bounds.value_or(std::array{-coefficients, coefficients});
    result.low.push_back(low / variable.range.scale), result.high.push_back(high / variable.range.scale);
  }
  return result;
}

std::vector<double> DeformedSpace::metric() const {
  constexpr double floor = 1e-3;  // in parts of the mean of the diagonal
  const std::size_t n = variables_.size();
  // How the stations of the start move with each variable, one column each.
  const Domain domain = with_stations(start_, start_, points_);
  std::vector<BoundaryStation> stations;
  std::vector<std::size_t> loop;
  for (std::size_t l = 0; l < domain.loops.size(); ++l)
    for (const BoundaryStation& station : domain.stations(l)) stations.push_back(station), loop.push_back(l);
  const MeshDerivative derivative = derivative_of_stations(domain, stations);
  std::vector<std::vector<Point>> moved;
  for (const DeformationVariable& variable : variables_) {
    std::vector<double> direction(numbers_.size(), 0.0);
    for (const MovedNumber& number : variable.moves)
      direction[number.number] += variable.range.scale * number.by;
    moved.push_back(derivative.jvp(direction));
  }
  std::vector<double> result(n * n, 0.0);
  double mean = 0.0;
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t p = 1; p < loop.size(); ++p)
        if (loop[p] == loop[p - 1])
          result[j * n + k] += dot(moved[j][p] - moved[j][p - 1], moved[k][p] - moved[k][p - 1]);
    mean += result[j * n + j] / static_cast<double>(n);
  }
  for (double& x : result) x /= mean;
  for (std::size_t j = 0; j < n; ++j) result[j * n + j] += floor;
  return result;
}

CstAirfoil DeformedSpace::section(std::span<const double>, std::size_t) const {
  no_section();
}

std::vector<double> DeformedSpace::gradient_of_section(std::size_t, std::span<const double>) const {
  no_section();
}

std::vector<NamedNumber> DeformedSpace::named(std::span<const double> design) const {
  std::vector<NamedNumber> result;
  for (std::size_t i = 0; i < variables_.size(); ++i)
    result.push_back({variables_[i].name, design[i] * variables_[i].range.scale});
  return result;
}

std::vector<double> DeformedSpace::gradient_of_domain(std::span<const double> by_numbers) const {
  std::vector<double> result;
  for (const DeformationVariable& variable : variables_) {
    double sum = 0.0;
    for (const MovedNumber& moved : variable.moves) sum += by_numbers[moved.number] * moved.by;
    result.push_back(sum * variable.range.scale);
  }
  return result;
}

std::vector<std::size_t> DeformedSpace::moving_loops() const {
  std::vector<std::size_t> result;
  std::size_t first = 0;
  for (std::size_t l = 0; l < start_.loops.size(); ++l) {
    const std::size_t end = first + coefficients_of(Domain{{start_.loops[l]}}).size();
    const auto is_here = [&](const MovedNumber& moved) {
      return moved.number >= first && moved.number < end;
    };
    const auto moves_it = [&](const DeformationVariable& variable) {
      return std::any_of(variable.moves.begin(), variable.moves.end(), is_here);
    };
    if (std::any_of(variables_.begin(), variables_.end(), moves_it)) result.push_back(l);
    first = end;
  }
  return result;
}

bool DeformedSpace::feasible(std::span<const double> design) const {
  constexpr double rounding = 1e-12;  // of numbers that are divided and multiplied by their scale
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    const DeformationRange& range = variables_[i].range;
    if (!range.bounds) continue;
    const auto [low, high] = *range.bounds;
    const double value = design[i] * range.scale, slack = rounding * std::max(high, -low);
    if (!(value >= low - slack && value <= high + slack)) return false;
  }
  return DesignSpace::feasible(design);
}

std::string DeformedSpace::text(std::span<const double> design) const {
  return domain_to_json(domain(design));
}

std::string DeformedSpace::description() const {
  DeformedJson variables = DeformedJson::array();
  for (const DeformationVariable& variable : variables_) {
    DeformedJson& json =
        variables.emplace_back(DeformedJson{{"name", variable.name}, {"scale", variable.range.scale}});
    if (variable.range.bounds) json["bounds"] = *variable.range.bounds;
    json["moves"] = DeformedJson::array();
    for (const MovedNumber& moved : variable.moves) json["moves"].push_back({moved.number, moved.by});
  }
  return DeformedJson{{"deformed",
                       {{"domain", DeformedJson::parse(domain_to_json(start_))},
                        {"points", points_},
                        {"variables", std::move(variables)}}}}
      .dump();
}

DeformedSpace DeformedSpace::from_description(const std::string& text, const std::string& source) {
  const DeformedJson deformed = DeformedJson::parse(text).at("deformed");
  Domain start = domain_from_json(deformed.at("domain").dump(), source);
  const std::size_t numbers = coefficients_of(start).size();
  std::vector<DeformationVariable> variables;
  for (const DeformedJson& entry : deformed.at("variables")) {
    DeformationVariable& variable = variables.emplace_back();
    entry.at("name").get_to(variable.name);
    entry.at("scale").get_to(variable.range.scale);
    if (entry.contains("bounds")) variable.range.bounds = entry.at("bounds").get<std::array<double, 2>>();
    for (const DeformedJson& pair : entry.at("moves")) {
      variable.moves.push_back({pair.at(0).get<std::size_t>(), pair.at(1).get<double>()});
      if (variable.moves.back().number >= numbers)
        throw Error(ErrorCode::format, source, "found a variable that moves what the domain has not");
    }
  }
  const int points = deformed.at("points");
  if (points < 1 || points > 100000 || stations_on_walls(start) == 0)
    throw Error(ErrorCode::format, source, "found a deformed domain without stations");
  return {std::move(start), std::move(variables), points};
}

}  // namespace remodel
