#include "pickles.h"

namespace remodel::python {
namespace {

// visit(key, member) for every array and number but those that Python has to convert otherwise.
template <class State, class Visit>
void each_member(State& s, Visit&& visit) {
  visit("coordinates", s.coordinates);
  visit("length_scales", s.length_scales);
  visit("vertex_stars", s.vertex_stars);
  visit("vertex_generations", s.vertex_generations);
  visit("vertex_curves", s.vertex_curves);
  visit("vertex_parameters", s.vertex_parameters);
  visit("vertex_scale_factors", s.vertex_scale_factors);
  visit("triangle_vertices", s.triangle_vertices);
  visit("triangle_links", s.triangle_links);
  visit("triangle_regions", s.triangle_regions);
  visit("triangle_births", s.triangle_births);
  visit("free_vertices", s.free_vertices);
  visit("free_triangles", s.free_triangles);
  visit("step", s.step);
  visit("keep", s.keep);
  visit("stopped", s.stopped);
  visit("min_angle_deg", s.options.min_angle_deg);
  visit("max_gradation", s.options.max_gradation);
  visit("gradation", s.options.gradation);
  visit("resolution", s.options.resolution);
  visit("max_vertices", s.options.max_vertices);
  visit("min_edge", s.options.min_edge);
  visit("refine_angle_deg", s.options.refine_angle_deg);
  visit("count_factor", s.renewal.count_factor);
  visit("full_adjustments", s.renewal.full_adjustments);
  visit("sampled_at", s.renewal.sampled_at);
  visit("samplings", s.renewal.samplings);
  visit("until_renewal", s.renewal.until_renewal);
  visit("until_shed", s.renewal.until_shed);
  visit("pending_vertices", s.renewal.pending_vertices);
  visit("pending_loops", s.renewal.pending_loops);
  visit("import_slots", s.imported.slots);
  visit("import_faces", s.imported.faces);
  visit("import_triangles", s.imported.triangles);
}

// The reference of a mesh that is held, which other meshes and pickles of earlier versions do not have.
template <class State, class Visit>
void each_member_of_reference(State& s, Visit&& visit) {
  visit("reference_coordinates", s.reference_coordinates);
  visit("reference_length_scales", s.reference_length_scales);
  visit("delaunay_slack_deg", s.delaunay_slack_deg);
}

template <class T>
py::object to_python(const std::vector<T>& values) {
  return copied(values);
}
template <class T>
py::object to_python(T value) {
  return py::cast(value);
}

template <class T>
void from_python(const py::handle& object, std::vector<T>& values) {
  const auto array = object.cast<py::array_t<T, py::array::c_style>>();
  if (array.ndim() != 1) throw py::value_error("an array of one dimension");
  values.assign(array.data(), array.data() + array.size());
}
void from_python(const py::handle& object, std::vector<std::string>& values) {
  values = object.cast<std::vector<std::string>>();
}
template <class T>
void from_python(const py::handle& object, T& value) {
  value = object.cast<T>();
}

}  // namespace

py::dict dict_of(const MeshState& state) {
  py::dict result;
  each_member(state, [&](const char* key, const auto& member) { result[key] = to_python(member); });
  result["markers"] = state.imported.markers;
  result["domain"] = domain_to_json(state.domain);
  if (!state.reference_coordinates.empty()) {
    each_member_of_reference(state,
                             [&](const char* key, const auto& member) { result[key] = to_python(member); });
    result["reference_domain"] = domain_to_json(state.reference_domain);
  }
  return result;
}

MeshState state_of(const py::dict& dict) {
  MeshState state;
  const auto read = [&](const char* key, auto& member) {
    read_member(dict, key, [&](const py::handle& object) { from_python(object, member); });
  };
  each_member(state, read);
  read("markers", state.imported.markers);
  const auto read_domain = [&](const char* key) {
    std::string domain;
    read(key, domain);
    return domain_from_json(domain, "pickle");
  };
  state.domain = read_domain("domain");
  if (dict.contains("reference_coordinates")) {
    each_member_of_reference(state, read);
    state.reference_domain = read_domain("reference_domain");
  }
  return state;
}

}  // namespace remodel::python
