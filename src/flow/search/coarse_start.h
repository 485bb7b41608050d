#pragma once

// Cold flows on fine meshes begin with the flow through a coarser mesh of the same domain, that one likewise:
// undisturbed flow is many Newton steps away, and on a fine mesh each is dear. Source: nested iteration, A.
// Brandt, "Multi-level adaptive solutions to boundary-value problems", Math. Comp. 31 (1977), section 1.3.

#include "flow/search/newton_search.h"
#include "remodel/mesh.h"

namespace remodel::flow {

// NewtonSearch::cold(), but from the flow through a coarser mesh where the mesh is fine, its
// domain has one and that leads on. `spent` gets what coarser meshes took.
void search_by_meshes(const Domain& domain, const QualityOptions& quality, const Measure& measure,
                      const FlowConditions& conditions, NewtonSearch& search, State& state,
                      SearchRecord& spent);

// Counts what coarser meshes took in the result.
void add_coarse(const SearchRecord& spent, FlowResult& result);

}  // namespace remodel::flow
