#include "shape_input.h"

namespace remodel::app {

CstFit fit_shape(const std::string& shape, int degree) {
  for (const CatalogueEntry& entry : airfoil_catalogue()) {
    if (entry.name == shape) return {entry.airfoil(), entry.fit_max_error, entry.fit_rms_error};
  }
  const std::string naca = "naca:";
  if (shape.starts_with(naca)) return fit_cst(naca_airfoil(shape.substr(naca.size())), degree);
  if (shape.ends_with(".json")) return {.airfoil = load_airfoil(shape, degree)};
  return fit_cst(read_airfoil(shape), degree);
}

}  // namespace remodel::app
