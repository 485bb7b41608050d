// A living mesh to plain arrays and back.

#include <algorithm>

#include "mesh/mesh_data.h"
#include "remodel/error.h"
#include "triangulation/state.h"

namespace remodel {

MeshState Mesh::state() const {
  const TriangulationState from = TriangulationState::of(data_->triangulation);
  MeshState to;
  for (const Vertex& v : from.vertices) {
    to.coordinates.insert(to.coordinates.end(), {v.point.x, v.point.y});
    to.length_scales.push_back(v.length_scale);
    to.vertex_stars.push_back(v.star.bits);
    const BoundaryVertex* boundary = v.alive() && v.boundary != no_index ? &data_->at(v.boundary) : nullptr;
    to.vertex_curves.push_back(boundary != nullptr ? static_cast<std::int32_t>(boundary->curve) : -1);
    to.vertex_parameters.push_back(boundary != nullptr ? boundary->t : 0.0);
    to.vertex_scale_factors.push_back(boundary != nullptr ? boundary->scale_factor : 0.0);
  }
  to.vertex_generations = from.generations;
  for (const Triangle& t : from.triangles) {
    for (int i = 0; i < 3; ++i) {
      to.triangle_vertices.push_back(t.vertex[i].index);
      to.triangle_links.push_back(t.link[i].bits);
    }
    to.triangle_regions.push_back(static_cast<std::uint32_t>(t.region));
    to.triangle_births.push_back(t.birth);
  }
  to.free_vertices = from.free_vertices;
  to.free_triangles = from.free_triangles;
  to.step = data_->step;
  to.domain = data_->domain;
  to.options = data_->options;
  to.imported = data_->imported;
  return to;
}

namespace {

[[noreturn]] void refuse(const std::string& source, const std::string& problem) {
  throw Error(ErrorCode::format, source, "not the state of a mesh: " + problem);
}

TriangulationState unpack(const MeshState& state, const std::string& source) {
  const std::size_t vertices = state.vertex_stars.size(), triangles = state.triangle_regions.size();
  if (state.coordinates.size() != 2 * vertices || state.length_scales.size() != vertices ||
      state.vertex_generations.size() != vertices || state.vertex_curves.size() != vertices ||
      state.vertex_parameters.size() != vertices || state.vertex_scale_factors.size() != vertices)
    refuse(source, "vertex arrays differ in length");
  if (state.triangle_vertices.size() != 3 * triangles || state.triangle_links.size() != 3 * triangles ||
      state.triangle_births.size() != triangles)
    refuse(source, "triangle arrays differ in length");
  TriangulationState to;
  to.vertices.resize(vertices);
  for (std::size_t i = 0; i < vertices; ++i) {
    to.vertices[i].point = {state.coordinates[2 * i], state.coordinates[2 * i + 1]};
    to.vertices[i].length_scale = state.length_scales[i];
    to.vertices[i].star.bits = state.vertex_stars[i];
  }
  to.generations = state.vertex_generations;
  to.triangles.resize(triangles);
  for (std::size_t i = 0; i < triangles; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      to.triangles[i].vertex[k] = VertexId{state.triangle_vertices[3 * i + k]};
      to.triangles[i].link[k].bits = state.triangle_links[3 * i + k];
    }
    if (state.triangle_regions[i] > 1)
      refuse(source, "triangle " + std::to_string(i) + " has an unknown region");
    to.triangles[i].region = static_cast<Region>(state.triangle_regions[i]);
    to.triangles[i].birth = state.triangle_births[i];
  }
  to.free_vertices = state.free_vertices;
  to.free_triangles = state.free_triangles;
  return to;
}

// The boundary table: the vertices of each loop in the order of curve and parameter.
void restore_boundary(MeshData& mesh, const MeshState& state, const std::string& source) {
  struct Entry {
    std::uint32_t curve;
    double t;
    std::uint32_t vertex;
  };
  std::vector<Entry> entries;
  for (std::uint32_t i = 1; i < state.vertex_curves.size(); ++i) {
    if (state.vertex_curves[i] < 0) continue;
    if (static_cast<std::size_t>(state.vertex_curves[i]) >= mesh.domain.curve_count())
      refuse(source, "vertex " + std::to_string(i) + " lies on an unknown curve");
    entries.push_back({static_cast<std::uint32_t>(state.vertex_curves[i]), state.vertex_parameters[i], i});
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.curve != b.curve ? a.curve < b.curve : a.t < b.t;
  });
  std::uint32_t previous = no_index;
  std::size_t loop = no_index;
  for (const Entry& entry : entries) {
    const bool new_loop = mesh.domain.loop_of(entry.curve) != loop;
    loop = mesh.domain.loop_of(entry.curve);
    const auto& parameters = mesh.domain.curve(entry.curve).parameters;
    const bool steiner = !std::binary_search(parameters.begin(), parameters.end(), entry.t);
    const BoundaryVertex vertex{.vertex = VertexId{entry.vertex},
                                .curve = entry.curve,
                                .t = entry.t,
                                .steiner = steiner,
                                .scale_factor = state.vertex_scale_factors[entry.vertex]};
    previous = mesh.add_boundary_vertex(vertex, new_loop ? no_index : previous);
    if (new_loop) mesh.loop_heads.push_back(previous);
  }
  if (mesh.loop_heads.size() != mesh.domain.loops.size())
    refuse(source, "a loop of the design has no vertices");
  mesh.orient_loops();
}

void require_in_range(const ImportRecord& record, const MeshState& state, const std::string& source) {
  const std::size_t slots = state.triangle_regions.size(), vertices = state.vertex_stars.size();
  const auto below = [](std::size_t end) { return [end](std::uint32_t i) { return i < end; }; };
  if (record.faces.size() != record.slots.size() || record.triangles.size() != 3 * record.slots.size() ||
      !std::all_of(record.slots.begin(), record.slots.end(), below(slots)) ||
      !std::all_of(record.triangles.begin(), record.triangles.end(), below(vertices)) ||
      !std::is_sorted(record.faces.begin(), record.faces.end()))
    refuse(source, "what it remembers of the imported file does not fit the mesh");
}

}  // namespace

Mesh Mesh::restore(const MeshState& state, const std::string& source) {
  Mesh mesh;
  MeshData& data = *mesh.data_;
  data.domain = state.domain;
  data.options = state.options;
  data.step = state.step;
  require_in_range(state.imported, state, source);
  data.imported = state.imported;
  if (std::string broken = unpack(state, source).restore(data.triangulation); !broken.empty())
    refuse(source, broken);
  restore_boundary(data, state, source);
  data.count_domain_triangles();
  if (std::string broken = check_boundary(data); !broken.empty()) refuse(source, broken);
  return mesh;
}

}  // namespace remodel
