// The part that differs between two frozen meshes.

#include <algorithm>
#include <tuple>

#include "remodel/error.h"
#include "transfer/patches.h"

namespace remodel {

namespace {

using Triple = PatchBuilder::Triple;

// Numbers by name, for names that may be anything.
template <class Name>
class Directory {
 public:
  void add(const Name& name, std::uint32_t number) { entries_.emplace_back(name, number); }
  void close() { std::sort(entries_.begin(), entries_.end()); }
  std::uint32_t find(const Name& name) const {
    const auto at = std::lower_bound(entries_.begin(), entries_.end(), std::pair(name, 0U));
    return at != entries_.end() && at->first == name ? at->second : no_index;
  }

 private:
  std::vector<std::pair<Name, std::uint32_t>> entries_;
};

Triple from_least(Triple corners) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

std::vector<bool> boundary_points(const FrozenMesh& mesh) {
  std::vector<bool> at_boundary(mesh.points.size(), false);
  for (const FrozenBoundary& boundary : mesh.boundaries)
    for (const auto& edge : boundary.edges)
      for (const std::uint32_t v : edge) at_boundary[v] = true;
  return at_boundary;
}

// Every array that is there has its size, and no triangle a point that is not there.
void require_sound(const FrozenMesh& mesh, const char* which) {
  const std::size_t points = mesh.points.size();
  const auto fits = [&](std::size_t size) { return size == 0 || size == points; };
  bool sound = fits(mesh.vertex_keys.size()) && fits(mesh.curve.size()) && fits(mesh.parameter.size());
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) sound = sound && v < points;
  for (const FrozenBoundary& boundary : mesh.boundaries)
    for (const auto& edge : boundary.edges)
      for (const std::uint32_t v : edge) sound = sound && v < points;
  if (!sound || mesh.triangles.empty())
    throw Error(ErrorCode::argument, which,
                mesh.triangles.empty() ? "found a mesh without triangles, expected some"
                                       : "found arrays of different sizes, expected one value a point");
}

class BetweenMeshes {
 public:
  BetweenMeshes(const FrozenMesh& before, const FrozenMesh& after)
      : before_(before), after_(after), builder_(patches_, 16) {
    require_sound(before, "mesh before");
    require_sound(after, "mesh after");
  }

  Patches run() {
    patches_.vertices_before = before_.points.size(), patches_.vertices_after = after_.points.size();
    patches_.triangles_before = before_.triangles.size();
    patches_.triangles_after = after_.triangles.size();
    match_vertices();
    match_triangles();
    gather();
    builder_.match([&](std::uint32_t number) { return patches_.same_vertices[number]; });
    patches_.renumbered.clear();  // same_triangles has them
    return std::move(patches_);
  }

 private:
  void match_vertices() {
    patches_.same_vertices.assign(after_.points.size(), no_index);
    const bool keyed = !before_.vertex_keys.empty() && !after_.vertex_keys.empty();
    keyed ? match_by_keys() : match_by_places();
  }

  void match_by_keys() {
    Directory<std::uint64_t> keys;
    for (std::uint32_t v = 0; v < before_.points.size(); ++v) keys.add(before_.vertex_keys[v], v);
    keys.close();
    const std::vector<bool> was_boundary = boundary_points(before_), is_boundary = boundary_points(after_);
    for (std::uint32_t v = 0; v < after_.points.size(); ++v) {
      const std::uint32_t old = keys.find(after_.vertex_keys[v]);
      if (old == no_index || was_boundary[old] != is_boundary[v]) continue;
      // At the same place it is the same, although a domain whose loops have another order counts its curves
      // otherwise.
      const bool same = before_.points[old] == after_.points[v] || (is_boundary[v] && same_parameter(old, v));
      if (same) patches_.same_vertices[v] = old;
    }
  }

  bool same_parameter(std::uint32_t old, std::uint32_t now) const {
    if (before_.curve.empty() || after_.curve.empty()) return true;
    if (before_.curve[old] != after_.curve[now]) return false;
    return before_.parameter.empty() || after_.parameter.empty() ||
           before_.parameter[old] == after_.parameter[now];
  }

  void match_by_places() {
    Directory<std::pair<double, double>> places;
    for (std::uint32_t v = 0; v < before_.points.size(); ++v)
      places.add({before_.points[v].x, before_.points[v].y}, v);
    places.close();
    for (std::uint32_t v = 0; v < after_.points.size(); ++v)
      patches_.same_vertices[v] = places.find({after_.points[v].x, after_.points[v].y});
  }

  void match_triangles() {
    Directory<Triple> known;
    for (std::uint32_t t = 0; t < before_.triangles.size(); ++t)
      known.add(from_least(before_.triangles[t]), t);
    known.close();
    patches_.same_triangles.assign(after_.triangles.size(), no_index);
    old_rests_.assign(before_.triangles.size(), false);
    new_rests_.assign(after_.triangles.size(), false);
    for (std::uint32_t t = 0; t < after_.triangles.size(); ++t) {
      Triple corners;
      bool there = true, rests = true;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t now = after_.triangles[t][k];
        corners[k] = patches_.same_vertices[now];
        there = there && corners[k] != no_index;
        rests = rests && there && before_.points[corners[k]] == after_.points[now];
      }
      if (!there) continue;
      const std::uint32_t old = known.find(from_least(corners));
      patches_.same_triangles[t] = old;
      if (old != no_index && rests) old_rests_[old] = true, new_rests_[t] = true;
    }
  }

  // What has changed, and what shares a vertex with it.
  void gather() {
    std::vector<bool> marked(before_.points.size(), false);
    for (std::uint32_t t = 0; t < before_.triangles.size(); ++t)
      if (!old_rests_[t])
        for (const std::uint32_t v : before_.triangles[t]) marked[v] = true;
    for (std::uint32_t t = 0; t < before_.triangles.size(); ++t)
      if (!old_rests_[t] || touches(before_.triangles[t], marked)) add_before(t);
    for (std::uint32_t t = 0; t < after_.triangles.size(); ++t)
      if (!new_rests_[t] || touches(before_.triangles[patches_.same_triangles[t]], marked)) add_after(t);
  }

  static bool touches(const Triple& corners, const std::vector<bool>& marked) {
    return marked[corners[0]] || marked[corners[1]] || marked[corners[2]];
  }

  void add_before(std::uint32_t t) {
    patches_.before.triangles.push_back(
        builder_.before(before_.triangles[t], t, [&](std::uint32_t v) { return before_.points[v]; }));
  }
  void add_after(std::uint32_t t) {
    patches_.after.triangles.push_back(
        builder_.after(after_.triangles[t], t, [&](std::uint32_t v) { return after_.points[v]; }));
  }

  const FrozenMesh &before_, &after_;
  Patches patches_;
  PatchBuilder builder_;
  std::vector<bool> old_rests_, new_rests_;
};

}  // namespace

Patches patches_between(const FrozenMesh& before, const FrozenMesh& after) {
  return BetweenMeshes(before, after).run();
}

}  // namespace remodel
