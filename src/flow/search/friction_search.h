#pragma once

// Newton's method for flows with friction, globalised by pseudo-transient continuation from a stream that
// slows down towards walls.
//
// One step solves (V / dt dU/dq + J) dq = -R. The merit of its line search is the residual of the *unsteady*
// equations of that time step, R + V / dt (U - U_n), which falls along the step even where R has to rise (M.
// Ceze and K. J. Fidkowski, AIAA paper 2013-2686). The CFL number grows with the part of the step that was
// taken.
//
// Linear systems: GMRES with the exact Jacobian, preconditioned by the first-order scheme of one ring,
// friction and turbulence exact. Incomplete factors of the exact Jacobian are useless beside walls.

#include <vector>

#include "flow/linear/direct_solver.h"
#include "flow/linear/incomplete_lu.h"
#include "flow/scheme/friction_system.h"
#include "flow/search/newton_search.h"
#include "remodel/flow.h"

namespace remodel::flow {

// Numbers of the search, with where they come from: docs/viscous.md.
struct FrictionPolicy {
  static constexpr double first_cfl = 5.0, most_cfl = 1e13, least_cfl = 1e-2;
  static constexpr double full_growth = 2.0, part_growth = 0.5, shortest_part = 0.3, retried_part = 0.05;
  static constexpr double largest_part = 0.2;  // of a density or pressure that a step changes
  static constexpr int halvings = 8;
  static constexpr double start_thickness = 0.01;  // lengths
  static constexpr double least_forcing = 1e-3, most_forcing = 1e-2;
  static constexpr int restart = 60, rounds = 3;
  static constexpr int patience = 40;  // steps without a new least residual at full CFL
};

template <std::size_t N>
class FrictionSearch {
 public:
  FrictionSearch(const FrictionSystem<N>& system, const FlowOptions& options, SearchRecord& record)
      : system_(system), options_(options), record_(record) {}

  // Goes on from `state` to the flow, or to where the search ends.
  void run(FrictionState<N>& state, double cfl = FrictionPolicy::first_cfl);

 private:
  struct At {
    BlockVector<N> residual;
    Augmented augmented = {};
    double size = 0.0;
    double lift = 0.0;
  };
  At at(const FrictionState<N>& state) const;
  double size_of(const BlockVector<N>& residual, const Augmented& augmented) const;
  double unsteady_size(const FrictionState<N>& before, const FrictionState<N>& state,
                       const std::vector<double>& by_time, const At& now) const;
  bool solve(const FrictionState<N>& state, const std::vector<double>& by_time, const At& now,
             BlockIncrement<N>& step);
  void note_failure(bool failed);
  bool factor();
  void precondition(BlockVector<N>& x);
  double line_search(const BlockIncrement<N>& step, const std::vector<double>& by_time,
                     FrictionState<N>& state, At& now) const;

  const FrictionSystem<N>& system_;
  const FlowOptions& options_;
  SearchRecord& record_;
  double scale_ = 1.0;  // of residuals: those of the state that the search began with
  typename FrictionSystem<N>::Jacobian jacobian_;
  IncompleteLu<N> incomplete_;
  DirectSolver<N> lu_;
  bool by_lu_ = false, failed_before_ = false;
};

}  // namespace remodel::flow
