// remodel shapes: the built-in catalogue.

#include <array>
#include <cstdio>
#include <memory>

#include "arguments.h"
#include "command.h"
#include "figures.h"
#include "remodel/airfoil.h"

namespace remodel::app {
namespace {

void add_entry(Report& report, Json& list, const CatalogueEntry& entry) {
  const Extreme thickness = max_thickness(entry.airfoil());
  const Extreme camber = max_camber(entry.airfoil());
  list.push_back({{"name", entry.name},
                  {"description", entry.description},
                  {"degree", entry.degree},
                  {"max_error", entry.fit_max_error},
                  {"rms_error", entry.fit_rms_error},
                  {"thickness", thickness.value},
                  {"camber", camber.value}});
  std::array<char, 160> line{};
  std::snprintf(line.data(), line.size(), "%6d  %9.2e  %9.2e  %8.2f %%  %8.2f %%  %s", entry.degree,
                entry.fit_max_error, entry.fit_rms_error, 100.0 * thickness.value, 100.0 * camber.value,
                std::string(entry.description).c_str());
  report.line(std::string(entry.name), line.data());
}

Status run(bool json) {
  Report report;
  report.line("name", "degree  max error  RMS error  thickness      camber  (errors in chords)");
  Json list = Json::array();
  for (const CatalogueEntry& entry : airfoil_catalogue()) add_entry(report, list, entry);
  report.data("shapes", list);
  report.line("",
              "also: naca:2412 (4 digits), naca:23012 (5 digits), coordinate files, .json of `remodel fit`");
  report.print(json);
  return Status::done;
}

}  // namespace

void add_shapes_command(CLI::App& program, Action& action) {
  auto json = std::make_shared<bool>(false);
  CLI::App& app = add_subcommand(program, "shapes", "Lists the built-in airfoils",
                                 [json, &action] { action = [json] { return run(*json); }; });
  add_json_flag(app, *json);
}

}  // namespace remodel::app
