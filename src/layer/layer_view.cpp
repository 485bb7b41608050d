// The frozen view of a layered mesh: the layer's points and cells, and the outer mesh's behind them.

#include <algorithm>
#include <map>
#include <utility>

#include "layer/heights.h"
#include "layer/layer_parts.h"
#include "layer/outside.h"

namespace remodel {

namespace {

LayerTopology topology_of(const LayerColumns& columns, std::uint32_t levels) {
  LayerTopology topology{.levels = levels, .wall = {}, .first = {}, .next = {}, .column = {}, .level = {}};
  for (const ColumnRing& ring : columns.rings) {
    const auto ring_begin = static_cast<std::uint32_t>(topology.wall.size());
    for (std::size_t c = 0; c < ring.size(); ++c) {
      const auto column = static_cast<std::uint32_t>(topology.wall.size());
      const bool shared = c > 0 && ring.station[c] == ring.station[c - 1];
      if (shared) {
        topology.wall.push_back(topology.wall.back());
      } else {
        topology.wall.push_back(static_cast<std::uint32_t>(topology.column.size()));
        topology.column.push_back(column);
        topology.level.push_back(0);
      }
      topology.first.push_back(static_cast<std::uint32_t>(topology.column.size()));
      for (std::uint32_t level = 1; level <= levels; ++level) {
        topology.column.push_back(column);
        topology.level.push_back(level);
      }
      const bool last = c + 1 == ring.size();
      topology.next.push_back(!last ? column + 1 : ring.closed() ? ring_begin : column);
    }
  }
  return topology;
}

// Puts the two meshes together.
class LayerView {
 public:
  LayerView(const Mesh& outer, const Domain& walls, const LayerColumns& columns, std::uint32_t levels,
            double first_height, const std::vector<std::vector<std::uint32_t>>& ids, LayerCells cells)
      : walls_(walls),
        columns_(columns),
        levels_(levels),
        first_height_(first_height),
        cells_(cells),
        outside_(outer.freeze()),
        tops_(tops_of(outer, columns)),
        topology_(topology_of(columns, levels)) {
    for (std::size_t l = 0, first = 0; l < walls.loops.size(); first += walls.loops[l++].curves.size())
      first_curves_.push_back(first);
    add_layer_points(ids);
    add_outer_points();
    add_layer_cells();
    add_outer_cells();
    add_boundaries();
    mesh_.periodic = outside_.periodic;
    mesh_.delaunay_slack_deg = outside_.delaunay_slack_deg;
    mesh_.last_generation = outside_.last_generation;
  }
  FrozenMesh take() { return std::move(mesh_); }

 private:
  void add_layer_points(const std::vector<std::vector<std::uint32_t>>& ids) {
    std::uint32_t column = 0;
    for (std::size_t r = 0; r < columns_.rings.size(); ++r) {
      const ColumnRing& ring = columns_.rings[r];
      const std::vector<BoundaryStation> stations = walls_.stations(ring.wall.loop);
      for (std::size_t c = 0; c < ring.size(); ++c, ++column) {
        const auto add = [&](Point p, std::uint32_t level, std::int32_t curve, double t) {
          mesh_.points.push_back(p);
          mesh_.length_scale.push_back(ring.spacing[c]);
          mesh_.vertex_keys.push_back(layer_key(ids[r][c], level, levels_));
          mesh_.curve.push_back(curve);
          mesh_.parameter.push_back(t);
          mesh_.steiner.push_back(0);
        };
        const BoundaryStation& station = stations[ring.station[c]];
        if (topology_.wall[column] == mesh_.points.size())
          add(ring.foot[c], 0, static_cast<std::int32_t>(station.curve), station.t);
        const std::vector<BoundaryStation> sides = places_on_opening(ring, c);
        for (std::uint32_t level = 1; level <= levels_; ++level) {
          const BoundaryStation side = sides.empty() ? BoundaryStation{no_curve, 0.0} : sides[level - 1];
          add(ring.points[c * levels_ + level - 1], level,
              side.curve == no_curve ? -1 : static_cast<std::int32_t>(side.curve), side.t);
        }
      }
    }
  }

  // Where the points of a column lie on an opening: none but at the ends of chains.
  std::vector<BoundaryStation> places_on_opening(const ColumnRing& ring, std::size_t column) const {
    std::vector<BoundaryStation> places;
    if (ring.closed() || (column > 0 && column + 1 < ring.size())) return places;
    const Opening& opening = ring.openings[column == 0 ? 0 : 1];
    std::vector<double> heights(levels_);
    level_heights(first_height_, ring.growth[column], ring.thickness[column], heights);
    for (const double height : heights)
      places.push_back({first_curves_[ring.wall.loop] + opening.curve(), opening.parameter(height)});
    return places;
  }

  // A curve beyond the layer: which one of the walls it is, or no_curve, and how its parameters are those of
  // that.
  struct OwnCurve {
    std::size_t curve = no_curve;
    OutsideCurve place = {};
  };
  std::vector<OwnCurve> own_curves() const {
    std::vector<OwnCurve> own;
    for (std::size_t l = 0; l < walls_.loops.size(); ++l) {
      const std::vector<OutsideCurve> curves = outside_curves(walls_, columns_.rings, l);
      for (const OutsideCurve& curve : curves)
        own.push_back({curve.ring == OutsideCurve::none ? first_curves_[l] + curve.curve : no_curve, curve});
      for (std::size_t c = 0; curves.empty() && c < walls_.loops[l].curves.size(); ++c)
        own.push_back({first_curves_[l] + c, {}});
    }
    return own;
  }

  void add_outer_points() {
    const std::vector<std::uint32_t>& ids = outside_.vertex_ids;
    point_of_.assign(outside_.points.size(), no_index);
    on_top_.assign(outside_.points.size(), no_index);
    along_top_.assign(outside_.points.size(), 0);
    const auto position = [&](VertexId v) {
      return static_cast<std::size_t>(std::lower_bound(ids.begin(), ids.end(), v.index) - ids.begin());
    };
    std::uint32_t column = 0;
    split_points_.resize(topology_.wall.size());
    for (std::uint32_t r = 0; r < tops_.size(); ++r) {
      std::uint32_t along = 0;
      for (std::size_t c = 0; c < tops_[r].top.size(); ++c, ++column) {
        const std::size_t p = position(tops_[r].top[c]);
        point_of_[p] = topology_.point(column, levels_);
        mesh_.length_scale[point_of_[p]] = outside_.length_scale[p];
        on_top_[p] = r, along_top_[p] = along++;
        for (const RingTops::Split& split : tops_[r].splits[c]) {
          const std::size_t s = position(split.key.id);
          on_top_[s] = r, along_top_[s] = along++;
          split_points_[column].push_back(static_cast<std::uint32_t>(s));
        }
      }
      on_tops_.push_back(along);
    }
    const std::vector<OwnCurve> curves = own_curves();
    for (std::size_t p = 0; p < point_of_.size(); ++p) {
      if (point_of_[p] != no_index) continue;
      point_of_[p] = static_cast<std::uint32_t>(mesh_.points.size());
      const OwnCurve own =
          outside_.curve[p] < 0 ? OwnCurve{} : curves[static_cast<std::size_t>(outside_.curve[p])];
      const std::int32_t curve = own.curve == no_curve ? -1 : static_cast<std::int32_t>(own.curve);
      const double t =
          curve < 0 ? 0.0 : own.place.own_parameter(walls_.curve(own.curve).shape, outside_.parameter[p]);
      mesh_.points.push_back(outside_.points[p]);
      mesh_.length_scale.push_back(outside_.length_scale[p]);
      mesh_.vertex_keys.push_back(outside_.vertex_keys[p]);
      mesh_.curve.push_back(curve);
      mesh_.parameter.push_back(t);
      mesh_.steiner.push_back(curve < 0 ? 0 : outside_.steiner[p]);
    }
    for (auto& split : split_points_)
      for (std::uint32_t& p : split) p = point_of_[p];
  }

  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t ring) {
    mesh_.triangles.push_back({a, b, c});
    triangle_rings_.push_back(ring);
  }

  // The polygon of a divided top cell: its lower edge from a to b, its upper one, whose points run from over
  // b to over a. a == b where the cell is a triangle.
  void add_divided(std::uint32_t a, std::uint32_t b, const std::vector<std::uint32_t>& upper,
                   std::uint32_t ring) {
    const std::size_t middle = upper.size() / 2;
    for (std::size_t i = 0; i + 1 < upper.size(); ++i) {
      if (i == middle && a != b) add_triangle(a, b, upper[middle], ring);
      add_triangle(i < middle ? b : a, upper[i], upper[i + 1], ring);
    }
  }

  void add_quad(const ColumnRing& ring, const std::array<std::uint32_t, 4>& quad, std::uint32_t r) {
    if (cells_ == LayerCells::quadrilaterals) {
      mesh_.quads.push_back(quad);
      quad_rings_.push_back(r);
      return;
    }
    // The diagonal begins at the wall, on the column that comes first.
    const std::size_t k = ring.left ? 0 : 1;
    add_triangle(quad[0], quad[1], quad[2 + k], r);
    add_triangle(quad[k], quad[2], quad[3], r);
  }

  void add_layer_cells() {
    std::uint32_t column = 0;
    for (std::uint32_t r = 0; r < columns_.rings.size(); ++r) {
      const ColumnRing& ring = columns_.rings[r];
      for (std::size_t c = 0; c < ring.size(); ++c, ++column) {
        if (c == ring.pairs()) continue;
        const std::uint32_t next = topology_.next[column];
        const std::uint32_t a = ring.left ? column : next, b = ring.left ? next : column;
        for (std::uint32_t level = 0; level < levels_; ++level) {
          const std::array<std::uint32_t, 4> quad{topology_.point(a, level), topology_.point(b, level),
                                                  topology_.point(b, level + 1),
                                                  topology_.point(a, level + 1)};
          if (level + 1 == levels_ && !split_points_[column].empty()) {
            std::vector<std::uint32_t> upper = split_points_[column];
            if (ring.left) std::reverse(upper.begin(), upper.end());
            upper.insert(upper.begin(), quad[2]);
            upper.push_back(quad[3]);
            add_divided(quad[0], quad[1], upper, r);
          } else if (quad[0] == quad[1]) {
            add_triangle(quad[1], quad[2], quad[3], r);
          } else {
            add_quad(ring, quad, r);
          }
        }
      }
    }
  }

  void add_outer_cells() {
    const std::size_t of_layer = mesh_.triangles.size();
    mesh_.layer_triangles = static_cast<std::uint32_t>(of_layer);
    for (const auto& triangle : outside_.triangles)
      mesh_.triangles.push_back({point_of_[triangle[0]], point_of_[triangle[1]], point_of_[triangle[2]]});
    if (outside_.region_names.empty()) return;
    mesh_.region_names = outside_.region_names;
    // The region of a ring is that of the triangles on its tops.
    std::vector<std::uint32_t> of_ring(columns_.rings.size(), 0);
    for (std::size_t t = 0; t < outside_.triangles.size(); ++t)
      for (const std::uint32_t p : outside_.triangles[t])
        if (on_top_[p] != no_index) of_ring[on_top_[p]] = outside_.region[t];
    for (std::size_t t = 0; t < of_layer; ++t) mesh_.region.push_back(of_ring[triangle_rings_[t]]);
    mesh_.region.insert(mesh_.region.end(), outside_.region.begin(), outside_.region.end());
    for (const std::uint32_t ring : quad_rings_) mesh_.region.push_back(of_ring[ring]);
  }

  FrozenBoundary& boundary(const std::string& name) {
    for (FrozenBoundary& known : mesh_.boundaries)
      if (known.name == name) return known;
    return mesh_.boundaries.emplace_back(FrozenBoundary{name, {}});
  }

  struct WallEdge {
    std::size_t curve;
    std::array<std::uint32_t, 2> ends;
  };

  // The sides of the columns at the ends of a chain, in the loop's direction, around the wall's edges.
  void add_sides(const ColumnRing& ring, std::uint32_t first_column, std::vector<WallEdge>& edges) const {
    if (ring.closed()) return;
    const std::uint32_t last_column = first_column + static_cast<std::uint32_t>(ring.size()) - 1;
    std::vector<WallEdge> before;
    for (std::uint32_t level = levels_; level > 0; --level)
      before.push_back({first_curves_[ring.wall.loop] + ring.openings[0].curve(),
                        {topology_.point(first_column, level), topology_.point(first_column, level - 1)}});
    edges.insert(edges.begin(), before.begin(), before.end());
    for (std::uint32_t level = 0; level < levels_; ++level)
      edges.push_back({first_curves_[ring.wall.loop] + ring.openings[1].curve(),
                       {topology_.point(last_column, level), topology_.point(last_column, level + 1)}});
  }

  void add_wall(const ColumnRing& ring, std::uint32_t first_column) {
    std::vector<WallEdge> edges;
    const std::vector<BoundaryStation> stations = walls_.stations(ring.wall.loop);
    for (std::uint32_t c = 0; c < ring.pairs(); ++c) {
      const std::uint32_t column = first_column + c, next = topology_.next[column];
      if (topology_.wall[column] == topology_.wall[next]) continue;
      edges.push_back({stations[ring.station[c]].curve, {topology_.wall[column], topology_.wall[next]}});
    }
    add_sides(ring, first_column, edges);
    if (!ring.left) {
      std::reverse(edges.begin(), edges.end());
      for (WallEdge& edge : edges) std::swap(edge.ends[0], edge.ends[1]);
    }
    for (const WallEdge& edge : edges) boundary(walls_.curve(edge.curve).name).edges.push_back(edge.ends);
  }

  // Whether an edge of the outer mesh is one of the tops, between neighbours along them.
  bool is_top(std::uint32_t a, std::uint32_t b) const {
    const std::uint32_t ring = on_top_[a];
    if (ring == no_index || on_top_[b] != ring) return false;
    const std::uint32_t least = std::min(along_top_[a], along_top_[b]),
                        most = std::max(along_top_[a], along_top_[b]);
    return most - least == 1 || (columns_.rings[ring].closed() && least == 0 && most + 1 == on_tops_[ring]);
  }

  void add_boundaries() {
    for (std::size_t curve = 0; curve < walls_.curve_count(); ++curve) boundary(walls_.curve(curve).name);
    std::uint32_t first_column = 0;
    for (const ColumnRing& ring : columns_.rings) {
      add_wall(ring, first_column);
      first_column += static_cast<std::uint32_t>(ring.size());
    }
    for (const FrozenBoundary& outer : outside_.boundaries)
      for (const auto& edge : outer.edges) {
        if (is_top(edge[0], edge[1])) continue;
        boundary(outer.name).edges.push_back({point_of_[edge[0]], point_of_[edge[1]]});
      }
    for (std::size_t l = 0; l < walls_.loops.size(); ++l)
      if (std::any_of(columns_.rings.begin(), columns_.rings.end(),
                      [&](const ColumnRing& ring) { return ring.wall.loop == l && !ring.closed(); }))
        order_edges(l);
  }

  // Puts the edges of a loop with chains into its order, which is that of other loops already.
  void order_edges(std::size_t loop) {
    const std::size_t first = first_curves_[loop], end = first + walls_.loops[loop].curves.size();
    const auto is_on = [&](std::uint32_t p) {
      const std::int32_t curve = mesh_.curve[p];
      return curve >= 0 && static_cast<std::size_t>(curve) >= first && static_cast<std::size_t>(curve) < end;
    };
    struct Next {
      std::size_t boundary;
      std::uint32_t point;
    };
    std::map<std::uint32_t, Next> next;
    for (std::size_t b = 0; b < mesh_.boundaries.size(); ++b)
      std::erase_if(mesh_.boundaries[b].edges, [&](const std::array<std::uint32_t, 2>& edge) {
        if (!is_on(edge[0]) || !is_on(edge[1])) return false;
        next[edge[0]] = {b, edge[1]};
        return true;
      });
    // From where a name begins.
    const auto begin = std::find_if(next.begin(), next.end(), [&](const auto& edge) {
      return next.at(edge.second.point).boundary != edge.second.boundary;
    });
    std::uint32_t at = begin == next.end() ? next.begin()->first : begin->second.point;
    for (std::size_t i = 0; i < next.size(); ++i) {
      const Next to = next.at(at);
      mesh_.boundaries[to.boundary].edges.push_back({at, to.point});
      at = to.point;
    }
  }

  static constexpr std::size_t no_curve = static_cast<std::size_t>(-1);

  const Domain& walls_;
  std::vector<std::size_t> first_curves_;  // per loop
  const LayerColumns& columns_;
  std::uint32_t levels_;
  double first_height_;
  LayerCells cells_;
  FrozenMesh outside_;
  std::vector<RingTops> tops_;
  LayerTopology topology_;
  FrozenMesh mesh_;
  std::vector<std::uint32_t> point_of_;   // per point outside: its number in the view
  std::vector<std::uint32_t> on_top_;     // per point outside: the ring on whose tops it lies
  std::vector<std::uint32_t> along_top_;  // and its place in the order of the points there
  std::vector<std::uint32_t> on_tops_;    // per ring: how many there are
  std::vector<std::vector<std::uint32_t>>
      split_points_;  // per column: points between its top and the next one's
  std::vector<std::uint32_t> triangle_rings_, quad_rings_;  // per cell of the layer
};

}  // namespace

std::uint64_t layer_key(std::uint32_t column, std::uint32_t level, std::uint32_t levels) {
  // Of generations that living meshes, which count from 0, never reach.
  constexpr std::uint32_t layer_generation = 0x80000000U;
  return (std::uint64_t{layer_generation} << 32) + std::uint64_t{column} * (levels + 1) + level;
}

LayerTopology LayeredMesh::topology() const {
  return empty() ? LayerTopology{} : topology_of(*columns_, levels());
}

FrozenMesh LayeredMesh::freeze(LayerCells cells) const {
  if (empty()) return {};
  return LayerView(outer_, walls_, *columns_, levels(), options_.first_height, columns_->ids, cells).take();
}

}  // namespace remodel
