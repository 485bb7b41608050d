#pragma once

// From the solver's terms to the public ones, and back.

#include <cmath>

#include "flow/search/newton_search.h"
#include "remodel/flow.h"

namespace remodel::flow {

// Throws Error (argument) for what is out of range.
void require_possible(const FlowConditions& conditions, const FlowOptions& options);
// Throws Error (argument) where that is no flow through this mesh, or has no state that the model can begin
// with.
void require_known(const FlowResult& known, const FlowMesh& mesh, FlowModel model, const std::string& source);
// The mesh as the solver sees it, with far field, inlets and outlets as the options name them. Throws Error
// (argument), naming `source`, where it has no wall, or nothing that gas enters or leaves by.
FlowMesh dual_of(const FrozenMesh& mesh, const FlowConditions& conditions, const FlowOptions& options,
                 const std::string& source);
// Without a far field there have to be an inlet and an outlet, and no lift can be asked for.
void require_ways(const FlowMesh& dual, const FlowConditions& conditions, const FlowOptions& options,
                  const std::string& source);
Stream stream_of(const FlowConditions& conditions, const FlowOptions& options, const FlowMesh& dual);
// What a search has done, as its result tells it.
void note_search(const SearchRecord& record, FlowResult& result);
// The opening of a patch, with means of the result's states.
FlowOpening opening_of(const FlowMesh& dual, std::uint32_t patch, double mass_flow, const FlowResult& result);
double largest_mach(const FlowResult& flow);
// Where the stream goes, of length 1.
Point stream_direction(double alpha_deg);
FlowResult result_of(const FlowSystem& system, const State& state, const SearchRecord& record,
                     FlowStart start);

// The state of another mesh at these points, interpolated linearly; beyond it that of its nearest triangle.
// Transfer (remodel/transfer.h) does not serve here: it goes by keys of vertices, and the meshes of
// search_by_meshes() and solve_flow_from() have no history in common.
template <std::size_t N>
BlockVector<N> interpolated(const FlowMesh& mesh, const BlockVector<N>& state, std::span<const Point> at);

}  // namespace remodel::flow
