#include "import/loops.h"

#include <algorithm>
#include <utility>

#include "import/interfaces.h"
#include "remodel/ids.h"

namespace remodel {

namespace {

using Chain = std::vector<BoundaryEdge>;

// The boundary, cut at the points where more than one of its edges leaves: which piece goes on as which is a
// matter of taste there. Closed chains are those that pass no such point.
class BoundaryChains {
 public:
  explicit BoundaryChains(const SoundMesh& mesh)
      : boundary_(mesh.boundary), leaving_(mesh.points.size(), no_index), joint_(mesh.points.size(), false) {
    for (std::uint32_t i = 0; i < boundary_.size(); ++i) {
      const std::uint32_t from = boundary_[i].from;
      if (leaving_[from] != no_index) joint_[from] = true;
      leaving_[from] = i;
    }
    for (const BoundaryEdge& first : boundary_)
      if (joint_[first.from]) add_open(walk(first));
    for (const BoundaryEdge& first : boundary_)
      if (leaving_[first.from] != no_index && !joint_[first.from]) closed_.push_back(walk(first));
    for (const std::uint32_t point : halves_) joint_[point] = true;
  }

  std::vector<Chain>& closed() { return closed_; }
  std::vector<Chain>& open() { return open_; }
  // Per point: whether an open chain ends there.
  const std::vector<bool>& joint() const { return joint_; }

 private:
  // Up to the next joint, or all around.
  Chain walk(const BoundaryEdge& first) {
    Chain chain{first};
    leaving_[first.from] = no_index;
    for (std::uint32_t v = first.to; !joint_[v] && leaving_[v] != no_index; v = chain.back().to)
      chain.push_back(boundary_[std::exchange(leaving_[v], no_index)]);
    return chain;
  }

  // One that ends where it begins becomes two: a chain has two ends.
  void add_open(Chain chain) {
    if (chain.front().from == chain.back().to) {
      const auto middle = chain.begin() + static_cast<std::ptrdiff_t>(chain.size() / 2);
      halves_.push_back(middle->from);
      open_.emplace_back(middle, chain.end());
      chain.erase(middle, chain.end());
    }
    open_.push_back(std::move(chain));
  }

  const std::vector<BoundaryEdge>& boundary_;
  std::vector<std::uint32_t> leaving_;  // an edge at each point that is not in a chain yet
  std::vector<bool> joint_;
  std::vector<std::uint32_t> halves_;  // points where such chains were cut
  std::vector<Chain> closed_, open_;
};

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
  BoundaryChains boundary(mesh);
  for (Chain& chain : boundary.closed()) begin_with_first(mesh, chain);
  std::vector<std::pair<std::uint32_t, const Chain*>> chains;  // by the place of their first named edge
  for (const std::vector<Chain>* list : {&boundary.closed(), &boundary.open()})
    for (const Chain& chain : *list)
      chains.emplace_back(chain[static_cast<std::size_t>(first_named(chain))].place, &chain);
  std::sort(chains.begin(), chains.end());
  LoopsOfMesh result;
  for (const auto& [place, chain] : chains) {
    Loop& loop = result.domain.loops.emplace_back(loop_of(mesh, *chain));
    auto& points = result.points.emplace_back();
    for (const BoundaryEdge& edge : *chain) points.push_back(edge.from);
    loop.open = chain->front().from != chain->back().to;
    if (loop.open) points.push_back(chain->back().to);
  }
  // With the domain on the left, outlines run counter-clockwise and holes clockwise.
  for (std::size_t i = 0; i < result.domain.loops.size(); ++i)
    result.domain.loops[i].role = result.domain.loops[i].open           ? LoopRole::left
                                  : signed_area(result.domain, i) > 0.0 ? LoopRole::outer
                                                                        : LoopRole::hole;
  name_regions(mesh, result);
  result.joint = boundary.joint();
  for (const InnerChain& chain : inner_chains(mesh)) add_inner_chain(mesh, chain, result);
  return result;
}

}  // namespace remodel
