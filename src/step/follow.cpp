#include "step/follow.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/opposite_angles.h"
#include "remodel/predicates.h"
#include "step/adjust.h"
#include "step/lanes.h"
#include "step/outcome.h"
#include "step/wall_field.h"

namespace remodel {

namespace {

struct Place {
  Point point;
  double length_scale = 0.0;
  friend bool operator==(const Place&, const Place&) = default;
};

struct FollowCache : MeshCache {
  struct Follower {  // an interior vertex within reach
    VertexId vertex;
    std::size_t first, last;  // of its sights
  };
  struct Judged {  // a triangle with a vertex within reach
    TriangleId triangle;
    VertexId vertex[3];
    bool domain;
    Circle circle{};  // at the last places that were judged
  };
  struct Edge {  // of two triangles of the domain, one of them judged, or of one and the boundary
    std::uint32_t judged;
    VertexId a, b, apex, across;  // the apex on its left; across: infinite_vertex where it is the boundary
  };

  std::shared_ptr<const MeshReference> reference;
  std::vector<std::size_t> loops;
  std::optional<WallField> field;
  std::vector<Follower> followers;
  std::vector<WallField::Sight> sights;
  std::vector<Judged> judged;  // those of the domain first
  std::size_t in_domain = 0;
  std::vector<Edge> edges;

  // Scratch of one step.
  std::vector<Place> places;  // by slot
  std::vector<std::pair<VertexId, Point>> moved;
};

Place place_of(const MeshData& mesh, VertexId v) {
  return {mesh.triangulation.point(v), mesh.triangulation[v].length_scale};
}

std::shared_ptr<const MeshReference> reference_of(const MeshData& mesh) {
  auto reference = std::make_shared<MeshReference>();
  for (std::uint32_t i = 0; i < mesh.triangulation.vertex_slots(); ++i) {
    const Place place = place_of(mesh, VertexId{i});
    reference->points.push_back(place.point);
    reference->length_scales.push_back(place.length_scale);
  }
  reference->domain = mesh.domain;
  return reference;
}

bool describes(const MeshReference& reference, const MeshData& mesh) {
  const std::size_t slots = mesh.triangulation.vertex_slots();
  if (reference.points.size() != slots || !(reference.domain == mesh.domain)) return false;
  for (std::uint32_t i = 0; i < slots; ++i) {
    const Vertex& vertex = mesh.triangulation[VertexId{i}];
    if (vertex.alive() &&
        !(reference.points[i] == vertex.point && reference.length_scales[i] == vertex.length_scale))
      return false;
  }
  return true;
}

class CacheMaker {
 public:
  CacheMaker(MeshData& mesh, FollowCache& cache)
      : mesh_(mesh), triangulation_(mesh.triangulation), cache_(cache) {}

  void run() {
    cache_.field.emplace(mesh_, cache_.loops, cache_.reference->points);
    mesh_.seen_vertices.clear(triangulation_.vertex_slots());
    list_followers();
    for (const std::size_t loop : cache_.loops)
      mesh_.walk(mesh_.loop_heads[loop],
                 [&](std::uint32_t k) { mesh_.seen_vertices.insert(mesh_.at(k).vertex); });
    list_judged(true);
    cache_.in_domain = cache_.judged.size();
    list_judged(false);
    list_edges();
    cache_.places.resize(triangulation_.vertex_slots());
    cache_.moved.reserve(triangulation_.vertex_slots());
  }

 private:
  void list_followers() {
    for (std::uint32_t i = 0; i < triangulation_.vertex_slots(); ++i) {
      const VertexId v{i};
      const Vertex& vertex = triangulation_[v];
      if (!vertex.alive() || vertex.boundary != no_index || v == infinite_vertex) continue;
      const std::size_t first = cache_.sights.size();
      cache_.field->look(cache_.reference->points[i], cache_.sights);
      if (cache_.sights.size() == first) continue;
      cache_.followers.push_back({v, first, cache_.sights.size()});
      mesh_.seen_vertices.insert(v);
    }
  }

  void list_judged(bool domain) {
    const auto moves = [&](VertexId v) { return mesh_.seen_vertices.contains(v); };
    for (std::uint32_t i = 0; i < triangulation_.triangle_slots(); ++i) {
      const Triangle& t = triangulation_[TriangleId{i}];
      if (t.alive() && !t.ghost() && (t.region == Region::domain) == domain &&
          std::any_of(t.vertex, t.vertex + 3, moves))
        cache_.judged.push_back({TriangleId{i}, {t.vertex[0], t.vertex[1], t.vertex[2]}, domain});
    }
  }

  void list_edges() {
    mesh_.affected_indices.clear(triangulation_.triangle_slots());
    for (std::uint32_t i = 0; i < cache_.in_domain; ++i)
      mesh_.affected_indices.insert(cache_.judged[i].triangle, i);
    for (std::uint32_t i = 0; i < cache_.in_domain; ++i) {
      const Triangle& t = triangulation_[cache_.judged[i].triangle];
      for (int k = 0; k < 3; ++k) {
        const Link link = t.link[k];
        FollowCache::Edge edge{i, t.vertex[next3(k)], t.vertex[previous3(k)], t.vertex[k], infinite_vertex};
        if (!link.constrained()) {
          if (mesh_.affected_indices.value_or(link.triangle(), no_index) < i) continue;  // listed there
          edge.across = triangulation_.apex(link);
        }
        cache_.edges.push_back(edge);
      }
    }
  }

  MeshData& mesh_;
  Triangulation& triangulation_;
  FollowCache& cache_;
};

FollowCache& follow_cache(MeshData& mesh, std::span<const std::size_t> moving) {
  auto* present = dynamic_cast<FollowCache*>(mesh.follow_cache.get());
  const bool same_loops = present != nullptr && std::ranges::equal(present->loops, moving);
  if (same_loops &&
      (mesh.reference ? present->reference == mesh.reference : describes(*present->reference, mesh)))
    return *present;
  auto made = std::make_unique<FollowCache>();
  made->reference = mesh.reference ? mesh.reference : reference_of(mesh);
  made->loops.assign(moving.begin(), moving.end());
  CacheMaker(mesh, *made).run();
  present = made.get();
  mesh.follow_cache = std::move(made);
  return *present;
}

// One design's mesh, from its places to the verdict and, if that is good, into the mesh.
class Follow {
 public:
  Follow(MeshData& mesh, FollowCache& cache, double slack_deg)
      : mesh_(mesh),
        triangulation_(mesh.triangulation),
        cache_(cache),
        opposite_(slack_deg),
        slack_(slack_deg) {}

  // False where places are not finite.
  bool find_places(const Domain& domain) {
    const MeshReference& reference = *cache_.reference;
    for (std::size_t i = 0; i < cache_.places.size(); ++i)
      cache_.places[i] = {reference.points[i], reference.length_scales[i]};
    if (cache_.loops.empty()) return true;
    AdjustCache& walls = adjust_cache(mesh_, cache_.loops);
    place_moving(mesh_, walls, domain);
    if (!walls.finite()) return false;
    for (std::size_t i = 0; i < walls.moving.size(); ++i)
      cache_.places[walls.moving[i].vertex.index] = {walls.new_points[i], walls.new_scales[i]};
    cache_.field->displace(
        [&](VertexId v) { return cache_.places[v.index].point - reference.points[v.index]; });
    for (const FollowCache::Follower& f : cache_.followers) {
      const Point from = reference.points[f.vertex.index];
      cache_.places[f.vertex.index].point =
          from + cache_.field->at(from, std::span(cache_.sights).subspan(f.first, f.last - f.first));
    }
    return true;
  }

  bool good() { return triangles_are_good() && edges_are_good(); }

  // How many triangles of the domain have a vertex that moved.
  std::size_t move() {
    const auto slots = static_cast<std::uint32_t>(triangulation_.vertex_slots());
    mesh_.seen_vertices.clear(slots);
    cache_.moved.clear();
    for (std::uint32_t i = 1; i < slots; ++i) {
      const VertexId v{i};
      const Place& to = cache_.places[i];
      if (!triangulation_[v].alive()) continue;
      const Place from = place_of(mesh_, v);
      if (from == to) continue;
      triangulation_.move(v, to.point, to.length_scale);
      if (from.point == to.point) continue;
      mesh_.seen_vertices.insert(v);
      cache_.moved.emplace_back(v, from.point);
    }
    return refresh_circles();
  }

 private:
  const Place& at(VertexId v) const { return cache_.places[v.index]; }

  bool triangles_are_good() {
    const QualityBounds bounds = mesh_.promised_bounds();
    Lanes lanes;
    for (std::size_t begin = 0; begin < cache_.in_domain; begin += Lanes::count) {
      const std::size_t end = std::min(begin + Lanes::count, cache_.in_domain);
      for (std::size_t lane = 0; lane < Lanes::count; ++lane) {
        const FollowCache::Judged& j = cache_.judged[std::min(begin + lane, end - 1)];
        lanes.load(lane, at(j.vertex[0]), at(j.vertex[1]), at(j.vertex[2]));
      }
      lanes.judge(bounds);
      for (std::size_t i = begin; i < end; ++i) {
        if (!lanes.good(i - begin)) return false;
        cache_.judged[i].circle = lanes.circle(i - begin);
      }
    }
    return std::all_of(cache_.judged.begin(), cache_.judged.end(), [&](const FollowCache::Judged& j) {
      return orient2d(at(j.vertex[0]).point, at(j.vertex[1]).point, at(j.vertex[2]).point) > 0;
    });
  }

  bool edges_are_good() const {
    return std::all_of(cache_.edges.begin(), cache_.edges.end(), [&](const FollowCache::Edge& edge) {
      const Point a = at(edge.a).point, b = at(edge.b).point, apex = at(edge.apex).point;
      if (edge.across == infinite_vertex) return opposite_.within(apex, a, b);
      const Point across = at(edge.across).point;
      const Circle& circle = cache_.judged[edge.judged].circle;
      if (squared_distance(circle.centre, across) > circle.outside) return true;
      constexpr double margin = 1.0 - 1e-9;  // whoever checks rounds in another way
      return slack_ > 0.0 ? opposite_.within(a, b, apex, across, margin)
                          : incircle_sos(a, b, apex, across) <= 0;
    });
  }

  std::size_t refresh_circles() {
    std::size_t changed = 0;
    const auto moved = [&](VertexId v) { return mesh_.seen_vertices.contains(v); };
    mesh_.seen_triangles.clear(triangulation_.triangle_slots());
    for (const FollowCache::Judged& j : cache_.judged) {
      if (!std::any_of(j.vertex, j.vertex + 3, moved)) continue;
      mesh_.seen_triangles.insert(j.triangle);
      const Circle& circle = j.domain ? j.circle : triangulation_[j.triangle].circle;
      triangulation_.set_moved(j.triangle, circle, mesh_.step + 1);
      if (j.domain) ++changed;
    }
    for (std::uint32_t i = 0; i < triangulation_.triangle_slots(); ++i) {  // beyond reach of this design
      const TriangleId id{i};
      const Triangle& t = triangulation_[id];
      if (!t.alive() || t.ghost() || mesh_.seen_triangles.contains(id) ||
          !std::any_of(t.vertex, t.vertex + 3, moved))
        continue;
      triangulation_.set_moved(id, mesh_.step + 1);
      if (t.region == Region::domain) ++changed;
    }
    return changed;
  }

  MeshData& mesh_;
  Triangulation& triangulation_;
  FollowCache& cache_;
  OppositeAngles opposite_;
  double slack_;
};

// The design's loops that are not the mesh's own, to be put there without an allocation.
class NewLoops {
 public:
  NewLoops(const MeshData& mesh, const Domain& domain) {
    for (std::size_t i = 0; i < domain.loops.size(); ++i)
      if (!(domain.loops[i] == mesh.domain.loops[i]))
        indices_.push_back(i), loops_.push_back(domain.loops[i]);
  }
  void put(MeshData& mesh) noexcept {
    for (std::size_t i = 0; i < indices_.size(); ++i) {
      std::swap(mesh.domain.loops[indices_[i]], loops_[i]);
      mesh.loop_moved(indices_[i]);
    }
  }
  std::span<const std::size_t> indices() const { return indices_; }

 private:
  std::vector<std::size_t> indices_;
  std::vector<Loop> loops_;
};

// Where all curves of the domains have the same basis, the cache of adjustment serves both.
void forget_other_rows(MeshData& mesh, const Domain& domain) {
  for (std::size_t i = 0; i < domain.curve_count(); ++i) {
    const auto* to = std::get_if<CstAirfoil>(&domain.curve(i).shape);
    const auto* from = std::get_if<CstAirfoil>(&mesh.domain.curve(i).shape);
    if (to != nullptr && from != nullptr && !same_basis(*to, *from)) mesh.cache.reset();
  }
}

}  // namespace

RemodelResult follow_reference(MeshData& mesh, const Domain& domain, std::span<const std::size_t> moving,
                               double slack_deg) {
  RemodelResult result = unchanged(mesh);
  FollowCache& cache = follow_cache(mesh, moving);
  Follow follow(mesh, cache, slack_deg);
  if (!follow.find_places(domain) || !follow.good()) return result;

  // What may throw comes before the mesh is touched.
  NewLoops loops(mesh, domain);
  const Triangulation& triangulation = mesh.triangulation;
  mesh.seen_vertices.clear(triangulation.vertex_slots());
  mesh.seen_triangles.clear(triangulation.triangle_slots());
  mesh.marked.for_each([&](ChangeRecord& record) {
    record.reserve(triangulation.vertex_slots(), triangulation.vertex_slots(), mesh.domain.loops.size());
  });
  const std::size_t changed = follow.move();
  mesh.marked.for_each([&](ChangeRecord& record) {
    const bool first = record.vertices().empty();
    for (const auto& [v, from] : cache.moved) {
      if (first)
        record.note_first(v, triangulation.generation(v), from);
      else
        record.note({v, true, triangulation.generation(v), from});
    }
    record.note_loops(loops.indices());
  });
  forget_other_rows(mesh, domain);
  loops.put(mesh);
  mesh.reference = cache.reference;
  mesh.delaunay_slack_deg = slack_deg;
  mesh.outside_restored = false;
  ++mesh.step;
  result.preserved = mesh.domain_triangles - changed;
  result.moved = cache.moved.size();
  result.full_adjustment = result.morphed = result.held = true;
  return result;
}

void return_to_reference(MeshData& mesh) {
  const MeshReference& reference = *mesh.reference;
  Triangulation& triangulation = mesh.triangulation;
  mesh.seen_vertices.clear(triangulation.vertex_slots());
  for (std::uint32_t i = 1; i < triangulation.vertex_slots(); ++i) {
    const VertexId v{i};
    const Place to{reference.points[i], reference.length_scales[i]};
    if (!triangulation[v].alive() || place_of(mesh, v) == to) continue;
    mesh.seen_vertices.insert(v);
    triangulation.move(v, to.point, to.length_scale);
  }
  for (std::uint32_t i = 0; i < triangulation.triangle_slots(); ++i) {
    const Triangle& t = triangulation[TriangleId{i}];
    if (t.alive() && !t.ghost() &&
        std::any_of(t.vertex, t.vertex + 3, [&](VertexId v) { return mesh.seen_vertices.contains(v); }))
      triangulation.set_moved(TriangleId{i}, mesh.step + 1);
  }
  forget_other_rows(mesh, reference.domain);
  mesh.domain = reference.domain;
  mesh.forget_extent();
  mesh.outside_restored = false;
  mesh.reference.reset();
}

}  // namespace remodel
