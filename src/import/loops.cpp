#include "import/loops.h"

#include <algorithm>
#include <utility>

#include "import/interfaces.h"
#include "remodel/ids.h"

namespace remodel {

namespace {

using Chain = std::vector<BoundaryEdge>;  // closed

std::vector<Chain> chains_of(const SoundMesh& mesh) {
  std::vector<std::uint32_t> leaving(mesh.points.size(), no_index);
  for (std::uint32_t i = 0; i < mesh.boundary.size(); ++i) leaving[mesh.boundary[i].from] = i;
  std::vector<Chain> chains;
  for (const BoundaryEdge& first : mesh.boundary) {
    if (leaving[first.from] == no_index) continue;
    Chain& chain = chains.emplace_back();
    for (std::uint32_t v = first.from; leaving[v] != no_index;) {
      const std::uint32_t edge = std::exchange(leaving[v], no_index);
      chain.push_back(mesh.boundary[edge]);
      v = chain.back().to;
    }
  }
  return chains;
}

std::ptrdiff_t first_named(const Chain& chain) {
  return std::min_element(chain.begin(), chain.end(),
                          [](const BoundaryEdge& a, const BoundaryEdge& b) { return a.place < b.place; }) -
         chain.begin();
}

// Rotated to begin with the run that has the first named edge.
void begin_with_first(const SoundMesh& mesh, Chain& chain) {
  const auto n = static_cast<std::ptrdiff_t>(chain.size());
  const std::ptrdiff_t named = first_named(chain);
  std::ptrdiff_t begin = named;
  const auto before = [&](std::ptrdiff_t i) { return (i + n - 1) % n; };
  const auto marker = [&](std::ptrdiff_t i) { return chain[static_cast<std::size_t>(i)].marker; };
  while (marker(before(begin)) == marker(named)) {
    begin = before(begin);
    if (begin == named) {  // one name all around
      for (std::ptrdiff_t left = n; left > 0 && mesh.is_steiner(chain[static_cast<std::size_t>(begin)].from);
           --left)
        begin = before(begin);
      break;
    }
  }
  std::rotate(chain.begin(), chain.begin() + begin, chain.end());
}

Curve curve_of(const SoundMesh& mesh, Chain::const_iterator begin, Chain::const_iterator end) {
  Polyline line;
  for (auto edge = begin; edge != end; ++edge) line.points.push_back(mesh.points[edge->from]);
  line.points.push_back(mesh.points[(end - 1)->to]);
  return {.name = mesh.markers[begin->marker],
          .shape = std::move(line),
          .parameters = Parameters::uniform(static_cast<std::size_t>(end - begin))};
}

Loop loop_of(const SoundMesh& mesh, const Chain& chain) {
  Loop loop;
  for (auto begin = chain.begin(), end = begin; begin != chain.end(); begin = end) {
    while (end != chain.end() && end->marker == begin->marker) ++end;
    loop.curves.push_back(curve_of(mesh, begin, end));
  }
  return loop;
}

void add_inner_chain(const SoundMesh& mesh, const InnerChain& chain, LoopsOfMesh& result) {
  const auto region = [&](std::uint32_t index) {
    return index == no_region ? std::string() : mesh.region_names[index];
  };
  Polyline line;
  for (const std::uint32_t point : chain.points) line.points.push_back(mesh.points[point]);
  result.domain.loops.push_back({.role = LoopRole::internal,
                                 .curves = {{.name = mesh.markers[chain.marker],
                                             .shape = std::move(line),
                                             .parameters = Parameters::uniform(chain.points.size() - 1)}},
                                 .open = !chain.closed(),
                                 .placement = {},
                                 .region = region(chain.left),
                                 .right_region = region(chain.right)});
  result.points.push_back(chain.points);
  if (chain.closed()) {
    result.points.back().pop_back();
  } else {
    result.joint[chain.points.front()] = result.joint[chain.points.back()] = true;
  }
}

// What lies beside each loop: where it passes several regions, inner chains say which.
void name_regions(const SoundMesh& mesh, LoopsOfMesh& result) {
  if (mesh.region.empty()) return;
  const std::vector<DirectedEdge> edges = directed_edges(mesh.triangles);
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    const auto& points = result.points[i];
    const DirectedEdge* edge = find_edge(edges, points[0], points[1]);
    result.domain.loops[i].region = mesh.region_names[mesh.region[edge->triangle]];
  }
}

}  // namespace

LoopsOfMesh loops_of(const SoundMesh& mesh) {
  std::vector<Chain> chains = chains_of(mesh);
  for (Chain& chain : chains) begin_with_first(mesh, chain);
  std::sort(chains.begin(), chains.end(), [](const Chain& a, const Chain& b) {
    return a[static_cast<std::size_t>(first_named(a))].place <
           b[static_cast<std::size_t>(first_named(b))].place;
  });
  LoopsOfMesh result;
  for (const Chain& chain : chains) {
    result.domain.loops.push_back(loop_of(mesh, chain));
    auto& points = result.points.emplace_back();
    for (const BoundaryEdge& edge : chain) points.push_back(edge.from);
  }
  // With the domain on the left, outlines run counter-clockwise and holes clockwise.
  for (std::size_t i = 0; i < result.domain.loops.size(); ++i)
    result.domain.loops[i].role = signed_area(result.domain, i) > 0.0 ? LoopRole::outer : LoopRole::hole;
  name_regions(mesh, result);
  result.joint.assign(mesh.points.size(), false);
  for (const InnerChain& chain : inner_chains(mesh)) add_inner_chain(mesh, chain, result);
  return result;
}

}  // namespace remodel
