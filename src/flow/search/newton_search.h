#pragma once

// Newton's method, globalised by pseudo-transient continuation.
//
// One step solves (V / dt + J) dq = -R with the exact Jacobian J and local time steps dt of one CFL number
// for all vertices (C. T. Kelley and D. E. Keyes, "Convergence analysis of pseudo-transient continuation",
// SIAM J. Numer. Anal. 35 (1998)). The step is shortened until no density or pressure changes by too much and
// the residual does not rise beyond bounds; it may rise for a while, as it must while a shock moves (L.
// Grippo, F. Lampariello and S. Lucidi, SIAM J. Numer. Anal. 23 (1986)). Whole steps let the CFL number grow
// until there is no pseudo-time any more: then convergence is quadratic, or as fast as GMRES solves.
//
// One step of run():
//
//   1. The Jacobian at the state, and V / dt on its diagonal, for the derivatives of what is conserved: the
//      unknowns are densities, velocities and pressures.
//   2. Incomplete factors and GMRES, or whole factors where those fail or options say so. GMRES may leave a
//      part of the linear residual, the less the nearer the flow is (forcing()). Incomplete factors serve the
//      next steps too, until they cost GMRES eight steps more than their own matrix did.
//   3. The length: no density or pressure may change by more than two fifths. It is halved, four times at
//      most, while the residual is above 2.5 times the last one or 6 times the least.
//   4. A whole step multiplies the CFL number by 2 |R_old| / |R_new|, or by 2 where the residual rises. One
//      of less than a quarter halves it. Where no length will do the step is made again at a tenth of it.
//
//   residual                                   It ends when the residual is below the tolerance; at the limit
//     ^  \    /\                               on steps; when the residual has not halved in `patience`
//     |   \__/  \__                            steps (stalled); when the CFL number is below a hundredth
//     |             \    quadratic             (stalled); or without factors.
//     |              \__
//     +-----------------\-> steps              The hump is a shock on its way: the residual has to rise.
//
// cold() begins with potential flow, where there is one (potential_start.h), and else with undisturbed flow.
// from_undisturbed_flow() finds by fallbacks what run() does not find from there, in this order:
//
//   a. run() from CFL 5.
//   b. beside(): where it stalls with little residual left, short time steps from there. All but a stagnation
//      point may be steady by then, and long steps lose what it has gained.
//   c. in_stages(): from undisturbed flow again, by schemes from that of first order to the whole one; each
//      flow starts the next (homotopy in dissipation: D. A. Brown and D. W. Zingg, J. Comput. Appl. Math.,
//      2018, doi 10.1016/j.cam.2018.06.036, and references there). The CFL number is held to the residual's
//      fall (switched evolution relaxation).
//   d. Steps at constant CFL, away from a state that is nearly steady but no flow: a fold of the equations,
//      at which Newton's method would stay forever. Pseudo-time, along which it is unstable, leads away.
//
// A given lift has the angle of attack for an unknown more (linear/augmented.h). Undisturbed flow is too far
// from it: (a) to (d) find the flow at a guess of the angle, run() goes on from that.
//
// All numbers are in policy.h, with where they come from.

#include <limits>

#include "flow/scheme/flow_system.h"
#include "flow/search/policy.h"
#include "flow/search/search.h"

namespace remodel::flow {

// How pseudo-time goes on.
struct Pace {
  double cfl;  // of the first step; doubled and more after each whole step
  // Newton steps without halving the residual after which the search is stalled.
  int patience = SearchPolicy::usual_patience;
  // Switched evolution relaxation (W. A. Mulder and B. van Leer, J. Comput. Phys. 59 (1985)): the CFL number
  // is at most this times what the residual has fallen by since the start, so that time steps become short
  // again where it rises. A shock cannot be thrown to and fro for ever.
  double most = std::numeric_limits<double>::infinity();
  // Number of initial steps at constant `cfl`, however the residual grows.
  int constant_cfl_steps = 0;
  // The search ends at this residual where it is more than the tolerance that was asked for, which is the one
  // that messages name.
  double rough = 0.0;
};
inline constexpr double no_pseudo_time = std::numeric_limits<double>::infinity();  // as a CFL number

// Of the Euler equations.
class Measure final : public BlockMeasure<unknown_count> {
 public:
  explicit Measure(const FlowSystem& system) : BlockMeasure(system), system_(system) {}
  const FlowSystem& system() const { return system_; }

 private:
  const FlowSystem& system_;
};

// Searches on one mesh, with factors that are kept from one to the next.
class NewtonSearch : public BlockSearch<unknown_count> {
 public:
  using BlockSearch::BlockSearch;

  // Goes on from `state` to the flow, or to where it ends; the record's status and reason say which.
  void run(const Measure& measure, const Pace& pace, State& state);
  // Goes on by short time steps where the last search has stalled with little residual left; otherwise does
  // nothing. All but a stagnation point may be steady by then, and long steps lose what it has gained.
  void beside(const Measure& measure, State& state);
  // Starts from a flow that is near: without pseudo-time where it is very near and that does not stall.
  void near(const Measure& measure, State& state);
  // Starts from potential flow; false where that leads to no flow and something else is to be tried.
  bool from_potential_flow(const Measure& measure, State& state);
  // From potential flow or else from undisturbed flow.
  void cold(const Measure& measure, State& state) {
    if (!from_potential_flow(measure, state)) from_undisturbed_flow(measure, state);
  }
  // Starts from undisturbed flow, with all fallbacks. It looks for a given lift from the flow at a guess of
  // the angle, and by shorter steps where that stalls.
  void from_undisturbed_flow(const Measure& measure, State& state);

 private:
  struct Progress;
  // False where the search has to end, or has ended.
  bool may_go_on(const Progress& at);
  bool step(Progress& at, State& state);
  bool take(Progress& at, State& state, const Increment& step, bool solved);
  bool shorten(Progress& at, double left);
  void in_stages(const Measure& measure, double rough, State& state);
  void at_given_angle(const Measure& measure, double rough, State& state);
};

}  // namespace remodel::flow
