// States of living meshes with single values changed: Mesh::restore() refuses them or makes a usable mesh.

#include <bit>

#include "fuzz.h"
#include "remodel/generate.h"
#include "remodel/mesh_state.h"
#include "remodel/remodel.h"

using namespace remodel;

namespace {

Domain design(double factor) {
  CstAirfoil airfoil = airfoil_catalogue().front().airfoil();
  for (double& value : airfoil.upper) value *= factor;
  return airfoil_domain(airfoil, {.points = 12, .farfield_radius = 3, .farfield_points = 8});
}

const MeshState& original() {
  static const MeshState state = [] {
    Mesh mesh = generate(design(1.0), {.gradation = 1.0}).mesh;
    for (const double factor : {1.3, 1.2})  // leaves free slots, and vertices that wait for a renewal
      remodel::remodel(mesh, design(factor), {.strategy = Strategy::renew});
    return mesh.state();
  }();
  return state;
}

template <class Value>
void change(std::vector<Value>& values, fuzz::Bytes& bytes) {
  const unsigned index = bytes.below(65536);
  const unsigned how = bytes.below(4);
  if (how == 3) {
    values.resize(values.empty() ? 1 : values.size() + index % 3 - 1);
    return;
  }
  if (values.empty()) return;
  Value& value = values[index % values.size()];
  if constexpr (std::is_same_v<Value, double>) {
    value = how == 0   ? std::bit_cast<double>(bytes.word())
            : how == 1 ? -value
                       : value * (1.0 + bytes.next() * 1e-3);
  } else {
    value = static_cast<Value>(how == 0   ? bytes.word()
                               : how == 1 ? bytes.next()
                                          : static_cast<std::uint64_t>(value) ^ (1U << bytes.below(32)));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  MeshState state = original();
  fuzz::Bytes bytes(data, size);
  for (int edits = 0; edits < 8 && !bytes.empty(); ++edits) {
    switch (bytes.below(15)) {
      case 0:
        change(state.coordinates, bytes);
        break;
      case 1:
        change(state.length_scales, bytes);
        break;
      case 2:
        change(state.vertex_stars, bytes);
        break;
      case 3:
        change(state.vertex_generations, bytes);
        break;
      case 4:
        change(state.vertex_curves, bytes);
        break;
      case 5:
        change(state.vertex_parameters, bytes);
        break;
      case 6:
        change(state.vertex_scale_factors, bytes);
        break;
      case 7:
        change(state.triangle_vertices, bytes);
        break;
      case 8:
        change(state.triangle_links, bytes);
        break;
      case 9:
        change(state.triangle_regions, bytes);
        break;
      case 10:
        change(state.triangle_births, bytes);
        break;
      case 11:
        change(state.free_vertices, bytes);
        break;
      case 12:
        change(state.free_triangles, bytes);
        break;
      case 13:
        change(state.renewal.pending_vertices, bytes);
        break;
      case 14:
        change(state.renewal.pending_loops, bytes);
        break;
    }
  }
  try {
    Mesh mesh = Mesh::restore(state, "input");
    mesh.freeze();
    mesh.statistics();
    if (mesh.quick_check().empty())
      for (const Strategy strategy : {Strategy::renew, Strategy::chain, Strategy::renew})
        remodel::remodel(mesh, design(strategy == Strategy::chain ? 0.9 : 1.1), {.strategy = strategy});
  } catch (const Error&) {
    ++fuzz::refusals;
  }
  return 0;
}
