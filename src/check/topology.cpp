#include "check/topology.h"

#include <algorithm>
#include <utility>

namespace remodel::checker {

namespace {

std::pair<std::uint32_t, std::uint32_t> sorted_ends(std::uint32_t a, std::uint32_t b) {
  return std::minmax(a, b);
}

}  // namespace

std::size_t corner_of(Corners cell, std::uint32_t point) {
  return static_cast<std::size_t>(std::find(cell.begin(), cell.end(), point) - cell.begin());
}

struct Topology::HalfEdge {
  std::uint32_t from, to;
  std::uint32_t cell;
  std::uint32_t corner;

  auto key() const { return std::pair(sorted_ends(from, to), cell); }
};

Topology::Topology(const FrozenMesh& mesh, Report& report)
    : mesh_(mesh), neighbours_(mesh.cell_count(), {none, none, none, none}) {
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
  halves.reserve(3 * mesh_.triangles.size() + 4 * mesh_.quads.size());
  for (std::uint32_t i = 0; i < mesh_.cell_count(); ++i) {
    const Corners corners = mesh_.cell(i);
    for (std::uint32_t k = 0; k < corners.size(); ++k)
      halves.push_back({corners[k], next_corner(corners, k), i, k});
  }
  std::sort(halves.begin(), halves.end(),
            [](const HalfEdge& a, const HalfEdge& b) { return a.key() < b.key(); });
  return halves;
}

void Topology::add_edge(const HalfEdge* first, const HalfEdge* last, Report& report) {
  const auto count = last - first;
  if (count == 1) {
    edges_.push_back({first->from, first->to, first->cell, none});
    return;
  }
  if (count > 2) {
    std::vector<std::uint32_t> cells;
    for (const HalfEdge* h = first; h != last; ++h) cells.push_back(h->cell);
    report.add("adjacency", std::move(cells),
               sentence("the edge of points ", first->from, " and ", first->to, " is in ", count,
                        mesh_.quads.empty() ? " triangles" : " cells"));
    return;
  }
  const HalfEdge& second = first[1];
  if (first->from == second.from) {
    report.add(
        "adjacency", {first->cell, second.cell},
        sentence(mesh_.quads.empty() ? "triangles " : "cells ", first->cell, " and ", second.cell,
                 " pass the edge of points ", first->from, " and ", first->to, " in the same direction"));
    return;
  }
  edges_.push_back({first->from, first->to, first->cell, second.cell});
  neighbours_[first->cell][first->corner] = second.cell;
  neighbours_[second.cell][second.corner] = first->cell;
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
  const auto visit = [&](std::uint32_t cell) {
    if (cell == none || seen[cell]) return;
    seen[cell] = true;
    stack.push_back(cell);
  };
  std::size_t components = 0;
  for (std::uint32_t start = 0; start < neighbours_.size(); ++start) {
    if (seen[start]) continue;
    ++components;
    visit(start);
    while (!stack.empty()) {
      const std::uint32_t cell = stack.back();
      stack.pop_back();
      for (const std::uint32_t next : neighbours_[cell]) visit(next);
    }
  }
  return components;
}

std::uint32_t Topology::next_on_boundary(std::uint32_t e) const {
  const std::uint32_t v = edges_[e].to;
  for (std::uint32_t t = edges_[e].left;;) {
    const Corners corners = mesh_.cell(t);
    const std::size_t k = corner_of(corners, v);
    if (neighbours_[t][k] == none) return find(v, next_corner(corners, k));
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
