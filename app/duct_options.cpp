// Inlets, outlets, symmetry planes, periodic boundaries and the residual's history: options of `remodel
// flow`.

#include "arguments.h"
#include "euler_run.h"
#include "remodel/error.h"

namespace remodel::app {

void add_duct_options(CLI::App& app, EulerRun& run) {
  add_texts(app, {"--inlet", "NAME", "", "Boundary that gas enters by; may be given several times"},
            Presence::optional, run.inlets);
  add_real(app,
           {"--total-pressure", "PART", "1",
            "Total pressure at inlets, as a part of the stream's of that Mach number: above 0"},
           {.low = 0.0, .above_low = true}, run.inlet.total_pressure);
  add_real(
      app,
      {"--total-temperature", "PART", "1", "Total temperature at inlets, as a part of the stream's: above 0"},
      {.low = 0.0, .above_low = true}, run.inlet.total_temperature);
  add_real(app,
           {"--inlet-angle", "DEG", "at a right angle",
            "Direction that gas enters in at inlets, to the x axis: -180 to 180"},
           {.low = -180.0, .high = 180.0}, run.inlet.angle_deg);
  add_texts(app, {"--outlet", "NAME", "", "Boundary that gas leaves by; may be given several times"},
            Presence::optional, run.outlets);
  add_real(app, {"--pressure", "PART", "1", "Pressure at outlets, as a part of the stream's: above 0"},
           {.low = 0.0, .above_low = true}, run.outlet.pressure);
  add_texts(
      app,
      {"--symmetry", "NAME", "",
       "Straight boundary along the stream with the flow's mirror image beyond it; may be given several "
       "times"},
      Presence::optional, run.options.symmetry);
  add_texts(
      app,
      {"--periodic", "NAME,NAME", "those of the domain file",
       "Two boundaries of which one is the other moved, as below and above the passage between two blades; "
       "may be given several times"},
      Presence::optional, run.periodic);
  add_text(app,
           {"--history", "FILE", "",
            "Residual at each step, also of a flow that is not found: .csv, .svg or .png"},
           Presence::optional, run.history);
}

FlowOptions options_of(const EulerRun& run) {
  const char* of_inlets = run.inlet.total_pressure != 1.0      ? "--total-pressure"
                          : run.inlet.total_temperature != 1.0 ? "--total-temperature"
                          : run.inlet.angle_deg                ? "--inlet-angle"
                                                               : nullptr;
  if (run.inlets.empty() && of_inlets != nullptr)
    throw Error(ErrorCode::argument, of_inlets, "given without --inlet, expected the name of a boundary");
  if (run.outlets.empty() && run.outlet.pressure != 1.0)
    throw Error(ErrorCode::argument, "--pressure", "given without --outlet, expected the name of a boundary");
  FlowOptions options = run.options;
  for (const std::string& name : run.inlets) {
    options.inlets.push_back(run.inlet);
    options.inlets.back().name = name;
  }
  for (const std::string& name : run.outlets) {
    options.outlets.push_back(run.outlet);
    options.outlets.back().name = name;
  }
  for (const std::string& pair : run.periodic) {
    const std::size_t comma = pair.find(',');
    if (comma == std::string::npos || comma == 0 || comma + 1 == pair.size())
      throw Error(ErrorCode::argument, "--periodic",
                  "found '" + pair + "', expected the names of two boundaries with a comma between them");
    options.periodic.push_back({pair.substr(0, comma), pair.substr(comma + 1)});
  }
  return options;
}

}  // namespace remodel::app
