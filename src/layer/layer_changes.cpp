// The changes of a layered mesh since a mark: those of its outer mesh, and those of its columns.

#include <algorithm>
#include <iterator>
#include <utility>

#include "layer/layer_count.h"
#include "layer/layer_parts.h"
#include "mesh/mesh_data.h"
#include "remodel/error.h"

namespace remodel {

struct LayerMark::Moment {
  Mark outer;
  std::shared_ptr<const LayerColumns> columns;
  std::shared_ptr<const std::vector<std::vector<std::uint32_t>>> ids;  // per ring and column: its number
  std::vector<RingTops> tops;
  std::vector<VertexKey> top_keys;
};

namespace {

using Keys = std::vector<VertexKey>;

Keys sorted(Keys keys) {
  std::sort(keys.begin(), keys.end(), [](VertexKey a, VertexKey b) { return a.value() < b.value(); });
  return keys;
}

Keys keys_of(const Mesh& outer, const std::vector<RingTops>& tops) {
  Keys keys;
  for (const RingTops& ring : tops)
    for (const VertexId top : ring.top) keys.push_back({top, outer.data().triangulation.generation(top)});
  return keys;
}

bool is_in(const Keys& sorted_keys, VertexKey key) {
  return std::binary_search(sorted_keys.begin(), sorted_keys.end(), key,
                            [](VertexKey a, VertexKey b) { return a.value() < b.value(); });
}

// Tops are points of the layer, whatever the outer mesh calls them.
class WholeChanges {
 public:
  WholeChanges(Changes outer, const Keys& tops_before, const Keys& tops_now)
      : before_(sorted(tops_before)), now_(sorted(tops_now)) {
    const Keys inserted = sorted(outer.inserted), removed = sorted(outer.removed);
    result_.born = std::move(outer.born), result_.gone = std::move(outer.gone);
    for (const VertexKey key : outer.moved)
      if (!is_in(before_, key) && !is_in(now_, key)) result_.moved.push_back(key);
    for (const VertexKey key : inserted)
      if (!is_in(now_, key)) result_.inserted.push_back(key);
    for (const VertexKey key : removed)
      if (!is_in(before_, key)) result_.removed.push_back(key);
    for (const VertexKey key : before_)  // a vertex that is no top any more
      if (!is_in(now_, key) && !is_in(removed, key)) result_.inserted.push_back(key);
    for (const VertexKey key : now_)  // one that was none before
      if (!is_in(before_, key) && !is_in(inserted, key)) result_.removed.push_back(key);
  }

  // Points of one column, from the wall to its top.
  template <class Key>
  void add_column(const ColumnRing& ring, std::size_t c, std::uint32_t levels, const ColumnRing* was,
                  std::size_t then, Key key) {
    for (std::uint32_t level = shares_foot(ring, c) ? 1 : 0; level <= levels; ++level) {
      if (was == nullptr)
        result_.inserted.push_back(key(level));
      else if (point(ring, c, level, levels) != point(*was, then, level, levels))
        result_.moved.push_back(key(level));
    }
  }
  template <class Key>
  void remove_column(const ColumnRing& ring, std::size_t c, std::uint32_t levels, Key key) {
    for (std::uint32_t level = shares_foot(ring, c) ? 1 : 0; level <= levels; ++level)
      result_.removed.push_back(key(level));
  }
  LayeredChanges take() {
    for (Keys* keys : {&result_.moved, &result_.inserted, &result_.removed}) *keys = sorted(std::move(*keys));
    return std::move(result_);
  }
  LayeredChanges& result() { return result_; }

 private:
  static Point point(const ColumnRing& ring, std::size_t c, std::uint32_t level, std::uint32_t levels) {
    return level == 0 ? ring.foot[c] : ring.points[c * levels + level - 1];
  }

  Keys before_, now_;
  LayeredChanges result_;
};

}  // namespace

LayerMark LayeredMesh::mark() {
  auto moment = std::make_shared<LayerMark::Moment>();
  moment->outer = outer_.mark();
  moment->columns = columns_;
  moment->ids = {columns_, &columns_->ids};
  moment->tops = tops_of(outer_, *columns_);
  moment->top_keys = keys_of(outer_, moment->tops);
  LayerMark mark;
  mark.moment_ = std::move(moment);
  return mark;
}

LayeredChanges LayeredMesh::changes_since(const LayerMark& mark) const {
  if (!mark.moment_)
    throw Error(ErrorCode::argument, "mark", "found one of no mesh, expected one of this layered mesh");
  const LayerMark::Moment& then = *mark.moment_;
  const std::vector<RingTops> tops = tops_of(outer_, *columns_);
  WholeChanges changes(outer_.changes_since(then.outer), then.top_keys, keys_of(outer_, tops));
  const ColumnMatches matches = match_columns(*then.ids, columns_->ids);
  std::vector<std::vector<bool>> stays;
  for (const std::vector<std::uint32_t>& ring : *then.ids) stays.emplace_back(ring.size(), false);
  const auto keys = [&](std::uint32_t number) {
    return [number, this](std::uint32_t level) { return VertexKey::of(layer_key(number, level, levels())); };
  };
  for (std::size_t r = 0; r < matches.size(); ++r)
    for (std::size_t c = 0; c < matches[r].size(); ++c) {
      const ColumnPlace old = matches[r][c];
      if (old.there()) stays[old.ring][old.column] = true;
      changes.add_column(columns_->rings[r], c, levels(),
                         old.there() ? &then.columns->rings[old.ring] : nullptr, old.column,
                         keys(columns_->ids[r][c]));
    }
  for (std::size_t r = 0; r < stays.size(); ++r)
    for (std::size_t c = 0; c < stays[r].size(); ++c)
      if (!stays[r][c]) changes.remove_column(then.columns->rings[r], c, levels(), keys((*then.ids)[r][c]));
  const LayerCounts cells = count_layer(*then.columns, then.tops, *columns_, tops, matches, levels());
  changes.result().layer_born = cells.now - cells.connected;
  changes.result().layer_gone = cells.before - cells.connected;
  return changes.take();
}

}  // namespace remodel
