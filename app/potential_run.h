#pragma once

// The potential flow of `remodel flow`.

#include <optional>
#include <string>

#include "mesh_input.h"
#include "outputs.h"
#include "remodel/potential_flow.h"

namespace remodel::app {

struct PotentialRun {
  double alpha_deg = 0.0;
  double mach = 0.0;           // for the pressures
  std::optional<double> lift;  // that the angle is found for
  PotentialOptions options;
  std::string cp_plot;  // a file; none if it is empty
  bool json = false;
};

// Solves, writes and reports.
void run_potential(const PotentialRun& run, const MeshInput& input, const std::string& source,
                   const MeshOutputs& outputs);

}  // namespace remodel::app
