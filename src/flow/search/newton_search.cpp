#include "flow/search/newton_search.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "flow/scheme/forces.h"
#include "flow/search/linear_step.h"
#include "flow/search/potential_start.h"

namespace remodel::flow {

namespace {

using Policy = SearchPolicy;

// Adds to the diagonal the derivatives of what is conserved, over a time step of this CFL number.
void add_pseudo_time(const FlowSystem& system, const State& state, double cfl, BlockRows& matrix) {
  constexpr std::size_t n = unknown_count;
  const std::vector<double> speeds = system.wave_speeds(state);
  for (std::size_t r = 0; r < matrix.rows.size(); ++r) {
    const std::uint32_t v = matrix.rows[r];
    if (system.mesh().is_image(v)) continue;
    Unknowns<Dual<n>> q;
    for (std::size_t k = 0; k < n; ++k) q[k] = Dual<n>::variable(state.q[v][k], k);
    const auto by_unknowns = conserved(q);
    Block& block = matrix.at(r, v);
    for (std::size_t z = 0; z < n * n; ++z) block[z] += speeds[v] / cfl * by_unknowns[z / n].slope[z % n];
  }
}

std::string text_of(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", value);
  return text;
}

// The part of the linear residual that GMRES may leave: less and less, so that Newton's method converges
// faster than linearly, but no less than the flow's tolerance needs.
double forcing(double residual, double target) {
  return std::clamp(std::max(residual, Policy::forcing_needed * target / residual), Policy::least_forcing,
                    Policy::most_forcing);
}

}  // namespace

// The progress of one run.
struct NewtonSearch::Progress {
  const Measure& measure;
  const Pace& pace;
  Residuals residuals;
  double target, first, least, halved;  // residuals: to end at, the first one, the least, the last half
  double cfl;
  int last_halved, end_of_constant_cfl;  // Newton steps
  FactorKind kind;
  bool may_be_whole = false;
  // Incomplete factors: whether new ones are due, and how many steps GMRES took with their own matrix.
  bool worn = true;
  int with_own = 0;
};

bool NewtonSearch::may_go_on(const Progress& at) {
  const std::string expected = ", expected " + text_of(options_.tolerance);
  if (options_.observer != nullptr && options_.observer->cancelled()) {
    record_.interrupt();
    return false;
  }
  if (record_.newton_steps >= options_.max_steps) {
    record_.status = FlowStatus::step_limit;
    record_.reason = "residual " + text_of(record_.residual) + " after " +
                     std::to_string(record_.newton_steps) + " Newton steps" + expected;
    return false;
  }
  if (record_.newton_steps - at.last_halved >= at.pace.patience) {
    record_.status = FlowStatus::stalled;
    record_.reason = "the residual, " + text_of(record_.residual) + ", has not halved in " +
                     std::to_string(at.pace.patience) + " Newton steps" + expected;
    return false;
  }
  return true;
}

void NewtonSearch::run(const Measure& measure, const Pace& pace, State& state) {
  Residuals residuals = measure(state);
  const double size = residuals.size;
  record_.residual = size;
  record_.history.push_back(size);
  const bool by_lu = options_.solver == FlowSolver::lu;
  Progress at = {.measure = measure,
                 .pace = pace,
                 .residuals = std::move(residuals),
                 .target = std::max(options_.tolerance, pace.rough),
                 .first = size,
                 .least = size,
                 .halved = size,
                 .cfl = pace.cfl,
                 .last_halved = record_.newton_steps,
                 .end_of_constant_cfl = record_.newton_steps + pace.constant_cfl_steps,
                 .kind = by_lu ? FactorKind::whole : FactorKind::incomplete};
  while (record_.residual > at.target)
    if (!may_go_on(at) || !step(at, state)) return;
  record_.status = FlowStatus::converged;
  record_.reason.clear();
}

// One step, or the same once more with better factors or a shorter time step.
bool NewtonSearch::step(Progress& at, State& state) {
  const FlowSystem& system = at.measure.system();
  if (record_.newton_steps < at.end_of_constant_cfl) {
    at.cfl = at.pace.cfl;
    at.least = at.halved = record_.residual, at.last_halved = record_.newton_steps;
  }
  BlockRows& matrix = matrix_.of(system);
  system.jacobian(state, matrix);
  if (at.cfl < Policy::full_cfl) add_pseudo_time(system, state, at.cfl, matrix);
  const bool older = !at.worn && at.kind == FactorKind::incomplete;
  const Factored outcome = older ? Factored::done : factor(system, state, matrix, at.kind);
  at.may_be_whole = at.kind != lasting_kind(options_) && !factors_.too_large(state.q.size());
  if (outcome == Factored::singular && at.may_be_whole) {
    at.kind = FactorKind::whole;
    return true;
  }
  if (outcome != Factored::done) {
    record_.end_without_factors(outcome, options_.memory_mb);
    return false;
  }
  ++record_.newton_steps;
  const LinearStep linear = linear_step(system, state, matrix, factors_, at.residuals.negated(),
                                        forcing(record_.residual, at.target), options_.observer);
  record_.gmres_iterations += linear.iterations;
  if (!older) at.with_own = linear.iterations;
  at.worn = linear.iterations > at.with_own + Policy::steps_of_factors;
  if (older && !linear.solved) {
    at.worn = true;
    return true;
  }
  const bool useful = linear.left <= Policy::most_left;
  if (!useful && at.may_be_whole) {
    at.kind = FactorKind::whole;  // of all steps to come
    return true;
  }
  if (useful && take(at, state, linear.step, linear.solved)) return true;
  return shorten(at, linear.left);
}

// Goes as far along the step as the residual allows; false where it allows nothing.
bool NewtonSearch::take(Progress& at, State& state, const Increment& step, bool solved) {
  double length = std::min(1.0, Policy::largest_part / largest_change(state, step));
  State next;
  Residuals residuals;
  for (int i = 0;; ++i) {
    if (i > Policy::halvings) return false;
    if (i > 0) length *= 0.5;
    next = moved(state, step, length);
    residuals = at.measure(next);
    if (residuals.size <= Policy::step_rise * record_.residual &&
        residuals.size <= Policy::whole_rise * at.least)
      break;
  }
  const double size = residuals.size;
  if (length == 1.0 && solved)
    at.cfl = std::min(Policy::full_cfl, at.cfl * 2.0 * std::max(1.0, record_.residual / size));
  if (length < Policy::short_step) at.cfl *= 0.5;
  at.cfl = std::min(at.cfl, at.pace.most * at.first / size);
  state = std::move(next), at.residuals = std::move(residuals);
  record_.residual = size;
  record_.history.push_back(size);
  const FlowSystem& system = at.measure.system();
  if (options_.on_step)
    options_.on_step(
        {record_.newton_steps, size, coefficients(system, state).lift * reported_length(system.stream())});
  at.least = std::min(at.least, size);
  if (at.least <= 0.5 * at.halved) at.halved = at.least, at.last_halved = record_.newton_steps;
  return true;
}

// A shorter time step for the same step; false where the shortest one leads nowhere.
bool NewtonSearch::shorten(Progress& at, double left) {
  at.end_of_constant_cfl = record_.newton_steps;
  at.cfl = std::min(at.cfl, Policy::retried_cfl) * 0.1;
  if (at.cfl >= Policy::smallest_cfl) return true;
  record_.status = FlowStatus::stalled;
  if (left > Policy::most_left)
    record_.reason = "GMRES leaves " + text_of(left) + " of the linear residual at a residual of " +
                     text_of(record_.residual) + ", expected " + text_of(Policy::most_left) +
                     ": the factors would have to be better ones, with more memory";
  else
    record_.reason = "no step leads on from a residual of " + text_of(record_.residual) + ", expected " +
                     text_of(options_.tolerance) + ": there may be no steady flow";
  return false;
}

void NewtonSearch::beside(const Measure& measure, State& state) {
  if (record_.status != FlowStatus::stalled || !(record_.residual < Policy::nearly_found)) return;
  run(measure, {.cfl = Policy::short_cfl, .patience = Policy::last_patience, .most = Policy::short_cfl},
      state);
}

void NewtonSearch::near(const Measure& measure, State& state) {
  if (measure(state).size < Policy::near) {
    run(measure, {.cfl = no_pseudo_time, .patience = Policy::near_patience}, state);
    if (record_.status != FlowStatus::stalled) return;
  }
  run(measure, {.cfl = Policy::carried_cfl}, state);
}

// Each stage but the last needs only the neighbourhood of its flow.
void NewtonSearch::in_stages(const Measure& measure, double rough, State& state) {
  const FlowSystem& system = measure.system();
  state = system.undisturbed();
  Pace pace = {
      .cfl = Policy::cold_cfl, .most = Policy::cold_cfl, .rough = std::max(rough, Policy::stage_tolerance)};
  for (const double slopes : Policy::stages) {
    Stream stream = system.stream();
    stream.slopes = slopes;
    const FlowSystem stage(system.mesh(), stream);
    run(Measure(stage), pace, state);
    if (record_.status != FlowStatus::converged && record_.status != FlowStatus::stalled) return;
    pace.cfl = pace.most = Policy::stage_cfl;
  }
  pace.patience = Policy::last_patience, pace.rough = rough;
  run(measure, pace, state);
}

// Where stages end near a state that is nearly steady but no flow (a fold of the equations, at which Newton's
// method stays for ever), pseudo-time, along which it is unstable, leads away from it.
void NewtonSearch::at_given_angle(const Measure& measure, double rough, State& state) {
  state = measure.system().undisturbed();
  run(measure, {.cfl = Policy::cold_cfl, .rough = rough}, state);
  beside(measure, state);
  if (record_.status == FlowStatus::stalled) in_stages(measure, rough, state);
  for (int i = 0; i < Policy::escapes && record_.status == FlowStatus::stalled; ++i)
    run(measure, {.cfl = Policy::escape_cfl, .constant_cfl_steps = Policy::steps_of_escape, .rough = rough},
        state);
}

bool NewtonSearch::from_potential_flow(const Measure& measure, State& state) {
  std::optional<State> start = potential_start(measure.system());
  if (!start) return false;
  state = std::move(*start);
  record_.origin = FlowOrigin::potential;
  record_.newton_steps = 0;
  run(measure, {.cfl = Policy::potential_cfl, .patience = Policy::potential_patience}, state);
  if (record_.status != FlowStatus::stalled && record_.status != FlowStatus::step_limit) return true;
  record_.in_vain += record_.newton_steps;
  return false;
}

void NewtonSearch::from_undisturbed_flow(const Measure& measure, State& state) {
  const FlowSystem& system = measure.system();
  record_.newton_steps = 0;
  record_.origin = FlowOrigin::undisturbed;
  if (!system.stream().lift) return at_given_angle(measure, 0.0, state);
  // Undisturbed flow is too far from a flow of this lift for the angle to follow.
  Stream at_angle = system.stream();
  at_angle.lift.reset();
  const FlowSystem first(system.mesh(), at_angle);
  at_given_angle(Measure(first), Policy::first_angle_tolerance, state);
  if (record_.status != FlowStatus::converged) return;
  const State at_first_angle = state;
  run(measure, {.cfl = Policy::with_angle_cfl}, state);
  if (record_.status != FlowStatus::stalled) return;
  state = at_first_angle;
  run(measure, {.cfl = Policy::cautious_cfl, .patience = Policy::last_patience, .most = Policy::cautious_cfl},
      state);
}

}  // namespace remodel::flow
