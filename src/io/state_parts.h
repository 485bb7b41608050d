#pragma once

// The numbers and arrays of a mesh's state by name: visit(name, value), visit(name, values, values an
// element).

#include "remodel/mesh_state.h"

namespace remodel::io {

template <class State, class Visitor>
void for_each_state_array(State& state, Visitor&& visit) {
  visit("coordinates", state.coordinates, 2);
  visit("length_scales", state.length_scales, 1);
  visit("vertex_stars", state.vertex_stars, 1);
  visit("vertex_generations", state.vertex_generations, 1);
  visit("vertex_curves", state.vertex_curves, 1);
  visit("vertex_parameters", state.vertex_parameters, 1);
  visit("vertex_scale_factors", state.vertex_scale_factors, 1);
  visit("triangle_vertices", state.triangle_vertices, 3);
  visit("triangle_links", state.triangle_links, 3);
  visit("triangle_regions", state.triangle_regions, 1);
  visit("triangle_births", state.triangle_births, 1);
  visit("free_vertices", state.free_vertices, 1);
  visit("free_triangles", state.free_triangles, 1);
  visit("pending_vertices", state.renewal.pending_vertices, 1);
  visit("pending_loops", state.renewal.pending_loops, 1);
  visit("imported_slots", state.imported.slots, 1);
  visit("imported_faces", state.imported.faces, 1);
  visit("imported_triangles", state.imported.triangles, 3);
}

template <class State, class Visitor>
void for_each_state_number(State& state, Visitor&& visit) {
  visit("step", state.step);
  visit("min_angle_deg", state.options.min_angle_deg);
  visit("max_gradation", state.options.max_gradation);
  visit("gradation", state.options.gradation);
  visit("resolution", state.options.resolution);
  visit("max_vertices", state.options.max_vertices);
  visit("min_edge", state.options.min_edge);
  visit("refine_angle_deg", state.options.refine_angle_deg);
  visit("keep", state.keep);
  visit("stopped", state.stopped);
  visit("count_factor", state.renewal.count_factor);
  visit("full_adjustments", state.renewal.full_adjustments);
  visit("sampled_at", state.renewal.sampled_at);
  visit("samplings", state.renewal.samplings);
  visit("until_renewal", state.renewal.until_renewal);
  visit("until_shed", state.renewal.until_shed);
}

// The arrays that a held mesh alone has, in a group of their own.
template <class State, class Visitor>
void for_each_reference_array(State& state, Visitor&& visit) {
  visit("coordinates", state.reference_coordinates, 2);
  visit("length_scales", state.reference_length_scales, 1);
}

}  // namespace remodel::io
