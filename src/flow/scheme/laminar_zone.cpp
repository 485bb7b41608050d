#include "flow/scheme/laminar_zone.h"

#include <algorithm>

#include "flow/scheme/friction_mesh.h"
#include "flow/scheme/wall_chains.h"

namespace remodel::flow {

namespace {

struct Chord {
  Point leading, trailing;
  double fraction(Point p) const {
    const Point whole = trailing - leading;
    return dot(p - leading, whole) / dot(whole, whole);
  }
};

// The sides of all walls, by boundary edges.
class WallSides {
 public:
  explicit WallSides(const FlowMesh& mesh);
  const Chord& chord(std::uint32_t edge) const { return chords_[wall_[edge]]; }
  bool lower(std::uint32_t edge) const { return lower_[edge]; }

 private:
  void add_wall(const std::vector<std::uint32_t>& edges);

  const FlowMesh& mesh_;
  std::vector<Chord> chords_;
  std::vector<std::uint32_t> wall_;  // of each edge; no_index: of none
  std::vector<bool> lower_;
};

WallSides::WallSides(const FlowMesh& mesh)
    : mesh_(mesh), wall_(mesh.boundary().size(), no_index), lower_(mesh.boundary().size()) {
  for (const WallChain& chain : wall_chains(mesh)) add_wall(chain.edges);
}

void WallSides::add_wall(const std::vector<std::uint32_t>& edges) {
  std::vector<Point> p;
  for (const std::uint32_t e : edges) p.push_back(mesh_.points()[mesh_.boundary()[e].a]);
  p.push_back(mesh_.points()[mesh_.boundary()[edges.back()].b]);
  const auto rear = std::max_element(p.begin(), p.end(), [](Point a, Point b) { return a.x < b.x; });
  const auto front = std::max_element(p.begin(), p.end(), [&](Point a, Point b) {
    return squared_distance(a, *rear) < squared_distance(b, *rear);
  });
  // Gas lies to the left of the edges: above those that lead from the front to the rear, below those back.
  const auto from = front - p.begin(), to = rear - p.begin();
  for (std::ptrdiff_t i = 0; i < std::ssize(edges); ++i) {
    const std::uint32_t e = edges[static_cast<std::size_t>(i)];
    wall_[e] = static_cast<std::uint32_t>(chords_.size());
    lower_[e] = from < to ? i < from || i >= to : i >= to && i < from;
  }
  chords_.push_back({*front, *rear});
}

}  // namespace

std::vector<bool> laminar_zone(const FrictionMesh& friction_mesh, std::array<double, 2> transition) {
  const FlowMesh& mesh = friction_mesh.dual();
  const WallSides sides(mesh);
  std::vector<bool> laminar(mesh.size(), false);
  for (std::size_t v = 0; v < mesh.size(); ++v) {
    const std::uint32_t e = friction_mesh.nearest()[v];
    if (e == no_index) continue;
    const BoundaryEdge& edge = mesh.boundary()[e];
    const Point a = mesh.points()[edge.a], b = mesh.points()[edge.b];
    const Point place = a + nearest_part(friction_mesh.nearest_from(v), a, b) * (b - a);
    laminar[v] = sides.chord(e).fraction(place) < transition[sides.lower(e) ? 1 : 0];
  }
  return laminar;
}

}  // namespace remodel::flow
