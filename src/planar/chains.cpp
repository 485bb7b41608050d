#include "planar/chains.h"

#include <algorithm>

namespace remodel {
namespace {

class Linker {
 public:
  explicit Linker(Arrangement& arrangement) : arrangement_(arrangement) {
    for (const auto& [key, marker] : arrangement.edges()) {
      const auto [a, b] = key;
      if (!arrangement.domain_on_left(a, b) && !arrangement.domain_on_left(b, a)) {
        ++arrangement.findings.outside_segments;
        continue;
      }
      neighbours_[a].push_back(b);
      neighbours_[b].push_back(a);
    }
  }

  std::vector<Chain> run() {
    for (const auto& [v, neighbours] : neighbours_)
      if (neighbours.size() != 2)
        for (const VertexId to : neighbours) follow(v, to, true);
    for (const auto& [v, neighbours] : neighbours_) follow(v, neighbours.front(), false);
    return std::move(chains_);
  }

 private:
  using Directed = std::pair<VertexId, VertexId>;

  void follow(VertexId from, VertexId to, bool joined) {
    if (!arrangement_.edges().contains(undirected(from, to)) || used_[undirected(from, to)]) return;
    Chain chain{.vertices = {from}, .markers = {}, .joined = joined};
    chain.domain_left = arrangement_.domain_on_left(from, to);
    chain.domain_right = arrangement_.domain_on_left(to, from);
    const VertexId start = from;
    for (;;) {
      used_[undirected(from, to)] = true;
      chain.vertices.push_back(to);
      chain.markers.push_back(arrangement_.edges().at(undirected(from, to)));
      const std::vector<VertexId>& next = neighbours_.at(to);
      if (next.size() != 2 || to == start) break;
      from = std::exchange(to, next[0] == from ? next[1] : next[0]);
    }
    chains_.push_back(std::move(chain));
  }

  Arrangement& arrangement_;
  std::map<VertexId, std::vector<VertexId>> neighbours_;
  std::map<Arrangement::Key, bool> used_;
  std::vector<Chain> chains_;
};

}  // namespace

std::vector<Chain> link_chains(Arrangement& arrangement) {
  return Linker(arrangement).run();
}

}  // namespace remodel
