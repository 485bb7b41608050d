#pragma once

// From the solver's terms to the public ones, and back.

#include "flow/newton.h"
#include "remodel/flow.h"

namespace remodel::flow {

// Throws Error (argument) for what is out of range.
void require_possible(const FlowConditions& conditions, const FlowOptions& options);
Stream stream_of(const FlowConditions& conditions, const FlowOptions& options);
FlowResult result_of(const Euler& euler, const State& state, const Search& search, FlowStart start);

// The state of another mesh at these points, interpolated linearly; beyond it that of its nearest triangle.
std::vector<Primitive<double>> interpolated(const FlowMesh& mesh, const std::vector<Primitive<double>>& state,
                                            std::span<const Point> at);

}  // namespace remodel::flow
