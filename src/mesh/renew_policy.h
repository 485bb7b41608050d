#pragma once

// Every number that Strategy::renew is tuned by, with where it comes from. "Measured" refers to searches with
// CMA-ES from NACA 0012 to RAE 2822 at sigma = 0.01, 0.05 and 0.25; docs/strategies.md has them all.
//
// Words: K is the number of triangles of a fresh mesh per size S (step/count_control.h); a *sampling* of K
// generates one or two fresh meshes.

#include <algorithm>
#include <cstdint>
#include <numbers>

#include "remodel/mesh.h"

namespace remodel {

struct RenewPolicy {
  // ---- renewal of length scales (step/renew.h)

  // Length scales are renewed at every fifteenth replacement: much of what one design changes the next one
  // changes back. Measured: at every sixth a step of I = 700 at sigma = 0.25 takes 6 % longer; at every
  // twentieth the gain is within the noise.
  static constexpr std::uint32_t replacements_between_renewals = 14;
  // The relative error that renewal leaves alone. Measured at I = 100 to 400: from 1 to 4 % surplus and
  // gradation error stay the same and the cost falls by a third; at 6 % the surplus grows.
  static constexpr double length_scale_tolerance = 0.04;
  // The factor on H of kept triangles. Propagated length scales scatter by 3 to 4 % about those of a fresh
  // mesh: at a factor of 1 refinement would follow the scatter. Measured: 1.25 loses the fewest triangles at
  // G = 4 and above; at G = 2 (I = 100) 1.2 makes a tenth to a sixth fewer replacements than 1.1, at G = 1
  // (I = 50) nothing clear.
  static double keep(double gradation) { return gradation <= 1.0 ? 1.1 : gradation <= 2.0 ? 1.2 : 1.25; }

  // ---- coarsening (step/coarsen.h)

  // A vertex may go if a triangle of its star has (r / (H LS))^2 below this. Its star of about six triangles
  // loses two, and those that are left are larger by half: where none is that small, some would exceed H.
  static constexpr double coarsened_below = 0.4;

  // Coarsening takes single vertices, where what is left is good. After the discretisation has changed, in that
  // replacement and the next two, a surplus beyond large_surplus goes at once: Steiner vertices of boundaries
  // and all other vertices that have a triangle with (r / (H LS))^2 below dense_below, and refinement fills in.
  // Of a fresh mesh's triangles one in ten is below 0.4. Measured: a mesh of 2,000 points that is updated to 100
  // has 3 % fewer triangles than a fresh one after that step, 11 % more where Steiner vertices stay. Counts of
  // fresh meshes scatter by less than large_surplus.
  static constexpr std::uint32_t replacements_that_shed = 3;
  static constexpr double large_surplus = 0.08;
  static constexpr double dense_below = 0.4;
  static constexpr int shedding_passes = 4;  // at most
  // A morph of a mesh whose surplus is larger sheds it: what a large change stretches and the next one squeezes
  // is refined but not coarsened between renewals, so that walks of large steps may run away.
  // Steiner vertices of boundaries that have a triangle below dense_below are dissolved then, and at each
  // renewal of a morph. Without it they heap up, 491 beside 200 stations, and cannot be shed: two of nine
  // searches at I = 200 lost half of their triangles in every step. Measured there: dissolved at renewals too,
  // the surplus is 2.7 instead of 8.1 % where it is largest, and a step 15 % cheaper; only those below 0.2
  // leave 4.6 %, all of them 16 %.
  static constexpr double morph_surplus = 0.2;
  // Samples of K where the discretisation has changed: it depends on that.
  static constexpr int samples_of_another_discretisation = 2;

  // ---- removal around vertices that cannot be moved in place (step/replace.h)

  // A vertex that fails although it moves by less than 0.3 of the distance to its nearer neighbour has a
  // triangle that is at a bound already and would fail again: everything within sqrt(2) of that distance,
  // twice the area, is made anew. Measured (I = 50, means of eight seeds): 142 replacements instead of 244,
  // 295 of 343, 562 of 733. A limit of 0.03 or 0.1, or a factor of 1.2, saves fewer; a factor of 1.7 or more
  // loses more triangles.
  static constexpr double tight_motion = 0.3;
  static constexpr double tight_removal = std::numbers::sqrt2;

  // ---- the triangle count

  // Counts of fresh meshes scatter by some 4 % from sample to sample: five samples know K within 2 %, twenty
  // within 1 %. A run can afford twenty before its first step, a mesh of unknown history five at its first
  // renewal.
  static constexpr int samples_before_a_run = 20, samples_on_the_way = 5;
  // Samples differ in H by at most 0.5 %, so that their counts differ by less than they scatter anyway.
  static constexpr double sample_spread = 0.005;
  // The count is looked at after 25 full adjustments in a row: then replacements, which would mend it, have
  // become rare, and the samples cost as much as so many steps.
  static constexpr std::uint32_t full_adjustments_before_sampling = 25;
  // Most samplings say that the mesh is as it should be: the first comes after 1,000 designs, each next one
  // after four times as many, so that a run of 9,000 designs has two.
  static constexpr std::uint64_t designs_before_sampling = 1000;
  static constexpr std::uint32_t sampling_growth_bits = 2;
  static constexpr std::uint32_t samples_per_sampling =
      2;  // at most: the second if the first finds an excess
  // An excess of 2 % is what the tolerance of renewal alone may cause: it is left alone.
  static constexpr double tolerated_excess = 0.02;
  // The weight of a sampling in K. It is more than two samples have against the twenty of the start, because
  // K differs a little from design to design.
  static constexpr double sampling_weight = 1.0 / 3.0;

  // How many designs a mesh waits from one sampling to the next.
  static std::uint64_t designs_between_samplings(std::uint32_t samplings) {
    return designs_before_sampling << std::min(sampling_growth_bits * samplings, 40U);
  }
  // The factor on H of sample n of a sampling at this step: another one each time, of 51 within the spread.
  // 17 is prime to 51's other factor, so that samples of one step lie apart.
  static double sample_factor(std::uint32_t step, std::uint32_t n) {
    constexpr std::uint32_t factors = 51;
    return 1.0 - 0.02 * sample_spread * static_cast<double>((step + 17 * n) % factors);
  }
};

}  // namespace remodel
