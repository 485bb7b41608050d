// SU2 meshes imported as living meshes, their quadrilaterals split, and remodelled if they have an airfoil.

#include "remodel/import.h"
#include "fuzz.h"
#include "io/formats.h"
#include "remodel/remodel.h"

using namespace remodel;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const FrozenMesh mesh = io::parse_su2(fuzz::text_of(data, size), "input");
    if (mesh.cell_count() > 256) return 0;
    for (const NonDelaunay what : {NonDelaunay::flip, NonDelaunay::keep}) {
      ImportResult imported = import_mesh(
          mesh, "input", {.non_delaunay = what, .max_vertices = 5000, .layers = FlatLayers::dissolve});
      fuzz::require_empty(imported.mesh.quick_check());
      fuzz::require(check(imported.mesh.freeze(), {.delaunay = false}).valid, "an import is not valid");
      const AirfoilPlace place = find_airfoil(imported.mesh.domain(), "airfoil", "input");
      remodel::remodel(imported.mesh,
                       with_airfoil(imported.mesh.domain(), place, airfoil_catalogue()[0].airfoil()));
      fuzz::require(check(imported.mesh.freeze(), {.delaunay = false}).valid, "an update is not valid");
    }
  } catch (const Error&) {
    ++fuzz::refusals;
  }
  return 0;
}
