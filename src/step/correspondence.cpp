#include "step/correspondence.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nanoflann.hpp>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <variant>

#include "step/station_links.h"

namespace remodel {

namespace {

using Key = std::tuple<double, double, double, double>;

Key key_of(Point a, Point b) {
  return {a.x, a.y, b.x, b.y};
}

// The old loop in the place of a new one that has its points: its curves, by the new names. Nothing where one
// old curve has two names now.
std::optional<Loop> renamed(const Outline& old, const Outline& to, const SameStations& same) {
  Loop loop = *old.loop;
  std::vector<const std::string*> names(loop.curves.size(), nullptr);
  const auto name = [&](std::size_t segment, std::size_t old_segment) {
    const std::string& found = to.loop->curves[to.curve[segment]].name;
    const std::string*& known = names[old.curve[old_segment]];
    if (known != nullptr && *known != found) return false;
    known = &found;
    return true;
  };
  const std::size_t segments = to.segments();
  for (std::size_t i = 0; i < segments; ++i)
    if (!name(i, same.reversed ? same.station[to.after(i)] : same.station[i])) return std::nullopt;
  if (segments == 0 && !name(0, 0)) return std::nullopt;
  for (std::size_t c = 0; c < loop.curves.size(); ++c)
    if (names[c] != nullptr) loop.curves[c].name = *names[c];
  loop.role = to.loop->role;
  loop.region = to.loop->region;
  loop.right_region = to.loop->right_region;
  if (!same.reversed) return loop;
  if (loop.role == LoopRole::left)
    loop.role = LoopRole::right;
  else if (loop.role == LoopRole::right)
    loop.role = LoopRole::left;
  else if (loop.role == LoopRole::internal)
    std::swap(loop.region, loop.right_region);
  return loop;
}

std::set<std::string> names_of(const Loop& loop) {
  std::set<std::string> names;
  for (const Curve& curve : loop.curves) names.insert(curve.name);
  return names;
}

// Centres of boxes, as nanoflann asks for them.
struct Centres {
  std::vector<Point> points;
  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return axis == 0 ? points[i].x : points[i].y;
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};
using CentreTree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Centres>, Centres, 2>;

class Pairing {
 public:
  Pairing(const Domain& own, const Domain& wanted) : own_(own), result_{.domain = wanted, .loops = {}} {
    for (std::size_t j = 0; j < own.loops.size(); ++j) old_.push_back(outline_of_loop(own, j));
    for (std::size_t i = 0; i < wanted.loops.size(); ++i) new_.push_back(outline_of_loop(wanted, i));
    partner_.assign(new_.size(), no_link);
    taken_.assign(old_.size(), false);
    for (const Outline& outline : new_)
      result_.loops.push_back({.from = no_link,
                               .in_order = false,
                               .stations = std::vector<StationLink>(outline.size()),
                               .segments = std::vector<SegmentLink>(outline.segments())});
  }

  Correspondence run() && {
    find_same();
    find_same_segments();
    find_successors();
    for (std::size_t i = 0; i < new_.size(); ++i)
      if (partner_[i] != no_link) result_.loops[i].from = partner_[i];
    return std::move(result_);
  }

 private:
  // ---- Loops that are old ones.
  void find_same() {
    for (std::size_t i = 0; i < new_.size() && i < old_.size(); ++i)
      if (own_.loops[i] == result_.domain.loops[i]) take_same(i, i, false);
    double rounding = 0.0;
    for (const std::vector<Outline>* outlines : {&old_, &new_})
      for (const Outline& outline : *outlines) rounding = std::max(rounding, rounding_of(outline));
    std::multimap<Cell, std::size_t> by_cell;  // by the lower left corners of boxes
    for (std::size_t j = 0; j < old_.size(); ++j)
      if (!taken_[j]) by_cell.emplace(cell_of(old_[j].low, rounding), j);
    for (std::size_t i = 0; i < new_.size(); ++i) {
      if (partner_[i] != no_link || new_[i].size() == 0) continue;
      std::set<Cell> cells;  // that a corner within rounding may be in
      for (const double x : {-rounding, rounding})
        for (const double y : {-rounding, rounding})
          cells.insert(cell_of(new_[i].low + Point{x, y}, rounding));
      for (const Cell& cell : cells) {
        const auto [begin, end] = by_cell.equal_range(cell);
        const auto same = std::find_if(
            begin, end, [&](const auto& entry) { return !taken_[entry.second] && is_same(i, entry.second); });
        if (same != end) break;
      }
    }
  }

  using Cell = std::pair<double, double>;
  static Cell cell_of(Point p, double rounding) {
    const double size = rounding > 0.0 ? 2.0 * rounding : 1.0;
    return {std::floor(p.x / size), std::floor(p.y / size)};
  }

  bool is_same(std::size_t i, std::size_t j) {
    const SameStations same = same_stations(old_[j], new_[i]);
    if (same.station.empty()) return false;
    const bool left = same.reversed ? old_[j].right : old_[j].left;
    const bool right = same.reversed ? old_[j].left : old_[j].right;
    if (left != new_[i].left || right != new_[i].right) return false;
    std::optional<Loop> loop = renamed(old_[j], new_[i], same);
    if (!loop) return false;
    result_.domain.loops[i] = *std::move(loop);
    take_same(i, j, true);
    return true;
  }

  void take_same(std::size_t i, std::size_t j, bool rewritten) {
    partner_[i] = j;
    taken_[j] = true;
    if (rewritten) new_[i] = outline_of_loop(result_.domain, i);
    LoopLinks& links = result_.loops[i];
    links.in_order = true;
    for (std::size_t s = 0; s < links.stations.size(); ++s) links.stations[s] = {j, s};
    for (std::size_t s = 0; s < links.segments.size(); ++s) links.segments[s] = {j, s, false};
  }

  // ---- Segments of loops that are left.
  void find_same_segments() {
    std::multimap<Key, SegmentLink> old_segments;
    for (std::size_t j = 0; j < old_.size(); ++j) {
      if (taken_[j]) continue;
      const Outline& outline = old_[j];
      for (std::size_t s = 0; s < outline.segments(); ++s) {
        const Point a = outline.points[s], b = outline.points[outline.after(s)];
        old_segments.emplace(key_of(a, b), SegmentLink{j, s, false});
        old_segments.emplace(key_of(b, a), SegmentLink{j, s, true});
      }
    }
    std::set<std::pair<std::size_t, std::size_t>> used;
    for (std::size_t i = 0; i < new_.size(); ++i) {
      if (partner_[i] != no_link) continue;
      for (std::size_t s = 0; s < new_[i].segments(); ++s) {
        const Point a = new_[i].points[s], b = new_[i].points[new_[i].after(s)];
        const auto [begin, end] = old_segments.equal_range(key_of(a, b));
        for (auto it = begin; it != end; ++it) {
          if (!agrees(i, s, it->second) || !used.insert({it->second.loop, it->second.segment}).second)
            continue;
          link_segment(i, s, it->second);
          break;
        }
      }
    }
  }

  bool agrees(std::size_t i, std::size_t s, const SegmentLink& link) const {
    const Outline &old = old_[link.loop], &to = new_[i];
    const bool left = link.reversed ? old.right : old.left, right = link.reversed ? old.left : old.right;
    const Point a = on_segment(to, s, 0.5), b = on_segment(old, link.segment, 0.5);
    return left == to.left && right == to.right &&
           squared_distance(a, b) <= rounding_of(to) * rounding_of(to);
  }

  void link_segment(std::size_t i, std::size_t s, const SegmentLink& link) {
    const std::size_t next = old_[link.loop].after(link.segment);
    LoopLinks& links = result_.loops[i];
    links.segments[s] = link;
    links.stations[s] = {link.loop, link.reversed ? next : link.segment};
    links.stations[new_[i].after(s)] = {link.loop, link.reversed ? link.segment : next};
  }

  // ---- Successors of the old loops that are left.
  void find_successors() {
    pair_by_segments();
    pair_by_names();
    pair_by_places(true);
    pair_by_places(false);
    pair_by_index();
    for (std::size_t i = 0; i < new_.size(); ++i)
      if (partner_[i] != no_link && !result_.loops[i].in_order) link_stations(i, partner_[i]);
  }

  bool may_pair(std::size_t i, std::size_t j) const {
    return partner_[i] == no_link && !taken_[j] && old_[j].loop->open == new_[i].loop->open &&
           (old_[j].left == new_[i].left) + (old_[j].right == new_[i].right) != 1;
  }
  void pair(std::size_t i, std::size_t j) {
    partner_[i] = j;
    taken_[j] = true;
  }

  void pair_by_segments() {
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> shared;
    for (std::size_t i = 0; i < new_.size(); ++i)
      if (partner_[i] == no_link)
        for (const SegmentLink& link : result_.loops[i].segments)
          if (link.there()) ++shared[{i, link.loop}];
    std::vector<std::tuple<std::size_t, std::size_t, std::size_t>> most;
    for (const auto& [loops, count] : shared) most.emplace_back(count, loops.first, loops.second);
    std::stable_sort(most.begin(), most.end(),
                     [](const auto& a, const auto& b) { return std::get<0>(a) > std::get<0>(b); });
    for (const auto& [count, i, j] : most)
      if (partner_[i] == no_link && !taken_[j] && old_[j].loop->open == new_[i].loop->open) pair(i, j);
  }

  // Names that one loop has of those that are left, in both domains.
  void pair_by_names() {
    using Loops = std::map<std::set<std::string>, std::vector<std::size_t>>;
    Loops olds, news;
    for (std::size_t j = 0; j < old_.size(); ++j)
      if (!taken_[j]) olds[names_of(*old_[j].loop)].push_back(j);
    for (std::size_t i = 0; i < new_.size(); ++i)
      if (partner_[i] == no_link) news[names_of(*new_[i].loop)].push_back(i);
    for (const auto& [names, loops] : news) {
      const auto old = olds.find(names);
      if (old == olds.end() || loops.size() != 1 || old->second.size() != 1) continue;
      if (may_pair(loops[0], old->second[0])) pair(loops[0], old->second[0]);
    }
  }

  // The nearest first; of one name, or whatever their names.
  void pair_by_places(bool named) {
    Centres centres;
    std::vector<std::size_t> olds;
    for (std::size_t j = 0; j < old_.size(); ++j)
      if (!taken_[j] && old_[j].size() > 0) olds.push_back(j), centres.points.push_back(old_[j].centre());
    if (olds.empty()) return;
    const CentreTree tree(2, centres);
    std::vector<std::tuple<double, std::size_t, std::size_t>> near;
    for (std::size_t i = 0; i < new_.size(); ++i) {
      if (partner_[i] != no_link || new_[i].size() == 0) continue;
      constexpr std::size_t few = 8;
      const Point centre = new_[i].centre();
      const double query[2] = {centre.x, centre.y};
      std::uint32_t found[few];
      double squared[few];
      const std::size_t count = tree.knnSearch(query, few, found, squared);
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t j = olds[found[k]];
        const double reach = 0.5 * (old_[j].diagonal() + new_[i].diagonal());
        if (!may_pair(i, j) || squared[k] > reach * reach) continue;
        if (named && names_of(*old_[j].loop) != names_of(*new_[i].loop)) continue;
        near.emplace_back(
            squared[k] + squared_distance(old_[j].high - old_[j].low, new_[i].high - new_[i].low), i, j);
      }
    }
    std::sort(near.begin(), near.end());
    for (const auto& [distance, i, j] : near)
      if (may_pair(i, j)) pair(i, j);
  }

  void pair_by_index() {
    for (std::size_t i = 0; i < std::min(new_.size(), old_.size()); ++i)
      if (may_pair(i, i) && one_to_one(own_.loops[i], result_.domain.loops[i])) pair(i, i);
  }

  void link_stations(std::size_t i, std::size_t j) {
    LoopLinks& links = result_.loops[i];
    std::vector<std::size_t> known(new_[i].size(), no_station);
    for (std::size_t s = 0; s < known.size(); ++s)
      if (links.stations[s].loop == j) known[s] = links.stations[s].station;
    const SameStations following = following_stations(old_[j], new_[i], std::move(known));
    if (following.station.empty()) return;
    if (!sides_agree(i, j, following.reversed) || !most_segments(i, j, following)) return;
    for (std::size_t s = 0; s < following.station.size(); ++s) {
      links.stations[s] = {};
      if (following.station[s] != no_station) links.stations[s] = {j, following.station[s]};
    }
    for (std::size_t s = 0; s < links.segments.size(); ++s) {
      // Segments of other old loops may be those of this one now; at most one new loop has each.
      links.segments[s] = {};
      if (const std::optional<std::size_t> segment = old_segment(i, j, following, s))
        links.segments[s] = {j, *segment, following.reversed};
    }
    forget_elsewhere(i, j);
    links.in_order =
        !following.reversed && following.station[0] == 0 && in_order(own_.loops[j], result_.domain.loops[i]);
  }

  bool sides_agree(std::size_t i, std::size_t j, bool reversed) const {
    return new_[i].left == (reversed ? old_[j].right : old_[j].left) &&
           new_[i].right == (reversed ? old_[j].left : old_[j].right);
  }

  // The old segment that joins the stations of which the ends of a segment are the successors.
  std::optional<std::size_t> old_segment(std::size_t i, std::size_t j, const SameStations& following,
                                         std::size_t s) const {
    const std::size_t a = following.station[s], b = following.station[new_[i].after(s)];
    if (a == no_station || b == no_station) return std::nullopt;
    const std::size_t from = following.reversed ? b : a, to = following.reversed ? a : b;
    if (from >= old_[j].segments() || old_[j].after(from) != to) return std::nullopt;
    return from;
  }

  // Loops of which less corresponds are replaced as a whole, but for segments that are the same. Where not
  // all stations correspond, only segments count that are alike: much else can be put side by side in order.
  bool most_segments(std::size_t i, std::size_t j, const SameStations& following) const {
    const bool any = new_[i].size() == old_[j].size() || has_airfoil(*new_[i].loop);
    std::size_t linked = 0;
    for (std::size_t s = 0; s < new_[i].segments(); ++s) {
      const std::optional<std::size_t> old = old_segment(i, j, following, s);
      if (old && (any || alike(i, s, j, *old, following.reversed))) ++linked;
    }
    return 2 * linked > std::max(new_[i].segments(), old_[j].segments());
  }
  bool alike(std::size_t i, std::size_t s, std::size_t j, std::size_t old, bool reversed) const {
    constexpr double far = 0.5;
    const Point a = new_[i].points[new_[i].after(s)] - new_[i].points[s];
    const Point b = (reversed ? -1.0 : 1.0) * (old_[j].points[old_[j].after(old)] - old_[j].points[old]);
    return squared_distance(a, b) <= far * far * std::max(dot(a, a), dot(b, b));
  }

  // Segments of the old loop that another new one claims as the same.
  void forget_elsewhere(std::size_t i, std::size_t j) {
    std::set<std::size_t> claimed;
    for (const LoopLinks& links : result_.loops)
      if (&links != &result_.loops[i])
        for (const SegmentLink& link : links.segments)
          if (link.loop == j) claimed.insert(link.segment);
    for (SegmentLink& link : result_.loops[i].segments)
      if (link.there() && claimed.contains(link.segment)) link = {};
  }

  const Domain& own_;
  Correspondence result_;
  std::vector<Outline> old_, new_;
  std::vector<std::size_t> partner_;
  std::vector<bool> taken_;
};

// Each station moves by less than half the way to its neighbours.
bool moves_little(const Domain& own, const Domain& wanted, std::size_t loop) {
  const std::vector<Point> from = own.points(loop), to = wanted.points(loop);
  const std::size_t n = from.size();
  for (std::size_t i = 0; i < n; ++i) {
    double nearest = squared_distance(from[i], from[(i + 1) % n]);
    nearest = std::min(nearest, squared_distance(from[i], from[(i + n - 1) % n]));
    if (n > 1 && squared_distance(from[i], to[i]) >= 0.25 * nearest) return false;
  }
  return n > 1;
}

}  // namespace

bool in_order(const Loop& a, const Loop& b) {
  const auto same_curve = [](const Curve& c, const Curve& d) {
    return c.shape.index() == d.shape.index() && c.parameters == d.parameters;
  };
  return a.role == b.role && a.open == b.open &&
         std::equal(a.curves.begin(), a.curves.end(), b.curves.begin(), b.curves.end(), same_curve);
}

bool corresponds_by_index(const Domain& own, const Domain& wanted, std::span<const std::size_t> moving) {
  if (moving.size() == 1 && has_airfoil(own.loops[moving[0]])) return true;
  std::set<std::set<std::string>> names;
  const bool distinct = std::all_of(moving.begin(), moving.end(), [&](std::size_t loop) {
    return names.insert(names_of(own.loops[loop])).second;
  });
  return std::all_of(moving.begin(), moving.end(), [&](std::size_t loop) {
    return (distinct && has_airfoil(own.loops[loop])) || moves_little(own, wanted, loop);
  });
}

bool corresponds_in_parts(const Domain& own, const Correspondence& to) {
  constexpr std::size_t few = 4, a_tenth = 10;
  return own.loops.size() == to.loops.size() &&
         std::all_of(to.loops.begin(), to.loops.end(), [&](const LoopLinks& links) {
           if (links.from == no_link) return false;
           const auto linked = static_cast<std::size_t>(
               std::count_if(links.segments.begin(), links.segments.end(),
                             [&](const SegmentLink& link) { return link.loop == links.from; }));
           const std::size_t all = std::max(links.stations.size(), own.stations(links.from).size());
           return links.segments.empty() || (linked > 0 && all - linked <= std::max(few, all / a_tenth));
         });
}

bool differs_much(const Domain& own, const Correspondence& to) {
  constexpr double a_few = 0.25;
  std::size_t all = 0, linked = 0;
  for (const LoopLinks& links : to.loops) {
    if (links.from == no_link) continue;
    all += links.stations.size() + own.stations(links.from).size();
    linked += static_cast<std::size_t>(std::count_if(links.stations.begin(), links.stations.end(),
                                                     [](const StationLink& link) { return link.there(); }));
  }
  return static_cast<double>(all) - 2.0 * static_cast<double>(linked) > a_few * static_cast<double>(all);
}

Correspondence correspond(const Domain& own, const Domain& wanted) {
  return Pairing(own, wanted).run();
}

}  // namespace remodel
