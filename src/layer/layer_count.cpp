#include "layer/layer_count.h"

#include <algorithm>
#include <unordered_map>

namespace remodel {

namespace {

// Without its top, which is the outer mesh's, and without a foot that is another column's.
std::size_t vertices_below(const ColumnRing& ring, std::size_t column, std::uint32_t levels) {
  return levels - 1 + (shares_foot(ring, column) ? 0 : 1);
}

// Counts what is left of an earlier layer.
class LayerCounter {
 public:
  LayerCounter(const LayerColumns& was, const std::vector<RingTops>& tops_before, const LayerColumns& is,
               const std::vector<RingTops>& tops_now, const ColumnMatches& matches, std::uint32_t levels)
      : was_(was),
        is_(is),
        tops_before_(tops_before),
        tops_now_(tops_now),
        matches_(matches),
        levels_(levels) {
    for (std::size_t r = 0; r < was.rings.size(); ++r) {
      counts_.before += cell_count(was.rings[r], tops_before[r], levels);
      for (std::size_t c = 0; c < was.rings[r].size(); ++c)
        counts_.removed += vertices_below(was.rings[r], c, levels);
    }
    for (std::size_t r = 0; r < is.rings.size(); ++r) {
      counts_.now += cell_count(is.rings[r], tops_now[r], levels);
      compare_points(r);
      for (std::size_t c = 0; c < is.rings[r].pairs(); ++c) compare_cells(r, c);
    }
  }
  const LayerCounts& counts() const { return counts_; }

 private:
  // Fills stays_: per column and level from the wall to the top, whether the point stands where it stood.
  void compare_points(std::size_t r) {
    const ColumnRing& ring = is_.rings[r];
    stays_.assign(ring.size() * (levels_ + 1), false);
    for (std::size_t c = 0; c < ring.size(); ++c) {
      const ColumnPlace old = matches_[r][c];
      if (!old.there()) {
        counts_.inserted += vertices_below(ring, c, levels_);
        continue;
      }
      counts_.removed -= vertices_below(ring, c, levels_);
      const ColumnRing& before = was_.rings[old.ring];
      const std::size_t here = c * (levels_ + 1);
      stays_[here] = ring.foot[c] == before.foot[old.column];
      for (std::uint32_t j = 0; j < levels_; ++j)
        stays_[here + j + 1] = ring.points[c * levels_ + j] == before.points[old.column * levels_ + j];
      for (std::uint32_t level = shares_foot(ring, c) ? 1 : 0; level < levels_; ++level)
        counts_.moved += !stays_[here + level];
    }
  }

  // The cells between a column and the next one, if these stood side by side before.
  void compare_cells(std::size_t r, std::size_t c) {
    const ColumnRing& ring = is_.rings[r];
    const std::size_t next = ring.after(c);
    const ColumnPlace a = matches_[r][c], b = matches_[r][next];
    if (!a.there() || !b.there() || !was_.rings[a.ring].are_neighbours(a.column, b.column)) return;
    const std::size_t here = c * (levels_ + 1), there = next * (levels_ + 1);
    const auto stands = [&](std::uint32_t level) {
      return stays_[here + level] && stays_[here + level + 1] && stays_[there + level] &&
             stays_[there + level + 1];
    };
    const auto &split_before = tops_before_[a.ring].splits[a.column], &split = tops_now_[r].splits[c];
    const bool whole = split.empty() && split_before.empty();
    const std::uint32_t plain = whole ? levels_ : levels_ - 1;
    counts_.connected += plain;
    for (std::uint32_t level = 0; level < plain; ++level) counts_.preserved += stands(level);
    const auto same_key = [](const RingTops::Split& p, const RingTops::Split& q) { return p.key == q.key; };
    if (whole || !std::equal(split.begin(), split.end(), split_before.begin(), split_before.end(), same_key))
      return;
    const std::size_t parts = parts_of_split(ring, c, split.size(), levels_);
    counts_.connected += parts;
    if (stands(levels_ - 1) && split == split_before) counts_.preserved += parts;
  }

  const LayerColumns &was_, &is_;
  const std::vector<RingTops>&tops_before_, &tops_now_;
  const ColumnMatches& matches_;
  std::uint32_t levels_;
  std::vector<bool> stays_;
  LayerCounts counts_;
};

}  // namespace

bool shares_foot(const ColumnRing& ring, std::size_t column) {
  return column > 0 && ring.station[column] == ring.station[column - 1];
}

ColumnMatches match_columns(const FanSectors& before, const FanSectors& now,
                            const std::vector<std::size_t>& old_ring) {
  ColumnMatches matches;
  for (std::size_t r = 0; r < now.size(); ++r) {
    std::vector<ColumnPlace>& ring = matches.emplace_back();
    std::size_t first_before = 0;
    for (std::size_t station = 0; station < now[r].size(); ++station) {
      const bool known = old_ring[r] != ColumnPlace::no_column;
      const std::uint32_t sectors = known ? before[old_ring[r]][station] : 0;
      for (std::uint32_t j = 0; j <= now[r][station]; ++j)
        ring.push_back(known && sectors == now[r][station] ? ColumnPlace{old_ring[r], first_before + j}
                                                           : ColumnPlace{});
      first_before += sectors + 1;
    }
  }
  return matches;
}

ColumnMatches match_columns(const std::vector<std::vector<std::uint32_t>>& before,
                            const std::vector<std::vector<std::uint32_t>>& now) {
  std::unordered_map<std::uint32_t, ColumnPlace> places;
  for (std::size_t r = 0; r < before.size(); ++r)
    for (std::size_t c = 0; c < before[r].size(); ++c) places[before[r][c]] = {r, c};
  ColumnMatches matches;
  for (const std::vector<std::uint32_t>& ring : now) {
    std::vector<ColumnPlace>& matched = matches.emplace_back();
    for (const std::uint32_t number : ring) {
      const auto found = places.find(number);
      matched.push_back(found == places.end() ? ColumnPlace{} : found->second);
    }
  }
  return matches;
}

LayerCounts count_layer(const LayerColumns& was, const std::vector<RingTops>& tops_before,
                        const LayerColumns& is, const std::vector<RingTops>& tops_now,
                        const ColumnMatches& matches, std::uint32_t levels) {
  return LayerCounter(was, tops_before, is, tops_now, matches, levels).counts();
}

}  // namespace remodel
