#include "import/flat_layers.h"

#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "remodel/error.h"

namespace remodel {

namespace {

constexpr double flattest = 20.0;       // edge over height
constexpr double flat_share = 0.1;      // of a boundary's edges
constexpr std::size_t fewest_flat = 8;  // at sharp corners a few stand in any mesh

std::uint64_t edge_key(std::uint32_t from, std::uint32_t to) {
  return std::uint64_t{from} << 32 | to;
}

bool is_flat_on(Point a, Point b, Point c) {
  const Point edge = b - a;
  const double squared = dot(edge, edge), twice_area = std::abs(cross(edge, c - a));
  return squared > flattest * twice_area;  // height = twice the area / edge
}

// The point across from each edge of a triangle that nobody has on the other side.
std::unordered_map<std::uint64_t, std::uint32_t> points_across(const FrozenMesh& mesh) {
  std::unordered_map<std::uint64_t, std::uint32_t> across;
  for (const auto& corners : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = corners[k], b = corners[(k + 1) % 3], c = corners[(k + 2) % 3];
      if (across.erase(edge_key(b, a)) == 0) across[edge_key(a, b)] = c;
    }
  return across;
}

}  // namespace

void refuse_flat_layers(const FrozenMesh& mesh, const std::string& source) {
  constexpr const char* advice =
      ", which a remodelling would dissolve: a mesh without layers expected, or the wish to lose them "
      "(update --dissolve-layers, ImportOptions::layers), which splits quadrilaterals a b c d into triangles "
      "a b c "
      "and a c d";
  const auto refuse = [&](const std::string& found) {
    throw Error(ErrorCode::geometry, source, found + advice);
  };
  if (!mesh.quads.empty())
    refuse(std::to_string(mesh.quads.size()) +
           (mesh.quads.size() == 1 ? " quadrilateral found" : " quadrilaterals found"));
  const auto across = points_across(mesh);
  const auto is_there = [&](std::uint32_t v) { return v < mesh.points.size(); };
  for (const FrozenBoundary& boundary : mesh.boundaries) {
    std::size_t flat = 0;
    for (const auto& [a, b] : boundary.edges) {
      auto found = across.find(edge_key(a, b));
      if (found == across.end()) found = across.find(edge_key(b, a));
      if (found == across.end() || !is_there(a) || !is_there(b) || !is_there(found->second)) continue;
      if (is_flat_on(mesh.points[a], mesh.points[b], mesh.points[found->second])) ++flat;
    }
    if (flat >= fewest_flat &&
        static_cast<double>(flat) > flat_share * static_cast<double>(boundary.edges.size()))
      refuse("triangles flatter than 20 to 1 on " + std::to_string(flat) + " of " +
             std::to_string(boundary.edges.size()) + " edges of '" + boundary.name + "' found");
  }
}

FrozenMesh without_quads(const FrozenMesh& mesh, const std::string& source) {
  for (std::size_t i = 0; i < mesh.quads.size(); ++i)
    for (const std::uint32_t v : mesh.quads[i])
      if (v >= mesh.points.size())
        throw Error(ErrorCode::geometry, source,
                    "quadrilateral " + std::to_string(i) + ": point " + std::to_string(v) +
                        " found, an index below " + std::to_string(mesh.points.size()) + " expected");
  return with_split_quads(mesh);
}

}  // namespace remodel
