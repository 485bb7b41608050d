#include "flow/search/newton_search.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "flow/search/linear_step.h"

namespace remodel::flow {

namespace {

constexpr double full_cfl = 1e12;  // more is no pseudo-time at all

void add_pseudo_time(const FlowSystem& system, const State& state, double cfl, BlockRows& matrix) {
  const std::vector<double> speeds = system.wave_speeds(state);
  for (std::size_t r = 0; r < matrix.rows.size(); ++r) {
    const std::uint32_t v = matrix.rows[r];
    const auto first = matrix.column.begin() + matrix.start[r],
               last = matrix.column.begin() + matrix.start[r + 1];
    Block& at =
        matrix.block[static_cast<std::size_t>(std::lower_bound(first, last, v) - matrix.column.begin())];
    const double s = speeds[v] / cfl;
    const auto [rho, u, w, p] = state.q[v];
    // Derivatives of density, momentum and energy by the unknowns.
    at[0] += s;
    at[4] += s * u, at[5] += s * rho;
    at[8] += s * w, at[10] += s * rho;
    at[12] += 0.5 * s * (u * u + w * w), at[13] += s * rho * u, at[14] += s * rho * w;
    at[15] += s / (gas_gamma - 1.0);
  }
}

std::string text_of(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", value);
  return text;
}

// How far a step may go: the residual may rise 2.5 times a step, and to 6 times the least there was.
struct LineSearch {
  static constexpr double step_rise = 2.5, whole_rise = 6.0, largest_part = 0.4;
  static constexpr int halvings = 4;
};

// A state with its residuals.
struct Place {
  State state = {};
  Vector residual = {};
  Augmented augmented = {};
  double size = 0.0;
};

// A place along the step that may be gone to, and the part of the step it lies at.
std::optional<std::pair<Place, double>> place_along(const Increment& step, const Measure& measure,
                                                    const State& state, double size, double least) {
  double length = std::min(1.0, LineSearch::largest_part / largest_change(state, step));
  for (int i = 0; i <= LineSearch::halvings; ++i) {
    if (i > 0) length *= 0.5;
    Place next{.state = moved(state, step, length)};
    next.size = measure(next.state, next.residual, next.augmented);
    if (next.size <= LineSearch::step_rise * size && next.size <= LineSearch::whole_rise * least)
      return std::pair{std::move(next), length};
  }
  return std::nullopt;
}

// Whether the search has to end before its next step.
bool is_over(const Pace& pace, const FlowOptions& options, int last_halved, Search& search) {
  if (options.observer != nullptr && options.observer->cancelled()) {
    search.status = FlowStatus::interrupted, search.reason = "interrupted";
    return true;
  }
  if (search.newton_steps >= options.max_steps) {
    search.status = FlowStatus::step_limit;
    search.reason = "residual " + text_of(search.residual) + " after " + std::to_string(search.newton_steps) +
                    " Newton steps, expected " + text_of(options.tolerance);
    return true;
  }
  if (search.newton_steps - last_halved >= pace.patience) {
    search.status = FlowStatus::stalled;
    search.reason = "the residual, " + text_of(search.residual) + ", has not halved in " +
                    std::to_string(pace.patience) + " Newton steps, expected " + text_of(options.tolerance);
    return true;
  }
  return false;
}

// The part of the linear residual that GMRES may leave: less and less, so that Newton's method converges
// faster than linearly, but no less than the flow's tolerance needs.
double forcing(double residual, double target) {
  constexpr double least = 1e-3, most = 1e-2, needed = 0.3;
  return std::clamp(std::max(residual, needed * target / residual), least, most);
}
// Where GMRES leaves more than this, its step is not tried.
constexpr double most_left = 0.5;

void end_without_step(double left, const FlowOptions& options, Search& search) {
  search.status = FlowStatus::stalled;
  if (left > most_left)
    search.reason = "GMRES leaves " + text_of(left) + " of the linear residual at a residual of " +
                    text_of(search.residual) + ", expected " + text_of(most_left) +
                    ": the factors would have to be better ones, with more memory";
  else
    search.reason = "no step leads on from a residual of " + text_of(search.residual) + ", expected " +
                    text_of(options.tolerance) + ": there may be no steady flow";
}

}  // namespace

FactorKind lasting_kind(const FlowOptions& options) {
  return options.solver == FlowSolver::gmres ? FactorKind::incomplete : FactorKind::whole;
}

namespace {

void jacobian_at(const FlowSystem& system, const State& state, double cfl, BlockRows& matrix) {
  system.jacobian(state, matrix);
  if (cfl < full_cfl) add_pseudo_time(system, state, cfl, matrix);
}

void note_step(const FlowSystem& system, const State& state, double size, const FlowOptions& options,
               Search& search) {
  search.residual = size;
  search.history.push_back(size);
  if (options.on_step)
    options.on_step(
        {search.newton_steps, size, system.coefficients(state).lift * reported_length(system.stream())});
}

Factored factor(const FlowSystem& system, const State& state, FactorKind kind, const FlowOptions& options,
                const BlockRows& matrix, Factors& factors, Search& search) {
  const Factored outcome = factors.factor(matrix, system.augmented_columns(state), kind, options.memory_mb);
  ++search.factorisations;
  if (outcome != Factored::done) return outcome;
  search.memory_mb = std::max(search.memory_mb, factors.memory_mb());
  search.whole_factors = factors.whole();
  return outcome;
}

}  // namespace

Factored factor_at(const FlowSystem& system, const State& state, double cfl, FactorKind kind,
                   const FlowOptions& options, BlockRows& matrix, Factors& factors, Search& search) {
  jacobian_at(system, state, cfl, matrix);
  return factor(system, state, kind, options, matrix, factors, search);
}

void end_without_factors(Factored outcome, const FlowOptions& options, Search& search) {
  if (outcome == Factored::out_of_memory) {
    search.status = FlowStatus::memory;
    search.reason =
        "even incomplete factors need more than the " + text_of(options.memory_mb) + " MB that they may take";
  } else {
    search.status = FlowStatus::stalled;
    search.reason =
        "the Jacobian, or its incomplete LU, is singular at a residual of " + text_of(search.residual);
  }
}

void find_flow(const FlowSystem& system, const Measure& measure, const Pace& pace, const FlowOptions& options,
               BlockRows& matrix, Factors& factors, State& state, Search& search) {
  Vector residual;
  Augmented augmented;
  search.residual = measure(state, residual, augmented);
  search.history.push_back(search.residual);
  const double first = search.residual, target = std::max(options.tolerance, pace.rough);
  double least = first, halved = first, cfl = pace.cfl;
  int last_halved = search.newton_steps;
  int end_of_march = search.newton_steps + pace.march;
  constexpr double smallest_cfl = 1e-2;
  FactorKind kind = options.solver == FlowSolver::lu ? FactorKind::whole : FactorKind::incomplete;
  // Incomplete factors serve the matrices of the next steps too, until GMRES takes this many steps more with
  // them than it took with the matrix of their own: new ones take about as long.
  constexpr int steps_of_factors = 8;
  bool worn = true;
  int with_own = 0;
  while (search.residual > target) {
    if (is_over(pace, options, last_halved, search)) return;
    const bool marching = search.newton_steps < end_of_march;
    if (marching) cfl = pace.cfl, least = halved = search.residual, last_halved = search.newton_steps;
    jacobian_at(system, state, cfl, matrix);
    const bool older = !worn && kind == FactorKind::incomplete;
    const Factored outcome =
        older ? Factored::done : factor(system, state, kind, options, matrix, factors, search);
    const bool may_be_whole = kind != lasting_kind(options) && !factors.too_large(state.q.size());
    if (outcome == Factored::singular && may_be_whole) {
      kind = FactorKind::whole;
      continue;
    }
    if (outcome != Factored::done) return end_without_factors(outcome, options, search);
    ++search.newton_steps;
    const LinearStep linear = linear_step(system, state, matrix, factors, residual, augmented,
                                          forcing(search.residual, target), options.observer);
    search.gmres_iterations += linear.iterations;
    if (!older) with_own = linear.iterations;
    worn = linear.iterations > with_own + steps_of_factors;
    if (older && !linear.solved) {
      worn = true;  // the same step once more, with factors of its own
      continue;
    }
    if (!(linear.left <= most_left) && may_be_whole) {
      kind = FactorKind::whole;  // the same step once more, and all to come
      continue;
    }
    if (linear.left <= most_left)
      if (auto found = place_along(linear.step, measure, state, search.residual, least)) {
        auto& [next, length] = *found;
        if (length == 1.0 && linear.solved)
          cfl = std::min(full_cfl, cfl * 2.0 * std::max(1.0, search.residual / next.size));
        if (length < 0.25) cfl *= 0.5;
        cfl = std::min(cfl, pace.most * first / next.size);
        state = std::move(next.state), residual = std::move(next.residual), augmented = next.augmented;
        note_step(system, state, next.size, options, search);
        least = std::min(least, next.size);
        if (least <= 0.5 * halved) halved = least, last_halved = search.newton_steps;
        continue;
      }
    end_of_march = search.newton_steps;
    cfl = std::min(cfl, 1e4) * 0.1;
    if (!(cfl >= smallest_cfl)) return end_without_step(linear.left, options, search);
  }
  search.status = FlowStatus::converged;
  search.reason.clear();
}

void find_flow_beside(const FlowSystem& system, const Measure& measure, const FlowOptions& options,
                      BlockRows& matrix, Factors& factors, State& state, Search& search) {
  constexpr double beside = 1e-3, short_cfl = 20.0;
  if (search.status != FlowStatus::stalled || !(search.residual < beside)) return;
  find_flow(system, measure, {.cfl = short_cfl, .patience = last_patience, .most = short_cfl}, options,
            matrix, factors, state, search);
}

void find_flow_near(const FlowSystem& system, const Measure& measure, const FlowOptions& options,
                    BlockRows& matrix, Factors& factors, State& state, Search& search) {
  constexpr double near = 0.02, carried_cfl = 50.0;
  constexpr int patience = 5;  // what is near enough is found at once
  Vector residual;
  Augmented augmented;
  if (measure(state, residual, augmented) < near) {
    find_flow(system, measure, {.cfl = no_pseudo_time, .patience = patience}, options, matrix, factors, state,
              search);
    if (search.status != FlowStatus::stalled) return;
  }
  find_flow(system, measure, {.cfl = carried_cfl, .patience = usual_patience}, options, matrix, factors,
            state, search);
}

namespace {

// By way of the scheme of first order, whose flow is found from anywhere, and of more and more of the steps
// of the reconstruction: a homotopy in dissipation. Of each stage but the last only the neighbourhood of its
// flow is needed.
void find_flow_in_stages(const FlowSystem& system, const Measure& measure, double rough,
                         const FlowOptions& options, BlockRows& matrix, Factors& factors, State& state,
                         Search& search) {
  constexpr double stages[] = {0.0, 0.5, 0.75, 0.9, 0.95, 0.975, 0.99}, stage_cfl = 20.0,
                   stage_tolerance = 1e-2;
  state = system.uniform();
  Pace pace = {.cfl = cold_cfl,
               .patience = usual_patience,
               .most = cold_cfl,
               .rough = std::max(rough, stage_tolerance)};
  for (const double slopes : stages) {
    Stream stream = system.stream();
    stream.slopes = slopes;
    const FlowSystem stage(system.mesh(), stream);
    find_flow(stage, Measure(stage), pace, options, matrix, factors, state, search);
    if (search.status != FlowStatus::converged && search.status != FlowStatus::stalled) return;
    pace.cfl = pace.most = stage_cfl;
  }
  pace.patience = last_patience, pace.rough = rough;
  find_flow(system, measure, pace, options, matrix, factors, state, search);
}

// Straight from undisturbed flow; where that leads nowhere, in stages; where these end near a state that is
// nearly steady but no flow (a fold of the equations, at which Newton's method stays for ever), away from it
// in pseudo-time, along which it is unstable. rough: see Pace.
void find_flow_at_angle(const FlowSystem& system, const Measure& measure, double rough,
                        const FlowOptions& options, BlockRows& matrix, Factors& factors, State& state,
                        Search& search) {
  constexpr int marches = 3, steps_of_march = 15;
  constexpr double cfl_of_march = 20.0;
  state = system.uniform();
  find_flow(system, measure, {.cfl = cold_cfl, .patience = usual_patience, .rough = rough}, options, matrix,
            factors, state, search);
  find_flow_beside(system, measure, options, matrix, factors, state, search);
  if (search.status == FlowStatus::stalled)
    find_flow_in_stages(system, measure, rough, options, matrix, factors, state, search);
  const Pace march = {
      .cfl = cfl_of_march, .patience = usual_patience, .march = steps_of_march, .rough = rough};
  for (int i = 0; i < marches && search.status == FlowStatus::stalled; ++i)
    find_flow(system, measure, march, options, matrix, factors, state, search);
}

}  // namespace

// A lift that is asked for is looked for from the flow at the first guess of the angle: undisturbed flow is
// too far from it for the angle to follow.
void find_flow_cold(const FlowSystem& system, const Measure& measure, const FlowOptions& options,
                    BlockRows& matrix, Factors& factors, State& state, Search& search) {
  constexpr double rough_tolerance = 1e-4, late_cfl = 1e6, cautious_cfl = 20.0;
  search.newton_steps = 0;
  if (!system.stream().lift)
    return find_flow_at_angle(system, measure, 0.0, options, matrix, factors, state, search);
  Stream at_angle = system.stream();
  at_angle.lift.reset();
  const FlowSystem first(system.mesh(), at_angle);
  find_flow_at_angle(first, Measure(first), rough_tolerance, options, matrix, factors, state, search);
  if (search.status != FlowStatus::converged) return;
  const State at_first_angle = state;
  find_flow(system, measure, {.cfl = late_cfl, .patience = usual_patience}, options, matrix, factors, state,
            search);
  if (search.status != FlowStatus::stalled) return;
  state = at_first_angle;
  find_flow(system, measure, {.cfl = cautious_cfl, .patience = last_patience, .most = cautious_cfl}, options,
            matrix, factors, state, search);
}

}  // namespace remodel::flow
