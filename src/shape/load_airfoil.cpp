// SHAPE of the command line.

#include <filesystem>

#include "remodel/airfoil.h"
#include "remodel/error.h"
#include "text_file.h"

namespace remodel {
namespace {

constexpr std::string_view naca_prefix = "naca:";

bool names_a_file(const std::string& shape) {
  if (shape.find_first_of("/.") != std::string::npos) return true;
  std::error_code ignored;
  return std::filesystem::exists(shape, ignored) && !std::filesystem::is_directory(shape, ignored);
}

CstAirfoil airfoil_of_file(const std::string& shape, int degree) {
  const std::filesystem::path file(shape);
  if (file.extension() == ".json") return airfoil_from_json(read_text_file(file), shape);
  return fit_cst(read_airfoil(file), degree).airfoil;
}

CstAirfoil airfoil_of_catalogue(const std::string& name) {
  std::string names;
  for (const CatalogueEntry& entry : airfoil_catalogue()) {
    if (entry.name == name) return entry.airfoil();
    names.append(" ").append(entry.name);
  }
  throw Error(ErrorCode::argument, "shape",
              "found \"" + name + "\", expected a file, naca:DIGITS or one of" + names);
}

}  // namespace

CstAirfoil load_airfoil(const std::string& shape, int degree) {
  if (shape.starts_with(naca_prefix)) {
    return fit_cst(naca_airfoil(std::string_view(shape).substr(naca_prefix.size())), degree).airfoil;
  }
  return names_a_file(shape) ? airfoil_of_file(shape, degree) : airfoil_of_catalogue(shape);
}

}  // namespace remodel
