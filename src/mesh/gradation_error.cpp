// The gradation error, from the definition: a search over all boundary vertices for every vertex, but for
// runs of them that are too far away.

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/mesh_data.h"

namespace remodel {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

class DesignScales {
 public:
  explicit DesignScales(const MeshData& mesh) : inverse_gradation_(1.0 / mesh.options.gradation) {
    for (const std::uint32_t head : mesh.loop_heads)
      mesh.walk(head, [&](std::uint32_t k) {
        if (!mesh.at(k).steiner) add({mesh.point(k), mesh.base_length_scale(k) * mesh.at(k).scale_factor});
      });
  }

  double at(Point p) const {
    double least = infinity;
    for (const Run& run : runs_) {
      if (run.least + std::sqrt(run.squared_distance_to(p)) * inverse_gradation_ >= least) continue;
      for (std::size_t i = run.begin; i < run.end; ++i)
        least = std::min(least, sources_[i].scale +
                                    std::sqrt(squared_distance(sources_[i].point, p)) * inverse_gradation_);
    }
    return least;
  }

 private:
  struct Source {
    Point point;
    double scale;
  };
  // Neighbours on the boundary, in a box.
  struct Run {
    std::size_t begin, end;
    double least = infinity;
    Point low{infinity, infinity}, high{-infinity, -infinity};
    double squared_distance_to(Point p) const {
      const double dx = std::max({low.x - p.x, 0.0, p.x - high.x}),
                   dy = std::max({low.y - p.y, 0.0, p.y - high.y});
      return dx * dx + dy * dy;
    }
  };
  static constexpr std::size_t run_length = 16;

  void add(Source source) {
    if (sources_.size() % run_length == 0)
      runs_.push_back({.begin = sources_.size(), .end = sources_.size()});
    sources_.push_back(source);
    Run& run = runs_.back();
    ++run.end;
    run.least = std::min(run.least, source.scale);
    run.low = {std::min(run.low.x, source.point.x), std::min(run.low.y, source.point.y)};
    run.high = {std::max(run.high.x, source.point.x), std::max(run.high.y, source.point.y)};
  }

  double inverse_gradation_;
  std::vector<Source> sources_;
  std::vector<Run> runs_;
};

}  // namespace

GradationError Mesh::gradation_error() const {
  const Triangulation& triangulation = data().triangulation;
  const DesignScales design(data());
  std::vector<double> scales(triangulation.vertex_slots(), 0.0);  // 0: not yet asked for
  double sum = 0.0, squares = 0.0, count = 0.0;
  triangulation.for_each_domain_triangle([&](TriangleId, const Triangle& t) {
    double mean = 0.0;
    for (const VertexId v : t.vertex) {
      if (scales[v.index] == 0.0) scales[v.index] = design.at(triangulation.point(v));
      mean += scales[v.index] / 3.0;
    }
    const double e =
        0.5 * std::log(t.circle.squared_radius()) - std::log(data().options.max_gradation * mean);
    sum += e;
    squares += e * e;
    count += 1.0;
  });
  if (count == 0.0) return {};
  const double bias = sum / count;
  return {.bias = bias, .deviation = std::sqrt(std::max(0.0, squares / count - bias * bias))};
}

std::vector<double> Mesh::gradation_errors(const FrozenMesh& frozen) const {
  const DesignScales design(data());
  std::vector<double> scales, errors;
  scales.reserve(frozen.points.size());
  for (const Point p : frozen.points) scales.push_back(design.at(p));
  errors.reserve(frozen.triangles.size());
  for (const auto& [a, b, c] : frozen.triangles) {
    const Point p = frozen.points[a], q = frozen.points[b], s = frozen.points[c];
    const double sides = squared_distance(p, q) * squared_distance(q, s) * squared_distance(s, p);
    const double radius = std::sqrt(sides) / (2.0 * cross(q - p, s - p));
    const double mean = (scales[a] + scales[b] + scales[c]) / 3.0;
    errors.push_back(std::log(radius / (data().options.max_gradation * mean)));
  }
  return errors;
}

}  // namespace remodel
