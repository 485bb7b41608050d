#include "design/augmented_lagrangian.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "design/portable_math.h"

namespace remodel {
namespace {

// Far beyond the units of any problem: contradictory constraints drive coefficients up for ever.
constexpr double most = 1e100;

double in_range(double penalty) {
  return std::clamp(penalty, 1.0 / most, most);
}

// Between the quartiles; from the least to the largest where that is nothing.
double spread(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t last = values.size() - 1, quarter = last / 4;
  const double between = values[last - quarter] - values[quarter];
  return between > 0.0 ? between : values[last] - values[0];
}

double spread_of_objective(std::span<const Evaluation> generation) {
  std::vector<double> values;
  for (const Evaluation& one : generation) values.push_back(one.objective);
  return spread(std::move(values));
}

std::vector<double> values_of(std::size_t constraint, std::span<const Evaluation> generation) {
  std::vector<double> values;
  for (const Evaluation& one : generation) values.push_back(one.constraints[constraint]);
  return values;
}

std::vector<std::size_t> order_of(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  return order;
}

Evaluation recombined(std::span<const Evaluation> generation, const std::vector<std::size_t>& order,
                      std::span<const double> weights) {
  Evaluation mean{.objective = 0.0, .constraints = std::vector<double>(generation[0].constraints.size())};
  double sum = 0.0;
  for (std::size_t i = 0; i < std::min(order.size(), weights.size()); ++i) sum += weights[i];
  for (std::size_t i = 0; i < std::min(order.size(), weights.size()); ++i) {
    const Evaluation& one = generation[order[i]];
    const double weight = weights[i] / sum;
    mean.objective += weight * one.objective;
    for (std::size_t k = 0; k < one.constraints.size(); ++k)
      mean.constraints[k] += weight * one.constraints[k];
  }
  return mean;
}

}  // namespace

std::vector<double> AugmentedLagrangian::rank(std::span<const Evaluation> generation,
                                              std::span<const double> weights) {
  terms_.resize(generation[0].constraints.size());
  raise_penalties(generation);
  std::vector<double> values;
  for (const Evaluation& one : generation) values.push_back(penalised(one));
  adapt(recombined(generation, order_of(values), weights));
  return values;
}

// In the units of objective over constraint squared. Where the objective is the same everywhere, any will do;
// a constraint that is the same everywhere cannot rank.
void AugmentedLagrangian::raise_penalties(std::span<const Evaluation> generation) {
  constexpr double at_first = 5.0;
  double of_objective = spread_of_objective(generation);
  if (of_objective == 0.0) of_objective = 1.0;
  for (std::size_t k = 0; k < terms_.size(); ++k) {
    std::vector<double> values = values_of(k, generation);
    const auto violations = std::count_if(values.begin(), values.end(), [](double g) { return g > 0.0; });
    if (violations == 0 || (terms_[k].penalty > 0.0 && violations < std::ssize(values))) continue;
    const double of_constraint = spread(std::move(values));
    const double penalty = at_first * of_objective / (dimension_ * of_constraint * of_constraint);
    if (of_constraint > 0.0) terms_[k].penalty = std::max(terms_[k].penalty, in_range(penalty));
  }
}

double AugmentedLagrangian::penalised(const Evaluation& evaluation) const {
  double sum = evaluation.objective;
  for (std::size_t k = 0; k < terms_.size(); ++k) {
    const Term& term = terms_[k];
    if (term.penalty == 0.0) continue;
    const double g = std::max(evaluation.constraints[k], -term.multiplier / term.penalty);
    sum += g * (term.multiplier + 0.5 * term.penalty * g);
  }
  return sum;
}

// A penalty grows while it changes the number less than that changes by itself from one generation to the
// next, or while the constraint hardly moves. Four steps up are one down: one in five goes down where both
// are in balance.
void AugmentedLagrangian::adapt(Evaluation mean) {
  constexpr double k_number = 10.0, k_constraint = 5.0, damping = 5.0;
  const double up = portable::exp(0.25 * portable::log(2.0) / std::sqrt(static_cast<double>(dimension_)));
  const double down = up * up * up * up;
  const bool first = mean_.constraints.empty();
  const double change = first ? 0.0 : std::abs(penalised(mean) - penalised(mean_)) / dimension_;
  for (std::size_t k = 0; k < terms_.size(); ++k) {
    Term& term = terms_[k];
    if (term.penalty == 0.0) continue;
    const double g = mean.constraints[k];
    const bool active = term.multiplier + term.penalty * g > 0.0;
    term.multiplier = std::clamp(term.multiplier + term.penalty * g / damping, 0.0, most);
    if (first || !active) continue;
    const double before = mean_.constraints[k];
    const bool grow =
        term.penalty * g * g < k_number * change || k_constraint * std::abs(g - before) < std::abs(before);
    term.penalty = in_range(grow ? term.penalty * up : term.penalty / down);
  }
  mean_ = std::move(mean);
}

nlohmann::json AugmentedLagrangian::state() const {
  std::vector<double> multipliers, penalties;
  for (const Term& term : terms_) {
    multipliers.push_back(term.multiplier);
    penalties.push_back(term.penalty);
  }
  return {{"multipliers", multipliers},
          {"penalties", penalties},
          {"mean", {{"objective", mean_.objective}, {"constraints", mean_.constraints}}}};
}

void AugmentedLagrangian::restore(const nlohmann::json& state) {
  const auto multipliers = state.at("multipliers").get<std::vector<double>>();
  const auto penalties = state.at("penalties").get<std::vector<double>>();
  Evaluation mean;
  state.at("mean").at("constraints").get_to(mean.constraints);
  if (!mean.constraints.empty()) state.at("mean").at("objective").get_to(mean.objective);
  if (penalties.size() != multipliers.size() || mean.constraints.size() != multipliers.size())
    throw std::invalid_argument("\"multipliers\" and \"penalties\" are not those of the constraints");
  std::vector<Term> terms;
  for (std::size_t k = 0; k < multipliers.size(); ++k) {
    if (!(multipliers[k] >= 0.0 && multipliers[k] <= most && penalties[k] >= 0.0 && penalties[k] <= most))
      throw std::invalid_argument("a multiplier or penalty is out of its range");
    terms.push_back({.multiplier = multipliers[k], .penalty = penalties[k]});
  }
  terms_ = std::move(terms);
  mean_ = std::move(mean);
}

}  // namespace remodel
