#include "remodel/transfer.h"

#include <algorithm>
#include <string>

#include "remodel/error.h"
#include "transfer/halves.h"
#include "transfer/moment.h"
#include "transfer/remap.h"
#include "transfer/slopes.h"

namespace remodel {

struct Transfer::Impl {
  Impl(const Moment& moment, const TransferOptions& given)
      : patches(patches_since(moment)),
        options(given),
        locator(patches.before, patches.changed),
        vertices(vertex_map_since(moment, given.outside)) {}
  Impl(const FrozenMesh& before, const FrozenMesh& after, const TransferOptions& given)
      : halves_before(before, "mesh before"),
        halves_after(after, "mesh after"),
        patches(patches_between(halves_before.any() ? halves_before.take() : before,
                                halves_after.any() ? halves_after.take() : after)),
        options(given),
        locator(patches.before, patches.changed) {
    make_vertex_map();
  }

  void make_vertex_map();
  ValueMap triangle_map() const;
  bool has_quads() const { return halves_before.any() || halves_after.any(); }

  Halves halves_before, halves_after;
  Patches patches;
  TransferOptions options;
  Locator locator;
  ValueMap vertices;
};

namespace {

struct MapRow {
  std::uint32_t to;
  std::vector<ValueMap::Part> parts;
};

void close_rows(std::vector<MapRow>& rows, ValueMap& map) {
  std::sort(rows.begin(), rows.end(), [](const MapRow& a, const MapRow& b) { return a.to < b.to; });
  map.starts.push_back(0);
  for (const MapRow& row : rows) {
    map.rows.push_back(row.to);
    map.parts.insert(map.parts.end(), row.parts.begin(), row.parts.end());
    map.starts.push_back(static_cast<std::uint32_t>(map.parts.size()));
  }
}

MapRow slope_row(const Patches& patches, const Neighbours& neighbours, const Place& place, Point at,
                 std::uint32_t to) {
  const PatchSide& side = patches.before;
  const std::vector<std::uint32_t>& around = neighbours.around(place.triangle);
  const std::vector<Point> weights = slope_weights(side, place.triangle, around);
  const Point from_centroid = at - centroid_of(side.corners(place.triangle));
  MapRow row{to, {{side.triangles[place.triangle].number, 1.0}}};
  for (std::size_t i = 0; i < around.size(); ++i) {
    const double weight = dot(weights[i], from_centroid);
    row.parts[0].weight -= weight;
    row.parts.push_back({side.triangles[around[i]].number, weight});
  }
  return row;
}

// The point that a place stands for.
Point point_of(const Patches& patches, const Place& place) {
  const Corners corners = patches.before.corners(place.triangle);
  return place.weights[0] * corners[0] + place.weights[1] * corners[1] + place.weights[2] * corners[2];
}

}  // namespace

void Transfer::Impl::make_vertex_map() {
  vertices.size_before = patches.vertices_before, vertices.size_after = patches.vertices_after;
  vertices.same = patches.same_vertices, vertices.gone = patches.gone_vertices;
  vertices.starts.push_back(0);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> made;  // by number
  for (std::uint32_t v = 0; v < patches.after.points.size(); ++v)
    if (patches.same_vertex[v] == no_index) made.emplace_back(patches.after.numbers[v], v);
  std::sort(made.begin(), made.end());
  for (const auto& [number, v] : made) {
    const Place place = locator.locate(patches.after.points[v], options.outside);
    std::array<std::uint32_t, 3> from;
    for (std::size_t k = 0; k < 3; ++k)
      from[k] = patches.before.numbers[patches.before.triangles[place.triangle].corners[k]];
    vertices.add_row(number, from, place.weights, place.distance);
  }
}

ValueMap Transfer::Impl::triangle_map() const {
  ValueMap map;
  map.size_before = patches.triangles_before, map.size_after = patches.triangles_after;
  map.same = patches.same_triangles, map.gone = patches.gone_triangles;
  std::vector<MapRow> rows;
  for (const auto& [from, to] : patches.renumbered) rows.push_back({to, {{from, 1.0}}});
  const Neighbours neighbours(patches.before);
  for (std::uint32_t t = 0; t < patches.after.triangles.size(); ++t) {
    const std::uint32_t to = patches.after.triangles[t].number;
    if (const std::uint32_t old = patches.same_triangle[t]; old != no_index) {
      const std::uint32_t from = patches.before.triangles[old].number;
      if (from != to && map.same.empty()) rows.push_back({to, {{from, 1.0}}});
      continue;
    }
    const Place place = locator.locate(centroid_of(patches.after.corners(t)), options.outside);
    rows.push_back(slope_row(patches, neighbours, place, point_of(patches, place), to));
  }
  close_rows(rows, map);
  return map;
}

Transfer::Transfer(const Mesh& mesh, const Mark& mark, const TransferOptions& options)
    : impl_(std::make_unique<Impl>(Moment(mesh, mark), options)) {}
Transfer::Transfer(const FrozenMesh& before, const FrozenMesh& after, const TransferOptions& options)
    : impl_(std::make_unique<Impl>(before, after, options)) {}
Transfer::~Transfer() = default;
Transfer::Transfer(Transfer&&) noexcept = default;
Transfer& Transfer::operator=(Transfer&&) noexcept = default;

const ValueMap& Transfer::vertices() const {
  return impl_->vertices;
}
ValueMap Transfer::triangles() const {
  const ValueMap map = impl_->triangle_map();
  return impl_->has_quads() ? map_of_cells(map, impl_->halves_before, impl_->halves_after) : map;
}
std::size_t Transfer::outside() const {
  return impl_->vertices.outside;
}
double Transfer::farthest_outside() const {
  return impl_->vertices.farthest_outside;
}

void Transfer::ride(FieldPlace place, int components, std::vector<double>& values) const {
  if (place == FieldPlace::vertices)
    vertices().apply(values, components);
  else
    triangles().apply(values, components);
}

Balance Transfer::remap(FieldPlace place, int components, std::vector<double>& values,
                        const RemapOptions& options) const {
  if (options.conserved)
    for (const int k : *options.conserved)
      if (k < 0 || k >= components)
        throw Error(
            ErrorCode::argument, "conserved",
            "found component " + std::to_string(k) + ", expected 0 to " + std::to_string(components - 1));
  const RemapInput input{impl_->patches, impl_->locator, impl_->options.outside, options};
  if (place == FieldPlace::vertices) return remap_vertices(input, vertices(), components, values);
  values = impl_->halves_before.to_triangles(values, components);
  const Balance balance = remap_triangles(input, impl_->triangle_map(), components, values);
  values = impl_->halves_after.to_cells(values, components);
  return balance;
}

std::vector<double> integral(const Field& field, const FrozenMesh& mesh) {
  require_fit(field, mesh);
  if (Halves halves(mesh, "mesh"); halves.any()) {
    Field on_halves = field;
    if (field.place == FieldPlace::triangles)
      on_halves.values = halves.to_triangles(field.values, field.components);
    return integral(on_halves, halves.take());
  }
  const auto width = static_cast<std::size_t>(field.components);
  std::vector<double> result(width, 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const double area = area_of({mesh.points[a], mesh.points[b], mesh.points[c]});
    for (std::size_t k = 0; k < width; ++k) {
      const auto value = [&](std::size_t i) { return field.values[i * width + k]; };
      result[k] +=
          area * (field.place == FieldPlace::triangles ? value(t) : (value(a) + value(b) + value(c)) / 3.0);
    }
  }
  return result;
}

}  // namespace remodel
