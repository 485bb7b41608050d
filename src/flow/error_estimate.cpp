#include <algorithm>
#include <cmath>

#include "flow/solution.h"
#include "remodel/error.h"
#include "remodel/flow_error.h"
#include "remodel/generate.h"

namespace remodel {

namespace {

// The same curves with a station in the middle between every two.
Domain with_twice_the_stations(Domain domain) {
  for (Loop& loop : domain.loops)
    for (Curve& curve : loop.curves) {
      if (is_single_point(loop)) continue;
      std::vector<double> all;
      for (std::size_t i = 0; i < curve.parameters.size(); ++i) {
        const double next = i + 1 < curve.parameters.size() ? curve.parameters[i + 1] : 1.0;
        all.push_back(curve.parameters[i]);
        all.push_back(0.5 * (curve.parameters[i] + next));
      }
      curve.parameters = std::move(all);
    }
  return domain;
}

QualityOptions with_half_the_sizes(QualityOptions quality) {
  constexpr double largest_gradation = 1e6;
  quality.gradation = std::min(2.0 * quality.gradation, largest_gradation);
  return quality;
}

// Twice as many cells across the same thickness.
LayerOptions with_half_the_heights(LayerOptions layer) {
  constexpr double least_growth = 1.02;
  layer.first_height *= 0.5;
  layer.growth = std::max(std::sqrt(layer.growth), least_growth);
  return layer;
}

void require_found(const FlowResult& flow, const std::string& source) {
  if (!flow.converged())
    throw Error(ErrorCode::argument, source,
                "the flow was not found, expected one that was, to judge its error");
}

// `made` is the result of generate() or generate_layered().
template <typename Made>
FlowError error_beside(const Made& made, const FrozenMesh& mesh, const FlowResult& flow,
                       const FlowConditions& conditions, const FlowOptions& options,
                       const std::string& source) {
  FlowError error;
  if (made.stopped == Stopped::interrupted) {
    error.finer.status = FlowStatus::interrupted;
    return error;
  }
  if (made.stopped != Stopped::done)
    throw Error(ErrorCode::geometry, source,
                std::string("the finer mesh for the estimate of errors is unfinished (") +
                    name_of(made.stopped) + "), expected a whole one");
  const FrozenMesh finer = made.mesh.freeze();
  error.vertices = finer.points.size();
  error.finer = solve_flow_from(mesh, flow, finer, conditions, options, source);
  if (!error.finer.converged()) return error;
  error.order = order_of_errors(remodel::flow::largest_mach(error.finer));
  const double whole = 1.0 / (1.0 - std::pow(2.0, -error.order));
  error.cl = conditions.cl ? 0.0 : whole * (error.finer.cl - flow.cl);
  error.cd = lacking_drag(whole * (error.finer.cd - flow.cd), flow.cd,
                          options.inlets.empty() && options.outlets.empty());
  error.cm = whole * (error.finer.cm - flow.cm);
  error.alpha_deg = conditions.cl ? whole * (error.finer.alpha_deg - flow.alpha_deg) : 0.0;
  return error;
}

}  // namespace

FlowError estimate_error(const Mesh& mesh, const FlowResult& flow, const FlowConditions& conditions,
                         const FlowOptions& options, const std::string& source) {
  require_found(flow, source);
  const GenerateResult made =
      generate(with_twice_the_stations(mesh.domain()), with_half_the_sizes(mesh.options()), options.observer);
  return error_beside(made, mesh.freeze(), flow, conditions, options, source);
}

FlowError estimate_error(const LayeredMesh& mesh, const FlowResult& flow, const FlowConditions& conditions,
                         const FlowOptions& options, const std::string& source) {
  require_found(flow, source);
  const LayeredGenerateResult made =
      generate_layered(with_twice_the_stations(mesh.domain()), with_half_the_heights(mesh.options()),
                       with_half_the_sizes(mesh.outer().options()), options.observer);
  return error_beside(made, mesh.freeze(), flow, conditions, options, source);
}

}  // namespace remodel
