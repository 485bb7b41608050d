#include "domain_input.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "arguments.h"
#include "figures.h"
#include "number_text.h"
#include "remodel/error.h"
#include "remodel/io.h"
#include "remodel/shape_files.h"

namespace remodel::app {
namespace {

bool is_domain_file(const std::string& shape) {
  const std::filesystem::path file(shape);
  return (file.extension() == ".json" || is_pipe(file)) && holds_domain(file);
}

Placement placement_of(const std::string& text) {
  const std::vector<double> values = parse_reals("--place", text, 4);
  if (!(values[0] > 0.0))
    throw Error(ErrorCode::argument, "--place",
                "found '" + text + "', expected a chord of more than 0 first");
  return {.chord = values[0], .rotation_deg = values[1], .position = {values[2], values[3]}};
}

using Airfoils = std::vector<PlacedAirfoil>;

bool is_taken(const std::string& name, const Airfoils& before) {
  return name == "farfield" || std::any_of(before.begin(), before.end(), [&](const PlacedAirfoil& airfoil) {
           return airfoil.name == name;
         });
}

// "flap" for some/flap.dat, "naca2412" for naca:2412 (to solvers a bare number is a tag, not a name); a
// number is appended to a name that is already taken.
std::string name_of(const std::string& shape, const Airfoils& before) {
  std::string name = std::filesystem::path(shape).stem().string();
  std::erase(name, ':');
  if (name.find_first_not_of("0123456789.+-") == std::string::npos) name.insert(0, "airfoil");
  std::string candidate = name;
  for (int i = 2; is_taken(candidate, before); ++i) candidate = name + "_" + std::to_string(i);
  return candidate;
}

// The user's own name, or one by its file.
std::string name_of(const DomainInputOptions& options, std::size_t i, const Airfoils& before) {
  if (i >= options.names.size()) return name_of(options.shapes[i], before);
  const std::string& name = options.names[i];
  if (name.empty() || is_taken(name, before))
    throw Error(ErrorCode::argument, "--name",
                "found '" + name + "', expected a name of its own for each airfoil, and not 'farfield'");
  return name;
}

void require_at_most_one_each(const char* option, std::size_t found, std::size_t airfoils) {
  if (found > airfoils)
    throw Error(ErrorCode::argument, option,
                "found " + std::to_string(found) + ", expected at most one for each of " +
                    std::to_string(airfoils) + " airfoils");
}

std::vector<Curve> outline_of_file(const std::string& shape, OutlineCurve curve, const std::string& name,
                                   std::vector<ShapeOutline>& outlines) {
  if (!is_coordinate_file(shape))
    throw Error(ErrorCode::argument, "--as-given",
                "given for '" + shape + "', expected for coordinate files");
  const AirfoilCoordinates coordinates = read_airfoil(shape);
  outlines.push_back({.shape = shape,
                      .points = coordinates.upper.size() + coordinates.lower.size() - 1,
                      .gap = coordinates.upper.back().y - coordinates.lower.back().y});
  return outline_of(coordinates, curve, name);
}

void add_outline_figures(Report& report, const std::vector<ShapeOutline>& outlines) {
  Json list = Json::array();
  for (const ShapeOutline& outline : outlines) {
    list.push_back(
        {{"shape", outline.shape}, {"points", outline.points}, {"trailing_edge_gap", outline.gap}});
    std::string text = std::to_string(outline.points) + " points as given, in chords from the leading edge";
    if (outline.gap != 0.0)
      text += "; its trailing edge is open by " + short_text(outline.gap) + " chords, kept";
    report.line("outline of " + outline.shape, text);
  }
  if (!list.empty()) report.data("outlines", std::move(list));
}

void require_alone(const DomainInputOptions& options, const std::string& shape) {
  if (options.as_given)
    throw Error(ErrorCode::argument, "--as-given",
                "given for '" + shape + "', a whole domain, expected for coordinate files");
  if (options.shapes.size() == 1 && options.places.empty() && options.names.empty()) return;
  throw Error(ErrorCode::argument, shape,
              "holds a whole domain, expected it alone and without --place and --name");
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
  add_texts(app,
            {"--name", "NAME", "airfoil; of several by their files",
             "Marker of an airfoil in mesh files; may be repeated, in the order of the airfoils"},
            Presence::optional, options.names);
  static constexpr std::array outlines{OutlineCurve::spline, OutlineCurve::polyline};
  add_choice(app,
             {"--as-given", "CURVE", "",
              "The outline of a coordinate file as it is, without a fit: a spline or a polyline through its "
              "points, which are the vertices"},
             {"spline", "polyline"}, [&](std::size_t choice) { options.as_given = outlines[choice]; });
  add_choice(app,
             {"--crossings", "WHAT", "insert",
              "Segments of a .poly file that cross: insert the crossing, or refuse the file"},
             {"insert", "refuse"}, [&](std::size_t choice) {
               options.crossings = choice == 0 ? Crossings::insert : Crossings::refuse;
             });
}

bool is_single_airfoil(const DomainInputOptions& options) {
  return options.shapes.size() == 1 && options.places.empty() && options.names.empty() && !options.as_given &&
         !holds_graph(options.shapes[0]) && !is_domain_file(options.shapes[0]);
}

DomainInput read_domain(const DomainInputOptions& options, const AirfoilDomainOptions& discretisation,
                        const FitOptions& fit) {
  DomainInput input;
  for (const std::string& shape : options.shapes) {
    if (holds_graph(shape)) {
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
  require_at_most_one_each("--place", options.places.size(), options.shapes.size());
  require_at_most_one_each("--name", options.names.size(), options.shapes.size());
  if (options.as_given && fit.close_trailing_edge)
    throw Error(ErrorCode::argument, "--close-trailing-edge",
                "given with --as-given, which leaves the outline as it is, expected one of them");
  Airfoils airfoils;
  for (std::size_t i = 0; i < options.shapes.size(); ++i) {
    const std::string& shape = options.shapes[i];
    PlacedAirfoil placed;
    if (options.shapes.size() > 1 || !options.names.empty()) placed.name = name_of(options, i, airfoils);
    if (options.as_given)
      placed.outline = outline_of_file(shape, *options.as_given, placed.name, input.outlines);
    else
      placed.airfoil = fit_shape(shape, fit, input.fits).airfoil;
    if (i < options.places.size()) placed.placement = placement_of(options.places[i]);
    airfoils.push_back(std::move(placed));
  }
  input.domain = airfoils_domain(airfoils, discretisation);
  input.in_farfield = true;
  return input;
}

void add_findings(Report& report, const DomainInput& input) {
  add_fit_figures(report, input.fits);
  add_outline_figures(report, input.outlines);
  if (!input.findings) return;
  const PlanarFindings& found = *input.findings;
  report.data("input", {{"duplicate_points", found.duplicate_points},
                        {"points_on_segments", found.points_on_segments},
                        {"crossings", found.crossings},
                        {"overlaps", found.overlaps},
                        {"empty_segments", found.empty_segments},
                        {"outside_segments", found.outside_segments},
                        {"outside_points", found.outside_points}});
  const auto line = [&](std::size_t count, const char* one, const char* more) {
    if (count > 0) report.line("input", std::to_string(count) + (count == 1 ? one : more));
  };
  line(found.duplicate_points, " point at the place of another", " points at the places of others");
  line(found.points_on_segments, " point on a segment, which was split",
       " points on segments, which were split");
  line(found.crossings, " crossing of segments, which were split",
       " crossings of segments, which were split");
  line(found.overlaps, " piece of a segment over another", " pieces of segments over others");
  line(found.empty_segments, " segment from a point to itself", " segments from a point to itself");
  line(found.outside_segments, " piece of a segment outside, left out",
       " pieces of segments outside, left out");
  line(found.outside_points, " point outside, left out", " points outside, left out");
}

}  // namespace remodel::app
