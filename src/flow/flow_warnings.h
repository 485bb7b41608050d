#pragma once

// What a person has to know of a flow before using its coefficients: sentences.

#include <string>
#include <vector>

#include "flow/scheme/flow_mesh.h"
#include "flow/scheme/flow_system.h"
#include "remodel/flow.h"
#include "remodel/potential_flow.h"

namespace remodel::flow {

struct Warnings {
  std::vector<std::string> sentences;
  bool lift_determined = true;  // of all bodies
};

// Of a compressible flow: the lift of bodies without an edge below Mach 1 (closed walls inside the domain,
// see edge_faces_downstream()).
Warnings warnings_of(const FlowMesh& mesh, double mach, double alpha_deg);
// Drag where there is none: a sentence where it is more than ten counts (by the walls' extent, which is
// `scale` of the reference length) in an unbounded stream in which nothing is faster than sound; otherwise
// empty.
std::string spurious_drag_warning(double drag, double scale, double largest_mach);

// What the stream that coefficients are of has to do with walls and openings: a reference length far from the
// walls' extent, turbulence where the Reynolds number has none, a row of blades whose gas enters otherwise
// than the stream, total pressure that is lost without friction and shocks. Adds to the result's warnings.
void add_stream_warnings(const FlowMesh& mesh, const Stream& stream, FlowResult& result);

// A body of a potential flow: its outline, clockwise, that begins with the `base` vertices of its trailing
// edge (0: there is none).
struct PotentialOutline {
  std::string name;
  std::vector<Point> points;
  std::size_t base = 0;
};
// Sums over all bodies, of the incompressible flow, as coefficients with that length: by pressure; and by the
// circulation that Kutta's condition gives a little beside the edges.
struct LiftAgain {
  double reference_length = 1.0;
  double lift = 0.0, drag = 0.0;
  double lift_beside = 0.0;
};
// Of a potential flow: bodies without an edge, or with one that faces the stream; meshes on which lift by
// circulation is not that by pressure or by the condition beside the edges, or there is drag; pressures that
// the rule for compressible flow does not hold for.
Warnings warnings_of(const std::vector<PotentialOutline>& bodies, const PotentialFlow& flow,
                     const LiftAgain& again);

}  // namespace remodel::flow
