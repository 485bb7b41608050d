// CST coefficients as JSON, there and back.

#include "fuzz.h"
#include "remodel/airfoil.h"

using namespace remodel;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const CstAirfoil airfoil = airfoil_from_json(fuzz::text_of(data, size), "input");
    fuzz::require(airfoil_from_json(airfoil_to_json(airfoil), "again") == airfoil, "JSON is not exact");
    if (surfaces_apart(airfoil)) max_thickness(airfoil);
  } catch (const Error&) {
    ++fuzz::refusals;
  }
  return 0;
}
