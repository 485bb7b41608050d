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

// By the area that the vectors from c to a and from d to b span: twice that of the triangle a b c where d is
// c, twice that of the quadrilateral a b c d otherwise. Beyond any doubt that rounding leaves. The bound is
// that of the orientation predicate's filter, (3 + 16 eps) eps of the permanent (Shewchuk 1997): a sliver
// whose sign is open stays as it is.
bool surely_clockwise(Point a, Point b, Point c, Point d) {
  const double left = (a.x - c.x) * (b.y - d.y);
  const double right = (a.y - c.y) * (b.x - d.x);
  return left - right < -3.3306690738754716e-16 * (std::abs(left) + std::abs(right));
}

// A program may write all its cells clockwise: then they are all turned. One among others that are not is a
// fault of the mesh, which a reader must not hide from the checker.
void turn_cells(FrozenMesh& mesh) {
  std::size_t clockwise = 0;
  for (std::size_t i = 0; i < mesh.cell_count(); ++i) {
    const auto corners = mesh.cell(i);
    const auto point = [&](std::size_t k) { return mesh.points[corners[k]]; };
    if (surely_clockwise(point(0), point(1), point(2), point(corners.size() - 1))) ++clockwise;
  }
  if (2 * clockwise <= mesh.cell_count()) return;
  for (auto& [a, b, c] : mesh.triangles) std::swap(b, c);
  for (auto& [a, b, c, d] : mesh.quads) std::swap(b, d);
}

std::uint64_t key_of(std::uint32_t from, std::uint32_t to) {
  return std::uint64_t{from} << 32 | to;
}

// For every boundary edge, in both directions: does a cell have it in that direction?
std::unordered_map<std::uint64_t, bool> directions_in_cells(const FrozenMesh& mesh) {
  std::unordered_map<std::uint64_t, bool> found;
  std::vector<bool> on_boundary(mesh.points.size());
  for (const auto& boundary : mesh.boundaries) {
    for (const auto& [a, b] : boundary.edges) {
      found[key_of(a, b)] = found[key_of(b, a)] = false;
      on_boundary[a] = on_boundary[b] = true;
    }
  }
  for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
    const auto corners = mesh.cell(cell);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto from = corners[i];
      const auto to = corners[(i + 1) % corners.size()];
      if (!on_boundary[from] || !on_boundary[to]) continue;
      if (const auto entry = found.find(key_of(from, to)); entry != found.end()) entry->second = true;
    }
  }
  return found;
}

void turn_boundary_edges(FrozenMesh& mesh) {
  const auto found = directions_in_cells(mesh);
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

// Keeps the rows of those points; nothing where there are none.
template <class Value>
void keep_rows(std::vector<Value>& values, std::size_t width, const std::vector<bool>& used) {
  if (values.size() != width * used.size()) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (used[i / width]) values[kept++] = values[i];
  values.resize(kept);
}

}  // namespace

std::vector<bool> used_points(const FrozenMesh& mesh, std::size_t points) {
  std::vector<bool> used(points);
  for (std::size_t i = 0; i < mesh.cell_count(); ++i)
    for (const std::uint32_t corner : mesh.cell(i)) used[corner] = true;
  return used;
}

std::size_t keep_used_points(FrozenMesh& mesh, const std::vector<bool>& used) {
  if (std::find(used.begin(), used.end(), false) == used.end()) return 0;
  std::size_t edges = 0;
  std::erase_if(mesh.boundaries, [&](FrozenBoundary& boundary) {
    const std::size_t loose =
        std::erase_if(boundary.edges, [&](const Edge& edge) { return !used[edge[0]] || !used[edge[1]]; });
    edges += loose;
    return loose > 0 && boundary.edges.empty();
  });
  keep_rows(mesh.length_scale, 1, used);
  keep_rows(mesh.vertex_ids, 1, used);
  keep_rows(mesh.vertex_keys, 1, used);
  keep_rows(mesh.curve, 1, used);
  keep_rows(mesh.parameter, 1, used);
  keep_rows(mesh.steiner, 1, used);
  keep_rows(mesh.points, 1, used);
  std::vector<std::uint32_t> index(used.size());
  for (std::uint32_t i = 0, kept = 0; i < used.size(); ++i) index[i] = used[i] ? kept++ : kept;
  const auto renumber = [&](auto& cells) {
    for (auto& cell : cells)
      for (std::uint32_t& corner : cell) corner = index[corner];
  };
  renumber(mesh.triangles);
  renumber(mesh.quads);
  for (FrozenBoundary& boundary : mesh.boundaries) renumber(boundary.edges);
  return edges;
}

void keep_used_points(std::span<Field> fields, const std::vector<bool>& used) {
  if (std::find(used.begin(), used.end(), false) == used.end()) return;
  for (Field& field : fields)
    if (field.place == FieldPlace::vertices)
      keep_rows(field.values, static_cast<std::size_t>(field.components), used);
}

void adopt_conventions(FrozenMesh& mesh, const std::string& file) {
  if (mesh.cell_count() == 0)
    throw Error(ErrorCode::format, file, "no triangle found, at least one expected");
  turn_cells(mesh);
  turn_boundary_edges(mesh);
  for (auto& boundary : mesh.boundaries) boundary.edges = ChainWalker(boundary.edges).ordered();
}

void RegionNames::add(FrozenMesh& mesh, Cell cell, const std::string& name) {
  const auto [entry, added] =
      indices_.try_emplace(name, static_cast<std::uint32_t>(mesh.region_names.size()));
  if (added) mesh.region_names.push_back(name);
  (cell == Cell::triangle ? mesh.region : of_quads_).push_back(entry->second);
}

void RegionNames::finish(FrozenMesh& mesh) {
  mesh.region.insert(mesh.region.end(), of_quads_.begin(), of_quads_.end());
  if (mesh.region_names.size() > 1) return;
  mesh.region.clear();
  mesh.region_names.clear();
}

FrozenMesh without_inner_edges(const FrozenMesh& mesh) {
  FrozenMesh result = mesh;
  const auto found = directions_in_cells(mesh);
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

std::vector<std::size_t> cells_at_boundaries(const FrozenMesh& mesh) {
  const auto key = [](std::uint32_t a, std::uint32_t b) { return std::uint64_t{a} << 32 | b; };
  std::unordered_map<std::uint64_t, std::size_t> found;
  for (const auto& boundary : mesh.boundaries)
    for (const auto& [a, b] : boundary.edges) found[key(a, b)] = 0;
  for (std::size_t i = 0; i < mesh.cell_count(); ++i) {
    const auto corners = mesh.cell(i);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto edge = found.find(key(corners[k], corners[(k + 1) % corners.size()]));
      if (edge != found.end()) edge->second = i;
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
  const auto found = io::directions_in_cells(mesh);
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
