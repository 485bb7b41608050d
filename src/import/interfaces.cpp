#include "import/interfaces.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "remodel/ids.h"

namespace remodel {

namespace {

class ChainMaker {
 public:
  explicit ChainMaker(const SoundMesh& mesh)
      : edges_(mesh.inner), taken_(edges_.size(), false), on_boundary_(mesh.points.size(), false) {
    std::sort(edges_.begin(), edges_.end(),
              [](const InnerEdge& a, const InnerEdge& b) { return a.place < b.place; });
    for (std::uint32_t i = 0; i < edges_.size(); ++i) {
      ends_.push_back({edges_[i].from, i});
      ends_.push_back({edges_[i].to, i});
    }
    std::sort(ends_.begin(), ends_.end());
    for (const BoundaryEdge& edge : mesh.boundary) on_boundary_[edge.from] = true;
  }

  std::vector<InnerChain> run() {
    for (std::uint32_t i = 0; i < edges_.size(); ++i) {
      if (is_end(edges_[i].from)) walk(i, edges_[i].from);
      if (is_end(edges_[i].to)) walk(i, edges_[i].to);
    }
    for (std::uint32_t i = 0; i < edges_.size(); ++i) walk(i, edges_[i].from);
    return std::move(chains_);
  }

 private:
  using End = std::pair<std::uint32_t, std::uint32_t>;  // point, edge

  static auto kind(const InnerEdge& edge) {
    return std::tuple(edge.marker, std::min(edge.left, edge.right), std::max(edge.left, edge.right));
  }

  std::pair<std::vector<End>::const_iterator, std::vector<End>::const_iterator> edges_at(
      std::uint32_t point) const {
    return {std::lower_bound(ends_.begin(), ends_.end(), End{point, 0}),
            std::upper_bound(ends_.begin(), ends_.end(), End{point, no_index})};
  }

  bool is_end(std::uint32_t point) const {
    const auto [begin, end] = edges_at(point);
    return on_boundary_[point] || end - begin != 2 ||
           kind(edges_[begin->second]) != kind(edges_[(begin + 1)->second]);
  }

  void walk(std::uint32_t edge, std::uint32_t from) {
    if (taken_[edge]) return;
    const InnerEdge& first = edges_[edge];
    const bool along = first.from == from;
    InnerChain chain{.points = {from},
                     .marker = first.marker,
                     .left = along ? first.left : first.right,
                     .right = along ? first.right : first.left};
    while (!taken_[edge]) {
      taken_[edge] = true;
      const std::uint32_t to = edges_[edge].from == chain.points.back() ? edges_[edge].to : edges_[edge].from;
      chain.points.push_back(to);
      if (is_end(to)) break;
      const auto begin = edges_at(to).first;
      edge = begin->second == edge ? (begin + 1)->second : begin->second;
    }
    add(std::move(chain));
  }

  // A loop that begins where other chains end is none by itself: it becomes two chains.
  void add(InnerChain chain) {
    if (chain.closed() && is_end(chain.points.front())) {
      InnerChain rest = chain;
      const auto half = static_cast<std::ptrdiff_t>(chain.points.size() / 2);
      rest.points.erase(rest.points.begin(), rest.points.begin() + half);
      chain.points.resize(static_cast<std::size_t>(half) + 1);
      chains_.push_back(std::move(chain));
      chains_.push_back(std::move(rest));
      return;
    }
    chains_.push_back(std::move(chain));
  }

  std::vector<InnerEdge> edges_;
  std::vector<End> ends_;  // sorted
  std::vector<bool> taken_;
  std::vector<bool> on_boundary_;
  std::vector<InnerChain> chains_;
};

}  // namespace

std::vector<InnerChain> inner_chains(const SoundMesh& mesh) {
  return ChainMaker(mesh).run();
}

}  // namespace remodel
