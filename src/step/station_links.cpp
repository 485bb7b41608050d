#include "step/station_links.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

namespace remodel {

namespace {

double length(Point p) {
  return std::sqrt(dot(p, p));
}

// The station `steps` behind another one, or before it.
std::size_t step_from(std::size_t station, std::size_t steps, std::size_t count, bool reversed) {
  steps %= count;
  return reversed ? (station + count - steps) % count : (station + steps) % count;
}

// Whether the loops are the same if the first station of `to` is this one of `from`.
bool same_from(const Outline& from, const Outline& to, std::size_t first, bool reversed, double rounding) {
  const std::size_t n = to.size();
  const auto near = [&](Point a, Point b) { return squared_distance(a, b) <= rounding * rounding; };
  for (std::size_t i = 0; i < n; ++i)
    if (!near(to.points[i], from.points[step_from(first, i, n, reversed)])) return false;
  for (std::size_t i = 0; i < to.segments(); ++i) {
    const std::size_t s = step_from(first, reversed ? i + 1 : i, n, reversed);
    for (const double fraction : {0.25, 0.5, 0.75})
      if (!near(on_segment(to, i, fraction), on_segment(from, s, reversed ? 1.0 - fraction : fraction)))
        return false;
  }
  return true;
}

// How one loop runs along another one: the first station of `to` is `first` of `from`.
struct Seed {
  std::size_t first = 0;
  bool reversed = false;
};

// Places relative to the middle of the loop.
struct Centred {
  explicit Centred(const Outline& outline) : outline_(&outline), centre_(outline.centre()) {}
  Point operator()(std::size_t i) const { return outline_->points[i] - centre_; }

 private:
  const Outline* outline_;
  Point centre_;
};

// The fraction of the way along a loop at each station, from station `first` on.
std::vector<double> way_along(const Outline& outline, std::size_t first, bool reversed) {
  std::vector<double> way{0.0};
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < outline.segments(); ++i) {
    const Point a = outline.points[step_from(first, i, n, reversed)];
    const Point b = outline.points[step_from(first, i + 1, n, reversed)];
    way.push_back(way.back() + length(b - a));
  }
  const double all = way.back() > 0.0 ? way.back() : 1.0;
  for (double& w : way) w /= all;
  return way;
}

Point at_way(const Outline& outline, const Centred& place, const std::vector<double>& way, std::size_t first,
             bool reversed, double w) {
  const auto above = std::upper_bound(way.begin() + 1, way.end() - 1, w);
  const auto i = static_cast<std::size_t>(above - way.begin()) - 1;
  const double part = way[i + 1] > way[i] ? (w - way[i]) / (way[i + 1] - way[i]) : 0.0;
  const std::size_t n = outline.size();
  return (1.0 - part) * place(step_from(first, i, n, reversed)) +
         part * place(step_from(first, i + 1, n, reversed));
}

// How far the loops are apart, if they correspond like this: the mean square over both.
double misfit(const Outline& from, const Outline& to, const Seed& seed) {
  const Centred old_place(from), new_place(to);
  double sum = 0.0;
  if (from.size() == to.size()) {
    for (std::size_t i = 0; i < to.size(); ++i)
      sum += squared_distance(new_place(i), old_place(step_from(seed.first, i, from.size(), seed.reversed)));
    return sum / static_cast<double>(to.size());
  }
  constexpr int samples = 64;
  const std::vector<double> old_way = way_along(from, seed.first, seed.reversed),
                            new_way = way_along(to, 0, false);
  for (int i = 0; i < samples; ++i) {
    const double w = i / static_cast<double>(samples);
    sum += squared_distance(at_way(to, new_place, new_way, 0, false, w),
                            at_way(from, old_place, old_way, seed.first, seed.reversed, w));
  }
  return sum / samples;
}

std::vector<Seed> candidates(const Outline& from, const Outline& to) {
  if (from.loop->open) return {{0, false}, {from.size() - 1, true}};
  const Centred old_place(from), new_place(to);
  const std::size_t n = from.size(), m = to.size();
  std::vector<Seed> seeds{{0, false}, {0, true}};
  constexpr std::size_t few = 64, anchors = 8;
  if (n == m && n <= few) {
    for (std::size_t first = 1; first < n; ++first)
      seeds.insert(seeds.end(), {{first, false}, {first, true}});
    return seeds;
  }
  // Where the loops begin, and what is nearest to some stations.
  for (std::size_t a = 0; a < anchors; ++a) {
    const std::size_t i = a * m / anchors;
    std::size_t nearest = 0;
    for (std::size_t j = 1; j < n; ++j)
      if (squared_distance(old_place(j), new_place(i)) < squared_distance(old_place(nearest), new_place(i)))
        nearest = j;
    const std::size_t back = i * n / m;  // where the counts differ: by shares
    seeds.push_back({step_from(nearest, back, n, true), false});
    seeds.push_back({step_from(nearest, back, n, false), true});
  }
  return seeds;
}

// Loops that begin alike are taken as they are, unless another way fits far better.
Seed best_seed(const Outline& from, const Outline& to) {
  constexpr double far_better = 0.25;
  Seed best;
  double least = far_better * misfit(from, to, best);
  for (const Seed& seed : candidates(from, to))
    if (const double value = misfit(from, to, seed); value < least) best = seed, least = value;
  return best;
}

// Curves whose stations say which is which: they do not return to where they began, or they do at a corner
// that is their own. Of the same kind, number of stations and name, once in each loop; of an airfoil with the
// same parameters.
using CurveKey = std::tuple<std::size_t, std::size_t, std::string>;

bool begins_somewhere(const Loop& loop, std::size_t c) {
  const Shape& shape = loop.curves[c].shape;
  if (std::holds_alternative<CstAirfoil>(shape)) return true;
  if (const auto* spline = std::get_if<Spline>(&shape); spline != nullptr && spline->corner) return true;
  return loop.open || loop.curves.size() > 1;
}

std::map<CurveKey, std::vector<std::size_t>> curves_by_key(const Loop& loop, bool named) {
  std::map<CurveKey, std::vector<std::size_t>> curves;
  for (std::size_t c = 0; c < loop.curves.size(); ++c) {
    const Curve& curve = loop.curves[c];
    if (begins_somewhere(loop, c))
      curves[{curve.shape.index(), curve.parameters.size(), named ? curve.name : std::string{}}].push_back(c);
  }
  return curves;
}

std::size_t first_station(const Outline& outline, std::size_t curve) {
  return static_cast<std::size_t>(std::find(outline.curve.begin(), outline.curve.end(), curve) -
                                  outline.curve.begin());
}

// Links the stations of curves that correspond, in the one order that all curves have: airfoils and splines
// with a corner above all, which cannot begin elsewhere.
bool link_curves(const Outline& from, const Outline& to, std::vector<std::size_t>& links) {
  bool any = false;
  const auto old_curves = curves_by_key(*from.loop, false);
  for (const auto& [key, curves] : curves_by_key(*to.loop, false)) {
    const auto old = old_curves.find(key);
    const std::size_t count = std::get<1>(key);
    if (count < 4 || curves.size() != 1 || old == old_curves.end() || old->second.size() != 1) continue;
    const Curve &a = from.loop->curves[old->second[0]], &b = to.loop->curves[curves[0]];
    if (std::holds_alternative<CstAirfoil>(a.shape) && !(a.parameters == b.parameters)) continue;
    const std::size_t old_first = first_station(from, old->second[0]), first = first_station(to, curves[0]);
    for (std::size_t i = 0; i < count; ++i) links[first + i] = old_first + i;
    any = true;
  }
  return any;
}

// The stations between two that are linked: of both loops, in the order of `to`.
struct Gap {
  std::vector<std::size_t> old_stations, stations;
};

// Pairs stations of a gap in order, and leaves out the fewest and those that correspond least: an alignment
// of two sequences by dynamic programming.
class Alignment {
 public:
  Alignment(const Outline& from, const Outline& to, const Gap& gap, Point from_a, Point from_b, Point to_a,
            Point to_b)
      : from_(from), to_(to), gap_(gap) {
    old_way_ = ways(from, gap.old_stations, from_a, from_b);
    new_way_ = ways(to, gap.stations, to_a, to_b);
    scale_ = static_cast<double>(std::max(gap.old_stations.size(), gap.stations.size()) + 1);
  }

  void link(std::vector<std::size_t>& links) const {
    const std::size_t p = gap_.old_stations.size(), q = gap_.stations.size();
    const std::size_t width = q + 1;
    std::vector<float> cost((p + 1) * width, 0.0F);
    for (std::size_t i = 0; i <= p; ++i) cost[i * width] = static_cast<float>(i) * left_out;
    for (std::size_t j = 0; j <= q; ++j) cost[j] = static_cast<float>(j) * left_out;
    for (std::size_t i = 1; i <= p; ++i)
      for (std::size_t j = 1; j <= q; ++j)
        cost[i * width + j] =
            std::min({cost[(i - 1) * width + j - 1] + apart(i - 1, j - 1),
                      cost[(i - 1) * width + j] + left_out, cost[i * width + j - 1] + left_out});
    std::size_t i = p, j = q;
    while (i > 0 && j > 0) {
      const float here = cost[i * width + j];
      if (here == cost[(i - 1) * width + j - 1] + apart(i - 1, j - 1)) {
        --i, --j;
        links[gap_.stations[j]] = gap_.old_stations[i];
      } else if (here == cost[(i - 1) * width + j] + left_out) {
        --i;
      } else {
        --j;
      }
    }
  }

 private:
  static constexpr float left_out = 1.0F;

  static std::vector<double> ways(const Outline& outline, const std::vector<std::size_t>& stations, Point a,
                                  Point b) {
    std::vector<double> way;
    double sum = 0.0;
    Point last = a;
    for (const std::size_t s : stations) {
      sum += length(outline.points[s] - last);
      way.push_back(sum);
      last = outline.points[s];
    }
    sum += length(b - last);
    for (double& w : way) w /= sum > 0.0 ? sum : 1.0;
    return way;
  }

  // In mean distances of stations.
  float apart(std::size_t i, std::size_t j) const {
    return static_cast<float>(std::abs(old_way_[i] - new_way_[j]) * scale_);
  }

  const Outline &from_, &to_;
  const Gap& gap_;
  std::vector<double> old_way_, new_way_;
  double scale_;
};

// Links what lies between links, all the way round.
class GapFiller {
 public:
  GapFiller(const Outline& from, const Outline& to, bool reversed, std::vector<std::size_t>& links)
      : from_(from), to_(to), reversed_(reversed), links_(links) {}

  void run() {
    std::vector<std::size_t> linked;
    for (std::size_t i = 0; i < to_.size(); ++i)
      if (links_[i] != no_station) linked.push_back(i);
    if (linked.empty()) return;
    if (to_.loop->open) {
      fill_end(linked.front(), true);
      fill_end(linked.back(), false);
    }
    for (std::size_t l = 0; l < linked.size(); ++l) {
      if (to_.loop->open && l + 1 == linked.size()) break;
      fill(linked[l], linked[(l + 1) % linked.size()]);
    }
  }

 private:
  std::size_t next_old(std::size_t s) const { return step_from(s, 1, from_.size(), reversed_); }

  void fill(std::size_t a, std::size_t b) {
    Gap gap;
    for (std::size_t i = to_.after(a); i != b; i = to_.after(i)) gap.stations.push_back(i);
    for (std::size_t s = next_old(links_[a]); s != links_[b]; s = next_old(s)) {
      if (from_.loop->open && gap.old_stations.size() > from_.size()) return;
      gap.old_stations.push_back(s);
    }
    link(gap, from_.points[links_[a]], from_.points[links_[b]], to_.points[a], to_.points[b]);
  }

  // Of a chain, what lies before the first link or behind the last one, from the end on.
  void fill_end(std::size_t linked, bool before) {
    Gap gap;
    const bool upwards = before == reversed_;
    for (std::size_t i = linked; before ? i > 0 : i + 1 < to_.size();)
      gap.stations.push_back(before ? --i : ++i);
    for (std::size_t s = links_[linked]; upwards ? s + 1 < from_.size() : s > 0;)
      gap.old_stations.push_back(upwards ? ++s : --s);
    if (gap.stations.size() != gap.old_stations.size()) return;
    for (std::size_t i = 0; i < gap.stations.size(); ++i) links_[gap.stations[i]] = gap.old_stations[i];
  }

  // Where the counts differ by more than some, this is another discretisation, of which nothing corresponds.
  void link(const Gap& gap, Point from_a, Point from_b, Point to_a, Point to_b) {
    constexpr std::size_t most = 4'000'000, a_tenth = 10;
    if (gap.stations.empty() || gap.old_stations.empty()) return;
    if (gap.stations.size() == gap.old_stations.size()) {
      for (std::size_t i = 0; i < gap.stations.size(); ++i) links_[gap.stations[i]] = gap.old_stations[i];
      return;
    }
    const auto [fewer, more] = std::minmax({gap.stations.size(), gap.old_stations.size()});
    if (more - fewer > 1 + more / a_tenth || more * fewer > most) return;
    Alignment(from_, to_, gap, from_a, from_b, to_a, to_b).link(links_);
  }

  const Outline &from_, &to_;
  const bool reversed_;
  std::vector<std::size_t>& links_;
};

// The order in which most neighbours among the links follow each other; what contradicts it is dropped: links
// must go round once.
std::optional<bool> keep_one_order(const Outline& from, std::vector<std::size_t>& links) {
  std::vector<std::size_t> linked;
  for (std::size_t i = 0; i < links.size(); ++i)
    if (links[i] != no_station) linked.push_back(i);
  if (linked.empty()) return std::nullopt;
  std::size_t forwards = 0, backwards = 0;
  const std::size_t n = from.size();
  for (std::size_t l = 0; l + 1 < linked.size(); ++l) {
    const std::size_t ahead = (links[linked[l + 1]] + n - links[linked[l]]) % n;
    (2 * ahead <= n ? forwards : backwards) += 1;
  }
  const bool reversed = backwards > forwards;
  std::size_t way = 0;  // along the old loop from the first link
  for (std::size_t l = 1; l < linked.size(); ++l) {
    const std::size_t first = links[linked[0]], here = links[linked[l]];
    const std::size_t ahead = reversed ? (first + n - here) % n : (here + n - first) % n;
    const bool wraps = from.loop->open && (reversed ? here > first : here < first);
    if (ahead <= way || wraps)
      links[linked[l]] = no_station;
    else
      way = ahead;
  }
  return reversed;
}

}  // namespace

bool has_airfoil(const Loop& loop) {
  return std::any_of(loop.curves.begin(), loop.curves.end(),
                     [](const Curve& curve) { return std::holds_alternative<CstAirfoil>(curve.shape); });
}

double Outline::diagonal() const {
  return length(high - low);
}

Outline outline_of_loop(const Domain& domain, std::size_t index) {
  const Loop& loop = domain.loops[index];
  Outline outline{.loop = &loop, .points = domain.points(index), .curve = {}, .t = {}};
  for (std::size_t c = 0; c < loop.curves.size(); ++c)
    for (const double t : loop.curves[c].parameters) outline.curve.push_back(c), outline.t.push_back(t);
  if (outline.curve.size() < outline.points.size()) {  // the end of a chain
    outline.curve.push_back(loop.curves.size() - 1);
    outline.t.push_back(1.0);
  }
  if (outline.points.empty()) return outline;
  outline.low = outline.high = outline.points.front();
  for (const Point p : outline.points) {
    outline.low = {std::min(outline.low.x, p.x), std::min(outline.low.y, p.y)};
    outline.high = {std::max(outline.high.x, p.x), std::max(outline.high.y, p.y)};
  }
  const bool turns_left = signed_area(domain, index) > 0.0;
  switch (loop.role) {
    case LoopRole::outer:
      (turns_left ? outline.left : outline.right) = true;
      break;
    case LoopRole::hole:
      (turns_left ? outline.right : outline.left) = true;
      break;
    case LoopRole::internal:
      outline.left = outline.right = true;
      break;
    case LoopRole::left:
      outline.left = true;
      break;
    case LoopRole::right:
      outline.right = true;
      break;
  }
  return outline;
}

Point on_segment(const Outline& outline, std::size_t segment, double fraction) {
  const std::size_t next = outline.after(segment);
  const bool goes_on = outline.curve[next] == outline.curve[segment] && outline.t[next] > outline.t[segment];
  const double from = outline.t[segment], to = goes_on ? outline.t[next] : 1.0;
  return Frame(outline.loop->placement)(
      point_at(outline.loop->curves[outline.curve[segment]].shape, from + fraction * (to - from)));
}

double rounding_of(const Outline& outline) {
  constexpr double spacings = 0x1p-44;
  return spacings * std::max({std::abs(outline.low.x), std::abs(outline.low.y), std::abs(outline.high.x),
                              std::abs(outline.high.y)});
}

SameStations same_stations(const Outline& from, const Outline& to) {
  const std::size_t n = to.size();
  if (n == 0 || from.size() != n || from.loop->open != to.loop->open) return {};
  const double rounding = std::max(rounding_of(from), rounding_of(to));
  const auto found = [&](std::size_t first, bool reversed) {
    SameStations same{.station = {}, .reversed = reversed};
    for (std::size_t i = 0; i < n; ++i) same.station.push_back(step_from(first, i, n, reversed));
    return same;
  };
  const auto may_begin = [&](std::size_t s) {
    return squared_distance(from.points[s], to.points[0]) <= rounding * rounding;
  };
  for (std::size_t s = 0; s < n; ++s) {
    if (to.loop->open && s != 0 && s != n - 1) continue;
    if (!may_begin(s)) continue;
    if ((!to.loop->open || s == 0) && same_from(from, to, s, false, rounding)) return found(s, false);
    if ((!to.loop->open || s == n - 1) && same_from(from, to, s, true, rounding)) return found(s, true);
  }
  return {};
}

SameStations following_stations(const Outline& from, const Outline& to, std::vector<std::size_t> known) {
  if (from.loop->open != to.loop->open || from.size() < 2 || to.size() < 2) return {};
  std::optional<bool> reversed = keep_one_order(from, known);
  const auto count = static_cast<std::size_t>(
      std::count_if(known.begin(), known.end(), [](std::size_t s) { return s != no_station; }));
  if (!reversed || count < 2) {
    known.assign(to.size(), no_station);
    if (link_curves(from, to, known)) {
      reversed = keep_one_order(from, known);
    } else if (has_airfoil(*from.loop) || has_airfoil(*to.loop)) {
      return {};  // of another discretisation
    } else {
      const Seed seed = best_seed(from, to);
      known[0] = seed.first;
      reversed = seed.reversed;
    }
  }
  SameStations result{.station = std::move(known), .reversed = reversed.value_or(false)};
  GapFiller(from, to, result.reversed, result.station).run();
  return result;
}

}  // namespace remodel
