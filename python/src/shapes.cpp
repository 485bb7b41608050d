// Airfoil and Domain.

#include <algorithm>
#include <cmath>

#include <pybind11/operators.h>
#include "bindings.h"
#include "living.h"
#include "remodel/airfoil_degree.h"
#include "remodel/io.h"
#include "remodel/mesh_derivative.h"
#include "remodel/shape_files.h"

namespace remodel::python {
namespace {

void require_finite(const CstAirfoil& airfoil) {
  const auto finite = [](const std::vector<double>& values) {
    return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  };
  if (!finite(airfoil.upper) || !finite(airfoil.lower) || !std::isfinite(airfoil.te_upper) ||
      !std::isfinite(airfoil.te_lower) || !std::isfinite(airfoil.e1) || !std::isfinite(airfoil.e2))
    throw Error(ErrorCode::argument, "Airfoil", "found what is not finite, expected numbers");
}

CstAirfoil cst_airfoil(const Reals& upper, const Reals& lower, double e1, double e2, double te_upper,
                       double te_lower) {
  CstAirfoil airfoil{.upper = reals(upper, "upper"),
                     .lower = reals(lower, "lower"),
                     .e1 = e1,
                     .e2 = e2,
                     .te_upper = te_upper,
                     .te_lower = te_lower};
  if (airfoil.upper.size() != airfoil.lower.size() || airfoil.upper.size() < 2 || airfoil.upper.size() > 51)
    throw Error(ErrorCode::argument, "upper, lower",
                "found " + std::to_string(airfoil.upper.size()) + " and " +
                    std::to_string(airfoil.lower.size()) +
                    " coefficients, expected as many of both, 2 to 51");
  require_finite(airfoil);
  if (!(e1 > 0.0 && e2 > 0.0))
    throw Error(ErrorCode::argument, "e1, e2", "expected positive class exponents");
  return airfoil;
}

constexpr int usual_degree = 5;  // of fits

CstAirfoil new_airfoil(const std::optional<std::filesystem::path>& shape, const std::optional<int>& degree,
                       const std::optional<Reals>& upper, const std::optional<Reals>& lower, double e1,
                       double e2, double te_upper, double te_lower, bool close_trailing_edge) {
  if (shape.has_value() == upper.has_value() || upper.has_value() != lower.has_value())
    throw Error(ErrorCode::argument, "Airfoil",
                "expected a name or a file, or else the coefficients upper and lower");
  if (shape && *shape == standard_input)
    throw Error(ErrorCode::argument, "Airfoil", "found '-', expected a name or a file");
  if (!shape) {
    if (degree)
      throw Error(ErrorCode::argument, "degree",
                  "given with coefficients, which have their own, expected with_degree()");
    return cst_airfoil(*upper, *lower, e1, e2, te_upper, te_lower);
  }
  const CstFit fit = load_fit(shape->string(), degree.value_or(usual_degree),
                              close_trailing_edge ? TrailingEdge::closed : TrailingEdge::kept);
  warn(fit.warnings);
  return degree && shape->extension() == ".json" ? with_degree(fit.airfoil, *degree) : fit.airfoil;
}

py::array_t<double> coordinates(const CstAirfoil& airfoil, int count) {
  if (count < 3 || count > 1'000'000)
    throw Error(ErrorCode::argument, "n",
                "found " + std::to_string(count) + ", expected 3 to 1000000 points");
  py::array_t<double> result({py::ssize_t{count}, py::ssize_t{2}});
  auto rows = result.mutable_unchecked<2>();
  for (int i = 0; i < count; ++i) {
    const Point p = airfoil.at(static_cast<double>(i) / (count - 1));
    rows(i, 0) = p.x, rows(i, 1) = p.y;
  }
  return result;
}

std::string airfoil_text(const CstAirfoil& airfoil) {
  return "Airfoil(degree=" + std::to_string(airfoil.degree()) +
         ", thickness=" + std::to_string(max_thickness(airfoil).value) + ")";
}

// What a shape is pickled as.
std::string text_in(const py::tuple& state) {
  if (state.size() != 1 || !py::isinstance<py::str>(state[0]))
    throw Error(ErrorCode::format, "pickle", "is damaged, expected the text of a shape");
  return state[0].cast<std::string>();
}

void add_airfoil(py::module_& module) {
  py::class_<CstAirfoil> airfoil(
      module, "Airfoil",
      R"(An airfoil by class-shape transformation (CST; B. Kulfan, 2008), in chords. Values do not change.

Airfoil("naca:2412"), Airfoil("rae2822"), Airfoil("section.dat", degree=6), Airfoil("design.json") or
Airfoil(upper=[...], lower=[...]): y(x) = x**e1 * (1 - x)**e2 * sum(c[i] * Bernstein[i](x)) + x * te.
Coordinate files and NACA sections are fitted with `degree`, 2 to 12, or 5. Names of the catalogue and .json files have
their own degree, unless it is given: with_degree(). A file is moved, turned and scaled to its
chord: a UserWarning says so where that is more than rounding. Its blunt trailing edge is kept, unless
close_trailing_edge is True. Raises FileError, FormatError, ArgumentError.)");
  airfoil.def(py::init(&new_airfoil), "shape"_a = py::none(), "degree"_a = py::none(), py::kw_only(),
              "upper"_a = py::none(), "lower"_a = py::none(), "e1"_a = 0.5, "e2"_a = 1.0, "te_upper"_a = 0.0,
              "te_lower"_a = 0.0, "close_trailing_edge"_a = false);
  airfoil.def_property_readonly(
      "upper", [](const CstAirfoil& a) { return copied(a.upper); },
      "Coefficients of the upper surface, a copy of shape (degree + 1,).");
  airfoil.def_property_readonly(
      "lower", [](const CstAirfoil& a) { return copied(a.lower); },
      "Coefficients of the lower surface, a copy of shape (degree + 1,).");
  airfoil.def_property_readonly(
      "design",
      [](const CstAirfoil& a) {
        std::vector<double> all = a.upper;
        all.insert(all.end(), a.lower.begin(), a.lower.end());
        return copied(all);
      },
      "Upper, then lower coefficients in one array: what optimisers change.");
  airfoil.def(
      "with_design",
      [](const CstAirfoil& a, const Reals& design) {
        const std::vector<double> all = reals(design, "design");
        if (all.size() != a.upper.size() + a.lower.size())
          throw Error(ErrorCode::argument, "design",
                      "found " + std::to_string(all.size()) + " numbers, expected " +
                          std::to_string(a.upper.size() + a.lower.size()));
        CstAirfoil result = a;
        const auto middle = all.begin() + static_cast<std::ptrdiff_t>(a.upper.size());
        result.upper.assign(all.begin(), middle);
        result.lower.assign(middle, all.end());
        require_finite(result);
        return result;
      },
      "design"_a, "The same airfoil with other coefficients, in the order of `design`.");
  airfoil.def("with_degree", &with_degree, "degree"_a,
              "The section with surfaces of another degree, 1 to 50: exactly the same with a higher one, the "
              "nearest in the least squares with a lower one. Raises ArgumentError.");
  airfoil.def_readonly("e1", &CstAirfoil::e1);
  airfoil.def_readonly("e2", &CstAirfoil::e2);
  airfoil.def_readonly("te_upper", &CstAirfoil::te_upper, "y of the upper surface's trailing edge.");
  airfoil.def_readonly("te_lower", &CstAirfoil::te_lower, "y of the lower surface's trailing edge.");
  airfoil.def_property_readonly("degree", &CstAirfoil::degree);
  airfoil.def_property_readonly(
      "thickness", [](const CstAirfoil& a) { return max_thickness(a).value; },
      "The largest thickness, in chords.");
  airfoil.def_property_readonly("thickness_at", [](const CstAirfoil& a) { return max_thickness(a).at; });
  airfoil.def_property_readonly(
      "camber", [](const CstAirfoil& a) { return max_camber(a).value; }, "The largest camber, in chords.");
  airfoil.def_property_readonly(
      "feasible", &surfaces_apart,
      "Whether the upper surface lies above the lower one everywhere, by the coefficients.");
  airfoil.def("coordinates", &coordinates, "n"_a = 201,
              "Points of shape (n, 2), counter-clockwise from the trailing edge over the upper surface; "
              "cosine spacing.");
  airfoil.def(
      "save",
      [](const CstAirfoil& a, const std::filesystem::path& file) {
        write_text_atomically(file, airfoil_to_json(a));
      },
      "file"_a, "Writes the coefficients as .json, exactly.");
  airfoil.def(py::self == py::self);
  airfoil.def("__repr__", &airfoil_text);
  airfoil.def(py::pickle([](const CstAirfoil& a) { return py::make_tuple(airfoil_to_json(a)); },
                         [](const py::tuple& state) { return airfoil_from_json(text_in(state), "pickle"); }));
  module.def(
      "catalogue",
      [] {
        py::dict result;
        for (const CatalogueEntry& entry : airfoil_catalogue())
          result[py::str(std::string(entry.name))] = py::str(std::string(entry.description));
        return result;
      },
      "The names of the built-in airfoils, with what they are.");
}

template <class T>
T member(const py::handle& value, const std::string& name, const char* expected) {
  try {
    return value.cast<T>();
  } catch (const py::cast_error&) {
    throw py::type_error(name + ": found " + type_of(value) + ", expected " + expected);
  }
}

Loop polygon(const std::string& name, const Reals& values, LoopRole role) {
  std::vector<Point> corners = points(values, name);
  if (corners.size() < 3) throw Error(ErrorCode::argument, name, "expected at least 3 points");
  const std::size_t pieces = corners.size();
  corners.push_back(corners.front());
  return {
      .role = role,
      .curves = {
          {.name = name, .shape = Polyline{std::move(corners)}, .parameters = Parameters::uniform(pieces)}}};
}

Domain polygons(const py::dict& outer, const py::dict& holes) {
  Domain domain;
  const auto add = [&](const char* argument, const py::dict& loops, LoopRole role) {
    for (const auto& [key, values] : loops) {
      const auto name = member<std::string>(key, argument, "names of polygons");
      domain.loops.push_back(polygon(name, array_of(values, name), role));
    }
  };
  add("outer", outer, LoopRole::outer);
  add("holes", holes, LoopRole::hole);
  validate(domain);
  return domain;
}

PlacedAirfoil placed_airfoil(const py::handle& item, const std::string& place) {
  if (!py::isinstance<py::dict>(item))  // or pybind11 would make one of pairs
    throw py::type_error(place + ": found " + type_of(item) + ", expected a dict");
  const auto element = py::reinterpret_borrow<py::dict>(item);
  PlacedAirfoil placed;
  for (const char* needed : {"name", "airfoil"})
    if (!element.contains(needed))
      throw Error(ErrorCode::argument, place, std::string("found no '") + needed + "', expected one");
  for (const auto& [key, value] : element) {
    const auto word = member<std::string>(key, place, "names of its members");
    const std::string name = place + "['" + word + "']";
    if (word == "name")
      placed.name = member<std::string>(value, name, "a string");
    else if (word == "airfoil")
      placed.airfoil = member<CstAirfoil>(value, name, "an Airfoil");
    else if (word == "chord")
      placed.placement.chord = member<double>(value, name, "a number");
    else if (word == "rotation")
      placed.placement.rotation_deg = member<double>(value, name, "a number");
    else if (word == "position") {
      const auto [x, y] = member<std::pair<double, double>>(value, name, "two numbers");
      placed.placement.position = {x, y};
    } else {
      throw Error(ErrorCode::argument, name, "expected one of name, airfoil, chord, rotation, position");
    }
  }
  return placed;
}

Domain placed(const py::iterable& list, int points, double radius, int farfield_points,
              double turning_share) {
  std::vector<PlacedAirfoil> airfoils;
  for (const py::handle& item : list)
    airfoils.push_back(placed_airfoil(item, "elements[" + std::to_string(airfoils.size()) + "]"));
  if (airfoils.empty())
    throw Error(ErrorCode::argument, "elements", "found none, expected at least one airfoil");
  Domain domain = airfoils_domain(airfoils, {.points = points,
                                             .farfield_radius = radius,
                                             .farfield_points = farfield_points,
                                             .turning_share = turning_share});
  validate(domain);
  return domain;
}

py::dict loop_points(const Domain& domain) {
  py::dict result;
  for (std::size_t i = 0; i < domain.loops.size(); ++i) {
    const auto held = std::make_shared<const std::vector<Point>>(domain.points(i));
    std::string name = domain.loops[i].curves.empty() ? "" : domain.loops[i].curves.front().name;
    if (result.contains(name.c_str())) name += " " + std::to_string(i);
    result[py::str(name)] = view(held, reinterpret_cast<const double*>(held->data()),
                                 {static_cast<py::ssize_t>(held->size()), 2});
  }
  return result;
}

CstAirfoil airfoil_of(const Domain& domain, const std::string& boundary) {
  const std::vector<std::size_t> loops = airfoil_loops(domain, boundary);
  if (loops.size() != 1)
    throw Error(ErrorCode::argument, "boundary",
                "found '" + boundary + "', which names " + std::to_string(loops.size()) +
                    " airfoils by coefficients, expected one");
  return std::get<CstAirfoil>(domain.loops[loops[0]].curves.front().shape);
}

using Given = std::initializer_list<std::pair<bool, const char*>>;  // whether an argument was

void refuse_given(const Given& arguments, const std::string& what) {
  for (const auto& [is_given, argument] : arguments)
    if (is_given) throw Error(ErrorCode::argument, argument, "given for " + what);
}

// What a domain can be asked for, each of some shapes alone.
struct DomainArguments {
  std::optional<int> points;
  std::optional<double> radius;
  std::optional<int> farfield_points, degree;
  std::optional<std::string> crossings;
  std::optional<double> join, turning_share;

  // Throws Error (argument) for what this shape has no use for. `made`: the domain of it.
  void require_used(const py::object& shape, const ShapesDomain& made, bool as_given) const {
    const std::string name = py::isinstance<Domain>(shape)       ? "a Domain"
                             : py::isinstance<CstAirfoil>(shape) ? "an Airfoil"
                                                                 : "'" + name_of_shape(shape) + "'";
    const Given stations = {{points.has_value(), "points"}, {turning_share.has_value(), "turning_share"}};
    if (!made.in_farfield) {
      const std::string whole = name + ", a whole domain, which has its own, expected for airfoils";
      refuse_given(stations, whole);
      refuse_given(
          {{radius.has_value(), "farfield_radius"}, {farfield_points.has_value(), "farfield_points"}}, whole);
      refuse_given({{degree.has_value(), "degree"}}, whole);
    }
    if (as_given)
      refuse_given(stations, name + " as it is given, whose points are the vertices, expected with a fit");
    const bool fitted = !as_given && (!made.fits.empty() || !has_coefficients(shape));
    if (!fitted)
      refuse_given({{degree.has_value(), "degree"}}, name + ", which is not fitted, expected for a fit");
    if (!made.findings)
      refuse_given({{crossings.has_value(), "crossings"}}, name + ", expected for a planar graph (.poly)");
    if (made.in_farfield || py::isinstance<Domain>(shape))
      refuse_given({{join.has_value(), "join"}},
                   name + ", expected for a planar graph or the file of a domain");
  }

 private:
  // Of its own: not by a name, which has any degree.
  static bool has_coefficients(const py::object& shape) {
    return py::isinstance<Domain>(shape) || py::isinstance<CstAirfoil>(shape) ||
           std::filesystem::path(name_of_shape(shape)).extension() == ".json";
  }
};

Domain new_domain(const py::object& shape, const std::optional<int>& points,
                  const std::optional<double>& radius, const std::optional<int>& farfield_points,
                  const std::optional<int>& degree, bool close_trailing_edge,
                  const std::optional<std::string>& as_given, bool keep_coordinates,
                  const std::optional<std::string>& crossings, const std::optional<double>& join,
                  const std::optional<double>& turning_share) {
  const DomainArguments given{points, radius, farfield_points, degree, crossings, join, turning_share};
  ShapeReading reading{.degree = degree.value_or(usual_degree),
                       .close_trailing_edge = close_trailing_edge,
                       .keep_coordinates = keep_coordinates,
                       .join = join.value_or(default_join)};
  if (as_given) {
    if (*as_given != "spline" && *as_given != "polyline")
      throw Error(ErrorCode::argument, "as_given",
                  "found '" + *as_given + "', expected 'spline' or 'polyline'");
    reading.as_given = *as_given == "spline" ? OutlineCurve::spline : OutlineCurve::polyline;
  }
  if (py::isinstance<CstAirfoil>(shape) || py::isinstance<Domain>(shape))
    for (const auto& [is_set, argument] : {std::pair{as_given.has_value(), "as_given"},
                                           {keep_coordinates, "keep_coordinates"},
                                           {close_trailing_edge, "close_trailing_edge"}})
      if (is_set)
        throw Error(ErrorCode::argument, argument,
                    "given for " + type_of(shape) + ", expected for a file of coordinates");
  if (crossings && *crossings != "insert" && *crossings != "refuse")
    throw Error(ErrorCode::argument, "crossings",
                "found '" + *crossings + "', expected 'insert' or 'refuse'");
  reading.crossings = crossings == "refuse" ? Crossings::refuse : Crossings::insert;
  const AirfoilDomainOptions usual;
  ShapesDomain made = domain_of(shape,
                                {.points = points.value_or(usual.points),
                                 .farfield_radius = radius.value_or(usual.farfield_radius),
                                 .farfield_points = farfield_points.value_or(usual.farfield_points),
                                 .turning_share = turning_share},
                                reading);
  given.require_used(shape, made, as_given.has_value());
  validate(made.domain, "domain");
  return std::move(made.domain);
}

void add_domain(py::module_& module) {
  py::class_<Domain> domain(module, "Domain",
                            R"(The part of the plane to be meshed: closed loops of named curves.

Domain(airfoil, points=200, farfield_radius=25, farfield_points=50), where airfoil is an Airfoil, a name or a
file of coordinates; Domain("file.json") (docs/domains.md has the layout); Domain("graph.poly"), Triangle's
planar graph; Domain.polygons(...) or Domain.airfoils(...).

A file of several elements keeps their common coordinates, with the far field around all of them. A file of
one section is fitted with `degree`, 5 unless given, moved, turned and scaled to its chord, and its blunt trailing edge
is kept (close_trailing_edge). as_given="spline" or "polyline" takes the points as they are, as vertices, in chords from
the leading edge; keep_coordinates=True leaves files where they lie, in their units. A UserWarning says what was
moved, joined, mended or left out. crossings="refuse" refuses a planar graph whose segments cross, "insert",
as unless given, splits them. Places of a graph or a domain file that differ by rounding, at most `join` (1e-11) of
their size, are joined; 0 joins nothing. What the shape has no use for is refused where it is given.

turning_share is the part of the points on airfoils, 0 to 0.9, that follows how the surface turns, most of it at
noses; the others have cosine spacing. None: 0, and 0.2 in files of several elements, whose suction peaks need
it.

Raises FileError, FormatError; ArgumentError for options that do not go together; GeometryError for curves that
cross or touch, with the loop and the place.)");
  domain.def(py::init(&new_domain), "shape"_a, py::kw_only(), "points"_a = py::none(),
             "farfield_radius"_a = py::none(), "farfield_points"_a = py::none(), "degree"_a = py::none(),
             "close_trailing_edge"_a = false, "as_given"_a = py::none(), "keep_coordinates"_a = false,
             "crossings"_a = py::none(), "join"_a = py::none(), "turning_share"_a = py::none());
  domain.def_static("polygons", &polygons, "outer"_a, "holes"_a = py::dict(),
                    "Closed polygons by name, arrays of shape (n, 2): outer boundaries and holes.");
  domain.def_static("airfoils", &placed, "elements"_a, py::kw_only(), "points"_a = 200,
                    "farfield_radius"_a = 25.0, "farfield_points"_a = 50, "turning_share"_a = 0.0,
                    "Several airfoils in one far field. Each element is a dict: name, airfoil, and where it "
                    "lies: chord, rotation (degrees, counter-clockwise), position (of its leading edge). "
                    "turning_share as for Domain(): designs of one mesh keep 0, or one domain and "
                    "with_coefficients().");
  domain.def_static(
      "from_json", [](const std::string& text) { return domain_from_json(text, "text"); }, "text"_a);
  domain.def("to_json", &domain_to_json, "The domain as JSON text, exact.");
  domain.def_property_readonly(
      "coefficients", [](const Domain& d) { return copied(coefficients_of(d)); },
      "All numbers that its points depend on, loop by loop: those of each curve, then chord, rotation and "
      "position (include/remodel/mesh_derivative.h).");
  domain.def(
      "with_coefficients",
      [](const Domain& d, const Reals& values) {
        return with_coefficients(d, reals(values, "coefficients"));
      },
      "coefficients"_a, "The same domain with other numbers, in the order of `coefficients`.");
  domain.def("airfoil", &airfoil_of, "boundary"_a = "",
             "The airfoil by coefficients of that name, or the only one there is. Raises ArgumentError.");
  domain.def(
      "validate", [](const Domain& d) { validate(d); },
      "Raises GeometryError unless the domain can be meshed.");
  domain.def_property_readonly("loops", &loop_points,
                               "The stations of each loop, of shape (n, 2), by the name of its first curve.");
  domain.def(py::self == py::self);
  domain.def("__repr__",
             [](const Domain& d) { return "Domain(" + std::to_string(d.loops.size()) + " loops)"; });
  domain.def(py::pickle([](const Domain& d) { return py::make_tuple(domain_to_json(d)); },
                        [](const py::tuple& state) { return domain_from_json(text_in(state), "pickle"); }));
}

}  // namespace

std::vector<std::size_t> airfoil_loops(const Domain& domain, const std::string& name) {
  std::vector<std::size_t> loops;
  for (std::size_t i = 0; i < domain.loops.size(); ++i) {
    const std::vector<Curve>& curves = domain.loops[i].curves;
    if (!curves.empty() && std::holds_alternative<CstAirfoil>(curves.front().shape) &&
        (name.empty() || curves.front().name == name))
      loops.push_back(i);
  }
  return loops;
}

void warn(const std::vector<std::string>& sentences) {
  // Level 2: of whoever called the function of remodel/_calls.py that stands before every call.
  for (const std::string& sentence : sentences)
    if (PyErr_WarnEx(PyExc_UserWarning, sentence.c_str(), 2) < 0) throw py::error_already_set();
}

std::string name_of_shape(const py::object& shape) {
  if (!py::isinstance<py::str>(shape) && !py::hasattr(shape, "__fspath__"))
    throw py::type_error("shape: found " + type_of(shape) +
                         ", expected an Airfoil, a Domain, or the name of an airfoil or a file");
  const std::string name = shape.cast<std::filesystem::path>().string();
  if (name == standard_input)
    throw Error(ErrorCode::argument, "shape", "found '-', expected a name or a file");
  return name;
}

ShapesDomain domain_of(const py::object& shape, const AirfoilDomainOptions& options,
                       const ShapeReading& reading) {
  if (py::isinstance<Domain>(shape)) return {.domain = shape.cast<Domain>()};
  if (py::isinstance<CstAirfoil>(shape))
    return {.domain = airfoil_domain(shape.cast<const CstAirfoil&>(), options), .in_farfield = true};
  ShapesDomain result = domain_of_shapes({{.shape = name_of_shape(shape)}}, options, reading);
  warn(result.warnings);
  return result;
}

void add_shapes(py::module_& module) {
  add_airfoil(module);
  add_domain(module);
}

}  // namespace remodel::python
