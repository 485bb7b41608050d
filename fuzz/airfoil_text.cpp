// Coordinate files of every kind, as surfaces and as outlines.

#include "fuzz.h"
#include "remodel/airfoil.h"

using namespace remodel;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    for (const AirfoilOutline& outline : parse_outlines(fuzz::text_of(data, size), "input").elements)
      fuzz::require(outline.points.size() >= 4 && outline.frame.chord > 0.0, "no outline accepted");
  } catch (const Error&) {
    ++fuzz::refusals;
  }
  try {
    const AirfoilCoordinates coordinates = parse_airfoil(fuzz::text_of(data, size), "input");
    fuzz::require(coordinates.upper.size() >= 3 && coordinates.lower.size() >= 3,
                  "fewer than three points accepted");
    const CstFit fit = fit_cst(coordinates, 2 + static_cast<int>(size % 5));
    surfaces_apart(fit.airfoil);
  } catch (const Error&) {
    ++fuzz::refusals;
  }
  return 0;
}
