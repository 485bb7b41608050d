#pragma once

// Newton's method for flows with friction, globalised by pseudo-transient continuation from a stream that
// slows down towards walls.
//
// One step solves (V / dt dU/dq + J) dq = -R. The merit of its line search is the residual of the *unsteady*
// equations of that time step, R + V / dt (U - U_n), which falls along the step even where R has to rise (M.
// Ceze and K. J. Fidkowski, AIAA paper 2013-2686); it may rise somewhat itself. The CFL number grows with the
// part of the step that was taken.
//
// Linear systems: GMRES with the exact Jacobian, preconditioned by factors of the first-order scheme of one
// ring, friction and turbulence exact. Incomplete factors of the exact Jacobian are useless beside walls.

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "flow/linear/factors.h"
#include "flow/scheme/friction_system.h"
#include "flow/search/search.h"

namespace remodel::flow {

// Numbers of the search, with where they come from: docs/viscous.md. Steps in comments were counted with
// linear systems solved to a hundredth, and with ft2 in the model of turbulence.
struct FrictionPolicy {
  static constexpr double first_cfl = 5.0, most_cfl = 1e13, least_cfl = 1e-2;
  static constexpr double full_growth = 2.0, part_growth = 0.5, shortest_part = 0.3, retried_part = 0.05;
  // The part of a density or pressure that a step changes, and what the merit may rise to, as it must while a
  // shock is on its way. RAE 2822 at Mach 0.734 (7,412 vertices) takes 26 steps; with 0.2 and 1, 48; with 0.2
  // and 4, 30.
  static constexpr double largest_part = 0.4, merit_rise = 2.0;
  static constexpr int halvings = 8;
  // From a flow that is near: two degrees more take 10, 8, 14 and 32 steps from 5, 50, 1e3 and 1e5, and from
  // 1e3 on there may be another flow at the end (docs/viscous.md).
  static constexpr double carried_cfl = 50.0;
  // Such a search ends after so many steps without a smaller residual than there was: there is a nearer flow
  // to begin with, or a cold start.
  static constexpr int carried_patience = 60;
  // Cold flows at larger angles are led there by steps of the angle no larger than this, from rough flows of
  // this residual, each from this CFL number. NACA 0012 at 10, 15 and -15 degrees (17,687 vertices) and 4412
  // at 13.87 take 36, 45, 52 and 35 steps; from a CFL number of 50, 46, 54, 65 and 32; at once, 46, 142,
  // 115 and 49.
  static constexpr double angle_step = 5.0 * one_degree, angle_tolerance = 0.3, angle_cfl = 10.0;
  // Cold turbulent flows begin with the working variable upwinded to first order, to this residual, and go on
  // from there at this CFL number. NACA 0012 at 0, 4 and 10 degrees and RAE 2822 at Mach 0.734 take 23, 27,
  // 35 and 41 steps, NACA 0012 with transition at 0.6 41; from 1e3 on the last takes 88; with second order
  // from the start the first takes 38.
  static constexpr double first_order_tolerance = 5e-2, second_order_cfl = 1e2;
  // The part of a linear residual that GMRES may leave, by rows that count by their size (RowWeights): the
  // flow's own residual, within these.
  static constexpr double least_forcing = 1e-3, most_forcing = 0.1;
  static constexpr int rounds = 3;
  // Level of fill of the incomplete factors. Five hard flows of 16,000 to 18,000 vertices take 234, 218, 198
  // and 190 s with 1, 3, 4 and 5, easy ones the same; with 1 NACA 0012 with 97,371 vertices needs LU.
  static constexpr int fill_level = 4;
  // Newton's method may cycle far from the flow: after so many steps of full CFL in which the residual has
  // not fallen by that part, the search goes on in time, at this CFL number or less for so many steps: where
  // it grew at once, the cycle was there again (docs/viscous.md). A search from a flow that is near returns
  // once or twice within its patience.
  static constexpr double fall = 0.9, return_cfl = 100.0;
  static constexpr int patience = 8, most_returns = 4, steps_of_return = 20;
  // A flow is found, too, where so small a residual falls no more and Newton's step changes no density or
  // pressure by more than that part: what is left is rounding, as on NASA's grid of 14,576 points around NACA
  // 0012, whose largest cells are 100 chords long (2e-10).
  static constexpr double most_rounding = 1e-8, still = 1e-10;
};

template <std::size_t N>
class FrictionSearch {
 public:
  // measure: of the system.
  FrictionSearch(const FrictionSystem<N>& system, const BlockMeasure<N>& measure, const FlowOptions& options,
                 SearchRecord& record)
      : system_(system), measure_(measure), options_(options), record_(record) {}

  // From a stream that slows down towards walls.
  void cold(BlockState<N>& state);
  // From a flow that is near.
  void near(BlockState<N>& state) {
    run(state, FrictionPolicy::carried_cfl, FrictionPolicy::carried_patience);
  }
  // Goes on from `state` to the flow, or to where the search ends: at the latest after `patience` steps
  // without a smaller residual than there was.
  void run(BlockState<N>& state, double cfl, int patience = std::numeric_limits<int>::max());

 private:
  using Residuals = BlockResiduals<N>;
  std::optional<double> rough_at_angle(BlockState<N>& state);
  // Goes to a rough flow of another stream, or with other transition; false: none was found.
  bool found_rough(const FrictionMesh& mesh, const Stream& stream, double tolerance, double cfl,
                   BlockState<N>& state);
  double unsteady_size(const BlockState<N>& before, const BlockState<N>& state,
                       const std::vector<double>& by_time, const Residuals& now) const;
  // waves: by vertices, wave speeds times faces; by_time: those over the CFL number.
  bool solve(const BlockState<N>& state, const std::vector<double>& waves, const std::vector<double>& by_time,
             const Residuals& now, BlockIncrement<N>& step);
  Factored factor(std::array<BlockVector<N>, augmented_count> columns);
  void note_failure(bool failed);
  double line_search(const BlockIncrement<N>& step, const std::vector<double>& by_time, BlockState<N>& state,
                     Residuals& now) const;

  const FrictionSystem<N>& system_;
  const BlockMeasure<N>& measure_;
  const FlowOptions& options_;
  SearchRecord& record_;
  typename FrictionSystem<N>::Jacobian jacobian_;
  BlockFactors<N> factors_{FrictionPolicy::fill_level};
  Factored factored_ = Factored::done;
  bool by_lu_ = false, failed_before_ = false;
};

}  // namespace remodel::flow
