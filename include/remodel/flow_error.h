#pragma once

// Error bars: how far a flow's coefficients are from those that an infinitely fine mesh would have.
//
// The estimate is Richardson's, from one mesh more of the same domain: a station in the middle between every
// two on the walls and twice the gradation's G, so that edges are half as long (on the coarsest meshes, which
// angles and not G make grow, less away from walls). Its flow is found from the given one. With errors of
// order p the finer mesh's coefficient is nearer by all but 2^-p of the error. The scheme's order is 2 where
// flows are smooth (docs/flow.md), and 1 is assumed where there is a supersonic region, which mostly ends in
// a shock. Source: P. J. Roache, "Perspective: a method for uniform reporting of grid refinement studies", J.
// Fluids Eng. 116 (1994).

#include <algorithm>

#include "remodel/flow.h"
#include "remodel/layers.h"

namespace remodel {

// p, as above, of errors of coefficients, by the largest local Mach number.
inline double order_of_errors(double mach_max) {
  return mach_max > 1.0 ? 1.0 : 2.0;
}

// The value is what a drag coefficient lacks by such an estimate. In a free stream, without inlets and
// outlets, no body has thrust: then the estimate takes away no more than there is.
inline double lacking_drag(double estimate, double cd, bool free_stream) {
  return free_stream && cd > 0.0 ? std::max(estimate, -cd) : estimate;
}

struct FlowError {
  // These estimate what the given flow's figures lack, and are to be added to them. Where lift is given, that
  // of cl is 0, and alpha_deg has what the angle lacks.
  double cl = 0.0, cd = 0.0, cm = 0.0, alpha_deg = 0.0;
  double order = 2.0;        // p, as above
  FlowResult finer;          // the flow through the finer mesh; where it was not found nothing else counts
  std::size_t vertices = 0;  // of the finer mesh
};

// `flow` is one through this mesh that was found under these conditions and options. Takes four to eight
// times the time of a cold flow and four times the memory at most. Throws Error (argument) where `flow` is
// none of this mesh, Error (geometry) where the finer mesh cannot be made, which the reference to `source`
// names.
FlowError estimate_error(const Mesh& mesh, const FlowResult& flow, const FlowConditions& conditions,
                         const FlowOptions& options = {}, const std::string& source = "mesh");
// This one is through layers: the finer mesh has also twice the columns and twice the cells across.
FlowError estimate_error(const LayeredMesh& mesh, const FlowResult& flow, const FlowConditions& conditions,
                         const FlowOptions& options = {}, const std::string& source = "mesh");

}  // namespace remodel
