#include "shape_input.h"

#include <filesystem>

namespace remodel::app {

CstFit fit_shape(const std::string& shape, int degree) {
  const CstAirfoil airfoil = load_airfoil(shape, degree);
  for (const CatalogueEntry& entry : airfoil_catalogue()) {
    // A file may have an entry's name; then it is the file that was loaded.
    if (entry.name == shape && entry.airfoil() == airfoil) {
      return {airfoil, entry.fit_max_error, entry.fit_rms_error};
    }
  }
  const std::string naca = "naca:";
  if (shape.starts_with(naca)) return fit_cst(naca_airfoil(shape.substr(naca.size())), degree);
  if (std::filesystem::path(shape).extension() == ".json") return {.airfoil = airfoil};
  return fit_cst(read_airfoil(shape), degree);
}

}  // namespace remodel::app
