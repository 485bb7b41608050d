#pragma once

// The compressible flow of `remodel flow`, and rows of designs on one living mesh.

#include <string>

#include "command.h"
#include "mesh_input.h"
#include "outputs.h"
#include "remodel/flow.h"
#include "start_mesh.h"

namespace remodel::app {

enum class Compare { none, cold, rival };

struct EulerRun {
  FlowConditions conditions;
  bool mach_given = false;
  FlowOptions options;
  std::string series;      // a file; none if it is empty
  std::string cp_plot;     // likewise
  std::string cf_plot;     // likewise
  std::string wall_table;  // likewise
  std::string profiles;    // likewise
  std::vector<double> profiles_at = {0.25, 0.5, 0.75, 0.95};
  std::string history;  // likewise
  std::vector<std::string> inlets, outlets;
  std::vector<std::string> periodic;  // pairs of names
  FlowInlet inlet;    // what is given at all inlets
  FlowOutlet outlet;  // likewise
  Compare compare = Compare::none;
  bool gradient = false;  // of the coefficients, by the numbers of the mesh's domain
  bool error = false;     // estimates of what the coefficients are off by
  bool json = false;
};

// --farfield, which may be given several times.
void add_farfield(CLI::App& app, std::vector<std::string>& names);
// --tolerance, --max-steps, --memory, --solver, --limiter, --reference, --reference-length.
void add_solver_options(CLI::App& app, FlowConditions& conditions, FlowOptions& options);
// --transition, of turbulent flow, and --wall-temperature, of flows with friction.
void add_friction_options(CLI::App& app, FlowConditions& conditions);
// --mach, those of add_solver_options(), --series, --compare, --gradient, --error.
void add_euler_options(CLI::App& app, EulerRun& run);

// --inlet, --total-pressure, --total-temperature, --inlet-angle, --outlet, --pressure, --symmetry,
// --periodic, --history.
void add_duct_options(CLI::App& app, EulerRun& run);
// The solver's options with the inlets and outlets of the command line. Throws Error (argument) for pressures
// that no inlet or outlet has.
FlowOptions options_of(const EulerRun& run);

// Throws Error (argument) where no Mach number is given.
void require_mach(const EulerRun& run);
Status status_of(const FlowResult& flow);

// Solves, writes and reports; where no flow is found residuals alone are written, if they are asked for.
Status run_euler(const EulerRun& run, const MeshInput& input, const std::string& source,
                 const MeshOutputs& outputs);
// Remodels the mesh to each airfoil of the series and reports the flow around each. One that no mesh can have
// is reported as not converged, with the reason. It is in flow_series.cpp.
Status run_series(const EulerRun& run, StartMesh start);
// The same on a mesh with layers; `source` names it.
Status run_layered_series(const EulerRun& run, LayeredMesh start, const std::string& source);

}  // namespace remodel::app
