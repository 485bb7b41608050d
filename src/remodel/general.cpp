// The general method (the paper's section 3): any closed loops to any closed loops. Loops that are the same
// in both domains, by value, are not touched.

#include <cmath>
#include <limits>
#include <memory>
#include <nanoflann.hpp>

#include "generate/discretise.h"
#include "generate/recovery_error.h"
#include "remodel/methods.h"
#include "remodel/replace.h"

namespace remodel {

namespace {

// The non-Steiner vertices of one model (the loops of one domain that the other does not have), with the two
// boundary neighbours of each.
struct Model {
  std::vector<Point> points, before, after;

  // What nanoflann asks of a point set.
  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return axis == 0 ? points[i].x : points[i].y;
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

void add_loop(Model& model, const Domain& domain, std::size_t loop) {
  const std::vector<BoundaryStation> stations = domain.stations(loop);
  const std::size_t n = stations.size(), first = model.points.size();
  for (const BoundaryStation& station : stations) model.points.push_back(domain.at(station));
  for (std::size_t i = 0; i < n; ++i) {
    model.before.push_back(model.points[first + (i + n - 1) % n]);
    model.after.push_back(model.points[first + (i + 1) % n]);
  }
}

class Nearest {
 public:
  explicit Nearest(const Model& model) : tree_(2, model), empty_(model.points.empty()) {}
  // Infinity if the model has no points.
  double squared_distance_to(Point p) const {
    const double query[2] = {p.x, p.y};
    std::uint32_t index = 0;
    double distance = std::numeric_limits<double>::infinity();
    if (!empty_) tree_.knnSearch(query, 1, &index, &distance);
    return distance;
  }

 private:
  nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Model>, Model, 2> tree_;
  bool empty_;
};

class LoopReplacement {
 public:
  LoopReplacement(MeshData& mesh, const Domain& domain, double distance)
      : mesh_(mesh),
        triangulation_(mesh.triangulation),
        old_domain_(mesh.domain),
        domain_(domain),
        distance_(distance) {}

  void run() {
    match_loops();
    restore_outside(mesh_);
    const std::vector<VertexId> inside = vertices_inside(mesh_, regions());
    release_old();
    for (const VertexId v : inside) triangulation_.remove(v);
    const std::vector<VertexId> old_boundary = forget_old();
    rebuild_table();
    for (const VertexId v : old_boundary)
      if (triangulation_[v].boundary == no_index) triangulation_.remove(v);
    Refiner refiner(mesh_);
    for (const std::size_t loop : new_loops_) refiner.recover_loop(mesh_.loop_heads[loop]);
    relabel_touched(mesh_);
    for (const std::size_t loop : new_loops_) set_length_scales(mesh_.loop_heads[loop]);
  }

 private:
  // kept_[new loop]: the old loop that is the same.
  void match_loops() {
    kept_.assign(domain_.loops.size(), none);
    std::vector<bool> used(old_domain_.loops.size(), false);
    for (std::size_t i = 0; i < domain_.loops.size(); ++i) {
      for (std::size_t j = 0; j < used.size() && kept_[i] == none; ++j)
        if (!used[j] && domain_.loops[i] == old_domain_.loops[j]) kept_[i] = j, used[j] = true;
      if (kept_[i] == none) new_loops_.push_back(i);
    }
    for (std::size_t j = 0; j < used.size(); ++j)
      if (!used[j]) old_loops_.push_back(j);
  }

  std::vector<RemovalRegion> regions() const {
    Model old_model, new_model;
    for (const std::size_t loop : old_loops_) add_loop(old_model, old_domain_, loop);
    for (const std::size_t loop : new_loops_) add_loop(new_model, domain_, loop);
    const TriangleId start = any_triangle();
    std::vector<RemovalRegion> result;
    const auto add = [&](const Model& model, const Nearest& other) {
      TriangleId hint = start;
      for (std::size_t i = 0; i < model.points.size(); ++i) {
        const double nearest = std::sqrt(other.squared_distance_to(model.points[i]));
        const double pair = std::isfinite(nearest) ? nearest : 0.0;
        result.push_back({model.points[i],
                          removal_radius(distance_, pair, model.points[i], model.before[i], model.after[i]),
                          hint});
        hint = triangulation_.locate(model.points[i], hint).triangle;
      }
    };
    const Nearest to_old(old_model), to_new(new_model);
    add(old_model, to_new);
    add(new_model, to_old);
    return result;
  }

  TriangleId any_triangle() const {
    std::uint32_t v = 1;
    while (!triangulation_[VertexId{v}].alive()) ++v;
    return triangulation_.star(VertexId{v}).triangle;
  }

  template <class Visit>
  void walk(std::uint32_t head, Visit visit) const {
    std::uint32_t k = head;
    do {
      visit(k);
      k = mesh_.at(k).next;
    } while (k != head);
  }

  void release_old() {
    for (const std::size_t loop : old_loops_)
      walk(mesh_.loop_heads[loop],
           [&](std::uint32_t k) { triangulation_.release(mesh_.at(k).vertex, mesh_.next(k).vertex); });
  }

  // The old boundary's vertices, which are free vertices now.
  std::vector<VertexId> forget_old() {
    std::vector<VertexId> vertices;
    for (const std::size_t loop : old_loops_)
      walk(mesh_.loop_heads[loop], [&](std::uint32_t k) {
        vertices.push_back(mesh_.at(k).vertex);
        triangulation_.set_boundary(mesh_.at(k).vertex, no_index);
      });
    return vertices;
  }

  // The boundary table of the new domain: kept loops as they are, new ones inserted. A vertex that is already
  // at a station (the trailing edge, often) becomes the boundary vertex.
  void rebuild_table() {
    const std::vector<BoundaryVertex> old_table = std::move(mesh_.boundary);
    const std::vector<std::uint32_t> old_heads = std::move(mesh_.loop_heads);
    mesh_.boundary.clear();
    mesh_.free_boundary.clear();
    mesh_.loop_heads.clear();
    mesh_.domain = domain_;
    for (std::size_t loop = 0; loop < domain_.loops.size(); ++loop) {
      if (kept_[loop] == none)
        insert_loop(loop);
      else
        copy_loop(old_table, old_heads[kept_[loop]], first_curve(domain_, loop),
                  first_curve(old_domain_, kept_[loop]));
    }
    mesh_.orient_loops();
    for (const std::size_t loop : new_loops_)
      walk(mesh_.loop_heads[loop], [&](std::uint32_t k) {  // until the neighbours are known
        mesh_.set_boundary_length_scale(k, mesh_.base_length_scale(k));
      });
  }

  static std::uint32_t first_curve(const Domain& domain, std::size_t loop) {
    std::uint32_t curve = 0;
    for (std::size_t i = 0; i < loop; ++i) curve += static_cast<std::uint32_t>(domain.loops[i].curves.size());
    return curve;
  }

  void copy_loop(const std::vector<BoundaryVertex>& table, std::uint32_t head, std::uint32_t to,
                 std::uint32_t from) {
    std::uint32_t k = head, previous = no_index;
    do {
      BoundaryVertex vertex = table[k];
      vertex.curve += to - from;
      previous = mesh_.add_boundary_vertex(vertex, previous);
      if (k == head) mesh_.loop_heads.push_back(previous);
      k = table[k].next;
    } while (k != head);
  }

  void insert_loop(std::size_t loop) {
    std::uint32_t previous = no_index;
    TriangleId hint = any_triangle();
    for (const BoundaryStation& station : domain_.stations(loop)) {
      const VertexId v = triangulation_.insert(domain_.at(station), hint).vertex;
      if (triangulation_[v].boundary != no_index)
        throw RecoveryError("two boundary vertices of the new design lie at one point");
      hint = triangulation_.star(v).triangle;
      const BoundaryVertex vertex{
          .vertex = v, .curve = static_cast<std::uint32_t>(station.curve), .t = station.t};
      const bool first = previous == no_index;
      previous = mesh_.add_boundary_vertex(vertex, previous);
      if (first) mesh_.loop_heads.push_back(previous);
    }
  }

  // A vertex that both models share (the trailing edge, often) keeps triangles from before the step, but not
  // its length scale: they count as touched, so that refinement judges them anew.
  void set_length_scales(std::uint32_t head) {
    walk(head, [&](std::uint32_t k) {
      if (mesh_.at(k).steiner) return;
      mesh_.set_boundary_length_scale(k, neighbour_length_scale(mesh_, k));
      const Corner first = triangulation_.star(mesh_.at(k).vertex);
      Corner c = first;
      do {
        triangulation_.refresh_circle(c.triangle);
        c = triangulation_.counterclockwise(c);
      } while (c.triangle != first.triangle);
    });
  }

  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  MeshData& mesh_;
  Triangulation& triangulation_;
  const Domain old_domain_;
  const Domain& domain_;
  double distance_;
  std::vector<std::size_t> kept_, old_loops_, new_loops_;
};

}  // namespace

void replace_loops(MeshData& mesh, const Domain& domain, double distance) {
  LoopReplacement(mesh, domain, distance).run();
}

}  // namespace remodel
