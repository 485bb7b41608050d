#include "remodel/designer.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "remodel/error.h"

namespace remodel {
namespace {

// One number that orders designs as Deb's rules do: those within all constraints by their objective, which
// has to be below 1e300, the others behind them by their violation.
double rank_of(const Evaluation& evaluation, double constraint_tolerance) {
  constexpr double behind_all = 1e300;
  const double violation = violation_of(evaluation.constraints);
  if (violation <= constraint_tolerance || !std::isfinite(evaluation.objective)) return evaluation.objective;
  return std::isfinite(violation) ? behind_all * (1.0 + violation / (1.0 + violation)) : 2.0 * behind_all;
}

}  // namespace

double violation_of(const std::vector<double>& constraints) {
  double worst = 0.0;
  for (const double constraint : constraints)
    worst = std::isnan(constraint) ? Evaluation::failed : std::max(worst, constraint);
  return worst;
}

CmaesDesigner::CmaesDesigner(std::vector<double> start, const CmaesOptions& options,
                             AtConvergence at_convergence, double constraint_tolerance)
    : options_(options),
      at_convergence_(at_convergence),
      constraint_tolerance_(constraint_tolerance),
      cmaes_(std::move(start), options) {}

std::size_t CmaesDesigner::population() const {
  return static_cast<std::size_t>(cmaes_.population());
}

Proposal CmaesDesigner::ask() {
  return {.design = cmaes_.ask()};
}

void CmaesDesigner::tell(const Proposal& proposal, const Evaluation& evaluation) {
  cmaes_.tell(proposal.design, rank_of(evaluation, constraint_tolerance_));
}

// The distribution wavers above its floor by a small factor: it is not waited for to be hit.
bool CmaesDesigner::finished() const {
  return at_convergence_ == AtConvergence::end &&
         cmaes_.largest_deviation() <= 10.0 * options_.least_deviation;
}

std::uint64_t CmaesDesigner::generation() const {
  return cmaes_.generation();
}

double CmaesDesigner::step_size() const {
  return cmaes_.sigma();
}

std::vector<double> CmaesDesigner::centre() const {
  return {cmaes_.mean().begin(), cmaes_.mean().end()};
}

std::string CmaesDesigner::state() const {
  return cmaes_.state();
}

void CmaesDesigner::restore(const std::string& state, const std::string& source) {
  Cmaes restored = Cmaes::restore(state, source);
  if (restored.dimension() != cmaes_.dimension() || restored.population() != cmaes_.population())
    throw Error(ErrorCode::format, source,
                "expected " + std::to_string(cmaes_.dimension()) + " coefficients and " +
                    std::to_string(cmaes_.population()) + " samples per generation, found " +
                    std::to_string(restored.dimension()) + " and " + std::to_string(restored.population()));
  cmaes_ = std::move(restored);
}

std::string CmaesDesigner::description() const {
  return nlohmann::ordered_json{{"designer", "cmaes"},
                                {"sigma", options_.sigma},
                                {"seed", options_.seed},
                                {"population", cmaes_.population()},
                                {"least_deviation", options_.least_deviation}}
      .dump();
}

}  // namespace remodel
