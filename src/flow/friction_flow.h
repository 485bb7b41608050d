#pragma once

// Flows with friction behind the door of flow.cpp.

#include <string>

#include "flow/search/friction_search.h"
#include "remodel/flow.h"

namespace remodel::flow {

// Of a model with friction. Throws Error (argument) as solve_flow() does.
FlowResult friction_flow(const FrozenMesh& mesh, const FlowConditions& conditions, const FlowOptions& options,
                         const std::string& source);

// As solve_flow_from() of a model with friction.
FlowResult friction_flow_from(const FrozenMesh& before, const FlowResult& known, const FrozenMesh& mesh,
                              const FlowConditions& conditions, const FlowOptions& options, const std::string& source);

Viscosity viscosity_of(const FlowConditions& conditions, const FlowOptions& options);

template <std::size_t N>
FlowResult result_of(const FrictionSystem<N>& system, const BlockState<N>& state, const SearchRecord& record,
                     FlowStart start);

}  // namespace remodel::flow
