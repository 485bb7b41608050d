// The specialised method's removal and replacement (the paper's section 4.2).
//
// Words: a moving vertex is *kept* if it was moved in place, otherwise *lost*: it is removed, and a
// non-Steiner vertex comes back as a new vertex at its new place. Lost Steiner vertices do not come back:
// refinement splits the restored segment again where it must.

#include <algorithm>
#include <cmath>

#include "generate/discretise.h"
#include "remodel/methods.h"
#include "remodel/replace.h"

namespace remodel {

namespace {

class Replacement {
 public:
  Replacement(MeshData& mesh, AdjustCache& cache, const ReplaceOptions& options)
      : mesh_(mesh), triangulation_(mesh.triangulation), cache_(cache), options_(options) {}

  void run() {
    restore_delaunay();
    const List<VertexId> inside = vertices_inside(mesh_, regions());
    release_boundary();
    triangulation_.remove(inside);
    List<std::uint32_t> loose(&mesh_.arena);
    triangulation_.remove(take_lost(loose));
    insert_new();
    for (const std::size_t loop : cache_.loops) mesh_.orient_loop(loop);
    recover(loose);
    relabel_touched(mesh_);
    for (std::size_t i = 0; i < cache_.non_steiner && !options_.renewing; ++i)
      if (lost(i)) set_length_scale(cache_.moving[i].boundary);
  }

 private:
  bool lost(std::size_t i) const { return !cache_.accepted[i]; }
  const AdjustCache::Moving& moving(std::size_t i) const { return cache_.moving[i]; }

  // What the paper omits: a partial adjustment leaves edges that are not Delaunay, since vertices moved for
  // which the triangles are good only once their neighbours have moved too. In holes every move does.
  //
  // A triangle of the domain without a lost vertex is where adjust_all() evaluated it, and good there:
  // nothing needs to look at it again, and its edges need a look from its lost neighbours only. The others
  // are gone soon, or in holes.
  void restore_delaunay() {
    for (std::size_t i = 0; i < cache_.moving.size(); ++i)
      for (std::size_t s = moving(i).star_begin; lost(i) && s < moving(i).star_end; ++s)
        cache_.affected[cache_.stars[s]].kept = false;
    List<TriangleId> uncertain(&mesh_.arena);
    for (const AdjustCache::Affected& a : cache_.affected) {
      const bool known = a.domain && a.kept;
      const std::uint32_t birth = a.moved ? mesh_.step + 1 : triangulation_[a.triangle].birth;
      if (!known) uncertain.push_back(a.triangle);
      if (!known || a.moved)
        triangulation_.set_moved(
            a.triangle, known ? a.circle : triangulation_.circle_of(a.vertex[0], a.vertex[1], a.vertex[2]),
            birth);
    }
    triangulation_.restore_delaunay(uncertain);
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
        const double radius = removal_radius(options_, pair, points[i], points[m.before], points[m.after]);
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

  void release_boundary() {
    for (std::size_t i = 0; i < cache_.moving.size(); ++i) {
      if (!lost(i)) continue;
      const BoundaryVertex& v = mesh_.at(moving(i).boundary);
      for (const std::uint32_t neighbour : {v.previous, v.next}) {
        if (neighbour == no_index) continue;
        const auto edge = triangulation_.find_edge(v.vertex, mesh_.at(neighbour).vertex);
        if (edge && triangulation_.link(*edge).constrained())
          triangulation_.release(v.vertex, mesh_.at(neighbour).vertex);
      }
    }
  }

  // The lost vertices leave the boundary table. The entries of which boundary edges are missing then are
  // `loose`, some of them twice; Steiner vertices among them may be lost too.
  List<VertexId> take_lost(List<std::uint32_t>& loose) {
    List<VertexId> going(&mesh_.arena);
    for (std::size_t i = 0; i < cache_.moving.size(); ++i) {
      if (!lost(i)) continue;
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
    for (std::size_t i = 0; i < cache_.non_steiner; ++i) {
      if (!lost(i)) continue;
      const std::uint32_t k = moving(i).boundary;
      const VertexId v = insert_boundary_point(triangulation_, cache_.new_points[i], hint_near(k));
      triangulation_.set_boundary(v, k);
      triangulation_.set_length_scale(v,
                                      cache_.new_scales[i]);  // until its neighbours are known, or for good
      mesh_.boundary.edit(k).vertex = v;
      if (!options_.renewing) mesh_.boundary.edit(k).scale_factor = 1.0;
    }
  }

  // A triangle at the nearest boundary vertex before k that is in the mesh.
  TriangleId hint_near(std::uint32_t k) const {
    for (std::uint32_t n = mesh_.at(k).previous; n != k && n != no_index; n = mesh_.at(n).previous)
      if (mesh_.at(n).vertex) return triangulation_.star(mesh_.at(n).vertex).triangle;
    const std::uint32_t other =
        mesh_.loop_heads[mesh_.loop_heads.front() == k ? mesh_.loop_heads.size() - 1 : 0];
    if (mesh_.at(other).vertex) return triangulation_.star(mesh_.at(other).vertex).triangle;
    std::uint32_t any = 1;
    while (!triangulation_[VertexId{any}].alive()) ++any;
    return triangulation_.star(VertexId{any}).triangle;
  }

  void recover(std::span<const std::uint32_t> loose) {
    Refiner refiner(mesh_);
    for (const std::uint32_t k : loose)
      if (mesh_.at(k).vertex && mesh_.at(k).next != no_index) refiner.recover_edge(k);
  }

  void set_length_scale(std::uint32_t k) {
    mesh_.set_boundary_length_scale(k, neighbour_length_scale(mesh_, k));
  }

  MeshData& mesh_;
  Triangulation& triangulation_;
  AdjustCache& cache_;
  ReplaceOptions options_;
};

}  // namespace

List<VertexId> replace_where_needed(MeshData& mesh, AdjustCache& cache, const Domain& domain,
                                    const ReplaceOptions& options) {
  adjust_some(mesh, cache);
  for (const std::size_t loop : cache.loops) {
    mesh.domain.loops[loop] = domain.loops[loop];
    mesh.loop_moved(loop);
  }
  Replacement(mesh, cache, options).run();
  List<VertexId> moved(&mesh.arena);
  for (std::size_t i = 0; i < cache.moving.size(); ++i)
    if (cache.accepted[i] && !(cache.new_points[i] == cache.old_points[i]))
      moved.push_back(cache.moving[i].vertex);
  return moved;
}

}  // namespace remodel
