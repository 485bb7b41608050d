#include "remodel/optimise.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "design/airfoil_space.h"
#include "design/design_loop.h"
#include "design/design_search.h"
#include "design/interpolation.h"
#include "design/run_space.h"
#include "design/workers.h"
#include "remodel/error.h"

namespace remodel {

OptimiseResult optimise(const DesignSpace& space, Designer& designer, Evaluator& evaluator,
                        const OptimiseOptions& options, OptimiseObserver* observer) {
  return run_design_loop({.space = space, .designer = designer, .evaluator = evaluator}, options, observer);
}

namespace {

// Work of a crew, with what it needs.
struct AirfoilWork {
  AirfoilWork(const CstAirfoil& from, const OptimiseOptions& given) : options(given), space(from, given) {
    options.ranks = nullptr;
    options.threads = 1;
  }
  OptimiseOptions options;
  RunSpace space;
  std::unique_ptr<Evaluator> own;  // where it has one
  CrewWork work;
};

CrewWork work_around(const CstAirfoil& from, Evaluator* evaluator, std::unique_ptr<Evaluator> own,
                     const OptimiseOptions& options) {
  const auto parts = std::make_shared<AirfoilWork>(from, options);
  parts->own = std::move(own);
  const std::size_t population =
      interpolation_designer(parts->space.space().start(), options.sigma, options.seed).population();
  parts->work = optimise_work(parts->space.space(), evaluator != nullptr ? *evaluator : *parts->own,
                              parts->options, population);
  return [parts](const std::string& bytes, const std::function<bool()>& cancelled) {
    return parts->work(bytes, cancelled);
  };
}

// Both with the higher of their degrees.
std::pair<CstAirfoil, CstAirfoil> of_one_degree(const CstAirfoil& start, const CstAirfoil& target) {
  require_same_family(start, target);
  const int degree = std::max(start.degree(), target.degree());
  return {raise_degree(start, degree), raise_degree(target, degree)};
}

// CMA-ES over the coefficients of an airfoil. target: of a shape interpolation.
OptimiseResult optimise_airfoil(const CstAirfoil& from, const CstAirfoil* target, Evaluator& evaluator,
                                const OptimiseOptions& options, OptimiseObserver* observer) {
  if (!(options.sigma > 0.0 && std::isfinite(options.sigma)))
    throw Error(ErrorCode::argument, "sigma", "expected more than 0");
  const RunSpace around(from, options);
  const DesignSpace& space = around.space();
  using enum CmaesDesigner::AtConvergence;
  CmaesDesigner designer = interpolation_designer(space.start(), options.sigma, options.seed,
                                                  options.tolerance == 0.0 ? go_on : end);
  std::optional<InterpolationObjective> distance;
  LoopParts problem{.space = space, .designer = designer, .evaluator = evaluator};
  problem.facts = {{"seed", std::to_string(options.seed)}, {"from", airfoil_to_json(from)}};
  if (options.start) problem.facts["place"] = place_to_json(options.start->place);
  if (target) {
    distance.emplace(*target);
    problem.facts["to"] = airfoil_to_json(*target);
    problem.half_way = 0.25 * distance->mean_square(from);
  }
  problem.complete = [&](OptimiseResult& result) {
    result.seed = options.seed;
    result.best = around.airfoils().airfoil(result.best_design);
    if (distance && result.evaluations > 0) result.max_error = distance->max_error(result.best);
  };
  return run_design_loop(problem, options, observer);
}

}  // namespace

OptimiseResult optimise(const CstAirfoil& from, Evaluator& evaluator, const OptimiseOptions& options,
                        OptimiseObserver* observer) {
  if (!surfaces_apart(from)) throw Error(ErrorCode::geometry, "start airfoil", "its surfaces touch or cross");
  return optimise_airfoil(from, nullptr, evaluator, options, observer);
}

OptimiseResult optimise(const CstAirfoil& start, const CstAirfoil& target, const OptimiseOptions& options,
                        OptimiseObserver* observer) {
  const auto [from, to] = of_one_degree(start, target);
  const std::unique_ptr<Evaluator> evaluator = interpolation_evaluator(to);
  return optimise_airfoil(from, &to, *evaluator, options, observer);
}

CrewWork optimise_work(const DesignSpace& space, Evaluator& evaluator, const OptimiseOptions& options,
                       std::size_t population) {
  return Workers::work_of_crew(space, evaluator, options, population);
}

CrewWork optimise_work(const CstAirfoil& start, const CstAirfoil& target, const OptimiseOptions& options) {
  const auto [from, to] = of_one_degree(start, target);
  return work_around(from, nullptr, interpolation_evaluator(to), options);
}

CrewWork optimise_work(const CstAirfoil& from, Evaluator& evaluator, const OptimiseOptions& options) {
  return work_around(from, &evaluator, nullptr, options);
}

}  // namespace remodel
