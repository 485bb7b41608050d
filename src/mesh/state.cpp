// A living mesh to plain arrays and back.

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "mesh/mesh_data.h"
#include "mesh/option_ranges.h"
#include "mesh/renew_policy.h"
#include "remodel/error.h"
#include "triangulation/state.h"

namespace remodel {

MeshState Mesh::state() const {
  const TriangulationState from = TriangulationState::of(data().triangulation);
  MeshState to;
  for (const Vertex& v : from.vertices) {
    to.coordinates.insert(to.coordinates.end(), {v.point.x, v.point.y});
    to.length_scales.push_back(v.length_scale);
    to.vertex_stars.push_back(v.star.bits);
    const BoundaryVertex* boundary = v.alive() && v.boundary != no_index ? &data().at(v.boundary) : nullptr;
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
  to.step = data().step;
  to.domain = data().domain;
  to.options = data().options;
  to.keep = data().keep;
  to.stopped = static_cast<std::uint32_t>(data().stopped);
  to.renewal = data().renewal;
  to.imported = data().imported;
  if (const auto& reference = data().reference) {
    for (const Point p : reference->points)
      to.reference_coordinates.insert(to.reference_coordinates.end(), {p.x, p.y});
    to.reference_length_scales = reference->length_scales;
    to.reference_domain = reference->domain;
    to.delaunay_slack_deg = data().delaunay_slack_deg;
  }
  return to;
}

namespace {

[[noreturn]] void refuse(const std::string& source, const std::string& problem) {
  throw Error(ErrorCode::format, source, "not the state of a mesh: " + problem);
}

bool is_scale(double value) {
  return std::isfinite(value) && value > 0.0;
}

void require_length_scales(const Triangulation& triangulation, const std::string& source) {
  for (std::uint32_t i = 1; i < triangulation.vertex_slots(); ++i)
    if (const Vertex& vertex = triangulation[VertexId{i}]; vertex.alive() && !is_scale(vertex.length_scale))
      refuse(source, "vertex " + std::to_string(i) + " has no positive length scale");
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

class BoundaryRestorer {
 public:
  BoundaryRestorer(MeshData& mesh, const MeshState& state, const std::string& source)
      : mesh_(mesh), state_(state), source_(source), entries_(mesh.domain.curve_count()) {}

  void run() {
    collect();
    if (joined()) collect_joined();
    for (std::size_t loop = 0, curve = 0; loop < mesh_.domain.loops.size(); ++loop) {
      add_loop(loop, curve);
      curve += mesh_.domain.loops[loop].curves.size();
    }
    mesh_.orient_loops();
  }

 private:
  struct Entry {
    double t;
    std::uint32_t vertex;
    friend bool operator<(const Entry& a, const Entry& b) { return a.t < b.t; }
  };

  // The vertices of each curve in the order of their parameters.
  void collect() {
    for (std::uint32_t i = 1; i < state_.vertex_curves.size(); ++i) {
      const std::int32_t curve = state_.vertex_curves[i];
      if (curve < 0) continue;
      if (static_cast<std::size_t>(curve) >= entries_.size())
        refuse(source_, "vertex " + std::to_string(i) + " lies on an unknown curve");
      if (!(state_.vertex_parameters[i] >= 0.0 && state_.vertex_parameters[i] <= 1.0))
        refuse(source_, "vertex " + std::to_string(i) + " has a parameter outside of 0 to 1");
      entries_[static_cast<std::size_t>(curve)].push_back({state_.vertex_parameters[i], i});
    }
    for (auto& entries : entries_) std::sort(entries.begin(), entries.end());
  }

  bool joined() const {
    return std::any_of(mesh_.domain.loops.begin(), mesh_.domain.loops.end(),
                       [](const Loop& loop) { return loop.open; });
  }

  // A vertex where chains join is recorded for the first of its loops only: the others have a station there.
  void collect_joined() {
    std::map<std::pair<double, double>, std::uint32_t> vertex_at;
    for (const auto& entries : entries_)
      for (const Entry& entry : entries)
        vertex_at[{state_.coordinates[2 * entry.vertex], state_.coordinates[2 * entry.vertex + 1]}] =
            entry.vertex;
    for (std::size_t loop = 0; loop < mesh_.domain.loops.size(); ++loop) {
      const std::vector<BoundaryStation> stations = mesh_.domain.stations(loop);
      const std::vector<Point> points = mesh_.domain.points(loop);
      for (std::size_t i = 0; i < stations.size(); ++i) {
        auto& entries = entries_[stations[i].curve];
        const Entry wanted{stations[i].t, 0};
        if (std::binary_search(entries.begin(), entries.end(), wanted)) continue;
        const auto found = vertex_at.find({points[i].x, points[i].y});
        if (found == vertex_at.end()) refuse(source_, "a station of the design has no vertex");
        entries.insert(std::lower_bound(entries.begin(), entries.end(), wanted),
                       {stations[i].t, found->second});
      }
    }
  }

  void add_loop(std::size_t loop, std::size_t first_curve) {
    const std::vector<Curve>& curves = mesh_.domain.loops[loop].curves;
    std::uint32_t head = no_index, previous = no_index;
    for (std::size_t c = 0; c < curves.size(); ++c)
      for (const Entry& entry : entries_[first_curve + c]) {
        const auto& parameters = curves[c].parameters;
        const bool station = std::binary_search(parameters.begin(), parameters.end(), entry.t) ||
                             (entry.t == 1.0 && mesh_.domain.loops[loop].open && c + 1 == curves.size());
        if (!is_scale(state_.vertex_scale_factors[entry.vertex]))
          refuse(source_, "vertex " + std::to_string(entry.vertex) +
                              " of the boundary has no positive factor of its length scale");
        previous = mesh_.add_boundary_vertex({.vertex = VertexId{entry.vertex},
                                              .curve = static_cast<std::uint32_t>(first_curve + c),
                                              .t = entry.t,
                                              .steiner = !station,
                                              .scale_factor = state_.vertex_scale_factors[entry.vertex]},
                                             previous);
        if (head == no_index) mesh_.loop_heads.push_back(head = previous);
        if (state_.vertex_curves[entry.vertex] == static_cast<std::int32_t>(first_curve + c) &&
            state_.vertex_parameters[entry.vertex] == entry.t)
          mesh_.triangulation.set_boundary(VertexId{entry.vertex}, previous);
      }
    if (head == no_index) refuse(source_, "a loop of the design has no vertices");
    if (mesh_.boundary[head].steiner || (mesh_.domain.loops[loop].open && mesh_.boundary[previous].steiner))
      refuse(source_, "a loop of the design has no first or no last station");
    if (!mesh_.domain.loops[loop].open) mesh_.close_loop(head, previous);
  }

  MeshData& mesh_;
  const MeshState& state_;
  const std::string& source_;
  std::vector<std::vector<Entry>> entries_;  // per curve
};

bool all_below(const std::vector<std::uint32_t>& values, std::size_t end) {
  return std::all_of(values.begin(), values.end(), [end](std::uint32_t i) { return i < end; });
}

void require_domain(const Domain& domain, const std::string& source) {
  try {
    validate(domain);
  } catch (const Error& error) {
    refuse(source, error.what());
  }
}

// Beyond these numbers a count would begin anew, or has no meaning.
constexpr std::uint32_t last_step = 4'000'000'000;
constexpr double largest_count_factor = 1e12;

void require_in_range(const MeshState& state, const std::string& source) {
  const std::size_t slots = state.triangle_regions.size(), vertices = state.vertex_stars.size();
  const ImportRecord& record = state.imported;
  if (record.faces.size() != record.slots.size() || record.triangles.size() != 3 * record.slots.size() ||
      !all_below(record.slots, slots) || !all_below(record.triangles, vertices) ||
      !std::is_sorted(record.faces.begin(), record.faces.end()))
    refuse(source, "what it remembers of the imported file does not fit the mesh");
  for (const auto& found : {out_of_range(state.options), keep_out_of_range(state.keep)})
    if (found) refuse(source, std::string(found->option) + ": " + found->problem);
  if (state.step > last_step)
    refuse(source, "step " + std::to_string(state.step) + ", expected at most " + std::to_string(last_step));
  for (std::size_t i = 0; i < slots; ++i)
    if (state.triangle_births[i] > state.step && state.triangle_vertices[3 * i] != no_index)
      refuse(source, "triangle " + std::to_string(i) + " of step " +
                         std::to_string(state.triangle_births[i]) + " in a mesh of step " +
                         std::to_string(state.step));
  for (const std::uint32_t generation : state.vertex_generations)
    if (generation > last_step)
      refuse(source, "a vertex of generation " + std::to_string(generation) + ", expected at most " +
                         std::to_string(last_step));
  if (state.stopped > static_cast<std::uint32_t>(Stopped::minimum_edge))
    refuse(source, "refinement ended for reason " + std::to_string(state.stopped) + ", expected 0 to 2");
  const RenewalState& renewal = state.renewal;
  if (!(renewal.count_factor >= 0.0 && renewal.count_factor <= largest_count_factor) ||
      renewal.until_shed > RenewPolicy::replacements_that_shed ||
      renewal.until_renewal > RenewPolicy::replacements_between_renewals)
    refuse(source, "what it remembers of its triangle count and of the next renewal is out of range");
  const auto& pending = renewal.pending_loops;
  if (!all_below(renewal.pending_vertices, vertices) ||
      std::count(renewal.pending_vertices.begin(), renewal.pending_vertices.end(), 0U) != 0 ||
      !all_below(pending, state.domain.loops.size()) ||
      !std::is_sorted(pending.begin(), pending.end(), std::less_equal<>()))
    refuse(source, "what the renewal of length scales has to look at does not fit the mesh");
}

void require_reference_in_range(const MeshState& state, const std::string& source) {
  if (state.reference_coordinates.size() != state.coordinates.size() ||
      state.reference_length_scales.size() != state.length_scales.size())
    refuse(source, "its reference's vertices and its own differ in number");
  if (const auto found = slack_out_of_range(state.delaunay_slack_deg))
    refuse(source, std::string(found->option) + ": " + found->problem);
  const std::vector<Loop>&loops = state.domain.loops, &reference = state.reference_domain.loops;
  bool same = loops.size() == reference.size();
  for (std::size_t i = 0; same && i < loops.size(); ++i) same = one_to_one(reference[i], loops[i]);
  if (!same) refuse(source, "its reference is of another domain");
  require_domain(state.domain, source);
}

// The mesh is its reference: puts its vertices to their places on the design.
void put_held(MeshData& mesh, const MeshState& state, const std::string& source) {
  auto reference = std::make_shared<MeshReference>();
  for (std::uint32_t i = 0; i < mesh.triangulation.vertex_slots(); ++i) {
    const Vertex& vertex = mesh.triangulation[VertexId{i}];
    reference->points.push_back(vertex.point);
    reference->length_scales.push_back(vertex.length_scale);
  }
  reference->domain = std::exchange(mesh.domain, state.domain);
  mesh.reference = std::move(reference);
  mesh.delaunay_slack_deg = state.delaunay_slack_deg;
  mesh.forget_extent();
  Triangulation& triangulation = mesh.triangulation;
  for (std::uint32_t i = 1; i < triangulation.vertex_slots(); ++i) {
    const Point p{state.coordinates[2 * i], state.coordinates[2 * i + 1]};
    if (!triangulation[VertexId{i}].alive()) continue;
    if (!(std::abs(p.x) <= largest_coordinate && std::abs(p.y) <= largest_coordinate))
      refuse(source, "a coordinate is not finite, or beyond 1e60");
    triangulation.move(VertexId{i}, p, state.length_scales[i]);
  }
  for (std::uint32_t i = 0; i < triangulation.triangle_slots(); ++i) {
    const Triangle& t = triangulation[TriangleId{i}];
    if (t.alive() && !t.ghost()) triangulation.refresh_circle(TriangleId{i});
  }
  require_length_scales(triangulation, source);
}

}  // namespace

Mesh Mesh::restore(const MeshState& state, const std::string& source) {
  if (!state.reference_coordinates.empty()) {
    require_reference_in_range(state, source);
    MeshState reference = state;
    reference.coordinates = std::exchange(reference.reference_coordinates, {});
    reference.length_scales = state.reference_length_scales;
    reference.domain = state.reference_domain;
    Mesh mesh = restore(reference, source);
    put_held(mesh.data(), state, source);
    if (std::string broken = check_boundary(mesh.data()); !broken.empty()) refuse(source, broken);
    return mesh;
  }
  Mesh mesh;
  MeshData& data = *mesh.data_;
  require_domain(state.domain, source);
  data.domain = state.domain;
  data.options = state.options;
  data.step = state.step;
  data.keep = state.keep;
  data.stopped = static_cast<Stopped>(state.stopped);
  data.renewal = state.renewal;
  const TriangulationState triangulation = unpack(state, source);  // the arrays fit each other
  require_in_range(state, source);
  data.imported = state.imported;
  if (std::string broken = triangulation.restore(data.triangulation); !broken.empty()) refuse(source, broken);
  require_length_scales(data.triangulation, source);
  data.index_curves();
  BoundaryRestorer(data, state, source).run();
  data.domain_triangles = data.count_domain_triangles();
  if (std::string broken = check_boundary(data); !broken.empty()) refuse(source, broken);
  return mesh;
}

}  // namespace remodel
