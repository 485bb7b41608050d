#pragma once

// Rows of flows over angles of attack or lift coefficients, on a mesh or on the meshes of a chain of
// sections, by one living flow: each search begins where one that is near has ended.

#include <functional>
#include <map>
#include <tuple>
#include <vector>

#include "aero/flow_march.h"
#include "remodel/flow.h"
#include "remodel/polar.h"

namespace remodel::aero {

class FlowRows {
 public:
  using Solve = std::function<FlowResult(LivingFlow&, const FlowConditions&)>;
  // `remembers`: a search begins with the flow that was last found at the same conditions, which was around
  // the section before; where that does not lead to a flow, or otherwise, as march() says.
  FlowRows(const FlowOptions& flow, const MarchOptions& march, bool over_lift, bool remembers)
      : living_(flow), march_(march), over_lift_(over_lift), remembers_(remembers) {}

  struct See {
    std::function<void(double value)> before = {};                         // each search
    std::function<void(double value, const FlowResult& flow)> found = {};  // with all fields
  };
  // The row of these values: angles or lifts take the place of those of `conditions`. It begins at the value
  // nearest to 0, with the first flow of the row before. Flows of the result have no fields.
  March march(const FlowConditions& conditions, const std::vector<double>& values, const Solve& solve,
              const See& see);

 private:
  struct Known {
    KeptFlow flow;
    double alpha_deg = 0.0;
  };
  using Place = std::tuple<double, double, double>;  // Mach and Reynolds number, value

  FlowResult find(const FlowConditions& conditions, double value, const Solve& solve);
  FlowResult search(FlowConditions conditions, double value, const Solve& solve);

  LivingFlow living_;
  MarchOptions march_;
  bool over_lift_, remembers_;
  KeptFlow first_of_row_;
  double alpha_deg_ = 0.0;  // where the search for a lift begins
  std::map<Place, Known> known_;
};

// A flow of a row as results have it.
PolarPoint point_of(const MarchedFlow& marched, bool over_lift);

}  // namespace remodel::aero
