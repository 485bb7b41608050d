// The map of vertices since a mark alone: of what has changed it looks at triangles that are gone, and around
// new vertices.

#include <algorithm>
#include <optional>

#include "transfer/locator.h"
#include "transfer/moment.h"

namespace remodel {

namespace {

class VertexProvenance {
 public:
  VertexProvenance(const Moment& moment, Outside outside) : moment_(moment), outside_(outside) {
    moment.for_each_gone([&](TriangleId id, const Moment::Triple& vertices) { add(id, vertices); });
    locator_.emplace(side_, side_.triangles.size());
  }

  Place place_of(VertexId v) {
    const Point p = moment_.triangulation.point(v);
    if (const std::optional<Place> found = locator_->within(p)) return *found;
    if (!moved_too_) {
      if (const std::optional<Place> found = locate_around(v, p)) return *found;
      add_moved();
      if (const std::optional<Place> found = locator_->within(p)) return *found;
    }
    return locator_->beyond(p, outside_);
  }
  // The corners of the triangle that a place is in, by slot.
  const Moment::Triple& corners_of(const Place& place) const { return vertices_[place.triangle]; }

 private:
  void add(TriangleId id, const Moment::Triple& vertices) {
    const auto first = static_cast<std::uint32_t>(side_.points.size());
    for (const std::uint32_t v : vertices) side_.points.push_back(moment_.point_then(v));
    side_.triangles.push_back({{first, first + 1, first + 2}, id.index});
    vertices_.push_back(vertices);
  }

  // All triangles that are there still but have moved.
  void add_moved() {
    NumberMap seen;
    for (const VertexKey& moved : moment_.fates.moved)
      moment_.triangulation.for_each_corner(moved.id, [&](Corner c) {
        const Triangle& triangle = moment_.triangulation[c.triangle];
        if (triangle.in_domain() && !moment_.is_born(c.triangle) && seen.emplace(c.triangle.index, 0).second)
          add(c.triangle, Moment::triple_of(triangle));
      });
    locator_->extend(side_.triangles.size());
    moved_too_ = true;
  }

  // What is not in a triangle that is gone is mostly in one beside it that has moved.
  std::optional<Place> locate_around(VertexId v, Point p) {
    std::optional<Place> found;
    moment_.triangulation.for_each_corner(v, [&](Corner c) {
      const Triangle& beside = moment_.triangulation[c.triangle];
      const TriangleId t = beside.link[c.index].triangle();
      const Triangle& triangle = moment_.triangulation[t];
      if (!found && triangle.in_domain() && !moment_.is_born(t)) found = locate_in(t, triangle, p);
    });
    return found;
  }

  std::optional<Place> locate_in(TriangleId id, const Triangle& triangle, Point p) {
    const Moment::Triple vertices = Moment::triple_of(triangle);
    const Corners corners{moment_.point_then(vertices[0]), moment_.point_then(vertices[1]),
                          moment_.point_then(vertices[2])};
    if (!holds(corners, p)) return std::nullopt;
    add(id, vertices);  // the locator goes on with those that are gone
    return Place{static_cast<std::uint32_t>(vertices_.size() - 1), clamped_weights_at(corners, p), 0.0};
  }

  const Moment& moment_;
  const Outside outside_;
  PatchSide side_;
  std::vector<Moment::Triple> vertices_;
  std::optional<Locator> locator_;  // of those that are gone
  bool moved_too_ = false;          // and of those that have moved, where that was needed
};

}  // namespace

ValueMap vertex_map_since(const Moment& moment, Outside outside) {
  ValueMap map;
  map.size_before = moment.record.vertex_slots();
  map.size_after = moment.triangulation.vertex_slots();
  for (const VertexKey& key : moment.fates.removed) map.gone.push_back(key.id.index);
  map.starts.push_back(0);
  if (moment.fates.inserted.empty()) return map;
  std::vector<VertexKey> inserted = moment.fates.inserted;
  std::sort(inserted.begin(), inserted.end());
  VertexProvenance provenance(moment, outside);
  for (const VertexKey& key : inserted) {
    bool used = false;  // by a triangle of the domain
    moment.triangulation.for_each_corner(
        key.id, [&](Corner c) { used = used || moment.triangulation[c.triangle].in_domain(); });
    if (!used) continue;
    const Place place = provenance.place_of(key.id);
    map.add_row(key.id.index, provenance.corners_of(place), place.weights, place.distance);
  }
  return map;
}

ValueMap vertex_provenance(const Mesh& mesh, const Mark& mark, const TransferOptions& options) {
  return vertex_map_since(Moment(mesh, mark), options.outside);
}

}  // namespace remodel
