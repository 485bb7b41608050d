#include <algorithm>
#include <utility>

#include "layer/layer_parts.h"
#include "layer/outside.h"
#include "mesh/mesh_data.h"
#include "remodel/error.h"

namespace remodel {

namespace {

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

}  // namespace

std::size_t parts_of_split(const ColumnRing& ring, std::size_t column, std::size_t splits,
                           std::uint32_t levels) {
  const bool fan = levels == 1 && ring.step[column] == 0.0;
  return splits + (fan ? 1 : 2);
}

std::size_t cell_count(const ColumnRing& ring, const RingTops& tops, std::uint32_t levels) {
  std::size_t count = ring.pairs() * levels;
  for (std::size_t c = 0; c < ring.pairs(); ++c)
    if (!tops.splits[c].empty()) count += parts_of_split(ring, c, tops.splits[c].size(), levels) - 1;
  return count;
}

std::vector<RingTops> tops_of(const Mesh& outer, const LayerColumns& columns) {
  const MeshData& data = outer.data();
  std::vector<RingTops> rings;
  for (const ColumnRing& ring : columns.rings) {
    // All stations of the loop, and what lies between each and the next one.
    RingTops all;
    data.walk(data.loop_heads[ring.wall.loop], [&](std::uint32_t k) {
      const VertexId v = data.at(k).vertex;
      if (!data.at(k).steiner) {
        all.top.push_back(v);
        all.splits.emplace_back();
      } else {
        all.splits.back().push_back({{v, data.triangulation.generation(v)}, data.triangulation.point(v)});
      }
    });
    if (ring.closed()) {
      rings.push_back(std::move(all));
      continue;
    }
    RingTops& tops = rings.emplace_back();
    std::size_t first = 0;
    const std::vector<Curve>& curves = outer.domain().loops[ring.wall.loop].curves;
    for (std::size_t c = 0; c < ring.outside_curve; ++c) first += curves[c].parameters.size();
    for (std::size_t c = 0; c < ring.size(); ++c) {
      const std::size_t station = (first + c) % all.top.size();
      tops.top.push_back(all.top[station]);
      tops.splits.push_back(c < ring.pairs() ? std::move(all.splits[station])
                                             : std::vector<RingTops::Split>{});
    }
  }
  return rings;
}

LayeredMesh::LayeredMesh() : columns_(std::make_shared<Columns>()) {}
LayeredMesh::~LayeredMesh() = default;
LayeredMesh::LayeredMesh(LayeredMesh&& other) noexcept = default;
LayeredMesh& LayeredMesh::operator=(LayeredMesh&& other) noexcept = default;
LayeredMesh::LayeredMesh(const LayeredMesh& other) = default;
LayeredMesh& LayeredMesh::operator=(const LayeredMesh& other) = default;

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

Domain LayeredMesh::meshed_domain() const {
  return empty() ? walls_ : with_moved_stations(walls_, columns_->rings);
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
      for (std::uint32_t level = 0; c < ring.pairs() && level < levels(); ++level)
        if (!is_convex(layer_cell(ring, c, level, levels())))
          return place + ", level " + std::to_string(level) + ": the cell is not convex";
    }
  }
  return {};
}

LayeredState LayeredMesh::state() const {
  return {outer_.state(), walls_, options_, levels(), columns_->fans, columns_->ids, columns_->next_id};
}

LayeredMesh LayeredMesh::restore(const LayeredState& state, const std::string& source) {
  const auto refuse = [&](const std::string& problem) { throw Error(ErrorCode::format, source, problem); };
  LayeredMesh mesh;
  mesh.outer_ = Mesh::restore(state.outer, source);
  const auto made = std::make_shared<Columns>();
  Columns& columns = *made;
  try {
    require_layer_options(state.options);
    validate(state.walls);
    const Walls walls(state.walls);
    columns.layered = layered_walls(walls, state.options);
    if (state.levels < 1 || state.levels > 1000)
      refuse("found " + std::to_string(state.levels) + " levels of a layer, expected 1 to 1000");
    bool fits = state.fans.size() == columns.layered.size();
    for (std::size_t r = 0; fits && r < columns.layered.size(); ++r)
      fits = state.fans[r].size() == columns.layered[r].stations &&
             std::all_of(state.fans[r].begin(), state.fans[r].end(), [](std::uint32_t n) { return n <= 64; });
    if (!fits)
      refuse("found fans of a layer that do not fit its walls, expected one number a station, at most 64");
    columns.levels = state.levels;
    columns.fans = state.fans;
    static_cast<LayerColumns&>(columns) =
        columns_of(walls, columns.layered, columns.fans, state.options, columns.levels);
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
  mesh.columns_ = made;
  mesh.walls_ = state.walls;
  mesh.options_ = state.options;
  return mesh;
}

}  // namespace remodel
