#include "remodel/shape_files.h"

#include "remodel/error.h"
#include "remodel/io.h"

namespace remodel {
namespace {

// Larger files are no airfoils and no designs.
constexpr std::size_t largest_airfoil_file = std::size_t{16} << 20;

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

CstAirfoil load_airfoil(const std::string& shape, int degree, TrailingEdge trailing_edge) {
  if (shape.starts_with("naca:") || !names_a_file(shape)) return named_airfoil(shape, degree);
  const std::filesystem::path file(shape);
  const KeptPipes once;
  if (is_json(file)) return airfoil_from_json(read_text(file, largest_airfoil_file), shape);
  return fit_cst_apart(read_airfoil(file), degree, trailing_edge).airfoil;
}

Domain load_domain(const std::filesystem::path& file) {
  const auto resolve = [directory = file.parent_path()](const std::string& name, int degree,
                                                        TrailingEdge trailing_edge) {
    const std::filesystem::path beside = directory / name;
    std::error_code ignored;
    return load_airfoil(std::filesystem::is_regular_file(beside, ignored) ? beside.string() : name, degree,
                        trailing_edge);
  };
  Domain domain = domain_from_json(read_text(file, largest_airfoil_file), file.string(), resolve);
  validate(domain, file.string());
  return domain;
}

bool holds_domain(const std::filesystem::path& file) {
  return is_json(file) && holds_domain(read_text(file, largest_airfoil_file), file.string());
}

}  // namespace remodel
