#include "domain_input.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include "arguments.h"
#include "figures.h"
#include "flow_mesh.h"
#include "number_text.h"
#include "remodel/error.h"
#include "remodel/io.h"
#include "remodel/shape_files.h"
#include "warnings.h"

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

// Below, an incidence is what digits and the choice of a nose leave of none.
constexpr double least_incidence_deg = 0.1;

// The box of all noses and trailing edges, which a farfield goes around.
struct Extent {
  Point least{HUGE_VAL, HUGE_VAL}, largest{-HUGE_VAL, -HUGE_VAL};
  void add(Point p) {
    least = {std::min(least.x, p.x), std::min(least.y, p.y)};
    largest = {std::max(largest.x, p.x), std::max(largest.y, p.y)};
  }
  void add(const AirfoilFrame& frame) {
    add(frame.nose);
    add(frame.nose + frame.chord * frame.axis);
  }
  Point centre() const { return 0.5 * (least + largest); }
  double size() const { return std::max(largest.x - least.x, largest.y - least.y); }
};

// Reads what is given as airfoils, and says what became of their files.
class AirfoilInput {
 public:
  AirfoilInput(const DomainInputOptions& options, const FitOptions& fit, DomainInput& input)
      : options_(options), fit_(fit), input_(input) {}

  void read() {
    for (std::size_t i = 0; i < options_.shapes.size(); ++i) {
      if (is_coordinate_file(options_.shapes[i]))
        read_file(i);
      else
        add_named(i);
    }
    if (keeps_ && !lies_in_chords({.chord = longest_}))
      warn("the longest chord is " + short_text(longest_) +
           " in the coordinates of the files, which are kept: coefficients of a flow are of the reference "
           "length "
           "that is given, or of 1");
  }

  const Airfoils& airfoils() const { return airfoils_; }
  double chord() const { return keeps_ ? longest_ : 1.0; }
  // The farfield around what stays in the coordinates of its files.
  AirfoilDomainOptions farfield(AirfoilDomainOptions discretisation) const {
    if (!keeps_ || options_.farfield_stays) return discretisation;
    discretisation.farfield_radius *= extent_.size();
    discretisation.farfield_centre = extent_.centre();
    return discretisation;
  }

 private:
  std::string name_for(std::size_t i) const {
    const bool alone = options_.shapes.size() == 1 && options_.names.empty() && elements_ < 2;
    return alone ? "airfoil" : name_of(options_, i, airfoils_);
  }

  void add_named(std::size_t i) {
    const std::string& shape = options_.shapes[i];
    if (options_.as_given)
      throw Error(ErrorCode::argument, "--as-given",
                  "given for '" + shape + "', expected for coordinate files");
    if (options_.keep_coordinates)
      throw Error(ErrorCode::argument, "--keep-coordinates",
                  "given for '" + shape + "', expected for coordinate files");
    elements_ = 1;
    PlacedAirfoil placed{.name = name_for(i), .airfoil = fit_shape(shape, fit_, input_.fits).airfoil};
    if (i < options_.places.size()) placed.placement = placement_of(options_.places[i]);
    airfoils_.push_back(std::move(placed));
  }

  void read_file(std::size_t i) {
    const std::string& shape = options_.shapes[i];
    const AirfoilOutlines file = read_outlines(shape);
    elements_ = file.elements.size();
    const bool place = i < options_.places.size();
    if (place && elements_ > 1)
      throw Error(ErrorCode::argument, "--place",
                  "given for '" + shape + "', which has " + std::to_string(elements_) +
                      " elements in common coordinates, expected for a file of one");
    if (elements_ > 1)
      warn(shape + ": has " + std::to_string(elements_) + " elements, whose common coordinates are kept");
    if (options_.as_given || elements_ > 1) warn(file.warnings);
    for (const AirfoilOutline& outline : file.elements) {
      const bool keep = options_.keep_coordinates || elements_ > 1;
      keeps_ = keeps_ || keep;
      if (keep) extent_.add(outline.frame), longest_ = std::max(longest_, outline.frame.chord);
      PlacedAirfoil placed = options_.as_given ? as_given(i, outline, keep, place) : fitted(i, outline, keep);
      if (place) placed.placement = placement_of(options_.places[i]);
      airfoils_.push_back(std::move(placed));
    }
  }

  PlacedAirfoil as_given(std::size_t i, const AirfoilOutline& outline, bool keep, bool place) {
    const std::string& shape = options_.shapes[i];
    const bool stays = keep || (!place && lies_in_chords(outline.frame));
    PlacedAirfoil placed;
    placed.name = name_for(i);
    placed.outline =
        outline_of(stays ? outline.points : moved_to_origin(outline), *options_.as_given, placed.name);
    const bool closed = outline.points.front() == outline.points.back();
    input_.outlines.push_back({.shape = shape,
                               .points = outline.points.size() - (closed ? 1 : 0),
                               .gap = outline.gap,
                               .kept = stays,
                               .frame = outline.frame});
    if (!stays && !place)
      warn(shape + ": its chord of " + short_text(outline.frame.chord) +
           " is scaled to 1 and its nose moved from " + short_text(outline.frame.nose.x) + "," +
           short_text(outline.frame.nose.y) + " to the origin; --keep-coordinates leaves them");
    return placed;
  }

  // Several elements of a file are fitted one by one; a file of one by itself, with what is said of it.
  CstFit fit_of(std::size_t i, const AirfoilOutline& outline, bool keep) {
    const std::string& shape = options_.shapes[i];
    if (elements_ == 1 && !keep) return fit_shape(shape, fit_, input_.fits);
    const CstFit fit = fit_cst_apart(surfaces_of(outline, shape), fit_.degree, fit_.trailing_edge());
    warn(fit.warnings);
    input_.fits.push_back({shape, fit});
    return fit;
  }

  PlacedAirfoil fitted(std::size_t i, const AirfoilOutline& outline, bool keep) {
    const CstFit fit = fit_of(i, outline, keep);
    PlacedAirfoil placed{.name = name_for(i), .airfoil = fit.airfoil};
    const AirfoilFrame& frame = fit.frame;
    const double incidence = frame.incidence_deg();
    if (keep) {
      placed.placement = {.chord = frame.chord, .rotation_deg = -incidence, .position = frame.nose};
    } else if (std::abs(incidence) >= least_incidence_deg && i >= options_.places.size()) {
      placed.placement.rotation_deg = -incidence;
      warn(options_.shapes[i] + ": the section is placed at the incidence that it is drawn at");
    }
    return placed;
  }

  const DomainInputOptions& options_;
  const FitOptions& fit_;
  DomainInput& input_;
  Airfoils airfoils_;
  Extent extent_;
  std::size_t elements_ = 1;  // of the file that is read
  double longest_ = 0.0;      // chord that is kept
  bool keeps_ = false;
};

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

void require_alone(const DomainInputOptions& options, const FitOptions& fit, const std::string& shape) {
  for (const auto& [given, option] : {std::pair{options.as_given.has_value(), "--as-given"},
                                      {options.keep_coordinates, "--keep-coordinates"},
                                      {fit.close_trailing_edge, "--close-trailing-edge"}})
    if (given)
      throw Error(ErrorCode::argument, option,
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
         !options.keep_coordinates && !holds_graph(options.shapes[0]) && !is_domain_file(options.shapes[0]);
}

DomainInput read_domain(const DomainInputOptions& options, const AirfoilDomainOptions& discretisation,
                        const FitOptions& fit) {
  DomainInput input;
  for (const std::string& shape : options.shapes) {
    if (holds_graph(shape)) {
      require_alone(options, fit, shape);
      input.findings.emplace();
      const PlanarGraph graph = read_poly(shape);
      input.domain = planar_domain(graph, shape, options.crossings, &*input.findings, options.join);
      warn_of(input.findings->joins, shape);
      for (const std::string& sentence : graph.left_out) warn(sentence);
      for (const std::string& sentence : input.findings->left_out) warn(shape + ": " + sentence);
      validate(input.domain, shape);
      return input;
    }
    if (is_domain_file(shape)) {
      require_alone(options, fit, shape);
      Joins joins;
      std::vector<std::string> warnings;
      input.domain = load_domain(shape, options.join, &joins, &warnings);
      warn_of(joins, shape);
      warn(warnings);
      return input;
    }
  }
  require_at_most_one_each("--place", options.places.size(), options.shapes.size());
  require_at_most_one_each("--name", options.names.size(), options.shapes.size());
  if (options.as_given && fit.close_trailing_edge)
    throw Error(ErrorCode::argument, "--close-trailing-edge",
                "given with --as-given, which leaves the outline as it is, expected one of them");
  if (options.keep_coordinates && !options.places.empty())
    throw Error(ErrorCode::argument, "--place",
                "given with --keep-coordinates, which leaves airfoils where they are, expected one of them");
  AirfoilInput airfoils(options, fit, input);
  airfoils.read();
  input.domain = airfoils_domain(airfoils.airfoils(), airfoils.farfield(discretisation));
  input.in_farfield = true;
  input.chord = airfoils.chord();
  return input;
}

void require_used(const DomainInput& input, const std::function<bool(const char*)>& given) {
  if (!input.in_farfield)
    refuse_given(given, {"--points", "--farfield-radius", "--farfield-points", "--cst-degree"},
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

void add_findings(Report& report, const DomainInput& input) {
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
