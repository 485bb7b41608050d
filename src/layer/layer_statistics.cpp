#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "layer/layer_parts.h"
#include "mesh/mesh_data.h"

namespace remodel {

namespace {

double corner_deg(Point before, Point at, Point after) {
  const Point u = after - at, v = before - at;
  return std::atan2(cross(u, v), dot(u, v)) * (180.0 / std::numbers::pi);
}

double area_of(Point a, Point b, Point c) {
  return 0.5 * std::abs(cross(b - a, c - a));
}

void measure_cell(const CellPoints& cell, LayerStatistics& statistics) {
  if (cell.triangle) return;
  for (int k = 0; k < 4; ++k) {
    const double corner = corner_deg(cell.corner[(k + 3) % 4], cell.corner[k], cell.corner[(k + 1) % 4]);
    statistics.corner_min_deg = std::min(statistics.corner_min_deg, corner);
  }
}

// The cell at the wall: its edge there over its area's height.
void measure_wall(const CellPoints& cell, LayerStatistics& statistics) {
  if (cell.triangle) return;
  const auto& p = cell.corner;
  const double length = distance(p[0], p[1]);
  const double area = area_of(p[0], p[1], p[2]) + area_of(p[0], p[2], p[3]);
  statistics.aspect_max = std::max(statistics.aspect_max, length * length / area);
}

// The larger area over the smaller one at each edge of the tops: of undivided cells, and of the triangles
// there.
void measure_jumps(const Mesh& outer, const ColumnRing& ring, const RingTops& tops, std::uint32_t levels,
                   std::vector<double>& jumps) {
  const Triangulation& triangulation = outer.data().triangulation;
  for (std::size_t c = 0; c < ring.pairs(); ++c) {
    if (!tops.splits[c].empty()) continue;
    const VertexId from = tops.top[c], to = tops.top[ring.after(c)];
    const auto corner = ring.left ? triangulation.find_edge(from, to) : triangulation.find_edge(to, from);
    const CellPoints cell = layer_cell(ring, c, levels - 1, levels);
    const auto& p = cell.corner;
    const double below = area_of(p[0], p[1], p[2]) + area_of(p[0], p[2], p[3]);
    const double above = area_of(p[2], p[3], triangulation.point(triangulation.vertex(*corner)));
    jumps.push_back(std::max(below, above) / std::min(below, above));
  }
}

}  // namespace

LayerStatistics LayeredMesh::statistics() const {
  LayerStatistics statistics;
  if (empty()) return statistics;
  const std::vector<RingTops> tops = tops_of(outer_, *columns_);
  statistics.columns = columns_->count();
  statistics.first_height = options_.first_height;
  statistics.shrunk = columns_->shrunk;
  statistics.thickness = statistics.growth = {HUGE_VAL, 0.0};
  statistics.corner_min_deg = 180.0;
  const auto take = [](LeastAndMost& range, double value) {
    range = {std::min(range.least, value), std::max(range.most, value)};
  };
  std::vector<double> jumps;
  for (std::size_t r = 0; r < tops.size(); ++r) {
    const ColumnRing& ring = columns_->rings[r];
    statistics.cells += cell_count(ring, tops[r], levels());
    for (std::size_t c = 0; c < ring.size(); ++c) {
      take(statistics.thickness, ring.thickness[c]);
      take(statistics.growth, ring.growth[c]);
      if (c == ring.pairs()) break;
      statistics.split_tops += !tops[r].splits[c].empty();
      measure_wall(layer_cell(ring, c, 0, levels()), statistics);
      for (std::uint32_t level = 0; level < levels(); ++level)
        measure_cell(layer_cell(ring, c, level, levels()), statistics);
    }
    measure_jumps(outer_, ring, tops[r], levels(), jumps);
  }
  if (jumps.empty()) return statistics;
  std::sort(jumps.begin(), jumps.end());
  statistics.area_jump_median = jumps[jumps.size() / 2];
  statistics.area_jump_max = jumps.back();
  return statistics;
}

}  // namespace remodel
