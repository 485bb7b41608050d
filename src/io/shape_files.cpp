#include "remodel/shape_files.h"

#include <algorithm>
#include <cmath>

#include "remodel/error.h"
#include "remodel/io.h"

namespace remodel {
namespace {

// Larger files are no airfoils and no designs.
constexpr std::size_t largest_airfoil_file = std::size_t{16} << 20;

constexpr std::string_view naca_prefix = "naca:";

// Of the catalogue's own fit, and of a lower degree's to that.
void add_errors(const CatalogueEntry& entry, CstFit& fit) {
  fit.max_error = entry.fit_max_error, fit.rms_error = entry.fit_rms_error;
  if (fit.airfoil.degree() >= entry.degree) return;
  constexpr int stations = 400;
  double largest = 0.0, squares = 0.0;
  const CstAirfoil own = entry.airfoil();
  for (int i = 0; i <= stations; ++i) {
    const double t = static_cast<double>(i) / stations, off = fit.airfoil.at(t).y - own.at(t).y;
    largest = std::max(largest, std::abs(off)), squares += off * off;
  }
  fit.max_error += largest;
  fit.rms_error = std::hypot(fit.rms_error, std::sqrt(squares / (stations + 1)));
}

// By extension, or what comes through a pipe without one by its content.
bool is_json(const std::filesystem::path& file) {
  if (file.has_extension() || !is_pipe(file)) return file.extension() == ".json";
  const std::string text = read_text(file, largest_airfoil_file);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != text.npos && text[first] == '{';
}

bool names_a_file(const std::string& shape) {
  if (shape == standard_input) return true;
  if (shape.find_first_of("/.") != std::string::npos) return true;
  std::error_code ignored;
  return std::filesystem::exists(shape, ignored) && !std::filesystem::is_directory(shape, ignored);
}

}  // namespace

AirfoilCoordinates read_airfoil(const std::filesystem::path& file) {
  return parse_airfoil(read_text(file, largest_airfoil_file), file.string());
}

bool lies_in_chords(const AirfoilFrame& frame) {
  constexpr double near_origin = 0.1, near_one = 0.25;
  return std::abs(frame.chord - 1.0) <= near_one && std::abs(frame.nose.x) <= near_origin &&
         std::abs(frame.nose.y) <= near_origin;
}

std::vector<Point> moved_to_origin(const AirfoilOutline& outline) {
  std::vector<Point> points;
  for (const Point p : outline.points)
    points.push_back((1.0 / outline.frame.chord) * (p - outline.frame.nose));
  return points;
}

AirfoilOutlines read_outlines(const std::filesystem::path& file) {
  return parse_outlines(read_text(file, largest_airfoil_file), file.string());
}

bool is_coordinate_file(const std::string& shape) {
  return !shape.starts_with(naca_prefix) && names_a_file(shape) && !is_json(shape);
}

CstFit load_fit(const std::string& shape, int degree, TrailingEdge trailing_edge) {
  if (shape.starts_with(naca_prefix)) return fit_cst(naca_airfoil(shape.substr(naca_prefix.size())), degree);
  if (!names_a_file(shape)) {
    CstFit fit{.airfoil = named_airfoil(shape, degree)};
    for (const CatalogueEntry& entry : airfoil_catalogue())
      if (entry.name == shape) add_errors(entry, fit);
    return fit;
  }
  const std::filesystem::path file(shape);
  const KeptPipes once;
  if (is_json(file)) return {.airfoil = airfoil_from_json(read_text(file, largest_airfoil_file), shape)};
  AirfoilCoordinates coordinates = read_airfoil(file);
  coordinates.name = shape;  // for messages
  return fit_cst_apart(coordinates, degree, trailing_edge);
}

CstAirfoil load_airfoil(const std::string& shape, int degree, TrailingEdge trailing_edge) {
  return load_fit(shape, degree, trailing_edge).airfoil;
}

Domain load_domain(const std::filesystem::path& file, double join, Joins* joins,
                   std::vector<std::string>* warnings) {
  const auto resolve = [warnings, directory = file.parent_path()](const std::string& name, int degree,
                                                                  TrailingEdge trailing_edge) {
    const std::filesystem::path beside = directory / name;
    std::error_code ignored;
    const CstFit fit = load_fit(std::filesystem::is_regular_file(beside, ignored) ? beside.string() : name,
                                degree, trailing_edge);
    if (warnings != nullptr) warnings->insert(warnings->end(), fit.warnings.begin(), fit.warnings.end());
    return fit.airfoil;
  };
  Domain domain = domain_from_json(read_text(file, largest_airfoil_file), file.string(), resolve);
  const Joins found = join_ends(domain, file.string(), join);
  if (joins != nullptr) *joins = found;
  validate(domain, file.string());
  return domain;
}

bool holds_domain(const std::filesystem::path& file) {
  return is_json(file) && holds_domain(read_text(file, largest_airfoil_file), file.string());
}

}  // namespace remodel
