#pragma once

// Sines and cosines of fractions of a turn, made of additions and multiplications alone: the same bits on
// every machine and with every C library, exact at the quarters of a turn, and mirrored where the fractions
// are.

#include "remodel/point.h"

namespace remodel {

// The distance of t in [0,1] from the nearer end, in [0, 1/2], with fold(t) == fold(1 - t) to the last bit:
// both are rounded to what 1 - t can represent, multiples of 2^-53.
double fold(double t);

// sin(pi u) for u in [0, 1/4].
double sin_half_turns(double u);

// (cos, sin) of the given number of turns, finite: direction(1 - f) is direction(f) mirrored in the x axis.
Point direction(double turns);

}  // namespace remodel
