// The gradation error, from the definition: for every vertex the least over all boundary vertices, which a
// tree of boxes finds.

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/box.h"
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
    while (levels_.back().size() > 1) levels_.push_back(joined_in_pairs(levels_.back()));
  }

  // `most`: the value here is at most that. It only saves search.
  double at(Point p, double most = infinity) const {
    double least = most;
    if (!sources_.empty()) search(levels_.size() - 1, 0, p, least);
    return least;
  }
  // What the value at a neighbour says of the one here: values differ by distance / G at most. A little more,
  // so that rounding does not exclude the value itself.
  double bound_from(double value, double distance) const {
    return (value + distance * inverse_gradation_) * (1.0 + 1e-9);
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
    Box box{};
  };
  static constexpr std::size_t run_length = 16;

  static std::vector<Run> joined_in_pairs(const std::vector<Run>& runs) {
    std::vector<Run> pairs;
    for (std::size_t i = 0; i < runs.size(); i += 2) {
      Run pair = runs[i];
      if (i + 1 < runs.size()) {
        const Run& second = runs[i + 1];
        pair.end = second.end;
        pair.least = std::min(pair.least, second.least);
        pair.box.add(second.box);
      }
      pairs.push_back(pair);
    }
    return pairs;
  }

  // No source of the run gives less.
  double bound(const Run& run, Point p) const {
    return run.least + std::sqrt(run.box.squared_distance(p)) * inverse_gradation_;
  }

  void search(std::size_t level, std::size_t index, Point p, double& least) const {
    const Run& run = levels_[level][index];
    if (bound(run, p) >= least) return;
    if (level == 0) {
      for (std::size_t i = run.begin; i < run.end; ++i)
        least = std::min(least, sources_[i].scale +
                                    std::sqrt(squared_distance(sources_[i].point, p)) * inverse_gradation_);
      return;
    }
    const std::vector<Run>& below = levels_[level - 1];
    std::size_t first = 2 * index, second = first + 1;
    if (second == below.size()) return search(level - 1, first, p, least);
    if (bound(below[second], p) < bound(below[first], p)) std::swap(first, second);
    search(level - 1, first, p, least);
    search(level - 1, second, p, least);
  }

  void add(Source source) {
    std::vector<Run>& runs = levels_.front();
    if (sources_.size() % run_length == 0) runs.push_back({.begin = sources_.size(), .end = sources_.size()});
    sources_.push_back(source);
    Run& run = runs.back();
    ++run.end;
    run.least = std::min(run.least, source.scale);
    run.box.add(source.point);
  }

  double inverse_gradation_;
  std::vector<Source> sources_;
  std::vector<std::vector<Run>> levels_{1};  // runs of neighbours; pairs of these; and so on up to one
};

}  // namespace

GradationError Mesh::gradation_error(StepObserver* observer) const {
  constexpr std::uint32_t triangles_between_questions = 10'000;
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const Triangulation& triangulation = data().triangulation;
  const DesignScales design(data());
  std::vector<double> scales(triangulation.vertex_slots(), 0.0);  // 0: not yet asked for
  double sum = 0.0, squares = 0.0, count = 0.0;
  bool cancelled = false;
  const auto scale_of = [&](const Triangle& t, VertexId v) {
    const Point p = triangulation.point(v);
    double most = infinity;
    for (const VertexId u : t.vertex)
      if (const double known = scales[u.index]; known != 0.0)
        most =
            std::min(most, design.bound_from(known, std::sqrt(squared_distance(p, triangulation.point(u)))));
    return design.at(p, most);
  };
  triangulation.for_each_domain_triangle([&](TriangleId id, const Triangle& t) {
    if (cancelled) return;
    if (observer != nullptr && id.index % triangles_between_questions == 0) cancelled = observer->cancelled();
    double mean = 0.0;
    for (const VertexId v : t.vertex) {
      if (scales[v.index] == 0.0) scales[v.index] = scale_of(t, v);
      mean += scales[v.index] / 3.0;
    }
    const double e =
        0.5 * std::log(t.circle.squared_radius()) - std::log(data().options.max_gradation * mean);
    sum += e;
    squares += e * e;
    count += 1.0;
  });
  if (cancelled) return {.bias = none, .deviation = none};
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
