#pragma once

// Marches one parameter of a flow (angle of attack, lift, Mach number): each flow is looked for from the last
// one that was found.
//
// The values ascend. The march begins at one of them and goes up from there, then down from the first flow
// that it found. A flow that is not found may have been too far from the last one, or may not exist. So the
// step is halved, back towards the last flow that was found, and the march goes on with that step while it
// leads on:
//
//     found            found  found            not found
//   ----o----------------o------o------x--------x------>  value
//     last             step / 2   step / 4     asked for
//
// Flows in between are flows, and are kept: they show how far steady ones exist. A value that is not reached
// by steps of 2^-halvings of the first one is a miss. The next value is then tried once, straight from the
// last flow; if it is found, the march goes on. After so many misses in a row (MarchOptions::misses), the
// remaining values in that direction are not looked for.

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "remodel/flow.h"

namespace remodel::aero {

struct MarchOptions {
  int halvings = 3;  // of a step: 0 or more
  int misses = 2;    // in a row, that end the march in a direction: 1 or more
};

struct MarchedFlow {
  double value = 0.0;
  bool asked = true;   // false: between the values that were asked for
  bool tried = true;   // false: not looked for
  FlowResult flow;     // of the last search at this value
  std::string reason;  // why there is no flow; empty if there is one
};

struct MarchSearch {
  // The flow at a value, looked for from the last one that was found.
  std::function<FlowResult(double value)> find;
  // The next flow is looked for from this one as if it had been the last one: the first that was found.
  std::function<void()> return_to_first;
  // Called after each value that was looked for, with the flows as far as they came, by ascending value. May
  // be empty.
  std::function<void(std::span<const MarchedFlow> flows)> on_flow = {};
};

struct March {
  std::vector<MarchedFlow> flows;  // by ascending value
  bool interrupted = false;        // the flows are those that were found before
};

// `start`: the index of the value that is looked for first.
March march(std::span<const double> values, std::size_t start, const MarchSearch& search,
            const MarchOptions& options = {});

}  // namespace remodel::aero
