// The specialised method's removal and replacement (the paper's section 4.2).
//
// Words: a moving vertex is *kept* if it was moved in place and all triangles at it are good, otherwise
// *lost*: a non-Steiner vertex then comes to its place on the new design whatever becomes of its triangles,
// and a Steiner vertex goes for good. Refinement splits the restored segment again where it must.
//
// The paper removes lost vertices and inserts others at their new places. The constrained Delaunay
// triangulation of the same points and segments is the same, however it comes about: with the Steiner
// vertices of the removal regions gone, most lost vertices can be *relocated*, moved so that all triangles
// stay counter-clockwise, and most lost Steiner vertices *dissolved*: their two segments become one. Neither
// tears the boundary, so that the regions stay as they are. Those that are *stuck* are removed and inserted.

#include <algorithm>
#include <cmath>

#include "generate/discretise.h"
#include "generate/recovery_error.h"
#include "remodel/predicates.h"
#include "step/methods.h"
#include "step/replace.h"

namespace remodel {

namespace {

class Replacement {
 public:
  Replacement(MeshData& mesh, AdjustCache& cache, const ReplaceOptions& options)
      : mesh_(mesh),
        triangulation_(mesh.triangulation),
        cache_(cache),
        options_(options),
        stuck_(&mesh.arena),
        moved_(&mesh.arena) {}

  // The vertices that are at other places than before, but are the same.
  List<VertexId> run() {
    restore_outside_of_others();
    triangulation_.remove(vertices_inside(mesh_, regions()));
    list_kept();
    dissolve_steiner();
    relocate();
    restore_delaunay();
    if (!stuck_.empty()) reinsert();
    for (std::size_t i = 0; i < cache_.non_steiner; ++i)
      if (lost(i) && (!options_.renewing || mesh_.is_single_point(moving(i).boundary)))
        set_length_scale(moving(i).boundary);
    return std::move(moved_);
  }

 private:
  bool lost(std::size_t i) const { return !cache_.accepted[i]; }
  const AdjustCache::Moving& moving(std::size_t i) const { return cache_.moving[i]; }

  // Loops that stay may have moved in earlier steps, and refinement may split their edges: what lies behind
  // them has to be Delaunay. What lies behind those that move is restored later.
  void restore_outside_of_others() {
    mesh_.seen_vertices.clear(triangulation_.vertex_slots());
    for (const AdjustCache::Moving& m : cache_.moving) mesh_.seen_vertices.insert(m.vertex);
    restore_outside(mesh_);
  }

  void list_kept() {
    for (std::size_t i = 0; i < cache_.moving.size(); ++i)
      if (!lost(i) && cache_.changes_place(i)) moved_.push_back(moving(i).vertex);
  }

  void dissolve_steiner() {
    for (std::size_t i = cache_.non_steiner; i < cache_.moving.size(); ++i) {
      if (!lost(i)) continue;
      if (triangulation_.unsplit(moving(i).vertex))
        mesh_.remove_boundary_vertex(moving(i).boundary);
      else
        stuck_.push_back(i);
    }
  }

  void relocate() {
    for (std::size_t i = 0; i < cache_.non_steiner; ++i) {
      if (!lost(i)) continue;
      const VertexId v = moving(i).vertex;
      if (!may_relocate(v, cache_.new_points[i])) {
        stuck_.push_back(i);
        continue;
      }
      triangulation_.move(v, cache_.new_points[i], cache_.new_scales[i]);
      if (cache_.changes_place(i)) moved_.push_back(v);
    }
  }

  // Whether all triangles at the vertex stay counter-clockwise.
  bool may_relocate(VertexId v, Point p) const {
    return !triangulation_.any_corner(v, [&](Corner c) {
      const VertexId a = triangulation_.following(c), b = triangulation_.preceding(c);
      if (a == infinite_vertex || b == infinite_vertex) return true;
      return orient2d(p, triangulation_.point(a), triangulation_.point(b)) <= 0;
    });
  }

  // What the paper omits: a partial adjustment leaves edges that are not Delaunay, since vertices moved for
  // which the triangles are good only once their neighbours have moved too. In holes every move does, and so
  // does relocation.
  //
  // A triangle of the domain without a lost vertex is where adjust_all() evaluated it, and good there: its
  // edges need a look from the other side only, if that is not of this kind too. What removal touched is
  // looked at as well: it was left as Delaunay as what was around it.
  void restore_delaunay() {
    List<TriangleId> uncertain(&mesh_.arena);
    mesh_.seen_triangles.clear(triangulation_.triangle_slots());
    const auto add = [&](TriangleId t) {
      if (!mesh_.seen_triangles.insert(t)) return false;
      uncertain.push_back(t);
      return true;
    };
    for (std::size_t i = 0; i < cache_.moving.size(); ++i)
      if (lost(i) && triangulation_[moving(i).vertex].alive())
        triangulation_.for_each_corner(moving(i).vertex, [&](Corner c) {
          if (!triangulation_[c.triangle].ghost() && add(c.triangle))
            triangulation_.refresh_circle(c.triangle);
        });
    for (const AdjustCache::Affected& a : cache_.affected) {
      const Triangle& t = triangulation_[a.triangle];
      if (!std::ranges::equal(t.vertex, a.vertex)) continue;
      if (mesh_.seen_triangles.contains(a.triangle)) {
        if (a.moved) triangulation_.set_birth(a.triangle, mesh_.step + 1);
        continue;
      }
      if (!a.domain) add(a.triangle);
      if (!a.domain || a.moved)
        triangulation_.set_moved(
            a.triangle, a.domain ? a.circle : triangulation_.circle_of(a.vertex[0], a.vertex[1], a.vertex[2]),
            a.moved ? mesh_.step + 1 : t.birth);
    }
    for (const TriangleId t : triangulation_.touched())
      if (triangulation_[t].alive() && !triangulation_[t].ghost()) add(t);
    triangulation_.restore_delaunay(uncertain);
  }

  // Those that are stuck: what is left of the paper's way. Boundary edges are torn, so regions are found
  // anew. What insertion meets in holes, of other loops too, is Delaunay: all that lies outside was restored.
  void reinsert() {
    require_something_to_stand_on();
    triangulation_.mark();
    release_boundary();
    List<std::uint32_t> loose(&mesh_.arena);
    triangulation_.remove(take_stuck(loose));
    insert_new();
    for (const std::size_t loop : cache_.loops) mesh_.orient_loop(loop);
    recover(loose);
    relabel(mesh_, uncertain_since_torn(loose));
  }

  // All stuck vertices are removed before the first comes back: a triangle without one has to hold the mesh
  // meanwhile.
  void require_something_to_stand_on() {
    mesh_.seen_vertices.clear(triangulation_.vertex_slots());
    for (const std::size_t i : stuck_) mesh_.seen_vertices.insert(moving(i).vertex);
    const auto stays = [&](VertexId v) { return !mesh_.seen_vertices.contains(v); };
    for (std::uint32_t i = 0; i < triangulation_.triangle_slots(); ++i) {
      const Triangle& t = triangulation_[TriangleId{i}];
      if (t.alive() && !t.ghost() && std::all_of(t.vertex, t.vertex + 3, stays)) return;
    }
    throw RecoveryError("all boundary vertices would have to be replaced at once");
  }

  // One region for each lost pair, about the outermost of the two: the one farther into the domain. Where the
  // domain is on both sides, that is one for each of the two.
  List<RemovalRegion> regions() const {
    List<RemovalRegion> result(&mesh_.arena);
    for (std::size_t i = 0; i < cache_.non_steiner; ++i) {
      if (!lost(i)) continue;
      const AdjustCache::Moving& m = moving(i);
      const std::vector<Point>& news = cache_.new_points;
      const std::vector<Point>& olds = cache_.old_points;
      const Point along = news[m.after] - news[m.before];
      const double leftwards = cross(along, news[i] - olds[i]);
      const double pair = std::sqrt(squared_distance(olds[i], news[i]));
      const auto add = [&](const std::vector<Point>& points) {
        const double radius =
            lost_vertex_radius(options_, pair, points[i], points[m.before], points[m.after]);
        result.push_back({points[i], radius, triangulation_.star(m.vertex).triangle});
      };
      const Sides& sides = mesh_.sides[mesh_.loop_of(m.curve)];
      const bool left = sides.left == Region::domain;
      if (left && sides.right == Region::domain) {
        add(news);
        add(olds);
      } else {
        add((leftwards > 0.0) == left ? news : olds);
      }
    }
    return result;
  }

  // What has changed since the boundary was torn, and what lies beside the edges that are back.
  List<TriangleId> uncertain_since_torn(std::span<const std::uint32_t> loose) {
    List<TriangleId> result = alive_since_mark(mesh_);
    for (const std::uint32_t k : loose) {
      if (!begins_edge(k)) continue;
      const Corner c = *triangulation_.find_edge(mesh_.at(k).vertex, mesh_.at(mesh_.at(k).next).vertex);
      for (const TriangleId t : {c.triangle, triangulation_.link(c).triangle()}) result.push_back(t);
    }
    return result;
  }

  void release_boundary() {
    for (const std::size_t i : stuck_) {
      const BoundaryVertex& v = mesh_.at(moving(i).boundary);
      for (const std::uint32_t neighbour : {v.previous, v.next}) {
        if (neighbour == no_index) continue;
        const auto edge = triangulation_.find_edge(v.vertex, mesh_.at(neighbour).vertex);
        if (edge && triangulation_.link(*edge).constrained())
          triangulation_.release(v.vertex, mesh_.at(neighbour).vertex);
      }
    }
  }

  // The stuck vertices leave the boundary table. The entries of which boundary edges are missing then are
  // `loose`, some of them twice; entries among them may leave later.
  List<VertexId> take_stuck(List<std::uint32_t>& loose) {
    List<VertexId> going(&mesh_.arena);
    for (const std::size_t i : stuck_) {
      const std::uint32_t k = moving(i).boundary;
      going.push_back(mesh_.at(k).vertex);
      for (const std::uint32_t from : {mesh_.at(k).previous, k})
        if (from != no_index && (loose.empty() || loose.back() != from)) loose.push_back(from);
      if (i >= cache_.non_steiner)
        mesh_.remove_boundary_vertex(k);
      else
        mesh_.boundary.edit(k).vertex = VertexId{};
    }
    return going;
  }

  void insert_new() {
    for (const std::size_t i : stuck_) {
      if (i >= cache_.non_steiner) continue;
      const std::uint32_t k = moving(i).boundary;
      const VertexId v = insert_boundary_point(triangulation_, cache_.new_points[i], vertex_near(k));
      triangulation_.set_boundary(v, k);
      // Until its neighbours are known, or for good.
      triangulation_.set_length_scale(v, cache_.new_scales[i]);
      mesh_.boundary.edit(k).vertex = v;
    }
  }

  // The nearest boundary vertex before k that is in the mesh; failing that, any vertex.
  VertexId vertex_near(std::uint32_t k) const {
    for (std::uint32_t n = mesh_.at(k).previous; n != k && n != no_index; n = mesh_.at(n).previous)
      if (mesh_.at(n).vertex) return mesh_.at(n).vertex;
    const std::uint32_t other =
        mesh_.loop_heads[mesh_.loop_heads.front() == k ? mesh_.loop_heads.size() - 1 : 0];
    return mesh_.at(other).vertex ? mesh_.at(other).vertex : triangulation_.first_vertex();
  }

  void recover(std::span<const std::uint32_t> loose) {
    Refiner refiner(mesh_);
    for (const std::uint32_t k : loose)
      if (begins_edge(k)) refiner.recover_edge(k);
  }
  bool begins_edge(std::uint32_t k) const { return mesh_.at(k).vertex && mesh_.at(k).next != no_index; }

  void set_length_scale(std::uint32_t k) {
    const Neighbours neighbours = options_.renewing ? Neighbours::stations : Neighbours::all;
    mesh_.set_boundary_length_scale(k, neighbour_length_scale(mesh_, k, neighbours));
  }

  MeshData& mesh_;
  Triangulation& triangulation_;
  AdjustCache& cache_;
  ReplaceOptions options_;
  List<std::size_t> stuck_;  // lost vertices, as positions in cache_.moving
  List<VertexId> moved_;     // kept and relocated ones
};

}  // namespace

List<VertexId> replace_where_needed(MeshData& mesh, AdjustCache& cache, const Domain& domain,
                                    const ReplaceOptions& options) {
  adjust_some(mesh, cache);
  for (const std::size_t loop : cache.loops) {
    mesh.domain.loops[loop] = domain.loops[loop];
    mesh.loop_moved(loop);
  }
  return Replacement(mesh, cache, options).run();
}

}  // namespace remodel
