#include <algorithm>
#include <utility>

#include "layer/layer_parts.h"
#include "mesh/mesh_data.h"
#include "remodel/error.h"
#include "remodel/generate.h"
#include "step/correspondence.h"
#include "step/outcome.h"

namespace remodel {

namespace {

// The loops that differ; false if the two have other loops or stations, or may be in another order.
bool follows_by_index(const Domain& own, const Domain& wanted) {
  if (!one_to_one(own, wanted)) return false;
  std::vector<std::size_t> moving;
  for (std::size_t l = 0; l < own.loops.size(); ++l) {
    const Loop &from = own.loops[l], &to = wanted.loops[l];
    if (from.region != to.region || from.right_region != to.right_region) return false;
    if (!(from == to)) moving.push_back(l);
  }
  return corresponds_by_index(own, wanted, moving);
}

// The new walls in the terms of the mesh's own: its curves where loops are the same places, written
// otherwise.
struct NewWalls {
  Domain domain;
  std::vector<std::size_t> from;  // per loop: the old one that it is station for station, or no_link
};
NewWalls in_own_terms(const Domain& own, const Domain& wanted) {
  NewWalls walls{wanted, {}};
  if (follows_by_index(own, wanted)) {
    for (std::size_t l = 0; l < wanted.loops.size(); ++l) walls.from.push_back(l);
    return walls;
  }
  Correspondence to = correspond(own, wanted);
  walls.domain = std::move(to.domain);
  for (std::size_t l = 0; l < to.loops.size(); ++l) {
    const std::size_t from = to.loops[l].from;
    const bool same = from != no_link && in_order(own.loops[from], walls.domain.loops[l]);
    walls.from.push_back(same ? from : no_link);
  }
  return walls;
}

// Per ring: the one of its old loop, or no_column.
std::vector<std::size_t> old_rings(const std::vector<std::size_t>& loops,
                                   const std::vector<std::size_t>& from,
                                   const std::vector<std::size_t>& old_loops) {
  std::vector<std::size_t> rings;
  for (const std::size_t loop : loops) {
    const auto old = std::find(old_loops.begin(), old_loops.end(), from[loop]);
    rings.push_back(old == old_loops.end() ? ColumnPlace::no_column
                                           : static_cast<std::size_t>(old - old_loops.begin()));
  }
  return rings;
}

// The columns of a station are the same where its fan has as many sectors as before.
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

bool same_tops(const Domain& outside, const Domain& expected, const LayerColumns& columns) {
  if (outside.loops.size() != expected.loops.size()) return false;
  return std::all_of(columns.rings.begin(), columns.rings.end(), [&](const ColumnRing& ring) {
    const Loop &found = outside.loops[ring.loop], &wanted = expected.loops[ring.loop];
    return found.curves.size() == 1 && found.curves[0].shape == wanted.curves[0].shape &&
           found.curves[0].parameters == wanted.curves[0].parameters && found.placement == wanted.placement;
  });
}

// What a step has left of the layer.
struct LayerCounts {
  std::size_t before = 0, now = 0, preserved = 0, connected = 0;
  std::size_t moved = 0, inserted = 0, removed = 0;  // vertices below the tops
};

bool shares_foot(const ColumnRing& ring, std::size_t column) {
  return column > 0 && ring.station[column] == ring.station[column - 1];
}

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
      for (std::size_t c = 0; c < is.rings[r].size(); ++c) compare_cells(r, c);
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
    if (!a.there() || !b.there() || was_.rings[a.ring].after(a.column) != b.column) return;
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

LayeredRemodelResult of_the_whole(const RemodelResult& outer, const LayerCounts& layer) {
  LayeredRemodelResult result;
  static_cast<RemodelResult&>(result) = outer;
  result.triangles_before += layer.before;
  result.triangles += layer.now;
  result.preserved += layer.preserved;
  result.connected += layer.connected;
  result.moved += layer.moved;
  result.inserted += layer.inserted;
  result.removed += layer.removed;
  result.layer_cells = layer.now;
  return result;
}

// Whether the numbers of columns are different ones, as many as there are columns.
bool are_numbers(const LayeredState& state, const LayerColumns& columns) {
  std::vector<std::uint32_t> all;
  if (state.columns.size() != columns.rings.size()) return false;
  for (std::size_t r = 0; r < columns.rings.size(); ++r) {
    if (state.columns[r].size() != columns.rings[r].size()) return false;
    all.insert(all.end(), state.columns[r].begin(), state.columns[r].end());
  }
  std::sort(all.begin(), all.end());
  return std::adjacent_find(all.begin(), all.end()) == all.end() && all.back() < state.next_column;
}

// A fresh outer mesh takes the place of the one before, with keys that were never given out.
RemodelResult regenerate_outside(Mesh& outer, const Domain& outside, const RemodelOptions& options,
                                 const char* reason) {
  RemodelResult as_it_was = unchanged(outer.data());
  as_it_was.reason = reason;
  as_it_was.abandoned = !options.regenerate;
  if (as_it_was.abandoned) return as_it_was;
  GenerateResult fresh = generate(outside, outer.options(), options.observer);
  if (fresh.stopped == Stopped::interrupted) return interrupted(outer.data());
  MeshData& made = fresh.mesh.data();
  made.keep = outer.keep();
  made.step = outer.step() + 1;
  for (std::uint32_t i = 0; i < made.triangulation.triangle_slots(); ++i)
    made.triangulation.set_birth(TriangleId{i}, made.step);
  made.triangulation.begin_generations_after(outer.data().triangulation);
  RemodelResult result = count_exchange(outer, fresh.mesh);
  result.stopped = fresh.stopped;
  result.regenerated = true;
  result.reason = reason;
  outer = std::move(fresh.mesh);
  return result;
}

// The step of the outer mesh. Where it follows by index it takes the tops as they are. Where it has to find
// out what is what, it may keep an old loop whose places are those of the tops to the last rounding, although
// the wall below is another one, or is written otherwise. Then the tops are not the columns'.
RemodelResult step_outside(Mesh& outer, const Domain& outside, const LayerColumns& columns,
                           const RemodelOptions& options) {
  if (follows_by_index(outer.domain(), outside)) return remodel(outer, outside, options);
  {
    Trial trial(outer, outside, options);
    const RemodelResult result = trial.result();
    const bool as_it_was = result.abandoned || result.stopped == Stopped::interrupted;
    if (as_it_was || same_tops(outer.domain(), outside, columns)) {
      trial.keep();
      return result;
    }
  }
  return regenerate_outside(outer, outside, options, "the wall is the same place, described in another way");
}

}  // namespace

std::size_t parts_of_split(const ColumnRing& ring, std::size_t column, std::size_t splits,
                           std::uint32_t levels) {
  const bool fan = levels == 1 && ring.step[column] == 0.0;
  return splits + (fan ? 1 : 2);
}

std::size_t cell_count(const ColumnRing& ring, const RingTops& tops, std::uint32_t levels) {
  std::size_t count = ring.size() * levels;
  for (std::size_t c = 0; c < ring.size(); ++c)
    if (!tops.splits[c].empty()) count += parts_of_split(ring, c, tops.splits[c].size(), levels) - 1;
  return count;
}

std::vector<RingTops> tops_of(const Mesh& outer, const LayerColumns& columns) {
  const MeshData& data = outer.data();
  std::vector<RingTops> rings;
  for (const ColumnRing& ring : columns.rings) {
    RingTops& tops = rings.emplace_back();
    data.walk(data.loop_heads[ring.loop], [&](std::uint32_t k) {
      const VertexId v = data.at(k).vertex;
      if (!data.at(k).steiner) {
        tops.top.push_back(v);
        tops.splits.emplace_back();
      } else {
        tops.splits.back().push_back({{v, data.triangulation.generation(v)}, data.triangulation.point(v)});
      }
    });
  }
  return rings;
}

LayeredMesh::LayeredMesh() : columns_(std::make_unique<Columns>()) {}
LayeredMesh::~LayeredMesh() = default;
LayeredMesh::LayeredMesh(LayeredMesh&& other) noexcept = default;
LayeredMesh& LayeredMesh::operator=(LayeredMesh&& other) noexcept = default;
LayeredMesh::LayeredMesh(const LayeredMesh& other)
    : outer_(other.outer_),
      walls_(other.walls_),
      options_(other.options_),
      columns_(other.columns_ ? std::make_unique<Columns>(*other.columns_) : nullptr) {}
LayeredMesh& LayeredMesh::operator=(const LayeredMesh& other) {
  if (this != &other) *this = LayeredMesh(other);
  return *this;
}

std::uint32_t LayeredMesh::levels() const {
  return columns_ ? columns_->levels : 0;
}
std::size_t LayeredMesh::columns() const {
  return columns_ ? columns_->count() : 0;
}
std::size_t LayeredMesh::shrunk() const {
  return columns_ ? columns_->shrunk : 0;
}
std::size_t LayeredMesh::layer_cells() const {
  if (empty()) return 0;
  const std::vector<RingTops> tops = tops_of(outer_, *columns_);
  std::size_t count = 0;
  for (std::size_t r = 0; r < tops.size(); ++r) count += cell_count(columns_->rings[r], tops[r], levels());
  return count;
}

std::string LayeredMesh::quick_check() const {
  if (std::string broken = outer_.quick_check(); !broken.empty() || empty()) return broken;
  const std::vector<RingTops> tops = tops_of(outer_, *columns_);
  for (std::size_t r = 0; r < tops.size(); ++r) {
    const ColumnRing& ring = columns_->rings[r];
    if (tops[r].top.size() != ring.size()) return "layer: ring " + std::to_string(r) + " has other tops";
    for (std::size_t c = 0; c < ring.size(); ++c) {
      const std::string place = "layer: ring " + std::to_string(r) + ", column " + std::to_string(c);
      if (outer_.data().triangulation.point(tops[r].top[c]) != ring.points[(c + 1) * levels() - 1])
        return place + ": its top is not the outer mesh's";
      for (std::uint32_t level = 0; level < levels(); ++level)
        if (!is_convex(layer_cell(ring, c, level, levels())))
          return place + ", level " + std::to_string(level) + ": the cell is not convex";
    }
  }
  return {};
}

LayeredRemodelResult remodel(LayeredMesh& mesh, const Domain& domain, const RemodelOptions& options) {
  if (mesh.empty())
    throw Error(ErrorCode::argument, "mesh", "found an empty one, expected one that was generated or read");
  validate(domain);
  const LayeredMesh::Columns& own = *mesh.columns_;
  NewWalls wanted = in_own_terms(mesh.walls_, domain);
  const Walls walls(wanted.domain);

  auto columns = std::make_unique<LayeredMesh::Columns>();
  columns->loops = layered_loops(wanted.domain, mesh.options_);
  columns->levels = own.levels;
  const std::vector<std::size_t> old_ring = old_rings(columns->loops, wanted.from, own.loops);
  std::vector<const std::vector<std::uint32_t>*> kept;
  for (const std::size_t ring : old_ring)
    kept.push_back(ring == ColumnPlace::no_column ? nullptr : &own.fans[ring]);
  columns->fans = fans_of(walls, columns->loops, mesh.options_, kept);
  static_cast<LayerColumns&>(*columns) =
      columns_of(walls, columns->loops, columns->fans, mesh.options_, columns->levels);
  const ColumnMatches matches = match_columns(own.fans, columns->fans, old_ring);
  columns->next_id = own.next_id;
  std::size_t same = 0;
  for (const std::vector<ColumnPlace>& ring : matches) {
    std::vector<std::uint32_t>& ids = columns->ids.emplace_back();
    for (const ColumnPlace old : ring) {
      ids.push_back(old.there() ? own.ids[old.ring][old.column] : columns->next_id++);
      same += old.there();
    }
  }

  const std::vector<RingTops> tops_before = tops_of(mesh.outer_, own);
  const Domain outside = outside_of(wanted.domain, *columns, columns->levels);
  const RemodelResult outer = step_outside(mesh.outer_, outside, *columns, options);
  if (outer.abandoned || outer.stopped == Stopped::interrupted) {
    LayeredRemodelResult result = of_the_whole(outer, {});
    const std::size_t cells = mesh.layer_cells();
    for (std::size_t* count :
         {&result.triangles_before, &result.triangles, &result.preserved, &result.connected})
      *count += cells;
    result.layer_cells = cells;
    result.shrunk = own.shrunk;
    return result;
  }
  const LayerCounter counter(own, tops_before, *columns, tops_of(mesh.outer_, *columns), matches, own.levels);
  LayeredRemodelResult result = of_the_whole(outer, counter.counts());
  result.shrunk = columns->shrunk;
  result.same_columns = same == own.count() && same == columns->count();
  mesh.walls_ = std::move(wanted.domain);
  mesh.columns_ = std::move(columns);
  return result;
}

LayeredState LayeredMesh::state() const {
  return {outer_.state(), walls_, options_, levels(), columns_->fans, columns_->ids, columns_->next_id};
}

LayeredMesh LayeredMesh::restore(const LayeredState& state, const std::string& source) {
  const auto refuse = [&](const std::string& problem) { throw Error(ErrorCode::format, source, problem); };
  LayeredMesh mesh;
  mesh.outer_ = Mesh::restore(state.outer, source);
  Columns& columns = *mesh.columns_;
  try {
    require_layer_options(state.options);
    validate(state.walls);
    columns.loops = layered_loops(state.walls, state.options);
    if (state.levels < 1 || state.levels > 1000)
      refuse("found " + std::to_string(state.levels) + " levels of a layer, expected 1 to 1000");
    bool fits = state.fans.size() == columns.loops.size();
    for (std::size_t r = 0; fits && r < columns.loops.size(); ++r)
      fits = state.fans[r].size() == state.walls.stations(columns.loops[r]).size() &&
             std::all_of(state.fans[r].begin(), state.fans[r].end(), [](std::uint32_t n) { return n <= 64; });
    if (!fits)
      refuse("found fans of a layer that do not fit its walls, expected one number a station, at most 64");
    columns.levels = state.levels;
    columns.fans = state.fans;
    static_cast<LayerColumns&>(columns) =
        columns_of(Walls(state.walls), columns.loops, columns.fans, state.options, columns.levels);
    if (!are_numbers(state, columns))
      refuse("found numbers of a layer's columns that do not fit, expected different ones, one a column");
    columns.ids = state.columns;
    columns.next_id = state.next_column;
  } catch (const Error& error) {
    if (error.code() == ErrorCode::format) throw;
    refuse(std::string("found a layer that cannot be: ") + error.what());
  }
  if (!(mesh.outer_.domain() == outside_of(state.walls, columns, columns.levels)))
    refuse("found an outer mesh that does not end at the tops of the layer's columns");
  mesh.walls_ = state.walls;
  mesh.options_ = state.options;
  return mesh;
}

}  // namespace remodel
