#include "remodel/designer.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "design/augmented_lagrangian.h"
#include "remodel/error.h"

namespace remodel {
namespace {

using Json = nlohmann::json;

constexpr const char* constrained_format = "remodel-cmaes-constrained";

}  // namespace

double violation_of(const std::vector<double>& constraints) {
  double worst = 0.0;
  for (const double constraint : constraints)
    worst = std::isnan(constraint) ? Evaluation::failed : std::max(worst, constraint);
  return worst;
}

// What comes of a generation's designs is kept until all can be ranked; those that cannot be compared, which
// are behind the others, and those of problems without constraints are told at once.
struct CmaesDesigner::Constrained {
  explicit Constrained(int dimension) : lagrangian(dimension) {}

  bool untouched() const { return lagrangian.constraints() == 0 && designs.empty(); }
  bool can_rank(const Evaluation& evaluation) const {
    const std::vector<double>& constraints = evaluation.constraints;
    const std::size_t expected =
        evaluations.empty() ? lagrangian.constraints() : evaluations.front().constraints.size();
    return std::isfinite(evaluation.objective) && !constraints.empty() &&
           (expected == 0 || constraints.size() == expected) &&
           std::all_of(constraints.begin(), constraints.end(), [](double g) { return std::isfinite(g); });
  }
  void keep(std::vector<double> design, double objective, std::vector<double> constraints) {
    designs.push_back(std::move(design));
    evaluations.push_back({.objective = objective, .constraints = std::move(constraints)});
  }

  AugmentedLagrangian lagrangian;
  std::vector<std::vector<double>> designs{};  // of this generation so far
  std::vector<Evaluation> evaluations{};       // theirs
};

CmaesDesigner::CmaesDesigner(std::vector<double> start, const CmaesOptions& options,
                             AtConvergence at_convergence)
    : options_(options),
      at_convergence_(at_convergence),
      cmaes_(std::move(start), options),
      constrained_(std::make_unique<Constrained>(cmaes_.dimension())) {}

CmaesDesigner::~CmaesDesigner() = default;
CmaesDesigner::CmaesDesigner(CmaesDesigner&&) noexcept = default;
CmaesDesigner& CmaesDesigner::operator=(CmaesDesigner&&) noexcept = default;

std::size_t CmaesDesigner::population() const {
  return static_cast<std::size_t>(cmaes_.population());
}

Proposal CmaesDesigner::ask() {
  return {.design = cmaes_.ask()};
}

void CmaesDesigner::tell(const Proposal& proposal, const Evaluation& evaluation) {
  Constrained& kept = *constrained_;
  if (kept.can_rank(evaluation))
    kept.keep(proposal.design, evaluation.objective, evaluation.constraints);
  else if (kept.untouched() && evaluation.constraints.empty())
    cmaes_.tell(proposal.design, evaluation.objective);
  else
    cmaes_.tell(proposal.design, Evaluation::failed);
  if (kept.designs.empty() || cmaes_.told() + kept.designs.size() < population()) return;
  const std::vector<double> values = kept.lagrangian.rank(kept.evaluations, cmaes_.weights());
  for (std::size_t i = 0; i < values.size(); ++i) cmaes_.tell(kept.designs[i], values[i]);
  kept.designs.clear();
  kept.evaluations.clear();
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

// Where there are no constraints, that of the CMA-ES.
std::string CmaesDesigner::state() const {
  const Constrained& kept = *constrained_;
  if (kept.untouched()) return cmaes_.state();
  Json told = Json::array();
  for (std::size_t i = 0; i < kept.designs.size(); ++i)
    told.push_back({{"design", kept.designs[i]},
                    {"objective", kept.evaluations[i].objective},
                    {"constraints", kept.evaluations[i].constraints}});
  const Json json = {{"format", constrained_format},
                     {"version", 1},
                     {"cmaes", Json::parse(cmaes_.state())},
                     {"lagrangian", kept.lagrangian.state()},
                     {"told", told}};
  return json.dump();
}

void CmaesDesigner::restore(const std::string& state, const std::string& source) {
  auto kept = std::make_unique<Constrained>(cmaes_.dimension());
  std::string of_cmaes = state;
  try {
    const Json json = Json::parse(state);
    if (json.at("format") == constrained_format) {
      if (json.at("version") != 1) throw std::invalid_argument("not a state of version 1");
      of_cmaes = json.at("cmaes").dump();
      kept->lagrangian.restore(json.at("lagrangian"));
      for (const Json& one : json.at("told")) {
        const Evaluation evaluation{.objective = one.at("objective"), .constraints = one.at("constraints")};
        const auto design = one.at("design").get<std::vector<double>>();
        if (!kept->can_rank(evaluation) || design.size() != static_cast<std::size_t>(cmaes_.dimension()))
          throw std::invalid_argument("\"told\" has other numbers than a design and its constraints");
        kept->keep(design, evaluation.objective, evaluation.constraints);
      }
    }
  } catch (const std::exception& problem) {
    throw Error(ErrorCode::format, source, std::string("expected the state of a CMA-ES: ") + problem.what());
  }
  Cmaes restored = Cmaes::restore(of_cmaes, source);
  if (restored.dimension() != cmaes_.dimension() || restored.population() != cmaes_.population())
    throw Error(ErrorCode::format, source,
                "expected " + std::to_string(cmaes_.dimension()) + " coefficients and " +
                    std::to_string(cmaes_.population()) + " samples per generation, found " +
                    std::to_string(restored.dimension()) + " and " + std::to_string(restored.population()));
  if (restored.told() + kept->designs.size() >= population())
    throw Error(ErrorCode::format, source,
                "expected the state of a CMA-ES: more samples told than a generation has");
  cmaes_ = std::move(restored);
  constrained_ = std::move(kept);
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
