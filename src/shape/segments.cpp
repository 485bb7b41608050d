// The sides are the leaves of a binary tree of bounding boxes, built over their order: what follows each
// other along a polygon is close together, so the order is as good as any sorting. Two subtrees whose boxes
// are apart are done with; for two sides whose boxes meet the exact orientation decides.

#include "segments.h"

#include <algorithm>
#include <vector>

#include "remodel/predicates.h"

namespace remodel {
namespace {

struct Box {
  Point low, high;
};

Box box_of(const Side& side) {
  return {.low = {std::min(side.from.x, side.to.x), std::min(side.from.y, side.to.y)},
          .high = {std::max(side.from.x, side.to.x), std::max(side.from.y, side.to.y)}};
}

Box united(const Box& a, const Box& b) {
  return {.low = {std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y)},
          .high = {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y)}};
}

bool apart(const Box& a, const Box& b) {
  return a.high.x < b.low.x || b.high.x < a.low.x || a.high.y < b.low.y || b.high.y < a.low.y;
}

// Sides that share no corner of the polygon, boxes known to meet. Where the ends of each side are not
// strictly on one side of the other one's line, they meet; for four collinear points the boxes have decided.
bool strangers_meet(const Side& a, const Side& b) {
  return orient2d(a.from, a.to, b.from) * orient2d(a.from, a.to, b.to) <= 0 &&
         orient2d(b.from, b.to, a.from) * orient2d(b.from, b.to, a.to) <= 0;
}

bool turns_back(double before, double corner, double after) {
  return (before < corner && after < corner) || (before > corner && after > corner);
}

// Two sides end at one corner: they overlap where the path from one far end to the other turns straight back.
bool overlap_at(Point corner, Point far_a, Point far_b) {
  if (!turns_back(far_a.x, corner.x, far_b.x) && !turns_back(far_a.y, corner.y, far_b.y)) return false;
  return orient2d(far_a, corner, far_b) == 0;
}

// Sides of different chains, or far apart on one. Joined at an end of a chain they may share that corner.
bool apart_but_for_joints(const Side& a, const Side& b) {
  std::size_t joints = 0;
  const auto overlap_if_joined = [&](Point pa, Point far_a, bool a_end, Point pb, Point far_b, bool b_end) {
    if (!(pa == pb) || (!a_end && !b_end)) return false;
    ++joints;
    return overlap_at(pa, far_a, far_b);
  };
  if (overlap_if_joined(a.from, a.to, a.first, b.from, b.to, b.first) ||
      overlap_if_joined(a.from, a.to, a.first, b.to, b.from, b.last()) ||
      overlap_if_joined(a.to, a.from, a.last(), b.from, b.to, b.first) ||
      overlap_if_joined(a.to, a.from, a.last(), b.to, b.from, b.last()))
    return false;
  // A single point counts twice, as both of its ends.
  const bool single = a.from == a.to || b.from == b.to;
  if (joints > (single ? 2 : 1)) return false;  // the same two ends: the same side twice
  return joints > 0 || !strangers_meet(a, b);
}

class MeetingSides {
 public:
  explicit MeetingSides(std::span<const Side> sides) : sides_(sides) {
    nodes_.reserve(2 * sides.size());
    build(0, sides.size());
  }
  std::optional<SidePair> find() { return within(0) ? found_ : std::nullopt; }

 private:
  struct Node {
    Box box;
    std::size_t begin = 0, end = 0;
    std::size_t left = 0, right = 0;  // children, where there is more than one side
    std::size_t size() const { return end - begin; }
  };

  std::size_t build(std::size_t begin, std::size_t end) {
    const std::size_t index = nodes_.size();
    nodes_.push_back({.box = box_of(sides_[begin]), .begin = begin, .end = end});
    if (end - begin == 1) return index;
    const std::size_t middle = begin + (end - begin) / 2;
    const std::size_t left = build(begin, middle);
    const std::size_t right = build(middle, end);
    Node& node = nodes_[index];
    node.left = left;
    node.right = right;
    node.box = united(nodes_[left].box, nodes_[right].box);
    return index;
  }

  bool within(std::size_t index) {
    const Node& node = nodes_[index];
    if (node.size() == 1) return false;
    return within(node.left) || within(node.right) || between(node.left, node.right);
  }

  bool between(std::size_t a, std::size_t b) {
    const Node& left = nodes_[a];
    const Node& right = nodes_[b];
    if (apart(left.box, right.box)) return false;
    if (left.size() == 1 && right.size() == 1) return meet(left.begin, right.begin);
    if (left.size() >= right.size()) return between(left.left, b) || between(left.right, b);
    return between(a, right.left) || between(a, right.right);
  }

  bool meet(std::size_t i, std::size_t j) {
    const Side& a = sides_[i];
    const Side& b = sides_[j];
    const bool meeting = a.next == j   ? overlap_at(a.to, a.from, b.to)
                         : b.next == i ? overlap_at(b.to, b.from, a.to)
                                       : !apart_but_for_joints(a, b);
    if (meeting) found_ = SidePair{std::min(i, j), std::max(i, j)};
    return meeting;
  }

  std::span<const Side> sides_;
  std::vector<Node> nodes_;
  std::optional<SidePair> found_;
};

}  // namespace

std::optional<SidePair> find_meeting_sides(std::span<const Side> sides) {
  if (sides.empty()) return std::nullopt;
  return MeetingSides(sides).find();
}

bool is_inside(std::span<const Side> polygon, Point p) {
  bool inside = false;
  for (const Side& side : polygon) {  // count the sides that a ray to the right crosses
    const bool up = side.from.y <= p.y && p.y < side.to.y;
    const bool down = side.to.y <= p.y && p.y < side.from.y;
    if (!up && !down) continue;
    if (orient2d(side.from, side.to, p) == (up ? 1 : -1)) inside = !inside;
  }
  return inside;
}

}  // namespace remodel
