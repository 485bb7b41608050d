#pragma once

// Flows as figures.

#include "mesh_input.h"
#include "remodel/flow.h"
#include "remodel/flow_error.h"
#include "report.h"

namespace remodel::app {

// Lift and moment are null where they are not determined; so is the angle where lift was given.
Json to_json(const FlowResult& flow, const FlowConditions& conditions);
// The parts of each wall.
Json bodies_json(const std::vector<FlowBody>& bodies, bool lift_determined, bool has_friction);
inline constexpr const char* not_determined = "not determined";
// Not a number where it is not determined.
double determined_lift(const FlowResult& flow);
// In text a flow that was not found says so first, and its coefficients say it again.
void add_flow_figures(Report& report, const FlowResult& flow, const FlowConditions& conditions);
// Derivatives by coefficients_of() the mesh's domain, which `names` has the names of, the Mach number and
// what is given of angle and lift. Null where they were interrupted; those of lift, moment and, with a lift
// given, the angle are null where the flow's lift is not determined.
// The input is a native mesh or one of a shape. Its interior moves along with all closed loops but those of the
// far field alone. With friction CD of pressure and the Reynolds number are there too.
Json gradients_json(LivingFlow& living, const MeshInput& input, const FlowResult& flow,
                    const FlowConditions& conditions, const std::vector<std::string>& farfield);
void add_gradients(Report& report, const Json& gradients);
// In text as bars around the coefficients; null where the finer mesh has no flow.
void add_error(Report& report, const FlowError& error);

}  // namespace remodel::app
