#include "import/sound.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <tuple>

#include "remodel/error.h"
#include "remodel/ids.h"
#include "remodel/predicates.h"

namespace remodel {

namespace {

bool listed_before(const DirectedEdge& a, const DirectedEdge& b) {
  return std::tie(a.from, a.to) < std::tie(b.from, b.to);
}

class Mender {
 public:
  Mender(const FrozenMesh& mesh, const std::string& source, const std::string& unnamed)
      : mesh_(mesh), source_(source), unnamed_(unnamed) {}

  SoundMesh run() {
    take_points();
    refuse_coinciding_points();
    turn_triangles();
    drop_duplicates();
    edges_ = directed_edges(sound_.triangles);
    refuse_shared_edges();
    take_boundary();
    take_regions();
    name_boundary();
    name_interfaces();
    return std::move(sound_);
  }

 private:
  template <typename... Parts>
  [[noreturn]] void refuse(const Parts&... parts) const {
    std::ostringstream problem;
    problem.precision(17);
    (problem << ... << parts);
    throw Error(ErrorCode::geometry, source_, problem.str());
  }

  // Those that a triangle uses, with the file's numbers for messages.
  void take_points() {
    if (mesh_.triangles.empty()) refuse("no triangle found, at least one expected");
    std::vector<std::uint32_t> index(mesh_.points.size(), no_index);
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i)
      for (const std::uint32_t v : mesh_.triangles[i]) {
        if (v >= index.size())
          refuse("triangle ", i, ": point ", v, " found, an index below ", index.size(), " expected");
        index[v] = 0;
      }
    for (std::uint32_t v = 0; v < index.size(); ++v) {
      if (index[v] == no_index) {
        ++sound_.unused;
        continue;
      }
      const Point p = mesh_.points[v];
      if (!safe_for_predicates(p))
        refuse("point ", v, ": (", p.x, ", ", p.y,
               ") found, coordinates that are 0 or of magnitude 1e-60 to 1e60 expected");
      index[v] = static_cast<std::uint32_t>(sound_.points.size());
      sound_.points.push_back(p);
      if (mesh_.steiner.size() == mesh_.points.size()) sound_.steiner.push_back(mesh_.steiner[v]);
      number_.push_back(v);
    }
    take_keys();
    for (const auto& [a, b, c] : mesh_.triangles) sound_.triangles.push_back({index[a], index[b], index[c]});
    index_ = std::move(index);
  }

  // Keys that a living mesh wrote ascend, and their ids leave few gaps: vertices go on with them. Of others
  // it is enough that no key to come is one of them.
  void take_keys() {
    constexpr std::uint32_t largest_generation = 1U << 31;
    if (mesh_.vertex_keys.size() != mesh_.points.size()) return;
    std::uint32_t last = mesh_.last_generation, highest = 0;
    bool ascending = true;
    for (const std::uint32_t v : number_) {
      const VertexKey key = VertexKey::of(mesh_.vertex_keys[v]);
      ascending = ascending && key.id.index > highest && key.generation > 0;
      highest = key.id.index, last = std::max(last, key.generation);
      sound_.keys.push_back(key);
    }
    if (last > largest_generation || !ascending || highest > 2 * number_.size() + 1000) sound_.keys.clear();
    if (last <= largest_generation) sound_.last_generation = last;
  }

  void refuse_coinciding_points() const {
    std::vector<std::uint32_t> order(sound_.points.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto& p = sound_.points;
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::tie(p[a].x, p[a].y, a) < std::tie(p[b].x, p[b].y, b);
    });
    for (std::size_t i = 1; i < order.size(); ++i)
      if (p[order[i - 1]] == p[order[i]])
        refuse("points ", number_[order[i - 1]], " and ", number_[order[i]], " coincide at (", p[order[i]].x,
               ", ", p[order[i]].y, "), different points expected");
  }

  void turn_triangles() {
    for (std::size_t i = 0; i < sound_.triangles.size(); ++i) {
      auto& [a, b, c] = sound_.triangles[i];
      const int turn = orient2d(sound_.points[a], sound_.points[b], sound_.points[c]);
      if (turn == 0)
        refuse("triangle ", i, " (points ", number_[a], ", ", number_[b], ", ", number_[c],
               ") has no area, one with an area expected");
      if (turn > 0) continue;
      std::swap(b, c);
      ++sound_.turned;
    }
  }

  // A triangle that is listed again is one: Gmsh's version 2.2 lists it once for each physical surface that
  // it is in. The first one counts.
  void drop_duplicates() {
    std::set<std::array<std::uint32_t, 3>> seen;
    std::vector<std::array<std::uint32_t, 3>> once;
    for (std::uint32_t i = 0; i < sound_.triangles.size(); ++i) {
      std::array<std::uint32_t, 3> corners = sound_.triangles[i];
      std::sort(corners.begin(), corners.end());
      if (!seen.insert(corners).second) continue;
      once.push_back(sound_.triangles[i]);
      listed_.push_back(i);
    }
    sound_.duplicates = sound_.triangles.size() - once.size();
    sound_.triangles = std::move(once);
  }

  void refuse_shared_edges() const {
    for (std::size_t i = 1; i < edges_.size(); ++i)
      if (!listed_before(edges_[i - 1], edges_[i]))
        refuse("triangles ", listed_[edges_[i - 1].triangle], " and ", listed_[edges_[i].triangle],
               " overlap: both have the edge of points ", number_[edges_[i].from], " and ",
               number_[edges_[i].to], " with the same side, one triangle on each side expected");
  }

  void take_boundary() {
    for (const DirectedEdge& edge : edges_)
      if (find_edge(edges_, edge.to, edge.from) == nullptr)
        sound_.boundary.push_back({edge.from, edge.to, no_index, no_index});
  }

  BoundaryEdge* find_boundary(std::uint32_t from, std::uint32_t to) {
    const auto found =
        std::lower_bound(sound_.boundary.begin(), sound_.boundary.end(), from,
                         [](const BoundaryEdge& edge, std::uint32_t v) { return edge.from < v; });
    for (auto edge = found; edge != sound_.boundary.end() && edge->from == from; ++edge)
      if (edge->to == to) return &*edge;
    return nullptr;
  }

  void take_regions() {
    if (mesh_.region.empty()) return;
    if (mesh_.region.size() != mesh_.triangles.size())
      refuse(mesh_.region.size(), " regions of triangles found, ", mesh_.triangles.size(), " expected");
    for (std::size_t i = 0; i < mesh_.region.size(); ++i)
      if (mesh_.region[i] >= mesh_.region_names.size())
        refuse("triangle ", i, ": region ", mesh_.region[i], " found, an index below ",
               mesh_.region_names.size(), " expected");
    for (const std::uint32_t i : listed_) sound_.region.push_back(mesh_.region[i]);
    sound_.region_names = mesh_.region_names;
  }

  std::uint32_t region_of(const DirectedEdge& edge) const {
    return sound_.region.empty() ? no_region : sound_.region[edge.triangle];
  }

  // A name that an edge has twice is one name.
  void name_inner(const DirectedEdge& edge, const DirectedEdge& other, std::uint32_t number,
                  std::uint32_t place) {
    const auto [known, added] =
        inner_.try_emplace(std::minmax(edge.from, edge.to), static_cast<std::uint32_t>(sound_.inner.size()));
    if (added) {
      sound_.inner.push_back({edge.from, edge.to, number, place, region_of(edge), region_of(other)});
    } else if (sound_.inner[known->second].marker != number) {
      refuse("marker '", sound_.markers[number], "': the edge of points ", number_[edge.from], " and ",
             number_[edge.to], " is in marker '", sound_.markers[sound_.inner[known->second].marker],
             "' too, one name an edge expected");
    }
  }

  // Edges between regions that the file does not name.
  void name_interfaces() {
    if (sound_.region.empty()) return;
    const std::string interface = "interface";
    auto number = static_cast<std::uint32_t>(
        std::find(sound_.markers.begin(), sound_.markers.end(), interface) - sound_.markers.begin());
    for (const DirectedEdge& edge : edges_) {
      if (edge.from > edge.to || inner_.contains({edge.from, edge.to})) continue;
      const DirectedEdge* other = find_edge(edges_, edge.to, edge.from);
      if (other == nullptr || region_of(edge) == region_of(*other)) continue;
      if (number == sound_.markers.size()) sound_.markers.push_back(interface);
      name_inner(edge, *other, number, place_++);
    }
  }

  void name_boundary() {
    std::uint32_t& place = place_;
    for (const FrozenBoundary& marker : mesh_.boundaries) {
      const auto number = static_cast<std::uint32_t>(sound_.markers.size());
      sound_.markers.push_back(marker.name);
      for (const auto& edge : marker.edges) name_edge(marker.name, edge, number, place++);
    }
    const auto known = std::find(sound_.markers.begin(), sound_.markers.end(), unnamed_);
    const auto number = static_cast<std::uint32_t>(known - sound_.markers.begin());
    for (BoundaryEdge& edge : sound_.boundary) {
      if (edge.marker != no_index) continue;
      edge.marker = number;
      edge.place = place++;
      ++sound_.unnamed;
    }
    if (sound_.unnamed > 0 && known == sound_.markers.end()) sound_.markers.push_back(unnamed_);
  }

  // A name that an edge has twice is one name.
  void name_edge(const std::string& name, const std::array<std::uint32_t, 2>& edge, std::uint32_t number,
                 std::uint32_t place) {
    const auto known = [&](std::uint32_t v) { return v < index_.size() ? index_[v] : no_index; };
    const std::uint32_t a = known(edge[0]), b = known(edge[1]);
    BoundaryEdge* found = find_boundary(a, b);
    if (found == nullptr) found = find_boundary(b, a);
    if (found == nullptr) {
      const DirectedEdge *left = find_edge(edges_, a, b), *right = find_edge(edges_, b, a);
      if (left != nullptr && right != nullptr) return name_inner(*left, *right, number, place);
      refuse("marker '", name, "': the edge of points ", edge[0], " and ", edge[1],
             " is no triangle's, an edge of the mesh expected");
    }
    if (found->marker != no_index && found->marker != number)
      refuse("marker '", name, "': the edge of points ", edge[0], " and ", edge[1], " is in marker '",
             sound_.markers[found->marker], "' too, one name an edge expected");
    if (found->marker == number) return;
    found->marker = number;
    found->place = place;
  }

  const FrozenMesh& mesh_;
  const std::string& source_;
  const std::string& unnamed_;
  SoundMesh sound_;
  std::vector<std::uint32_t> number_;  // of each point in the file
  std::vector<std::uint32_t> index_;   // of each of the file's points
  std::vector<std::uint32_t> listed_;  // of each triangle in the file
  std::vector<DirectedEdge> edges_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>
      inner_;  // lower point first; index of inner edges
  std::uint32_t place_ = 0;
};

}  // namespace

std::vector<DirectedEdge> directed_edges(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::vector<DirectedEdge> edges;
  edges.reserve(3 * triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) edges.push_back({triangles[i][k], triangles[i][(k + 1) % 3], i});
  std::sort(edges.begin(), edges.end(), [](const DirectedEdge& a, const DirectedEdge& b) {
    return std::tie(a.from, a.to, a.triangle) < std::tie(b.from, b.to, b.triangle);
  });
  return edges;
}

const DirectedEdge* find_edge(const std::vector<DirectedEdge>& edges, std::uint32_t from, std::uint32_t to) {
  const auto found = std::lower_bound(edges.begin(), edges.end(), DirectedEdge{from, to, 0}, listed_before);
  return found != edges.end() && found->from == from && found->to == to ? &*found : nullptr;
}

SoundMesh make_sound(const FrozenMesh& mesh, const std::string& source, const std::string& unnamed) {
  return Mender(mesh, source, unnamed).run();
}

}  // namespace remodel
