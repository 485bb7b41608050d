#pragma once

// Newton's method for the augmented flow equations, globalised by pseudo-transient continuation. Source: C.
// T. Kelley and D. E. Keyes, "Convergence analysis of pseudo-transient continuation", SIAM J. Numer. Anal. 35
// (1998); the line search lets the residual rise for a while, as it must while a shock moves (L. Grippo, F.
// Lampariello and S. Lucidi, SIAM J. Numer. Anal. 23 (1986)). Relaxed pace: W. A. Mulder and
// B. van Leer, "Experiments with implicit upwind methods for the FlowSystem equations", J. Comput. Phys. 59
// (1985). What stalls is found by homotopy in dissipation (D. A. Brown and D. W. Zingg, "Monolithic homotopy
// continuation with predictor based on higher derivatives", J. Comput. Appl. Math., 2018,
// doi 10.1016/j.cam.2018.06.036, and references there).

#include <limits>
#include <string>
#include <vector>

#include "flow/linear/factors.h"
#include "remodel/flow.h"

namespace remodel::flow {

// How pseudo-time goes on.
struct Pace {
  double cfl;  // of the first step; doubled and more after each whole step
  // Newton steps without halving the residual after which the search is stalled.
  int patience = std::numeric_limits<int>::max();
  // Switched evolution relaxation (W. A. Mulder and B. van Leer, J. Comput. Phys. 59 (1985)): the CFL number
  // is at most this times what the residual has fallen by since the start, so that time steps become short
  // again where it rises. A shock cannot be thrown to and fro for ever.
  double most = std::numeric_limits<double>::infinity();
  // So many steps first that all have `cfl`, while the residual rises as it will.
  int march = 0;
  // The search ends at this residual where it is more than the tolerance that was asked for, which is the one
  // that messages name.
  double rough = 0.0;
};
inline constexpr double cold_cfl = 5.0;                                            // from undisturbed flow
inline constexpr double no_pseudo_time = std::numeric_limits<double>::infinity();  // as a CFL number
inline constexpr int usual_patience = 30, last_patience = 60;

// What a search for a flow has done so far.
struct Search {
  FlowStatus status = FlowStatus::stalled;
  std::string reason;
  double residual = 0.0;
  std::vector<double> history;
  int newton_steps = 0, factorisations = 0, iterations = 0, gmres_iterations = 0;
  double memory_mb = 0.0;
  bool whole_factors = true;
};

// Jacobian and factors at a state; cfl: no_pseudo_time, or the diagonal has that step. Counts in
// `search`.
Factored factor_at(const FlowSystem& system, const State& state, double cfl, FactorKind kind,
                   const FlowOptions& options, BlockRows& matrix, Factors& factors, Search& search);
// Of factors that serve for several solves.
FactorKind lasting_kind(const FlowOptions& options);

// Goes on from `state` to the flow, or to where it ends; search.status and reason say which. Leaves the
// factors of its last step.
void find_flow(const FlowSystem& system, const Measure& measure, const Pace& pace, const FlowOptions& options,
               BlockRows& matrix, Factors& factors, State& state, Search& search);

// Where the last search has stalled with little residual left: goes on from there, by short time steps again.
// All but a stagnation point may be steady by then, and what is gained there is lost by the next long step.
void find_flow_beside(const FlowSystem& system, const Measure& measure, const FlowOptions& options,
                      BlockRows& matrix, Factors& factors, State& state, Search& search);

// The same from a flow that is near: without pseudo-time where it is very near and that does not stall.
void find_flow_near(const FlowSystem& system, const Measure& measure, const FlowOptions& options,
                    BlockRows& matrix, Factors& factors, State& state, Search& search);

// The same from undisturbed flow, and where that stalls, from it in stages from the scheme of first order. A
// given lift is looked for from the flow at a guess of the angle, and where that stalls by shorter steps.
void find_flow_cold(const FlowSystem& system, const Measure& measure, const FlowOptions& options,
                    BlockRows& matrix, Factors& factors, State& state, Search& search);

// Counts a factorisation that failed as the end of the search.
void end_without_factors(Factored outcome, const FlowOptions& options, Search& search);

}  // namespace remodel::flow
