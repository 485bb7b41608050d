#include "domain_input.h"

#include <algorithm>
#include <filesystem>

#include "arguments.h"
#include "figures.h"
#include "remodel/error.h"
#include "remodel/io.h"

namespace remodel::app {
namespace {

bool is_graph_file(const std::string& shape) {
  return std::filesystem::path(shape).extension() == ".poly";
}

bool is_domain_file(const std::string& shape) {
  return std::filesystem::path(shape).extension() == ".json" && holds_domain(shape);
}

Placement placement_of(const std::string& text) {
  const std::vector<double> values = parse_reals("--place", text, 4);
  if (!(values[0] > 0.0))
    throw Error(ErrorCode::argument, "--place",
                "found '" + text + "', expected a chord of more than 0 first");
  return {.chord = values[0], .rotation_deg = values[1], .position = {values[2], values[3]}};
}

// "flap" for some/flap.dat, "2412" for naca:2412; numbered where a name was there before.
std::string name_of(const std::string& shape, const std::vector<PlacedAirfoil>& before) {
  std::string name = std::filesystem::path(shape).stem().string();
  name.erase(0, name.rfind(':') + 1);
  const auto taken = [&](const std::string& candidate) {
    return candidate == "farfield" ||
           std::any_of(before.begin(), before.end(),
                       [&](const PlacedAirfoil& airfoil) { return airfoil.name == candidate; });
  };
  std::string candidate = name;
  for (int i = 2; taken(candidate); ++i) candidate = name + "_" + std::to_string(i);
  return candidate;
}

void require_alone(const DomainInputOptions& options, const std::string& shape) {
  if (options.shapes.size() == 1 && options.places.empty()) return;
  throw Error(ErrorCode::argument, shape, "holds a whole domain, expected it alone and without --place");
}

}  // namespace

void add_domain_input(CLI::App& app, DomainInputOptions& options) {
  add_texts(app,
            {"shape", "SHAPE...", "",
             std::string(shape_help) +
                 "; several airfoils share a farfield; or a domain file (.json), or Triangle's .poly"},
            Presence::required, options.shapes);
  add_texts(app,
            {"--place", "CHORD,DEGREES,X,Y", "1,0,0,0",
             "Place of an airfoil: scaled by CHORD, turned counter-clockwise about its leading edge, which "
             "comes to "
             "X,Y; may be repeated, in the order of the airfoils"},
            Presence::optional, options.places);
  add_choice(app,
             {"--crossings", "WHAT", "insert",
              "Segments of a .poly file that cross: insert the crossing, or refuse the file"},
             {"insert", "refuse"}, [&](std::size_t choice) {
               options.crossings = choice == 0 ? Crossings::insert : Crossings::refuse;
             });
}

bool is_single_airfoil(const DomainInputOptions& options) {
  return options.shapes.size() == 1 && options.places.empty() && !is_graph_file(options.shapes[0]) &&
         !is_domain_file(options.shapes[0]);
}

DomainInput read_domain(const DomainInputOptions& options, const AirfoilDomainOptions& discretisation,
                        int cst_degree) {
  DomainInput input;
  for (const std::string& shape : options.shapes) {
    if (is_graph_file(shape)) {
      require_alone(options, shape);
      input.findings.emplace();
      input.domain = planar_domain(read_poly(shape), shape, options.crossings, &*input.findings);
      return input;
    }
    if (is_domain_file(shape)) {
      require_alone(options, shape);
      input.domain = load_domain(shape);
      return input;
    }
  }
  if (options.places.size() > options.shapes.size())
    throw Error(ErrorCode::argument, "--place",
                "found " + std::to_string(options.places.size()) +
                    " places, expected at most one for each of " + std::to_string(options.shapes.size()) +
                    " airfoils");
  std::vector<PlacedAirfoil> airfoils;
  for (std::size_t i = 0; i < options.shapes.size(); ++i) {
    PlacedAirfoil placed{.airfoil = load_airfoil(options.shapes[i], cst_degree)};
    if (options.shapes.size() > 1) placed.name = name_of(options.shapes[i], airfoils);
    if (i < options.places.size()) placed.placement = placement_of(options.places[i]);
    airfoils.push_back(std::move(placed));
  }
  input.domain = airfoils_domain(airfoils, discretisation);
  return input;
}

void add_findings(Report& report, const DomainInput& input) {
  if (!input.findings) return;
  const PlanarFindings& found = *input.findings;
  report.data("input", {{"duplicate_points", found.duplicate_points},
                        {"points_on_segments", found.points_on_segments},
                        {"crossings", found.crossings},
                        {"overlaps", found.overlaps},
                        {"empty_segments", found.empty_segments},
                        {"outside_segments", found.outside_segments},
                        {"outside_points", found.outside_points}});
  const auto line = [&](std::size_t count, const char* what) {
    if (count > 0) report.line("input", std::to_string(count) + what);
  };
  line(found.duplicate_points, " points at the place of another");
  line(found.points_on_segments, " points on segments, which were split");
  line(found.crossings, " crossings of segments, which were split");
  line(found.overlaps, " pieces of segments over others");
  line(found.empty_segments, " segments from a point to itself");
  line(found.outside_segments, " pieces of segments outside, left out");
  line(found.outside_points, " points outside, left out");
}

}  // namespace remodel::app
