#pragma once

// Every number that searches for a flow are tuned by, with what it is for and where it comes from. "Notebook"
// is docs/notebook/flow_starts.md, "memory" the section of docs/flow.md. Numbers of which no measurement is
// kept say so.

#include <cstddef>

namespace remodel::flow {

struct SearchPolicy {
  // ---- steps (search/measure.h)

  // What a step leaves of a density or pressure, at least. No measurement is kept; it has to be above 0.
  static constexpr double least_left = 0.2;
  // A step may change a density or pressure by this part. A change of what is smaller than nearly_vacuum
  // counts as a part of that: one vertex that runs empty holds back all others (notebook, flow 302).
  static constexpr double largest_part = 0.4;
  static constexpr double nearly_vacuum = 0.05;
  // The residual may rise by step_rise in a step and to whole_rise times the least there was, as it must
  // while a shock moves; otherwise the step is halved, this often at most.
  static constexpr double step_rise = 2.5, whole_rise = 6.0;
  static constexpr int halvings = 4;

  // ---- pseudo-time (search/newton_search.h)

  static constexpr double cold_cfl = 5.0;   // of the first step from undisturbed flow
  static constexpr double full_cfl = 1e12;  // more is no pseudo-time at all
  // A whole step doubles the CFL number and more, one below short_step halves it; where no step leads on, a
  // tenth of it, of retried_cfl at most, is tried again, until it is below smallest_cfl.
  static constexpr double short_step = 0.25, retried_cfl = 1e4, smallest_cfl = 1e-2;
  // Newton steps without halving the residual after which a search has stalled. Flows that are found do so
  // within 30; what is tried last may take twice as long.
  static constexpr int usual_patience = 30, last_patience = 60;

  // A search that has stalled below this residual goes on by short time steps: all but a stagnation point is
  // steady there. Notebook: CFL 20 takes 17 steps, 1 takes 20, 5 and 100 do not find the flow in 30.
  static constexpr double nearly_found = 1e-3, short_cfl = 20.0;

  // From potential flow. CFL 5, 20, 100 and 1000 take 7, 6, 5 and 5 steps around NACA 0012 at Mach .5, where
  // undisturbed flow takes 10; at 20 three elements have another flow, of more drag
  // (docs/notebook/flow_walls.md).
  static constexpr double potential_cfl = 100.0;
  // Up to this Mach number: beyond it the shocks are too strong. 28 flows at Mach .78 and .83 (I = 200) take
  // a quarter less time from undisturbed flow, and 28 at .65 and .72 a sixth less from potential flow.
  static constexpr double most_mach_of_potential = 0.75;
  static constexpr int potential_patience = 15;

  // From a flow that is near, below this residual, Newton's method needs no pseudo-time; what is near enough
  // is found at once. Otherwise from CFL 50: 200 takes a third less time at Mach 0.8 and leads to another
  // flow around three elements (notebook).
  static constexpr double near = 0.02, carried_cfl = 50.0;
  static constexpr int near_patience = 5;

  // Stages from the scheme of first order: the part of each step of the reconstruction. The last three find
  // flows 1105 and 1119. Each is followed to stage_tolerance, within CFL 20 times what the residual has
  // fallen by: seven of seven are found so, three of four without that bound (notebook).
  static constexpr double stages[] = {0.0, 0.5, 0.75, 0.9, 0.95, 0.975, 0.99};
  static constexpr double stage_cfl = 20.0, stage_tolerance = 1e-2;

  // Steps at constant CFL that lead away from a fold: 15 at 20 do, at 4 they do not (notebook, flow 211).
  static constexpr int escapes = 3, steps_of_escape = 15;
  static constexpr double escape_cfl = 20.0;

  // A given lift is looked for from the flow at the first guess of the angle, which is followed to
  // first_angle_tolerance; from there nearly without pseudo-time, and where that stalls by shorter steps. No
  // measurement is kept.
  static constexpr double first_angle_tolerance = 1e-4, with_angle_cfl = 1e6, cautious_cfl = 20.0;

  // ---- linear systems (search/linear_step.h)

  // The part of the linear residual that GMRES may leave: what the flow's residual is of undisturbed flow's,
  // within these, but no less than forcing_needed of what the tolerance needs. From .001 to 10 % there is no
  // difference beyond the noise (memory).
  static constexpr double least_forcing = 1e-3, most_forcing = 1e-2, forcing_needed = 0.3;
  // Where GMRES leaves more than this, after that many beginnings, its step is not tried.
  static constexpr double most_left = 0.5;
  static constexpr int most_rounds = 4;
  // Incomplete factors serve the matrices of the next steps too, until GMRES takes this many steps more with
  // them than it took with the matrix of their own: new ones take about as long.
  static constexpr int steps_of_factors = 8;

  // ---- steps with older factors (search/chord.h)

  static constexpr std::size_t chord_steps = 60;
  // They end where the residual rises to this many times the first one, or the least one.
  static constexpr double chord_rise = 6.0, chord_rise_of_least = 100.0;
  // The contraction is looked at over so many steps; a rate above fruitless is none.
  static constexpr std::size_t watched = 4;
  static constexpr double fruitless = 0.9;
  // Differences that Anderson's method keeps. 24 gain nothing (notebook).
  static constexpr std::size_t anderson_depth = 12;
  // Above this residual Newton's method wants pseudo-time; where one set of factors leaves more than
  // least_gain of the residual, too; and after so many of them. No measurement is kept.
  static constexpr double reach = 0.3, least_gain = 0.3;
  static constexpr int own_attempts = 4;

  // ---- coarser meshes (search/coarse_start.h)

  // How far a coarse flow is followed: the fine mesh's is another one, off by more than this.
  static constexpr double coarse_tolerance = 1e-5;
  // An interpolated flow goes on from this CFL number, and at most by it times what the residual has fallen
  // by: from 50 naca:4412 took 109 steps. With a given lift the residual has to rise while the angle goes: no
  // bound then (notebook).
  static constexpr double interpolated_cfl = 20.0, interpolated_cfl_with_lift = 50.0;
  // From this Mach number on there may be shocks: meshes begin on coarser ones rather than with potential
  // flow. Below it coarser meshes gain little, and around several elements they may lead to another flow, of
  // less lift (notebook).
  static constexpr double mach_of_shocks = 0.6;
  // Meshes of at least this many vertices begin on a coarser one.
  static std::size_t least_vertices(double mach) {
    constexpr std::size_t with_shocks = 1500, without = 4000;
    return mach < mach_of_shocks ? without : with_shocks;
  }

  // ---- the solver that outlives its mesh (living_flow/)

  // Vertices that a step changed beyond this part of the mesh are not worth a correction.
  static constexpr double largest_zone = 0.2;
  // A flow or a function's gradient takes about this many solves with factors of its own.
  static constexpr int own_solves = 4;
  // Where factors have served no other flow than their own, the next 1, 3, 7, ... flows go by without, no
  // more than this.
  static constexpr int longest_pause = 31;

  // ---- gradients (living_flow/adjoint.h)

  // The part of the right-hand side that is left: the flow's tolerance, within these. Rounding allows no
  // less, nor residuals below rounding_slack times it.
  static constexpr double least_adjoint = 1e-12, most_adjoint = 1e-8, rounding_slack = 10.0;
  // GMRES with whole factors: steps, and beginnings, so that the residual is as small as rounding lets it;
  // with incomplete ones beginnings.
  static constexpr int adjoint_steps = 25, adjoint_rounds = 2, incomplete_adjoint_rounds = 10;
};

}  // namespace remodel::flow
