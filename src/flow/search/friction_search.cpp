#include "flow/search/friction_search.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "flow/linear/gmres.h"
#include "flow/search/lead.h"
#include "flow/search/policy.h"

namespace remodel::flow {

namespace {

// The part of a step that changes no density and no pressure by too much.
template <std::size_t N>
double longest(const BlockState<N>& state, const BlockIncrement<N>& step) {
  double largest = 0.0;
  for (std::size_t v = 0; v < state.q.size(); ++v)
    for (const std::size_t k : positive_unknowns) {
      const double part = std::fabs(step.q[v][k]) / state.q[v][k];
      if (!(part <= largest)) largest = part;  // NaN stays
    }
  if (!std::isfinite(largest)) return 0.0;
  return std::min(1.0, FrictionPolicy::largest_part / largest);
}

// After a step of which this part was taken; `fall` is by how many times the residual is less.
double next_cfl(double cfl, double part, double fall) {
  if (part == 1.0) return cfl * (FrictionPolicy::full_growth * std::max(1.0, std::min(10.0, fall)));
  if (part >= FrictionPolicy::shortest_part) return cfl * (1.0 + FrictionPolicy::part_growth * part);
  return part > 0.0 ? 0.5 * cfl : 0.1 * std::min(cfl, 1e6);
}

// What rows count by in the norm that GMRES reduces. The plain norm does not see the errors of the tiny cells
// at sharp edges, which Newton's method then needs steps for. With the root of sizes, not the fourth one,
// NACA 0012 at Mach 0.5, 1 degree and Re 1e6 with few cells is not found. Augmented equations count as much
// as all others.
class RowWeights {
 public:
  RowWeights(const std::vector<double>& waves, double of_augmented)
      : of_rows_(waves), of_augmented_(of_augmented) {
    double mean = 0.0;
    for (const double wave : waves) mean += wave / static_cast<double>(waves.size());
    for (double& wave : of_rows_) wave = std::sqrt(std::sqrt(mean / wave));
  }
  template <std::size_t N>
  void apply(BlockIncrement<N>& x) const {
    for (std::size_t v = 0; v < of_rows_.size(); ++v)
      for (double& z : x.q[v]) z *= of_rows_[v];
    for (double& z : x.augmented) z *= of_augmented_;
  }
  template <std::size_t N>
  void remove(BlockIncrement<N>& x) const {
    for (std::size_t v = 0; v < of_rows_.size(); ++v)
      for (double& z : x.q[v]) z /= of_rows_[v];
    for (double& z : x.augmented) z /= of_augmented_;
  }

 private:
  std::vector<double> of_rows_;
  double of_augmented_;
};

// The angle of attack that is looked for first: 0, or that along the chord of the largest section where it is
// nearer to the stream's by a step.
double easy_angle(const FlowMesh& mesh, double angle) {
  const Extent& chord = mesh.extent();
  if (chord.a == no_index || chord.b == no_index) return 0.0;
  Point along = mesh.points()[chord.b] - mesh.points()[chord.a];
  if (along.x * std::cos(angle) + along.y * std::sin(angle) < 0.0) along = -1.0 * along;
  const double of_chord = std::atan2(along.y, along.x);
  const bool nearer = std::fabs(angle - of_chord) + FrictionPolicy::angle_step < std::fabs(angle);
  return nearer ? of_chord : 0.0;
}

}  // namespace

// The residual of the implicit time step from `before`.
template <std::size_t N>
double FrictionSearch<N>::unsteady_size(const BlockState<N>& before, const BlockState<N>& state,
                                        const std::vector<double>& by_time, const Residuals& now) const {
  if (!std::isfinite(now.size)) return now.size;
  BlockVector<N> whole = now.of_vertices;
  for (std::size_t v = 0; v < whole.size(); ++v) {
    const auto u = FrictionSystem<N>::conserved_at(state.q[v]),
               u0 = FrictionSystem<N>::conserved_at(before.q[v]);
    for (std::size_t k = 0; k < N; ++k)
      if (!system_.is_replaced(v, k)) whole[v][k] += by_time[v] * (u[k] - u0[k]);
  }
  return measure_.size_of(whole, now.augmented);
}

template <std::size_t N>
Factored FrictionSearch<N>::factor(std::array<BlockVector<N>, augmented_count> columns) {
  const bool whole = by_lu_ || options_.solver == FlowSolver::lu;
  ++record_.factorisations;
  factored_ = factors_.factor(jacobian_.first, std::move(columns),
                              whole ? FactorKind::whole : FactorKind::incomplete, options_.memory_mb);
  record_.memory_mb = std::max(record_.memory_mb, factors_.memory_mb());
  record_.whole_factors = factors_.whole();
  return factored_;
}

template <std::size_t N>
bool FrictionSearch<N>::solve(const BlockState<N>& state, const std::vector<double>& waves,
                              const std::vector<double>& by_time, const Residuals& now,
                              BlockIncrement<N>& step) {
  system_.jacobian(state, jacobian_);
  for (std::uint32_t v = 0; v < by_time.size(); ++v) {
    const SquareBlock<N> slope = FrictionSystem<N>::conserved_slope(state.q[v]);
    for (BlockMatrix<N>* matrix : {&jacobian_.whole, &jacobian_.first}) {
      SquareBlock<N>& block = matrix->at(v, v);
      for (std::size_t z = 0; z < N * N; ++z)
        if (!system_.is_replaced(v, z / N)) block[z] += by_time[v] * slope[z];
    }
  }
  auto columns = system_.augmented_columns(state);
  if (factor(columns) != Factored::done) {
    note_failure(true);
    return false;
  }
  jacobian_.first.block = std::vector<SquareBlock<N>>();  // makes room for GMRES's vectors
  const BlockAugmentedMatrix<N> matrix(jacobian_.whole, std::move(columns), jacobian_.rows);
  const RowWeights weights(waves, measure_.scale());
  BlockIncrement<N> right = now.negated();
  weights.apply(right);
  const double size = norm(right);
  const double part = std::clamp(now.size, FrictionPolicy::least_forcing, FrictionPolicy::most_forcing);
  step = {};
  const GmresEnd end = gmres_of<N>(
      [&](const BlockIncrement<N>& x) {
        BlockIncrement<N> result = matrix.times(x);
        weights.apply(result);
        return result;
      },
      [&](BlockIncrement<N>& x) {
        weights.remove(x);
        factors_.solve(x.q);
        x = close_augmented(std::move(x.q), factors_.columns(), jacobian_.rows, x.augmented);
      },
      right,
      {.wanted = part * size,
       .restart = factors_.restart(),
       .rounds = FrictionPolicy::rounds,
       .observer = options_.observer},
      step);
  record_.gmres_iterations += end.iterations;
  note_failure(!(end.residual <= 2.0 * part * size));
  return end.residual < 0.9 * size;
}

// Where incomplete factors do no longer, twice in a row, LU takes their place, unless GMRES was asked for.
template <std::size_t N>
void FrictionSearch<N>::note_failure(bool failed) {
  const bool may_be_lu = options_.solver != FlowSolver::gmres;
  by_lu_ = by_lu_ || (failed && failed_before_ && !record_.whole_factors && may_be_lu);
  failed_before_ = failed;
}

// The part of the step that was taken; 0: none.
template <std::size_t N>
double FrictionSearch<N>::line_search(const BlockIncrement<N>& step, const std::vector<double>& by_time,
                                      BlockState<N>& state, Residuals& now) const {
  double length = longest(state, step);
  for (int i = 0; i <= FrictionPolicy::halvings && length > FrictionPolicy::retried_part;
       ++i, length *= 0.5) {
    BlockState<N> next = moved(state, step, length);
    Residuals there = measure_(next);
    if (!(unsteady_size(state, next, by_time, there) < FrictionPolicy::merit_rise * now.size)) continue;
    state = std::move(next), now = std::move(there);
    return length;
  }
  return 0.0;
}

template <std::size_t N>
void FrictionSearch<N>::cold(BlockState<N>& state) {
  record_.origin = FlowOrigin::undisturbed;
  record_.in_vain += record_.newton_steps;
  record_.newton_steps = 0;
  std::optional<double> cfl = rough_at_angle(state);
  if (!cfl) return;
  // Undisturbed flow is too far from a flow of this lift for the angle to follow.
  if (system_.stream().lift) {
    Stream at_angle = system_.stream();
    at_angle.lift.reset();
    if (!found_rough(system_.friction_mesh(), at_angle, SearchPolicy::first_angle_tolerance, *cfl, state))
      return;
    cfl = SearchPolicy::with_angle_cfl;
  }
  run(state, *cfl);
}

// From undisturbed flow to a rough flow, with turbulence upwinded to first order at first (from the wall's
// beginning, where a transition is given), and by equal steps of the angle of attack from an easy one to the
// stream's own. The CFL number to go on from; nothing: none was found.
template <std::size_t N>
std::optional<double> FrictionSearch<N>::rough_at_angle(BlockState<N>& state) {
  Stream stage = system_.stream();
  stage.lift.reset();
  const FrictionMesh& mesh = system_.friction_mesh();
  const double angle = stage.alpha, easy = easy_angle(mesh.dual(), angle);
  const int steps =
      std::max(1, static_cast<int>(std::ceil(std::fabs(angle - easy) / FrictionPolicy::angle_step)));
  const auto angle_after = [&](int step) { return easy + (angle - easy) * step / steps; };
  stage.alpha = angle_after(1);
  state = FrictionSystem<N>(mesh, stage, system_.terms().viscosity).undisturbed();
  double cfl = FrictionPolicy::first_cfl;
  if constexpr (N == 5) {
    stage.working_slopes = 0.0;
    if (stage.transition) {
      const FrictionMesh turbulent(system_.mesh());
      if (!found_rough(turbulent, stage, FrictionPolicy::first_order_tolerance, cfl, state))
        return std::nullopt;
      cfl = FrictionPolicy::carried_cfl;
    }
    if (!found_rough(mesh, stage, FrictionPolicy::first_order_tolerance, cfl, state)) return std::nullopt;
    stage.working_slopes = 1.0;
    cfl = FrictionPolicy::second_order_cfl;
  }
  for (int i = 1; i < steps; ++i) {
    if (!found_rough(mesh, stage, FrictionPolicy::angle_tolerance, cfl, state)) return std::nullopt;
    stage.alpha = state.augmented[1] = angle_after(i + 1);
    cfl = FrictionPolicy::angle_cfl;
  }
  return cfl;
}

template <std::size_t N>
bool FrictionSearch<N>::found_rough(const FrictionMesh& mesh, const Stream& stream, double tolerance,
                                    double cfl, BlockState<N>& state) {
  FlowOptions rough = options_;
  rough.tolerance = std::max(options_.tolerance, tolerance);
  const FrictionSystem<N> system(mesh, stream, system_.terms().viscosity);
  const BlockMeasure<N> measure(system);
  FrictionSearch(system, measure, rough, record_).run(state, cfl);
  return record_.status == FlowStatus::converged;
}

template <std::size_t N>
void FrictionSearch<N>::run(BlockState<N>& state, double cfl, int patience) {
  record_.whole_factors = false;
  Residuals now = measure_(state);
  record_.history.push_back(now.size);
  Lead lead(now.size);
  bool is_still = false;
  const auto end = [&](FlowStatus status, const std::string& reason) {
    record_.status = status, record_.reason = reason, record_.residual = now.size;
  };
  while (!(now.size <= options_.tolerance)) {
    if (options_.observer != nullptr && options_.observer->cancelled())
      return end(FlowStatus::interrupted, "interrupted");
    if (record_.newton_steps >= options_.max_steps)
      return end(FlowStatus::step_limit, "the number of steps has reached its limit");
    const bool is_rounding = lead.falls_no_more() && now.size <= FrictionPolicy::most_rounding;
    if (is_rounding && is_still) return end(FlowStatus::converged, "");
    if (is_rounding && cfl < FrictionPolicy::most_cfl)
      cfl = FrictionPolicy::most_cfl;
    else if (lead.falls_no_more() && lead.returns())
      cfl = FrictionPolicy::return_cfl;
    else if (lead.falls_no_more() || lead.since_least_of_all() >= patience || cfl < FrictionPolicy::least_cfl)
      return end(FlowStatus::stalled, lead.reason());
    const std::vector<double> waves = system_.wave_speeds(state);
    std::vector<double> by_time = waves;
    for (double& x : by_time) x = cfl < FrictionPolicy::most_cfl ? x / cfl : 0.0;
    BlockIncrement<N> step;
    const bool solved = solve(state, waves, by_time, now, step);
    if (factored_ == Factored::out_of_memory)
      return record_.end_without_factors(factored_, options_.memory_mb);
    ++record_.newton_steps;
    is_still =
        solved && cfl >= FrictionPolicy::most_cfl && largest_change(state, step) <= FrictionPolicy::still;
    const double length = solved ? line_search(step, by_time, state, now) : 0.0;
    cfl = lead.limited(next_cfl(cfl, length, record_.history.back() / now.size));
    record_.history.push_back(now.size);
    const double lift = reported_length(system_.stream()) * (now.augmented[0] + state.augmented[0]);
    lead.note(now.size, cfl, lift);
    if (options_.on_step) options_.on_step({record_.newton_steps, now.size, lift});
  }
  end(FlowStatus::converged, "");
}

template class FrictionSearch<4>;
template class FrictionSearch<5>;

}  // namespace remodel::flow
