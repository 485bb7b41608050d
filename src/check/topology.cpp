#include "check/topology.h"

#include <algorithm>
#include <utility>

namespace remodel::checker {

namespace {

std::pair<std::uint32_t, std::uint32_t> sorted_ends(std::uint32_t a, std::uint32_t b) {
  return std::minmax(a, b);
}

}  // namespace

struct Topology::HalfEdge {
  std::uint32_t from, to;
  std::uint32_t triangle;
  std::uint32_t corner;

  auto key() const { return std::pair(sorted_ends(from, to), triangle); }
};

Topology::Topology(const FrozenMesh& mesh, Report& report)
    : mesh_(mesh), neighbours_(mesh.triangles.size(), {none, none, none}) {
  const std::vector<HalfEdge> halves = sorted_half_edges();
  const HalfEdge* const end = halves.data() + halves.size();
  for (const HalfEdge* first = halves.data(); first != end;) {
    const auto ends = sorted_ends(first->from, first->to);
    const HalfEdge* const last =
        std::find_if(first, end, [&](const HalfEdge& h) { return sorted_ends(h.from, h.to) != ends; });
    add_edge(first, last, report);
    first = last;
  }
}

std::vector<Topology::HalfEdge> Topology::sorted_half_edges() const {
  std::vector<HalfEdge> halves;
  halves.reserve(3 * mesh_.triangles.size());
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
    const auto& corners = mesh_.triangles[t];
    for (std::uint32_t k = 0; k < 3; ++k) halves.push_back({corners[k], corners[(k + 1) % 3], t, k});
  }
  std::sort(halves.begin(), halves.end(),
            [](const HalfEdge& a, const HalfEdge& b) { return a.key() < b.key(); });
  return halves;
}

void Topology::add_edge(const HalfEdge* first, const HalfEdge* last, Report& report) {
  const auto count = last - first;
  if (count == 1) {
    edges_.push_back({first->from, first->to, first->triangle, none});
    return;
  }
  if (count > 2) {
    std::vector<std::uint32_t> triangles;
    for (const HalfEdge* h = first; h != last; ++h) triangles.push_back(h->triangle);
    report.add(
        "adjacency", std::move(triangles),
        sentence("the edge of points ", first->from, " and ", first->to, " is in ", count, " triangles"));
    return;
  }
  const HalfEdge& second = first[1];
  if (first->from == second.from) {
    report.add("adjacency", {first->triangle, second.triangle},
               sentence("triangles ", first->triangle, " and ", second.triangle, " pass the edge of points ",
                        first->from, " and ", first->to, " in the same direction"));
    return;
  }
  edges_.push_back({first->from, first->to, first->triangle, second.triangle});
  neighbours_[first->triangle][first->corner] = second.triangle;
  neighbours_[second.triangle][second.corner] = first->triangle;
}

std::uint32_t Topology::find(std::uint32_t a, std::uint32_t b) const {
  const auto ends = sorted_ends(a, b);
  const auto found = std::lower_bound(edges_.begin(), edges_.end(), ends, [](const Edge& e, const auto& key) {
    return sorted_ends(e.from, e.to) < key;
  });
  if (found == edges_.end() || sorted_ends(found->from, found->to) != ends) return none;
  return static_cast<std::uint32_t>(found - edges_.begin());
}

std::uint32_t Topology::opposite(const Edge& edge, std::uint32_t triangle) const {
  const auto& corners = mesh_.triangles[triangle];
  return *std::find_if(corners.begin(), corners.end(),
                       [&](std::uint32_t v) { return v != edge.from && v != edge.to; });
}

std::size_t Topology::component_count() const {
  std::vector<bool> seen(neighbours_.size(), false);
  std::vector<std::uint32_t> stack;
  const auto visit = [&](std::uint32_t triangle) {
    if (triangle == none || seen[triangle]) return;
    seen[triangle] = true;
    stack.push_back(triangle);
  };
  std::size_t components = 0;
  for (std::uint32_t start = 0; start < neighbours_.size(); ++start) {
    if (seen[start]) continue;
    ++components;
    visit(start);
    while (!stack.empty()) {
      const std::uint32_t triangle = stack.back();
      stack.pop_back();
      for (const std::uint32_t next : neighbours_[triangle]) visit(next);
    }
  }
  return components;
}

std::uint32_t Topology::next_on_boundary(std::uint32_t e) const {
  const std::uint32_t v = edges_[e].to;
  for (std::uint32_t t = edges_[e].left;;) {
    const auto& corners = mesh_.triangles[t];
    const auto k = static_cast<std::size_t>(std::find(corners.begin(), corners.end(), v) - corners.begin());
    if (neighbours_[t][k] == none) return find(v, corners[(k + 1) % 3]);
    t = neighbours_[t][k];
  }
}

std::vector<std::vector<std::uint32_t>> Topology::loops() const {
  std::vector<std::uint32_t> starts;  // in the order of their first points
  for (std::uint32_t e = 0; e < edges_.size(); ++e)
    if (edges_[e].is_boundary()) starts.push_back(e);
  std::stable_sort(starts.begin(), starts.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return edges_[a].from < edges_[b].from; });
  std::vector<bool> seen(edges_.size(), false);
  std::vector<std::vector<std::uint32_t>> loops;
  for (const std::uint32_t start : starts) {
    if (seen[start]) continue;
    loops.emplace_back();
    for (std::uint32_t e = start; !seen[e]; e = next_on_boundary(e)) {
      seen[e] = true;
      loops.back().push_back(e);
    }
  }
  return loops;
}

}  // namespace remodel::checker
