// The general method (the paper's section 3): any loops and chains to any others. Those that are the same in
// both domains, by value, are not touched.

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <nanoflann.hpp>
#include <utility>

#include "generate/discretise.h"
#include "generate/recovery_error.h"
#include "step/methods.h"
#include "step/replace.h"
#include "triangulation/coarse_to_fine.h"

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

// All stations of a loop, but for those on curves that stay.
void add_loop(Model& model, const Domain& domain, std::size_t loop, const std::vector<std::uint32_t>& stays) {
  const std::vector<BoundaryStation> stations = domain.stations(loop);
  const std::vector<Point> points = domain.points(loop);
  const std::size_t n = points.size();
  const bool open = domain.loops[loop].open;
  for (std::size_t i = 0; i < n; ++i) {
    if (stays[stations[i].curve] != no_index) continue;
    // The end of a chain has one neighbour, a single point none: then they are the same.
    const bool first = open && i == 0, last = open && i + 1 == n;
    const Point before = first ? points[last ? i : i + 1] : points[(i + n - 1) % n];
    model.points.push_back(points[i]);
    model.before.push_back(before);
    model.after.push_back(last ? before : points[(i + 1) % n]);
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
  LoopReplacement(MeshData& mesh, const Domain& domain, const ReplaceOptions& options)
      : mesh_(mesh),
        triangulation_(mesh.triangulation),
        old_domain_(mesh.domain),
        domain_(domain),
        options_(options),
        old_curve_(domain.curve_count(), no_index),
        new_curve_(mesh.domain.curve_count(), no_index) {}

  void run() {
    match_loops();
    match_curves();
    mesh_.seen_vertices.clear(triangulation_.vertex_slots());
    restore_outside(mesh_);
    const List<VertexId> inside = vertices_inside(mesh_, regions());
    release_old();
    triangulation_.remove(inside);
    const std::vector<VertexId> old_boundary = forget_old();
    rebuild_table();
    std::vector<VertexId> left = old_boundary;
    std::erase_if(left, [&](VertexId v) { return triangulation_[v].boundary != no_index; });
    triangulation_.remove(left);
    Refiner refiner(mesh_);
    for (const std::size_t loop : new_loops_) refiner.recover_loop(mesh_.loop_heads[loop]);
    relabel_touched(mesh_);
    for_each_new_station([&](std::uint32_t k) { set_length_scale(k); });
    for (const VertexId v : old_boundary)  // other loops were joined to the old ones here
      if (triangulation_[v].alive() && triangulation_[v].boundary != no_index)
        set_length_scale(triangulation_[v].boundary);
  }

 private:
  // kept_[new loop]: the old loop that is the same.
  void match_loops() {
    std::multimap<std::pair<double, double>, std::size_t> old_loop_at;  // by their first points
    const auto first_point = [](const Domain& domain, std::size_t loop) {
      const Point p =
          Frame(domain.loops[loop].placement)(point_at(domain.loops[loop].curves.front().shape, 0.0));
      return std::pair(p.x, p.y);
    };
    for (std::size_t j = 0; j < old_domain_.loops.size(); ++j)
      old_loop_at.emplace(first_point(old_domain_, j), j);
    kept_.assign(domain_.loops.size(), none);
    std::vector<bool> used(old_domain_.loops.size(), false);
    for (std::size_t i = 0; i < domain_.loops.size(); ++i) {
      const auto [begin, end] = old_loop_at.equal_range(first_point(domain_, i));
      for (auto it = begin; it != end && kept_[i] == none; ++it)
        if (!used[it->second] && domain_.loops[i] == old_domain_.loops[it->second])
          kept_[i] = it->second, used[it->second] = true;
      if (kept_[i] == none) new_loops_.push_back(i);
    }
    for (std::size_t j = 0; j < used.size(); ++j)
      if (!used[j]) old_loops_.push_back(j);
  }

  // Curves that stay in loops that do not: of the same name, shape and parameters, between the same points,
  // in loops of one role and place. Their edges, and what refinement put on them, are not touched.
  void match_curves() {
    std::multimap<std::pair<double, double>, Span> old_spans;  // by their first points
    for (const std::size_t loop : old_loops_)
      for (const Span& span : spans_of(old_domain_, loop)) old_spans.emplace(key(span.from), span);
    for (const std::size_t loop : new_loops_)
      for (const Span& span : spans_of(domain_, loop)) {
        const auto [begin, end] = old_spans.equal_range(key(span.from));
        const auto same = std::find_if(begin, end, [&](const auto& old) { return stays(old.second, span); });
        if (same == end) continue;
        old_curve_[span.curve] = same->second.curve;
        new_curve_[same->second.curve] = span.curve;
        old_spans.erase(same);
      }
  }

  // A curve of a loop, from its first point to that of the next one.
  struct Span {
    std::size_t loop;
    std::uint32_t curve;
    Point from, to;
  };

  static std::pair<double, double> key(Point p) { return {p.x, p.y}; }

  // Those of more than one curve: one that is alone stays with its loop, or not at all.
  static std::vector<Span> spans_of(const Domain& domain, std::size_t loop) {
    const std::vector<Curve>& curves = domain.loops[loop].curves;
    const Frame frame(domain.loops[loop].placement);
    const std::uint32_t first = first_curves(domain)[loop];
    const auto begin = [&](std::size_t i) { return frame(point_at(curves[i].shape, 0.0)); };
    const auto end = [&](std::size_t i) {
      if (i + 1 < curves.size()) return begin(i + 1);
      return domain.loops[loop].open ? frame(point_at(curves[i].shape, 1.0)) : begin(0);
    };
    std::vector<Span> spans;
    for (std::size_t i = 0; i < curves.size() && curves.size() > 1; ++i)
      spans.push_back({loop, first + static_cast<std::uint32_t>(i), begin(i), end(i)});
    return spans;
  }

  bool stays(const Span& old, const Span& span) const {
    const Loop &a = old_domain_.loops[old.loop], &b = domain_.loops[span.loop];
    return a.role == b.role && a.placement == b.placement && old.from == span.from && old.to == span.to &&
           old_domain_.curve(old.curve) == domain_.curve(span.curve);
  }

  std::vector<RemovalRegion> regions() const {
    Model old_model, new_model;
    for (const std::size_t loop : old_loops_) add_loop(old_model, old_domain_, loop, new_curve_);
    for (const std::size_t loop : new_loops_) add_loop(new_model, domain_, loop, old_curve_);
    const TriangleId start = any_triangle();
    std::vector<RemovalRegion> result;
    const auto add = [&](const Model& model, const Nearest& other) {
      TriangleId hint = start;
      for (std::size_t i = 0; i < model.points.size(); ++i) {
        const double nearest = std::sqrt(other.squared_distance_to(model.points[i]));
        const double pair = std::isfinite(nearest) ? nearest : 0.0;
        const double least = least_radius(options_, model.points[i], model.before[i], model.after[i]);
        result.push_back({model.points[i], std::max(options_.distance * pair, least), hint});
        hint = triangulation_.locate(model.points[i], hint).triangle;
      }
    };
    const Nearest to_old(old_model), to_new(new_model);
    add(old_model, to_new);
    add(new_model, to_old);
    return result;
  }

  TriangleId any_triangle() const { return triangulation_.star(triangulation_.first_vertex()).triangle; }

  void release_old() {
    for (const std::size_t loop : old_loops_)
      mesh_.walk_edges(mesh_.loop_heads[loop], [&](std::uint32_t k, std::uint32_t next) {
        if (new_curve_[mesh_.at(k).curve] == no_index)
          triangulation_.release(mesh_.at(k).vertex, mesh_.at(next).vertex);
      });
  }

  // The old boundary's vertices, which are free vertices now, but for those that other loops join. No vertex
  // has a record any more: the table is made anew.
  std::vector<VertexId> forget_old() {
    std::vector<VertexId> vertices;
    for (const std::size_t loop : old_loops_)
      mesh_.walk(mesh_.loop_heads[loop], [&](std::uint32_t k) { vertices.push_back(mesh_.at(k).vertex); });
    for (const std::uint32_t head : mesh_.loop_heads)
      mesh_.walk(head, [&](std::uint32_t k) {
        if (triangulation_[mesh_.at(k).vertex].boundary != no_index)
          triangulation_.set_boundary(mesh_.at(k).vertex, no_index);
      });
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
  }

  // The boundary table of the new domain: kept loops and curves as they are, new ones inserted. A vertex that
  // is already at a station (the trailing edge, often) becomes the boundary vertex.
  void rebuild_table() {
    const std::vector<BoundaryVertex> old_table = mesh_.boundary.take_all();
    const std::vector<std::uint32_t> old_heads = std::move(mesh_.loop_heads);
    mesh_.loop_heads.clear();
    mesh_.domain = domain_;
    mesh_.index_curves();
    const std::vector<std::uint32_t> first = first_curves(domain_), old_first = first_curves(old_domain_);
    for (std::size_t loop = 0; loop < domain_.loops.size(); ++loop) {
      if (kept_[loop] == none)
        insert_loop(loop, old_table);
      else
        copy_loop(old_table, old_heads[kept_[loop]], first[loop] - old_first[kept_[loop]]);
    }
    mesh_.orient_loops();
    for_each_new_station([&](std::uint32_t k) {  // until the neighbours are known
      mesh_.set_boundary_length_scale(k, mesh_.base_length_scale(k));
    });
  }

  // Visits the entries of new loops that a curve begins at or belongs to which is new itself.
  template <class Visit>
  void for_each_new_station(Visit visit) const {
    for (const std::size_t loop : new_loops_)
      mesh_.walk(mesh_.loop_heads[loop], [&](std::uint32_t k) {
        const std::uint32_t previous = mesh_.at(k).previous;
        const bool after_new = previous == no_index || old_curve_[mesh_.at(previous).curve] == no_index;
        if (after_new || old_curve_[mesh_.at(k).curve] == no_index) visit(k);
      });
  }

  static std::vector<std::uint32_t> first_curves(const Domain& domain) {
    std::vector<std::uint32_t> first{0};
    for (const Loop& loop : domain.loops)
      first.push_back(first.back() + static_cast<std::uint32_t>(loop.curves.size()));
    return first;
  }

  void copy_loop(const std::vector<BoundaryVertex>& table, std::uint32_t head, std::uint32_t shift) {
    std::uint32_t k = head, previous = no_index;
    do {
      BoundaryVertex vertex = table[k];
      vertex.curve += shift;  // modulo 2^32: either way
      previous = mesh_.add_boundary_vertex(vertex, previous);
      if (k == head) mesh_.loop_heads.push_back(previous);
      k = table[k].next;
    } while (k != head && k != no_index);
    if (k == head) mesh_.close_loop(mesh_.loop_heads.back(), previous);
  }

  // The entries of a curve that stays, with what refinement put between its stations.
  std::uint32_t copy_curve(const std::vector<BoundaryVertex>& table, std::uint32_t curve,
                           std::uint32_t previous) {
    const std::uint32_t old = old_curve_[curve];
    for (std::uint32_t k = first_entry(table, old); k != no_index && table[k].curve == old;
         k = table[k].next) {
      BoundaryVertex vertex = table[k];
      vertex.curve = curve;
      previous = mesh_.add_boundary_vertex(vertex, previous);
    }
    return previous;
  }

  std::uint32_t first_entry(const std::vector<BoundaryVertex>& table, std::uint32_t curve) {
    if (first_entries_.empty()) {
      first_entries_.assign(new_curve_.size(), no_index);
      for (std::uint32_t k = 0; k < table.size(); ++k)
        if (table[k].vertex && !table[k].steiner && table[k].t == 0.0) first_entries_[table[k].curve] = k;
    }
    return first_entries_[curve];
  }

  void insert_loop(std::size_t loop, const std::vector<BoundaryVertex>& old_table) {
    std::uint32_t previous = no_index;
    const std::vector<BoundaryStation> stations = domain_.stations(loop);
    const std::vector<VertexId> vertices = insert_stations(loop, stations);
    for (std::size_t i = 0; i < stations.size(); ++i) {
      const auto curve = static_cast<std::uint32_t>(stations[i].curve);
      if (old_curve_[curve] != no_index) {
        if (i > 0 && stations[i - 1].curve == curve) continue;  // it was copied whole
        const auto entries = static_cast<std::uint32_t>(mesh_.boundary.size());
        previous = copy_curve(old_table, curve, previous);
        if (i == 0) mesh_.loop_heads.push_back(entries);
        continue;
      }
      const VertexId v = vertices[i];
      if (triangulation_[v].boundary != no_index && mesh_.at(triangulation_[v].boundary).steiner)
        throw RecoveryError(on_another_curve);
      previous = mesh_.add_boundary_vertex({.vertex = v, .curve = curve, .t = stations[i].t}, previous);
      if (i == 0) mesh_.loop_heads.push_back(previous);
    }
    if (!domain_.loops[loop].open) mesh_.close_loop(mesh_.loop_heads.back(), previous);
    last_ = mesh_.at(previous).vertex;
  }

  // The vertices of a loop's stations, but for those on curves that stay. Long loops are inserted from coarse
  // to fine: one point after the other along a curve, each would have to cut the triangles of all before it.
  std::vector<VertexId> insert_stations(std::size_t loop, const std::vector<BoundaryStation>& stations) {
    constexpr std::size_t long_loop = 1024;
    const std::vector<Point> points = domain_.points(loop);
    std::vector<VertexId> vertices(points.size());
    TriangleId hint = last_ ? triangulation_.star(last_).triangle : any_triangle();
    const auto insert = [&](std::size_t i) {
      if (old_curve_[stations[i].curve] != no_index) return;
      const auto [v, is_new] = triangulation_.insert(points[i], hint);
      if (is_new && triangulation_.at_constraint(v)) throw RecoveryError(on_another_curve);
      vertices[i] = v;
      hint = triangulation_.star(v).triangle;
    };
    if (points.size() < long_loop) {
      for (std::size_t i = 0; i < points.size(); ++i) insert(i);
      return vertices;
    }
    for (const std::size_t i : coarse_to_fine(points.size())) {
      if (const std::size_t before = i & (i - 1); i > 0 && vertices[before])
        hint = triangulation_.star(vertices[before]).triangle;
      insert(i);
    }
    return vertices;
  }

  // A vertex that both models share (the trailing edge, often) keeps triangles from before the step, but not
  // its length scale: they count as touched, so that refinement judges them anew.
  void set_length_scale(std::uint32_t k) {
    if (mesh_.at(k).steiner) return;
    const Neighbours neighbours = options_.renewing ? Neighbours::stations : Neighbours::all;
    mesh_.set_boundary_length_scale(k, neighbour_length_scale(mesh_, k, neighbours));
    keep_scales_beside(k);
    triangulation_.for_each_corner(mesh_.at(k).vertex,
                                   [&](Corner c) { triangulation_.refresh_circle(c.triangle); });
  }

  // Steiner vertices up to the next stations keep their length scales. What their factors refer to follows
  // the station's.
  void keep_scales_beside(std::uint32_t k) {
    const auto keep = [&](std::uint32_t s, std::uint32_t BoundaryVertex::*step) {
      for (; s != no_index && mesh_.at(s).steiner; s = mesh_.at(s).*step)
        mesh_.set_boundary_length_scale(s, mesh_.length_scale(s));
    };
    mesh_.at_vertex(k, [&](std::uint32_t e) {
      keep(mesh_.at(e).next, &BoundaryVertex::next);
      keep(mesh_.at(e).previous, &BoundaryVertex::previous);
    });
  }

  static constexpr const char* on_another_curve =
      "a boundary vertex of the new design lies on a curve of another loop";
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  MeshData& mesh_;
  Triangulation& triangulation_;
  const Domain old_domain_;
  const Domain& domain_;
  ReplaceOptions options_;
  std::vector<std::size_t> kept_, old_loops_, new_loops_;
  std::vector<std::uint32_t> old_curve_,
      new_curve_;                             // that is the same, of each new and old curve; no_index: none
  std::vector<std::uint32_t> first_entries_;  // of each old curve, in the old table
  VertexId last_;                             // inserted: where the search for the next loop begins
};

}  // namespace

void replace_loops(MeshData& mesh, const Domain& domain, const ReplaceOptions& options) {
  LoopReplacement(mesh, domain, options).run();
}

}  // namespace remodel
