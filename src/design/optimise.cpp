#include "remodel/optimise.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "design/airfoil_space.h"
#include "design/design_loop.h"
#include "design/design_search.h"
#include "design/interpolation.h"
#include "remodel/error.h"

namespace remodel {

OptimiseResult optimise(const DesignSpace& space, Designer& designer, Evaluator& evaluator,
                        const OptimiseOptions& options, OptimiseObserver* observer) {
  return run_design_loop({.space = space, .designer = designer, .evaluator = evaluator}, options, observer);
}

namespace {

// CMA-ES over the coefficients of an airfoil. target: of a shape interpolation.
OptimiseResult optimise_airfoil(const CstAirfoil& from, const CstAirfoil* target, Evaluator& evaluator,
                                const OptimiseOptions& options, OptimiseObserver* observer) {
  if (!(options.sigma > 0.0 && std::isfinite(options.sigma)))
    throw Error(ErrorCode::argument, "sigma", "expected more than 0");
  const AirfoilSpace space = options.start
                                 ? AirfoilSpace(from, options.start->mesh.domain(), options.start->place)
                                 : AirfoilSpace(from, options.domain);
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
    result.best = space.airfoil(result.best_design);
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
  require_same_family(start, target);
  const int degree = std::max(start.degree(), target.degree());
  const CstAirfoil from = raise_degree(start, degree), to = raise_degree(target, degree);
  const std::unique_ptr<Evaluator> evaluator = interpolation_evaluator(to);
  return optimise_airfoil(from, &to, *evaluator, options, observer);
}

}  // namespace remodel
