// Sections by name: the catalogue's, and NACA designations.

#include "fit_degree.h"
#include "remodel/airfoil_degree.h"
#include "remodel/error.h"

namespace remodel {
CstAirfoil named_airfoil(const std::string& name, int degree) {
  constexpr std::string_view naca_prefix = "naca:";
  if (name.starts_with(naca_prefix))
    return fit_cst(naca_airfoil(std::string_view(name).substr(naca_prefix.size())), degree).airfoil;
  std::string names;
  for (const CatalogueEntry& entry : airfoil_catalogue()) {
    if (entry.name == name) {
      require_fit_degree(degree);
      CstAirfoil airfoil = with_degree(entry.airfoil(), degree);
      while (!surfaces_apart(airfoil)) airfoil = with_degree(entry.airfoil(), ++degree);
      return airfoil;
    }
    names.append(" ").append(entry.name);
  }
  throw Error(ErrorCode::argument, "shape",
              "found \"" + name + "\", expected a file, naca:DIGITS or one of" + names);
}

}  // namespace remodel
