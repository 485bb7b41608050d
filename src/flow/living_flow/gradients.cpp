#include "flow/living_flow/gradients.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/stopwatch.h"
#include "flow/scheme/entropy_drag.h"
#include "flow/scheme/forces.h"
#include "flow/solution.h"
#include "remodel/error.h"

namespace remodel::flow {

namespace {

// scale: the function that is reported, over the one that these are of.
FlowGradient gradient_of(Total total, double scale, const Stream& stream) {
  for (Point& point : total.shape.points) point = scale * point;
  const double by_condition = scale * total.condition;
  return {.points = std::move(total.shape.points),
          .mach = scale * total.shape.mach,
          .alpha_deg = stream.lift ? 0.0 : by_condition * one_degree,
          .cl = stream.lift ? by_condition / reported_length(stream) : 0.0};
}

FunctionalSlope slope_of(const FlowFunctional& function, std::size_t size) {
  const std::vector<double>* by[unknown_count] = {&function.density, &function.velocity_x,
                                                  &function.velocity_y, &function.pressure};
  const auto require_size = [&](std::size_t found, const char* what) {
    if (found == size) return;
    throw Error(ErrorCode::argument, "functional",
                "found derivatives by " + std::to_string(found) + " " + what + ", expected the mesh's " +
                    std::to_string(size) + " points");
  };
  require_size(function.pressure.size(), "pressures");
  require_size(function.points.size(), "points");
  FunctionalSlope result;
  result.shape.points = function.points;
  result.shape.mach = function.mach;
  result.state.resize(size);
  for (std::size_t k = 0; k < unknown_count; ++k) {
    if (by[k]->empty()) continue;
    require_size(by[k]->size(), "values");
    for (std::size_t v = 0; v < size; ++v) result.state[v][k] = (*by[k])[v];
  }
  return result;
}

// The angle of attack itself, in degrees.
FunctionalSlope angle(std::size_t size) {
  FunctionalSlope result;
  result.shape.points.resize(size);
  result.state.resize(size);
  result.augmented[1] = 1.0 / one_degree;
  return result;
}

}  // namespace

// The multipliers of the last gradients are the guess for the next ones.
void Gradients::guess_multipliers(const Keys& keys, std::size_t functions) {
  if (multipliers_.size() != functions) multipliers_.assign(functions, {});
  const KeyTable table(multiplier_keys_);
  for (Increment& multiplier : multipliers_) {
    if (multiplier.q.size() != multiplier_keys_.size()) continue;
    Vector guess(keys.size());
    for (std::size_t v = 0; v < keys.size(); ++v)
      if (const std::uint32_t old = table.find(keys[v]); old != no_index) guess[v] = multiplier.q[old];
    multiplier.q = std::move(guess);
  }
  multiplier_keys_ = keys;
}

std::optional<std::vector<Total>> Gradients::by_kept_factors(const LastFlow<unknown_count>& last, const FlowSystem& system,
                                                             std::span<const FaceDerivative> faces,
                                                             std::span<const FunctionalSlope> functions,
                                                             int& iterations) {
  if (!kept_.ready()) return std::nullopt;
  const Overlap overlap = kept_.overlap(*last.mesh, last.keys);
  if (!KeptFactors<unknown_count>::is_small(overlap)) return std::nullopt;
  guess_multipliers(last.keys, functions.size());
  const bool are_own = overlap.zone.empty() && kept_.are_fresh();
  const double most_solves =
      are_own ? std::numeric_limits<double>::infinity() : std::max(0.0, kept_.solves_left());
  const int before = iterations;
  Adjoint adjoint(system, last.state, matrix_.of(system), faces, kept_.factors, overlap, options_);
  auto totals = adjoint.totals(functions, multipliers_, most_solves, iterations);
  kept_.charge(iterations - before, SearchPolicy::own_solves * static_cast<int>(functions.size()), 0.0);
  return totals;
}

FlowGradients Gradients::of(const LastFlow<unknown_count>& last, const std::vector<FlowFunctional>& functions,
                            const WantedGradients& wanted) {
  const Stopwatch watch;
  if (!last.found()) throw Error(ErrorCode::argument, "gradients", "no flow was found yet, expected one");
  if (!options_.inlets.empty() || !options_.outlets.empty())
    throw Error(ErrorCode::argument, "gradients", "found inlets or outlets, expected a far field alone");
  const FlowSystem system(*last.mesh, last.stream);
  FlowGradients result;
  result.functions.assign(functions.size(), {});
  std::vector<FunctionalSlope> slopes;
  std::vector<std::pair<FlowGradient*, double>> places;
  const auto add = [&](FunctionalSlope slope, FlowGradient& place, double scale = 1.0) {
    slopes.push_back(std::move(slope)), places.push_back({&place, scale});
  };
  const auto force = [&](const Coefficients& weight) {
    return slope_of(system, last.state, WallForce{.weight = weight});
  };
  const double scale = reported_length(last.stream);
  if (wanted.lift) add(force({.lift = 1.0}), result.cl, scale);
  if (wanted.drag) add(force({.drag = 1.0}), result.cd, scale);
  if (wanted.moment) add(force({.moment = 1.0}), result.cm, scale * scale);
  if (wanted.angle) add(angle(last.mesh->size()), result.alpha_deg);
  if (wanted.entropy_drag) add(slope_of(system, last.state, EntropyDrag{}), result.entropy_drag, scale);
  for (std::size_t i = 0; i < functions.size(); ++i)
    add(slope_of(functions[i], last.mesh->size()), result.functions[i]);

  std::vector<FaceDerivative> faces;
  system.jacobian(last.state, matrix_.of(system), &faces);
  const auto told_to_end = [&] {
    result.interrupted = options_.observer != nullptr && options_.observer->cancelled();
    return result.interrupted;
  };
  auto totals = by_kept_factors(last, system, faces, slopes, result.krylov_iterations);
  if (told_to_end()) return result;
  if (!totals) {
    SearchRecord made;
    kept_.replace();
    NewtonSearch search(options_, matrix_, kept_.factors, made);
    const Factored outcome = search.factor_at(system, last.state, lasting_kind(options_));
    kept_.belong(*last.mesh, last.keys);
    if (outcome == Factored::done) {
      result.factorisations = 1;
      totals = by_kept_factors(last, system, faces, slopes, result.krylov_iterations);
    }
    if (told_to_end()) return result;
    if (!totals)
      throw Error(ErrorCode::argument, "gradients",
                  "the adjoint was not found: the Jacobian is singular, or the factors need more than the "
                  "memory that they may take, or GMRES takes too long with them");
  }
  for (std::size_t i = 0; i < places.size(); ++i)
    *places[i].first = gradient_of(std::move((*totals)[i]), places[i].second, last.stream);
  result.seconds = watch.seconds();
  return result;
}

}  // namespace remodel::flow
