#pragma once

// What leaves a duct, for history and fresh meshes, and what histories call a point's numbers.

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "remodel/design_problem.h"
#include "remodel/flow_function.h"

namespace remodel {

// As outputs of a design have them: "cl", and of the second point "cl_2".
inline std::string output_name(const std::string& name, std::size_t point) {
  return point == 0 ? name : name + "_" + std::to_string(point + 1);
}

// Of all outlets of a point together: "mass_flow", and where gas leaves by them "total_pressure", the mean by
// mass flow as a part of the stream's, and "flow_angle", that of the momentum to the x axis in degrees.
// Nothing without outlets.
std::vector<std::pair<std::string, double>> outlet_numbers(const DesignPoint& point, const FlowView& of);

// The largest total pressure that gas enters with, a part of the stream's.
double entering_total_pressure(const DesignPoint& point, const Domain& walls);
// A sentence where a flow's total pressure at outlets is more than gas has that enters, which the mesh has
// made; otherwise empty.
std::string total_pressure_warning(double found, double entering);

}  // namespace remodel
