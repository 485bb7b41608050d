// The general method where a boundary of n segments goes, comes, or both: how its time grows with n.

#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "remodel/generate.h"
#include "remodel/remodel.h"
#include "seeded.h"

namespace remodel::bench {

namespace {

// Triangles of any shape, and no more than the boundary asks for: the boundary is what is measured.
constexpr QualityOptions options{.min_angle_deg = 20.0, .max_gradation = 2.0, .gradation = 1.0};

Loop ring(LoopRole role, std::string name, std::vector<Point> points) {
  const std::size_t pieces = points.size();
  points.push_back(points.front());
  return {role, {{std::move(name), Polyline{std::move(points)}, Parameters::uniform(pieces)}}};
}

// A square around a shore of n segments, ragged by a fraction of a segment's length; of 4 alone, without.
Domain lake(std::size_t segments, double radius) {
  Domain domain{{ring(LoopRole::outer, "outer", {{-2, -2}, {2, -2}, {2, 2}, {-2, 2}})}};
  if (segments == 0) return domain;
  Seeded random(7);
  std::vector<Point> shore;
  const double turn = 2.0 * std::numbers::pi / static_cast<double>(segments);
  for (std::size_t i = 0; i < segments; ++i) {
    const double r = radius * (1.0 + 0.3 * turn * random.number(-1.0, 1.0));
    shore.push_back(
        {r * std::cos(turn * static_cast<double>(i)), r * std::sin(turn * static_cast<double>(i))});
  }
  domain.loops.push_back(ring(LoopRole::hole, "shore", std::move(shore)));
  return domain;
}

const Mesh& mesh_of_lake(std::size_t segments) {
  static std::map<std::size_t, Mesh> made;
  const auto [place, is_new] = made.try_emplace(segments);
  if (is_new) place->second = generate(lake(segments, 1.0), options).mesh;
  return place->second;
}

// An iteration takes a mesh of n segments to another domain by the general method.
void update(benchmark::State& state, const Domain& next) {
  const auto segments = static_cast<std::size_t>(state.range(0));
  const Mesh& start = mesh_of_lake(segments);
  for (auto _ : state) {
    state.PauseTiming();
    Mesh mesh = start;
    state.ResumeTiming();
    remodel(mesh, next, {.method = Method::general});
    benchmark::DoNotOptimize(mesh.triangle_count());
  }
  state.SetComplexityN(state.range(0));
}

// The shore goes: what is left has a few triangles.
void shore_vanishes(benchmark::State& state) {
  update(state, lake(0, 1.0));
}
BENCHMARK(shore_vanishes)
    ->RangeMultiplier(10)
    ->Range(1000, 100000)
    ->Unit(benchmark::kMillisecond)
    ->Complexity();

// The shore is half as far from the centre: every region of removal reaches over the half of the domain.
void shore_recedes(benchmark::State& state) {
  update(state, lake(static_cast<std::size_t>(state.range(0)), 0.5));
}
BENCHMARK(shore_recedes)
    ->RangeMultiplier(10)
    ->Range(1000, 100000)
    ->Unit(benchmark::kMillisecond)
    ->Complexity();

// The shore has as many segments, elsewhere by a hundredth of a segment.
void shore_is_redrawn(benchmark::State& state) {
  const double n = static_cast<double>(state.range(0));
  update(state, lake(static_cast<std::size_t>(state.range(0)), 1.0 + 0.06 / n));
}
BENCHMARK(shore_is_redrawn)
    ->RangeMultiplier(10)
    ->Range(1000, 100000)
    ->Unit(benchmark::kMillisecond)
    ->Complexity();

}  // namespace

}  // namespace remodel::bench
