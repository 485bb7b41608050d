// Sections by name: the catalogue's, and NACA designations.

#include "remodel/airfoil_degree.h"
#include "remodel/error.h"

namespace remodel {
namespace {

// As fit_cst() does, so that all names take the same degrees.
void require_fit_degree(int degree) {
  if (degree < 2 || degree > 12)
    throw Error(ErrorCode::argument, "CST degree", "found " + std::to_string(degree) + ", expected 2 to 12");
}

}  // namespace

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
