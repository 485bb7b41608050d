#include "step/morph.h"

#include <algorithm>

#include "remodel/predicates.h"
#include "step/relax.h"
#include "step/replace.h"
#include "step/wall_field.h"

namespace remodel {

namespace {

class Morph {
 public:
  Morph(MeshData& mesh, const AdjustCache& cache, const QualityBounds& bounds)
      : mesh_(mesh),
        triangulation_(mesh.triangulation),
        cache_(cache),
        bounds_(bounds),
        moves_(&mesh.arena),
        triangles_(&mesh.arena),
        displacements_(&mesh.arena),
        at_start_(&mesh.arena) {}

  bool run(Interior interior) {
    note_start();
    restore_all_outside();
    if (moves_outermost(mesh_, cache_.loops)) open_hull(mesh_);
    const bool done = interior == Interior::still ? walls_alone() : all();
    if (done) restore_all_outside();
    return done;
  }

  List<VertexId> moved() const {
    List<VertexId> result(&mesh_.arena);
    for (const auto& [vertex, point] : at_start_)
      if (!(triangulation_.point(vertex) == point)) result.push_back(vertex);
    return result;
  }

 private:
  static constexpr int parts = 64;  // of the way; one is the smallest step
  // A step that takes more is dearer than a replacement, and keeps less: sets of slat, airfoil and flap took
  // up to 46. All 90 pairs of the catalogue at I = 200 take at most 11.
  static constexpr int most_tries = 12;
  struct Place {
    VertexId vertex;
    Point point;
  };
  struct Move {
    VertexId vertex;
    Point from, to;
  };

  bool walls_alone() {
    list_moves(0, parts, Interior::still);
    return advance() && all_mended_;
  }

  // Halves the part that is tried wherever triangles turn over, and goes on with parts of that size.
  bool all() {
    int done = 0, part = parts;
    for (int tried = 0; tried < most_tries && part > 0; ++tried) {
      part = std::min(part, parts - done);
      if (part == 0) break;
      if (displaced_for_ != done) displace(done);
      list_moves(done, part, Interior::along);
      if (advance())
        done += part;
      else
        part /= 2;
    }
    return done == parts;
  }

  bool interior(VertexId v) const {
    const Vertex& vertex = triangulation_[v];
    return vertex.alive() && vertex.boundary == no_index && v != infinite_vertex;
  }

  void note_start() {
    for (std::size_t i = 0; i < cache_.moving.size(); ++i)
      at_start_.push_back({cache_.moving[i].vertex, cache_.old_points[i]});
    for (std::uint32_t i = 0; i < triangulation_.vertex_slots(); ++i)
      if (const VertexId v{i}; interior(v)) at_start_.push_back({v, triangulation_.point(v)});
  }

  // Steps that moved vertices in place have left triangles outside the domain that are not Delaunay.
  void restore_all_outside() {
    mesh_.seen_vertices.clear(triangulation_.vertex_slots());
    restore_outside(mesh_);
  }

  Point wall_place(std::size_t i, int done) const {
    if (done == parts) return cache_.new_points[i];
    const double share = static_cast<double>(done) / parts;
    return cache_.old_points[i] + share * (cache_.new_points[i] - cache_.old_points[i]);
  }

  // Makes the moves that are listed, and mends what they spoil. False, and nothing has changed, where
  // triangles turn over.
  bool advance() {
    for (const Move& move : moves_) place(move.vertex, move.to);
    list_triangles();
    if (std::ranges::any_of(triangles_, [&](TriangleId t) { return turned_over(t); })) {
      for (const Move& move : moves_) place(move.vertex, move.from);
      return false;
    }
    for (std::size_t i = 0; i < cache_.moving.size(); ++i)
      triangulation_.set_length_scale(cache_.moving[i].vertex, cache_.new_scales[i]);
    for (const TriangleId t : triangles_) triangulation_.set_moved(t, mesh_.step + 1);
    all_mended_ = relax(mesh_, bounds_, triangles_);
    triangulation_.restore_delaunay(triangles_);
    return true;
  }

  void place(VertexId v, Point p) { triangulation_.move(v, p, triangulation_[v].length_scale); }

  // How the interior moves along with all that is left of the way: a part of it takes a part of that.
  void displace(int done) {
    WallField field(mesh_, cache_.loops);
    const std::size_t walls = cache_.moving.size();
    mesh_.candidate_indices.clear(triangulation_.vertex_slots());
    for (std::uint32_t i = 0; i < walls; ++i) mesh_.candidate_indices.insert(cache_.moving[i].vertex, i);
    field.displace([&](VertexId v) {
      const std::uint32_t i = mesh_.candidate_indices.value_or(v, no_index);
      return i == no_index ? Point{} : cache_.new_points[i] - triangulation_.point(v);
    });
    displacements_.resize(at_start_.size() - walls);
    for (std::size_t i = walls; i < at_start_.size(); ++i)
      displacements_[i - walls] = field.at(triangulation_.point(at_start_[i].vertex));
    displaced_for_ = done;
  }

  void list_moves(int done, int part, Interior interior) {
    moves_.clear();
    mesh_.seen_vertices.clear(triangulation_.vertex_slots());
    const auto add = [&](VertexId v, Point to) {
      if (mesh_.seen_vertices.insert(v)) moves_.push_back({v, triangulation_.point(v), to});
    };
    const std::size_t walls = cache_.moving.size();
    for (std::size_t i = 0; i < walls; ++i) {
      const VertexId v = cache_.moving[i].vertex;
      const Point to = wall_place(i, done + part);
      // Where only its length scale is another one, the triangles around it may miss the bound on gradation.
      if (!(triangulation_.point(v) == to) || cache_.new_scales[i] != triangulation_[v].length_scale)
        add(v, to);
    }
    if (interior == Interior::still) return;
    const double share = static_cast<double>(part) / (parts - done);
    for (std::size_t i = walls; i < at_start_.size(); ++i) {
      const VertexId v = at_start_[i].vertex;
      const Point p = triangulation_.point(v), to = p + share * displacements_[i - walls];
      if (!(p == to)) add(v, to);
    }
  }

  // Those with a vertex that is listed.
  void list_triangles() {
    triangles_.clear();
    const auto moves = [&](VertexId v) { return mesh_.seen_vertices.contains(v); };
    for (std::uint32_t i = 0; i < triangulation_.triangle_slots(); ++i) {
      const Triangle& t = triangulation_[TriangleId{i}];
      if (t.alive() && !t.ghost() && std::any_of(t.vertex, t.vertex + 3, moves))
        triangles_.push_back(TriangleId{i});
    }
  }

  bool turned_over(TriangleId t) const {
    const Triangle& triangle = triangulation_[t];
    return orient2d(triangulation_.point(triangle.vertex[0]), triangulation_.point(triangle.vertex[1]),
                    triangulation_.point(triangle.vertex[2])) <= 0;
  }

  MeshData& mesh_;
  Triangulation& triangulation_;
  const AdjustCache& cache_;
  const QualityBounds bounds_;
  List<Move> moves_;
  List<TriangleId> triangles_;
  List<Point> displacements_;  // of the interior, in the order of at_start_
  int displaced_for_ = -1;     // the part of the way at which they were computed
  bool all_mended_ = false;    // by the last relaxation, to the bounds
  List<Place> at_start_;  // of the moving loops' vertices, in the cache's order, and then of the interior
};

}  // namespace

std::optional<List<VertexId>> morph_mesh(MeshData& mesh, AdjustCache& cache, const Domain& domain,
                                         Interior interior, const QualityBounds& bounds) {
  Morph morph(mesh, cache, bounds);
  if (!morph.run(interior)) return std::nullopt;
  for (const std::size_t loop : cache.loops) {
    mesh.domain.loops[loop] = domain.loops[loop];
    mesh.loop_moved(loop);
  }
  return morph.moved();
}

}  // namespace remodel
