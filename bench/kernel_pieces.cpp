// The triangulation: insert, remove, locate, flip, roll back. All on uniform random points of the unit
// square, inside a far larger triangle, so that none is near the hull. An iteration works on a copy or
// undoes its changes; copying is not timed.

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include <benchmark/benchmark.h>

#include "remodel/predicates.h"
#include "seeded.h"
#include "triangulation/triangulation.h"

namespace remodel::bench {

namespace {

constexpr std::size_t standard = 20'000;  // number of vertices, except in locate

// Uniform random points, sorted by rows of cells in alternating direction: each is near the one before.
std::vector<Point> uniform_points(std::size_t n) {
  Seeded random(2);
  std::vector<Point> points(n);
  for (Point& p : points) p = random.point();
  const double rows = std::ceil(std::sqrt(static_cast<double>(n) / 2.0));
  const auto row = [&](Point p) { return static_cast<int>(p.y * rows); };
  std::sort(points.begin(), points.end(), [&](Point p, Point q) {
    if (row(p) != row(q)) return row(p) < row(q);
    return row(p) % 2 == 0 ? p.x < q.x : p.x > q.x;
  });
  return points;
}

Triangulation empty_triangulation() {
  Triangulation triangulation;
  triangulation.start({-10, -10}, {20, -10}, {-10, 20});
  return triangulation;
}

void insert_all(Triangulation& triangulation, const std::vector<Point>& points) {
  VertexId last{1};
  for (const Point p : points) last = triangulation.insert(p, triangulation.star(last).triangle).vertex;
}

// Made once per size.
const Triangulation& uniform_triangulation(std::size_t n) {
  static std::map<std::size_t, Triangulation> made;
  const auto [place, is_new] = made.try_emplace(n);
  if (is_new) {
    place->second = empty_triangulation();
    insert_all(place->second, uniform_points(n));
  }
  return place->second;
}

TriangleId triangle_at(const Triangulation& triangulation, Point p) {
  return triangulation.locate(p, triangulation.star(VertexId{1}).triangle).triangle;
}

// One iteration inserts 20,000 points, each near the one before, into an empty triangulation. An item is a
// vertex.
void insert(benchmark::State& state) {
  const std::vector<Point> points = uniform_points(standard);
  for (auto _ : state) {
    state.PauseTiming();
    Triangulation triangulation = empty_triangulation();
    triangulation.reserve(2 * standard);
    state.ResumeTiming();
    insert_all(triangulation, points);
    state.PauseTiming();
    triangulation = Triangulation();
    state.ResumeTiming();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(standard));
}
BENCHMARK(insert)->Unit(benchmark::kMillisecond);

// The `size` nearest vertices around each of `patches` places that are far from each other, in the order of
// their ids, which is that of rows.
std::vector<std::vector<VertexId>> patches_of(const Triangulation& triangulation, std::size_t patches,
                                              std::size_t size) {
  std::vector<std::vector<VertexId>> result;
  const auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(patches)));
  for (std::size_t i = 0; i < side * side; ++i) {
    const Point centre{(static_cast<double>(i % side) + 0.5) / static_cast<double>(side),
                       (static_cast<double>(i / side) + 0.5) / static_cast<double>(side)};
    std::vector<VertexId> all;
    for (std::uint32_t v = 4; v < triangulation.vertex_slots(); ++v) all.push_back(VertexId{v});
    const auto nearer = [&](VertexId a, VertexId b) {
      return squared_distance(triangulation.point(a), centre) <
             squared_distance(triangulation.point(b), centre);
    };
    std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(size), all.end(), nearer);
    all.resize(size);
    std::sort(all.begin(), all.end());
    result.push_back(std::move(all));
  }
  return result;
}

constexpr std::size_t removed = 2048;  // per iteration, whatever the size of the patches

template <class Remove>
void remove_patches(benchmark::State& state, Remove remove) {
  const Triangulation& before = uniform_triangulation(standard);
  const auto size = static_cast<std::size_t>(state.range(0));
  const std::vector<std::vector<VertexId>> gone = patches_of(before, removed / size, size);
  for (auto _ : state) {
    state.PauseTiming();
    {
      Triangulation triangulation = before;
      state.ResumeTiming();
      for (const std::vector<VertexId>& patch : gone) remove(triangulation, patch);
      state.PauseTiming();
    }
    state.ResumeTiming();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(removed));
}

// One iteration removes 2,048 vertices in patches of the given size, with one call per patch. An item is a
// vertex.
void remove_patch(benchmark::State& state) {
  remove_patches(state, [](Triangulation& triangulation, const std::vector<VertexId>& patch) {
    triangulation.remove(patch);
  });
}
BENCHMARK(remove_patch)->Arg(8)->Arg(32)->Arg(128)->Arg(512)->Unit(benchmark::kMicrosecond);

// The same vertices with one call each. An item is a vertex.
void remove_one_by_one(benchmark::State& state) {
  remove_patches(state, [](Triangulation& triangulation, const std::vector<VertexId>& patch) {
    for (const VertexId v : patch) triangulation.remove(v);
  });
}
BENCHMARK(remove_one_by_one)->Arg(8)->Arg(32)->Arg(128)->Arg(512)->Unit(benchmark::kMicrosecond);

// One iteration removes every tenth of 20,000 vertices, with one call each. An item is a vertex.
void remove_apart(benchmark::State& state) {
  const Triangulation& before = uniform_triangulation(standard);
  std::vector<VertexId> gone;
  for (std::uint32_t v = 4; v < before.vertex_slots(); v += 10) gone.push_back(VertexId{v});
  for (auto _ : state) {
    state.PauseTiming();
    {
      Triangulation triangulation = before;
      state.ResumeTiming();
      for (const VertexId v : gone) triangulation.remove(v);
      state.PauseTiming();
    }
    state.ResumeTiming();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(gone.size()));
}
BENCHMARK(remove_apart)->Unit(benchmark::kMicrosecond);

// ---- locate. One iteration finds the triangle of one point, which is an item.

struct Search {
  Point p;
  TriangleId hint;
};

// hint_of: the point whose triangle is the hint.
template <class HintOf>
void locate(benchmark::State& state, HintOf hint_of) {
  constexpr std::size_t count = 1024;
  const Triangulation& triangulation = uniform_triangulation(static_cast<std::size_t>(state.range(0)));
  Seeded random(3);
  std::vector<Search> searches;
  for (std::size_t i = 0; i < count; ++i) {
    const Point p = random.point();
    searches.push_back({p, triangle_at(triangulation, hint_of(p, random))});
  }
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(triangulation.locate(searches[i].p, searches[i].hint));
    i = (i + 1) % count;
  }
  state.SetItemsProcessed(state.iterations());
}

// The hint is one mean vertex distance away.
void locate_near(benchmark::State& state) {
  const double spacing = 1.0 / std::sqrt(static_cast<double>(state.range(0)));
  locate(state, [&](Point p, Seeded& random) {
    return random.coin() ? p + Point{spacing, 0.0} : p + Point{0.0, spacing};
  });
}
BENCHMARK(locate_near)->Arg(2'000)->Arg(20'000)->Arg(200'000);

// The hint is at another random point.
void locate_far(benchmark::State& state) {
  locate(state, [](Point, Seeded& random) { return random.point(); });
}
BENCHMARK(locate_far)->Arg(2'000)->Arg(20'000)->Arg(200'000);

// ---- flip

struct Bar {
  VertexId a, b;
};

// The number of edges that cross the open segment. No three of the points are collinear.
std::size_t crossed_edges(const Triangulation& triangulation, Bar bar) {
  const Point a = triangulation.point(bar.a), b = triangulation.point(bar.b);
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < triangulation.triangle_slots(); ++i) {
    const Triangle& t = triangulation[TriangleId{i}];
    if (!t.alive() || t.ghost()) continue;
    for (int k = 0; k < 3; ++k) {
      const VertexId u = t.vertex[next3(k)], v = t.vertex[previous3(k)];
      if (!(u < v)) continue;  // each edge from one of its sides
      const Point p = triangulation.point(u), q = triangulation.point(v);
      if (orient2d(a, b, p) * orient2d(a, b, q) < 0 && orient2d(p, q, a) * orient2d(p, q, b) < 0) ++count;
    }
  }
  return count;
}

// One iteration constrains 32 segments, which flips the edges that cross them, and releases them, which flips
// them back. An item is an edge that crosses a segment: at least two flips, each with its tests.
void flip(benchmark::State& state) {
  constexpr std::size_t bars = 32;
  Triangulation triangulation = uniform_triangulation(standard);
  Seeded random(4);
  std::vector<Bar> segments;
  std::size_t crossed = 0;
  while (segments.size() < bars) {
    const Point p{random.number(0.1, 0.9), random.number(0.1, 0.9)};
    const auto vertex_at = [&](Point q) { return triangulation[triangle_at(triangulation, q)].vertex[0]; };
    const Bar bar{vertex_at(p), vertex_at(p + Point{0.05, 0.02})};
    segments.push_back(bar);
    crossed += crossed_edges(triangulation, bar);
  }
  for (auto _ : state)
    for (const auto& [a, b] : segments) {
      if (triangulation.constrain(a, b).kind != ConstrainResult::Kind::done)
        return state.SkipWithError("a segment runs through a vertex");
      triangulation.release(a, b);
    }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(crossed));
}
BENCHMARK(flip)->Unit(benchmark::kMicrosecond);

// One iteration looks for edges to flip where there are none, around all triangles of 20,000 vertices. An
// item is a triangle.
void flip_none(benchmark::State& state) {
  Triangulation triangulation = uniform_triangulation(standard);
  std::vector<TriangleId> all;
  for (std::uint32_t i = 0; i < triangulation.triangle_slots(); ++i)
    if (triangulation[TriangleId{i}].alive() && !triangulation[TriangleId{i}].ghost())
      all.push_back(TriangleId{i});
  for (auto _ : state) triangulation.restore_delaunay(all);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(all.size()));
}
BENCHMARK(flip_none)->Unit(benchmark::kMillisecond);

// ---- rollback

// One iteration rolls back the removal of the given number of adjacent vertices. An item is a triangle that
// their removal had changed.
void rollback(benchmark::State& state) {
  Triangulation triangulation = uniform_triangulation(standard);
  const std::vector<VertexId> gone =
      patches_of(triangulation, 1, static_cast<std::size_t>(state.range(0))).front();
  std::size_t touched = 0;
  for (auto _ : state) {
    state.PauseTiming();
    triangulation.begin();
    triangulation.remove(gone);
    touched += triangulation.touched().size();
    state.ResumeTiming();
    triangulation.rollback();
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(touched));
}
BENCHMARK(rollback)->Arg(512)->Arg(4096);

}  // namespace

}  // namespace remodel::bench
