#include "io/assemble.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <utility>
#include <vector>

#include "remodel/error.h"
#include "remodel/io.h"

namespace remodel::io {

namespace {

using Edge = std::array<std::uint32_t, 2>;

// Beyond any doubt that rounding leaves. The bound is that of the orientation predicate's filter, (3 + 16
// eps) eps of the permanent (Shewchuk 1997): a sliver whose sign is open stays as it is.
bool surely_clockwise(Point a, Point b, Point c) {
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  return left - right < -3.3306690738754716e-16 * (std::abs(left) + std::abs(right));
}

// A program may write all its triangles clockwise: then they are all turned. One among others that are not is
// a fault of the mesh, which a reader must not hide from the checker.
void turn_triangles(FrozenMesh& mesh) {
  std::size_t clockwise = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    if (surely_clockwise(mesh.points[a], mesh.points[b], mesh.points[c])) ++clockwise;
  }
  if (2 * clockwise <= mesh.triangles.size()) return;
  for (auto& [a, b, c] : mesh.triangles) std::swap(b, c);
}

std::uint64_t key_of(std::uint32_t from, std::uint32_t to) {
  return std::uint64_t{from} << 32 | to;
}

// For every boundary edge, in both directions: does a triangle have it in that direction?
std::unordered_map<std::uint64_t, bool> directions_in_triangles(const FrozenMesh& mesh) {
  std::unordered_map<std::uint64_t, bool> found;
  std::vector<bool> on_boundary(mesh.points.size());
  for (const auto& boundary : mesh.boundaries) {
    for (const auto& [a, b] : boundary.edges) {
      found[key_of(a, b)] = found[key_of(b, a)] = false;
      on_boundary[a] = on_boundary[b] = true;
    }
  }
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto from = triangle[i];
      const auto to = triangle[(i + 1) % 3];
      if (!on_boundary[from] || !on_boundary[to]) continue;
      if (const auto entry = found.find(key_of(from, to)); entry != found.end()) entry->second = true;
    }
  }
  return found;
}

void turn_boundary_edges(FrozenMesh& mesh) {
  const auto found = directions_in_triangles(mesh);
  for (auto& boundary : mesh.boundaries) {
    for (auto& [a, b] : boundary.edges) {
      if (!found.at(key_of(a, b)) && found.at(key_of(b, a))) std::swap(a, b);
    }
  }
}

// Walks along edges that start where the last one ended.
class ChainWalker {
 public:
  explicit ChainWalker(const std::vector<Edge>& edges) : edges_(edges), taken_(edges.size()) {
    for (std::size_t i = edges.size(); i-- > 0;) leaving_[edges[i][0]].push_back(i);  // first at the back
    for (const auto& edge : edges) ++arriving_[edge[1]];
  }

  std::vector<Edge> ordered() {
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      if (!arriving_.contains(edges_[i][0])) walk_from(i);
    }
    for (std::size_t i = 0; i < edges_.size(); ++i) walk_from(i);
    return std::move(result_);
  }

 private:
  void walk_from(std::size_t edge) {
    while (!taken_[edge]) {
      taken_[edge] = true;
      result_.push_back(edges_[edge]);
      const auto next = leaving_.find(edges_[edge][1]);
      if (next == leaving_.end()) return;
      auto& candidates = next->second;
      while (candidates.size() > 1 && taken_[candidates.back()]) candidates.pop_back();
      edge = candidates.back();
    }
  }

  const std::vector<Edge>& edges_;
  std::vector<bool> taken_;
  std::unordered_map<std::uint32_t, std::vector<std::size_t>> leaving_;
  std::unordered_map<std::uint32_t, int> arriving_;
  std::vector<Edge> result_;
};

}  // namespace

void adopt_conventions(FrozenMesh& mesh, const std::string& file) {
  if (mesh.triangles.empty())
    throw Error(ErrorCode::format, file, "no triangle found, at least one expected");
  turn_triangles(mesh);
  turn_boundary_edges(mesh);
  for (auto& boundary : mesh.boundaries) boundary.edges = ChainWalker(boundary.edges).ordered();
}

void RegionNames::add(FrozenMesh& mesh, const std::string& name) {
  const auto [entry, added] =
      indices_.try_emplace(name, static_cast<std::uint32_t>(mesh.region_names.size()));
  if (added) mesh.region_names.push_back(name);
  mesh.region.push_back(entry->second);
}

void RegionNames::finish(FrozenMesh& mesh) {
  if (mesh.region_names.size() > 1) return;
  mesh.region.clear();
  mesh.region_names.clear();
}

FrozenMesh without_inner_edges(const FrozenMesh& mesh) {
  FrozenMesh result = mesh;
  const auto found = directions_in_triangles(mesh);
  std::erase_if(result.boundaries, [&](FrozenBoundary& boundary) {
    const auto inner = [&](const Edge& e) {
      return found.at(key_of(e[0], e[1])) && found.at(key_of(e[1], e[0]));
    };
    return std::erase_if(boundary.edges, inner) > 0 && boundary.edges.empty();
  });
  return result;
}

std::pair<std::size_t, bool> BoundaryNames::add(FrozenMesh& mesh, const std::string& name) {
  const auto [entry, added] = indices_.try_emplace(name, mesh.boundaries.size());
  if (added) mesh.boundaries.push_back({name, {}});
  return {entry->second, added};
}

std::vector<std::size_t> triangles_at_boundaries(const FrozenMesh& mesh) {
  const auto key = [](std::uint32_t a, std::uint32_t b) { return std::uint64_t{a} << 32 | b; };
  std::unordered_map<std::uint64_t, std::size_t> found;
  for (const auto& boundary : mesh.boundaries)
    for (const auto& [a, b] : boundary.edges) found[key(a, b)] = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& corners = mesh.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto edge = found.find(key(corners[k], corners[(k + 1) % 3]));
      if (edge != found.end()) edge->second = t;
    }
  }
  std::vector<std::size_t> result;
  for (const auto& boundary : mesh.boundaries)
    for (const auto& [a, b] : boundary.edges) result.push_back(found[key(a, b)]);
  return result;
}

}  // namespace remodel::io

namespace remodel {

std::vector<std::string> inner_curves(const FrozenMesh& mesh) {
  const auto found = io::directions_in_triangles(mesh);
  std::vector<std::string> names;
  for (const FrozenBoundary& boundary : mesh.boundaries) {
    const auto inner = [&](const auto& e) {
      return found.at(io::key_of(e[0], e[1])) && found.at(io::key_of(e[1], e[0]));
    };
    if (std::any_of(boundary.edges.begin(), boundary.edges.end(), inner)) names.push_back(boundary.name);
  }
  return names;
}

}  // namespace remodel
