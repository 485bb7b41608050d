#include "domain_input.h"

#include <algorithm>
#include <array>
#include <utility>

#include "arguments.h"
#include "figures.h"
#include "flow_mesh.h"
#include "number_text.h"
#include "remodel/error.h"
#include "shape_input.h"
#include "warnings.h"

namespace remodel::app {
namespace {

Placement placement_of(const std::string& text) {
  const std::vector<double> values = parse_reals("--place", text, 4);
  if (!(values[0] > 0.0))
    throw Error(ErrorCode::argument, "--place",
                "found '" + text + "', expected a chord of more than 0 first");
  return {.chord = values[0], .rotation_deg = values[1], .position = {values[2], values[3]}};
}

void require_at_most_one_each(const char* option, std::size_t found, std::size_t airfoils) {
  if (found > airfoils)
    throw Error(ErrorCode::argument, option,
                "found " + std::to_string(found) + ", expected at most one for each of " +
                    std::to_string(airfoils) + " airfoils");
}

// The library names the members of what it is given, a user knows the options behind them.
constexpr std::pair<const char*, const char*> members[] = {{"place", "--place"},
                                                           {"name", "--name"},
                                                           {"as_given", "--as-given"},
                                                           {"keep_coordinates", "--keep-coordinates"},
                                                           {"close_trailing_edge", "--close-trailing-edge"}};
Error with_options(const Error& error) {
  std::string text = error.what();
  for (const auto& [member, option] : members) {
    if (!text.starts_with(std::string(member) + ": ")) continue;
    std::string problem = text.substr(std::string(member).size() + 2);
    for (const auto& [other, its_option] : members)
      if (const std::string words = std::string("given with ") + other; problem.starts_with(words))
        problem = std::string("given with ") + its_option + problem.substr(words.size());
    return {error.code(), option, problem};
  }
  return error;
}

std::vector<ShapeOfDomain> shapes_of(const DomainInputOptions& options) {
  require_at_most_one_each("--place", options.places.size(), options.shapes.size());
  require_at_most_one_each("--name", options.names.size(), options.shapes.size());
  std::vector<ShapeOfDomain> shapes;
  for (std::size_t i = 0; i < options.shapes.size(); ++i) {
    ShapeOfDomain shape{.shape = options.shapes[i]};
    if (i < options.places.size()) shape.place = placement_of(options.places[i]);
    if (i < options.names.size()) {
      if (options.names[i].empty())
        throw Error(ErrorCode::argument, "--name", "found '', expected a name for an airfoil");
      shape.name = options.names[i];
    }
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

void add_outline_figures(Report& report, const std::vector<ShapeOutline>& outlines) {
  Json list = Json::array();
  for (const ShapeOutline& outline : outlines) {
    list.push_back({{"shape", outline.shape},
                    {"points", outline.points},
                    {"trailing_edge_gap", outline.gap},
                    {"kept", outline.kept},
                    {"frame", frame_json(outline.frame)}});
    std::string text = std::to_string(outline.points) + " points as given, " +
                       (outline.kept ? "where the file has them" : "in chords from the leading edge");
    if (outline.gap != 0.0)
      text += "; its trailing edge is open by " + short_text(outline.gap) + " chords, kept";
    report.line("outline of " + outline.shape, text);
  }
  if (!list.empty()) report.data("outlines", std::move(list));
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
  add_reading_options(app, options);
}

void add_reading_options(CLI::App& app, DomainInputOptions& options) {
  static constexpr std::array outlines{OutlineCurve::spline, OutlineCurve::polyline};
  add_choice(app,
             {"--as-given", "CURVE", "",
              "The outline of a coordinate file as it is, without a fit: a spline or a polyline through its "
              "points, which are the vertices"},
             {"spline", "polyline"}, [&](std::size_t choice) { options.as_given = outlines[choice]; });
  add_flag(app, "--keep-coordinates",
           "Coordinate files stay where they are: in their own place, incidence and units, with the farfield "
           "around all of them",
           options.keep_coordinates);
  add_choice(app,
             {"--crossings", "WHAT", "insert",
              "Segments of a .poly file that cross: insert the crossing, or refuse the file"},
             {"insert", "refuse"}, [&](std::size_t choice) {
               options.crossings = choice == 0 ? Crossings::insert : Crossings::refuse;
             });
  add_real(app,
           {"--join", "T", "1e-11",
            "Places of a .poly or domain file that are nearer than T, a share of its size or of its largest "
            "coordinate, differ by rounding: they are joined, and that is said; 1e-15 to 0.01, or 0: none"},
           {.low = 0.0, .high = 0.01}, options.join);
}

bool is_single_airfoil(const DomainInputOptions& options) {
  return options.shapes.size() == 1 && options.places.empty() && options.names.empty() && !options.as_given &&
         !options.keep_coordinates && !is_whole_domain(options.shapes[0]);
}

ShapesDomain read_domain(const DomainInputOptions& options, const AirfoilDomainOptions& discretisation,
                         const FitOptions& fit) {
  const std::vector<ShapeOfDomain> shapes = shapes_of(options);
  require_coordinate_file(options.shapes, fit);
  try {
    ShapesDomain input = domain_of_shapes(shapes, discretisation,
                                          {.degree = fit.degree,
                                           .close_trailing_edge = fit.close_trailing_edge,
                                           .as_given = options.as_given,
                                           .keep_coordinates = options.keep_coordinates,
                                           .farfield_stays = options.farfield_stays,
                                           .crossings = options.crossings,
                                           .join = options.join});
    warn(input.warnings);
    return input;
  } catch (const Error& error) {
    throw with_options(error);
  }
}

void require_used(const ShapesDomain& input, const std::function<bool(const char*)>& given) {
  if (!input.in_farfield)
    refuse_given(given,
                 {"--points", "--turning-share", "--farfield-radius", "--farfield-points", "--cst-degree"},
                 "given for a whole domain, which has its own, expected for airfoils");
  if (!input.findings)
    refuse_given(given, {"--crossings"}, "given without a planar graph, expected a .poly file");
}

void validate_input(const DomainInputOptions& options, const Domain& domain) {
  validate(domain, options.shapes.size() == 1 ? options.shapes[0] : nameless_domain);
}

GenerateResult generate_input(const DomainInputOptions& options, const Domain& domain,
                              const QualityOptions& quality, StepObserver* observer) {
  try {
    return generate(domain, quality, observer);
  } catch (const Error& error) {
    if (options.shapes.size() != 1) throw;
    throw from_file(error, options.shapes[0]);
  }
}

void add_findings(Report& report, const ShapesDomain& input) {
  add_fit_figures(report, input.fits);
  add_outline_figures(report, input.outlines);
  if (!input.findings) return;
  const PlanarFindings& found = *input.findings;
  report.data("input", {{"duplicate_points", found.duplicate_points},
                        {"joined", found.joins.count},
                        {"joined_distance", found.joins.largest},
                        {"join_tolerance", found.joins.tolerance},
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
