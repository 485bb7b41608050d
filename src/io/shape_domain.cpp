#include "remodel/shape_domain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "remodel/error.h"
#include "remodel/io.h"
#include "remodel/shape_files.h"

namespace remodel {
namespace {

// Below, an incidence is what digits and the choice of a nose leave of none.
constexpr double least_incidence_deg = 0.1;

std::string number_text(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

void append(std::vector<std::string>& list, const std::vector<std::string>& more) {
  list.insert(list.end(), more.begin(), more.end());
}

bool is_domain_file(const std::string& shape) {
  const std::filesystem::path file(shape);
  return (file.extension() == ".json" || is_pipe(file)) && holds_domain(file);
}

void say_joins(const Joins& joins, const std::string& file, std::vector<std::string>& warnings) {
  if (joins.count == 0) return;
  warnings.push_back(file + ": " + std::to_string(joins.count) +
                     (joins.count == 1
                          ? " place that differs from another by rounding was joined with it, "
                          : " places that differ from others by rounding were joined with them, at most ") +
                     number_text(joins.largest) + " apart (the tolerance of joins is " +
                     number_text(joins.tolerance) + "; 0 joins nothing); the first: " + joins.first);
}

// "flap" for some/flap.dat, "naca2412" for naca:2412 (to solvers a bare number is a tag, not a name).
std::string name_of_shape(const std::string& shape) {
  std::string name = std::filesystem::path(shape).stem().string();
  std::erase(name, ':');
  if (name.find_first_not_of("0123456789.+-") == std::string::npos) name.insert(0, "airfoil");
  return name;
}

// The box of all noses and trailing edges, which a far field goes around.
struct Surroundings {
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

// Reads airfoils, and says what became of their files.
class AirfoilShapes {
 public:
  AirfoilShapes(const std::vector<ShapeOfDomain>& shapes, const ShapeReading& reading, ShapesDomain& result)
      : shapes_(shapes), reading_(reading), result_(result) {}

  void read() {
    for (const ShapeOfDomain& shape : shapes_) {
      if (is_coordinate_file(shape.shape))
        read_file(shape);
      else
        add_named(shape);
    }
    if (keeps_ && !lies_in_chords({.chord = longest_}))
      result_.warnings.push_back(
          "the longest chord is " + number_text(longest_) +
          " in the coordinates of the files, which are kept: coefficients of a flow are of the reference "
          "length that is given, or of 1");
  }

  const std::vector<PlacedAirfoil>& airfoils() const { return airfoils_; }
  double chord() const { return keeps_ ? longest_ : 1.0; }
  // The far field around what stays in the coordinates of its files.
  AirfoilDomainOptions farfield(AirfoilDomainOptions options) const {
    if (!keeps_ || reading_.farfield_stays) return options;
    options.farfield_radius *= around_.size();
    options.farfield_centre = around_.centre();
    return options;
  }

 private:
  bool is_taken(const std::string& name) const {
    return name == "farfield" || std::any_of(airfoils_.begin(), airfoils_.end(),
                                             [&](const PlacedAirfoil& a) { return a.name == name; });
  }

  // The user's own name, or one by its file; a number is appended to one that is already taken.
  std::string name_for(const ShapeOfDomain& shape) const {
    if (shape.name.empty()) {
      const bool alone = shapes_.size() == 1 && elements_ < 2;
      const std::string name = alone ? "airfoil" : name_of_shape(shape.shape);
      std::string candidate = name;
      for (int i = 2; is_taken(candidate); ++i) candidate = name + "_" + std::to_string(i);
      return candidate;
    }
    if (is_taken(shape.name))
      throw Error(
          ErrorCode::argument, "name",
          "found '" + shape.name + "', expected a name of its own for each airfoil, and not 'farfield'");
    return shape.name;
  }

  CstFit fit_named(const ShapeOfDomain& shape) {
    CstFit fit = load_fit(shape.shape, reading_.degree, trailing_edge());
    append(result_.warnings, fit.warnings);
    if (is_coordinate_file(shape.shape)) result_.fits.push_back({shape.shape, fit});
    return fit;
  }

  void add_named(const ShapeOfDomain& shape) {
    for (const auto& [is_set, member] : {std::pair{reading_.as_given.has_value(), "as_given"},
                                         {reading_.keep_coordinates, "keep_coordinates"}})
      if (is_set)
        throw Error(ErrorCode::argument, member,
                    "given for '" + shape.shape + "', expected for coordinate files");
    elements_ = 1;
    PlacedAirfoil placed{.name = name_for(shape), .airfoil = fit_named(shape).airfoil};
    if (shape.place) placed.placement = *shape.place;
    airfoils_.push_back(std::move(placed));
  }

  void read_file(const ShapeOfDomain& shape) {
    const AirfoilOutlines file = read_outlines(shape.shape);
    elements_ = file.elements.size();
    if (shape.place && elements_ > 1)
      throw Error(ErrorCode::argument, "place",
                  "given for '" + shape.shape + "', which has " + std::to_string(elements_) +
                      " elements in common coordinates, expected for a file of one");
    if (elements_ > 1)
      result_.warnings.push_back(shape.shape + ": has " + std::to_string(elements_) +
                                 " elements, whose common coordinates are kept");
    if (reading_.as_given || elements_ > 1) append(result_.warnings, file.warnings);
    const bool keep = reading_.keep_coordinates || elements_ > 1;
    for (const AirfoilOutline& outline : file.elements) {
      keeps_ = keeps_ || keep;
      if (keep) around_.add(outline.frame), longest_ = std::max(longest_, outline.frame.chord);
      PlacedAirfoil placed =
          reading_.as_given ? as_given(shape, outline, keep) : fitted(shape, outline, keep);
      if (shape.place) placed.placement = *shape.place;
      airfoils_.push_back(std::move(placed));
    }
  }

  PlacedAirfoil as_given(const ShapeOfDomain& shape, const AirfoilOutline& outline, bool keep) {
    const bool stays = keep || (!shape.place && lies_in_chords(outline.frame));
    PlacedAirfoil placed;
    placed.name = name_for(shape);
    placed.outline =
        outline_of(stays ? outline.points : moved_to_origin(outline), *reading_.as_given, placed.name);
    const bool closed = outline.points.front() == outline.points.back();
    result_.outlines.push_back({.shape = shape.shape,
                                .points = outline.points.size() - (closed ? 1 : 0),
                                .gap = outline.gap,
                                .kept = stays,
                                .frame = outline.frame});
    if (!stays && !shape.place)
      result_.warnings.push_back(shape.shape + ": its chord of " + number_text(outline.frame.chord) +
                                 " is scaled to 1 and its nose moved from " +
                                 number_text(outline.frame.nose.x) + "," + number_text(outline.frame.nose.y) +
                                 " to the origin, unless its coordinates are to be kept");
    return placed;
  }

  // Several elements of a file are fitted one by one; a file of one by itself, with what is said of it.
  CstFit fit_of(const ShapeOfDomain& shape, const AirfoilOutline& outline, bool keep) {
    if (elements_ == 1 && !keep) return fit_named(shape);
    const CstFit fit = fit_cst_apart(surfaces_of(outline, shape.shape), reading_.degree, trailing_edge());
    append(result_.warnings, fit.warnings);
    result_.fits.push_back({shape.shape, fit});
    return fit;
  }

  PlacedAirfoil fitted(const ShapeOfDomain& shape, const AirfoilOutline& outline, bool keep) {
    const CstFit fit = fit_of(shape, outline, keep);
    PlacedAirfoil placed{.name = name_for(shape), .airfoil = fit.airfoil};
    const AirfoilFrame& frame = fit.frame;
    const double incidence = frame.incidence_deg();
    if (keep) {
      placed.placement = {.chord = frame.chord, .rotation_deg = -incidence, .position = frame.nose};
    } else if (std::abs(incidence) >= least_incidence_deg && !shape.place) {
      placed.placement.rotation_deg = -incidence;
      result_.warnings.push_back(shape.shape +
                                 ": the section is placed at the incidence that it is drawn at, and angles "
                                 "are from the file's axis");
    }
    return placed;
  }

  TrailingEdge trailing_edge() const {
    return reading_.close_trailing_edge ? TrailingEdge::closed : TrailingEdge::kept;
  }

  const std::vector<ShapeOfDomain>& shapes_;
  const ShapeReading& reading_;
  ShapesDomain& result_;
  std::vector<PlacedAirfoil> airfoils_;
  Surroundings around_;
  std::size_t elements_ = 1;  // of the file that is read
  double longest_ = 0.0;      // chord that is kept
  bool keeps_ = false;
};

void require_alone(const std::vector<ShapeOfDomain>& shapes, const ShapeReading& reading,
                   const std::string& whole) {
  for (const auto& [is_set, member] : {std::pair{reading.as_given.has_value(), "as_given"},
                                       {reading.keep_coordinates, "keep_coordinates"},
                                       {reading.close_trailing_edge, "close_trailing_edge"}})
    if (is_set)
      throw Error(ErrorCode::argument, member,
                  "given for '" + whole + "', a whole domain, expected for coordinate files");
  if (shapes.size() > 1 || shapes.front().place || !shapes.front().name.empty())
    throw Error(ErrorCode::argument, whole,
                "holds a whole domain, expected it alone, without a place and a name");
}

ShapesDomain graph_domain(const std::string& file, const ShapeReading& reading) {
  ShapesDomain result;
  result.findings.emplace();
  const PlanarGraph graph = read_poly(file);
  result.domain = planar_domain(graph, file, reading.crossings, &*result.findings, reading.join);
  say_joins(result.findings->joins, file, result.warnings);
  append(result.warnings, graph.left_out);
  for (const std::string& sentence : result.findings->left_out)
    result.warnings.push_back(file + ": " + sentence);
  validate(result.domain, file);
  return result;
}

ShapesDomain file_domain(const std::string& file, const ShapeReading& reading) {
  ShapesDomain result;
  Joins joins;
  std::vector<std::string> of_airfoils;
  result.domain = load_domain(file, reading.join, &joins, &of_airfoils);
  say_joins(joins, file, result.warnings);
  append(result.warnings, of_airfoils);
  return result;
}

// Whether the same parameters are the same points: those of polylines and splines are counted by their
// points.
bool has_parameters_of(const Shape& a, const Shape& b) {
  if (a.index() != b.index()) return false;
  const auto count = [](const Shape& shape) {
    if (const auto* polyline = std::get_if<Polyline>(&shape)) return polyline->points.size();
    if (const auto* spline = std::get_if<Spline>(&shape)) return spline->points.size();
    return std::size_t{0};
  };
  return count(a) == count(b);
}

}  // namespace

bool is_whole_domain(const std::string& shape) {
  return holds_graph(shape) || is_domain_file(shape);
}

AirfoilDomainOptions discretisation_of(const Domain& domain) {
  AirfoilDomainOptions options;
  for (std::size_t i = 0; i < domain.curve_count(); ++i) {
    const Curve& curve = domain.curve(i);
    const int points = static_cast<int>(curve.parameters.size());
    if (std::holds_alternative<CstAirfoil>(curve.shape)) options.points = points + points % 2;  // even
    if (const auto* circle = std::get_if<Arc>(&curve.shape)) {
      options.farfield_radius = circle->radius;
      options.farfield_centre = circle->centre;
      options.farfield_points = points;
    }
  }
  return options;
}

void take_names(Domain& domain, const Domain& before) {
  const auto holes_of = [](auto& loops) {
    std::vector<decltype(&loops[0])> holes;
    for (auto& loop : loops)
      if (loop.role == LoopRole::hole) holes.push_back(&loop);
    return holes;
  };
  const auto holes = holes_of(domain.loops);
  const auto named = holes_of(before.loops);
  const auto has_name = [&](const auto* hole) {
    return std::any_of(named.begin(), named.end(), [&](const auto* known) {
      return known->curves.front().name == hole->curves.front().name;
    });
  };
  if (holes.size() != named.size() || std::any_of(holes.begin(), holes.end(), has_name)) return;
  for (std::size_t i = 0; i < holes.size(); ++i)
    for (Curve& curve : holes[i]->curves) curve.name = named[i]->curves.front().name;
}

bool take_stations(Loop& loop, const Domain& before) {
  for (const Loop& old : before.loops) {
    const auto alike = [](const Curve& a, const Curve& b) {
      return a.name == b.name && has_parameters_of(a.shape, b.shape);
    };
    if (!std::equal(loop.curves.begin(), loop.curves.end(), old.curves.begin(), old.curves.end(), alike))
      continue;
    for (std::size_t c = 0; c < loop.curves.size(); ++c) loop.curves[c].parameters = old.curves[c].parameters;
    return true;
  }
  return false;
}

ShapesDomain domain_of_shapes(const std::vector<ShapeOfDomain>& shapes, const AirfoilDomainOptions& options,
                              const ShapeReading& reading) {
  if (shapes.empty()) throw Error(ErrorCode::argument, "shapes", "found none, expected at least one");
  const KeptPipes once;
  for (const auto& [shape, place, name] : shapes) {
    if (!is_whole_domain(shape)) continue;
    require_alone(shapes, reading, shape);
    return holds_graph(shape) ? graph_domain(shape, reading) : file_domain(shape, reading);
  }
  if (reading.as_given && reading.close_trailing_edge)
    throw Error(ErrorCode::argument, "close_trailing_edge",
                "given with as_given, which leaves the outline as it is, expected one of them");
  if (reading.keep_coordinates)
    for (const ShapeOfDomain& shape : shapes)
      if (shape.place)
        throw Error(
            ErrorCode::argument, "place",
            "given with keep_coordinates, which leaves airfoils where they are, expected one of them");
  ShapesDomain result{.domain = {}};
  AirfoilShapes airfoils(shapes, reading, result);
  airfoils.read();
  AirfoilDomainOptions discretisation = airfoils.farfield(options);
  if (!discretisation.turning_share && airfoils.airfoils().size() > 1)
    discretisation.turning_share = turning_share_of_elements;
  result.domain = airfoils_domain(airfoils.airfoils(), discretisation);
  result.in_farfield = true;
  result.chord = airfoils.chord();
  return result;
}

}  // namespace remodel
