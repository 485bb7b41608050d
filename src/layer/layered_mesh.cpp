#include <algorithm>
#include <utility>

#include "generate/require_option.h"
#include "layer/heights.h"
#include "layer/layer_parts.h"
#include "mesh/mesh_data.h"
#include "remodel/error.h"
#include "remodel/generate.h"
#include "step/correspondence.h"
#include "step/outcome.h"

namespace remodel {

namespace {

void require_layer_options(const LayerOptions& options) {
  require_option(options.first_height > 0.0 && options.first_height <= 1e3, "first layer height",
                 options.first_height, "more than 0 and at most 1000 chords");
  require_option(options.growth >= 1.02 && options.growth <= 2.0, "growth", options.growth, "1.02 to 2");
  require_option(options.thickness >= options.first_height && options.thickness <= 1e3, "layer thickness",
                 options.thickness, "at least the first layer's height and at most 1000 chords");
  require_option(options.fan_from_deg >= 10.0 && options.fan_from_deg <= 90.0, "angle of fans", options.fan_from_deg,
                 "10 to 90");
}

std::uint32_t levels_of(const LayerOptions& options) {
  const std::uint32_t levels = level_count(options.first_height, options.growth, options.thickness);
  const double reached = options.first_height * geometric_sum(options.growth, levels);
  require_option(reached >= options.thickness * (1.0 - 1e-6), "layer thickness", options.thickness,
                 "one that 1000 cells fill");
  return levels;
}

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

// The new walls in the terms of the mesh's own: its curves where loops are the same places, written otherwise.
Domain in_own_terms(const Domain& own, const Domain& wanted) {
  return follows_by_index(own, wanted) ? wanted : correspond(own, wanted).domain;
}

bool same_tops(const Domain& outside, const Domain& expected, const LayerColumns& columns) {
  if (outside.loops.size() != expected.loops.size()) return false;
  return std::all_of(columns.rings.begin(), columns.rings.end(), [&](const ColumnRing& ring) {
    const Loop &found = outside.loops[ring.loop], &wanted = expected.loops[ring.loop];
    return found.curves.size() == 1 && found.curves[0].shape == wanted.curves[0].shape &&
           found.curves[0].parameters == wanted.curves[0].parameters && found.placement == wanted.placement;
  });
}

// What steps of a mesh have left of the layer.
struct LayerCounts {
  std::size_t before = 0, now = 0, preserved = 0, connected = 0;
  std::size_t moved = 0, inserted = 0, removed = 0;  // vertices below the tops
};

// Per column and level from the wall to the top: whether the point stands where it stood.
std::vector<bool> points_that_stay(const ColumnRing& was, const ColumnRing& is, std::uint32_t levels) {
  std::vector<bool> stays;
  stays.reserve(is.size() * (levels + 1));
  for (std::size_t c = 0; c < is.size(); ++c) {
    stays.push_back(was.foot[c] == is.foot[c]);
    for (std::size_t i = c * levels; i < (c + 1) * levels; ++i) stays.push_back(was.points[i] == is.points[i]);
  }
  return stays;
}

void count_ring(const ColumnRing& was, const RingTops& tops_before, const ColumnRing& is, const RingTops& tops_now,
                std::uint32_t levels, LayerCounts& counts) {
  const std::vector<bool> stays = points_that_stay(was, is, levels);
  for (std::size_t c = 0; c < is.size(); ++c) {
    const auto &split_before = tops_before.splits[c], &split = tops_now.splits[c];
    const std::size_t here = c * (levels + 1), there = is.after(c) * (levels + 1);
    const auto stands = [&](std::uint32_t level) {
      return stays[here + level] && stays[here + level + 1] && stays[there + level] && stays[there + level + 1];
    };
    const bool whole = split.empty() && split_before.empty();
    const std::uint32_t plain = whole ? levels : levels - 1;
    counts.connected += plain;
    for (std::uint32_t level = 0; level < plain; ++level) counts.preserved += stands(level);
    const auto same_key = [](const RingTops::Split& a, const RingTops::Split& b) { return a.key == b.key; };
    if (!whole && std::equal(split.begin(), split.end(), split_before.begin(), split_before.end(), same_key)) {
      const std::size_t parts = parts_of_split(is, c, split.size(), levels);
      counts.connected += parts;
      if (stands(levels - 1) && split == split_before) counts.preserved += parts;
    }
    const bool shares_foot = c > 0 && is.station[c] == is.station[c - 1];
    for (std::uint32_t level = shares_foot ? 1 : 0; level < levels; ++level) counts.moved += !stays[here + level];
  }
}

// Without the tops, which are the outer mesh's.
std::size_t vertices_below(const ColumnRing& ring, std::uint32_t levels) {
  std::size_t count = ring.size() * (levels - 1);
  for (std::size_t c = 0; c < ring.size(); ++c) count += c == 0 || ring.station[c] != ring.station[c - 1];
  return count;
}

LayerCounts count_layer(const LayerColumns& was, const std::vector<RingTops>& tops_before, const LayerColumns& is,
                        const std::vector<RingTops>& tops_now, std::uint32_t levels, bool same_columns) {
  LayerCounts counts;
  for (std::size_t r = 0; r < was.rings.size(); ++r) {
    counts.before += cell_count(was.rings[r], tops_before[r], levels);
    if (!same_columns) counts.removed += vertices_below(was.rings[r], levels);
  }
  for (std::size_t r = 0; r < is.rings.size(); ++r) {
    counts.now += cell_count(is.rings[r], tops_now[r], levels);
    if (!same_columns) counts.inserted += vertices_below(is.rings[r], levels);
    if (same_columns) count_ring(was.rings[r], tops_before[r], is.rings[r], tops_now[r], levels, counts);
  }
  return counts;
}

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

// The step of the outer mesh. Where it follows by index it takes the tops as they are. Where it has to find out
// what is what, it may keep an old loop whose places are those of the tops to the last rounding, although the wall
// below is another one, or is written otherwise. Then the tops are not the columns'.
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

std::size_t parts_of_split(const ColumnRing& ring, std::size_t column, std::size_t splits, std::uint32_t levels) {
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

LayeredGenerateResult generate_layered(const Domain& domain, const LayerOptions& layers, const QualityOptions& quality,
                                       StepObserver* observer) {
  require_layer_options(layers);
  validate(domain);
  LayeredGenerateResult result;
  LayeredMesh& mesh = result.mesh;
  LayeredMesh::Columns& columns = *mesh.columns_;
  columns.loops = layered_loops(domain, layers);
  columns.levels = levels_of(layers);
  const Walls walls(domain);
  columns.fans = fans_of(walls, columns.loops, layers, nullptr).sectors;
  static_cast<LayerColumns&>(columns) = columns_of(walls, columns.loops, columns.fans, layers, columns.levels);
  GenerateResult outer = generate(outside_of(domain, columns, columns.levels), quality, observer);
  mesh.outer_ = std::move(outer.mesh);
  mesh.walls_ = domain;
  mesh.options_ = layers;
  result.stopped = outer.stopped;
  result.small_angles = outer.small_angles;
  result.exempt_triangles = outer.exempt_triangles;
  return result;
}

LayeredRemodelResult remodel(LayeredMesh& mesh, const Domain& domain, const RemodelOptions& options) {
  if (mesh.empty())
    throw Error(ErrorCode::argument, "mesh", "found an empty one, expected one that was generated or read");
  validate(domain);
  const LayeredMesh::Columns& own = *mesh.columns_;
  Domain wanted = in_own_terms(mesh.walls_, domain);
  const Walls walls(wanted);

  auto columns = std::make_unique<LayeredMesh::Columns>();
  columns->loops = layered_loops(wanted, mesh.options_);
  columns->levels = own.levels;
  // Fans are kept station for station. Loops in another order have the same stations only if they are one to one.
  const bool same_stations = columns->loops == own.loops && one_to_one(mesh.walls_, wanted);
  Fans fans = fans_of(walls, columns->loops, mesh.options_, same_stations ? &own.fans : nullptr);
  const bool same_columns = same_stations && (!fans.changed || fans.sectors == own.fans);
  columns->fans = std::move(fans.sectors);
  columns->epoch = own.epoch + (same_columns ? 0 : 1);
  static_cast<LayerColumns&>(*columns) =
      columns_of(walls, columns->loops, columns->fans, mesh.options_, columns->levels);

  const std::vector<RingTops> tops_before = tops_of(mesh.outer_, own);
  const RemodelResult outer = step_outside(mesh.outer_, outside_of(wanted, *columns, columns->levels), *columns, options);
  const bool as_it_was = outer.abandoned || outer.stopped == Stopped::interrupted;
  const LayeredMesh::Columns& now = as_it_was ? own : *columns;
  const LayerCounts counts =
      count_layer(own, tops_before, now, tops_of(mesh.outer_, now), own.levels, as_it_was || same_columns);
  LayeredRemodelResult result = of_the_whole(outer, counts);
  result.shrunk = now.shrunk;
  result.same_columns = as_it_was || same_columns;
  if (as_it_was) return result;
  mesh.walls_ = std::move(wanted);
  mesh.columns_ = std::move(columns);
  return result;
}

LayeredState LayeredMesh::state() const {
  return {outer_.state(), walls_, options_, levels(), columns_->epoch, columns_->fans};
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
    if (!fits) refuse("found fans of a layer that do not fit its walls, expected one number a station, at most 64");
    columns.levels = state.levels;
    columns.epoch = state.epoch;
    columns.fans = state.fans;
    static_cast<LayerColumns&>(columns) =
        columns_of(Walls(state.walls), columns.loops, columns.fans, state.options, columns.levels);
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
