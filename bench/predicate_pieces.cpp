// The predicates by the stage that decides. One iteration is one call and one item. The calls cycle through
// 4,096 sets of points, more than a branch predictor learns.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "remodel/predicates.h"
#include "seeded.h"

namespace remodel::bench {

namespace {

constexpr std::size_t sets = 4096;
using Points = std::array<Point, 4>;

template <class Make>
std::vector<Points> made(Make make) {
  Seeded random(1);
  std::vector<Points> result;
  for (std::size_t i = 0; i < sets; ++i) result.push_back(make(random));
  return result;
}

template <class Call>
void each_call(benchmark::State& state, const std::vector<Points>& data, Call call) {
  std::size_t i = 0;
  for (auto _ : state) {
    const auto& [a, b, c, d] = data[i];
    benchmark::DoNotOptimize(call(a, b, c, d));
    i = (i + 1) % sets;
  }
  state.SetItemsProcessed(state.iterations());
}

int orient_call(Point a, Point b, Point c, Point) {
  return orient2d(a, b, c);
}

// Triangles of random points, half of them clockwise.
Points triangle(Seeded& random) {
  return {random.point(), random.point(), random.point()};
}

// Three points of the diagonal, the last one beside it by one unit in the last place and so far from the
// others that the filter cannot decide. All differences are exact: their products decide. With a coordinate
// of 2^-40 they are not, and expansions decide.
Points near_diagonal(Seeded& random, double last_scale) {
  double a = random.number(0.5, 0.5625), b = random.number(0.5625, 0.625);
  const double c = last_scale * random.number(0.9375, 1.0);
  if (random.coin()) std::swap(a, b);
  return {Point{a, a}, Point{b, b}, Point{c, std::nextafter(c, 1.0)}};
}

// Four corners of a rectangle, counter-clockwise from any of them: exactly on a circle. Of one binade, so
// that the differences are short; with x0 of 2^-40 those on x take more bits than the integer stage has, and
// expansions decide.
Points rectangle(Seeded& random, double x0_scale) {
  const double x0 = x0_scale * random.number(0.5, 0.625), x1 = random.number(0.875, 1.0);
  const double y0 = random.number(0.5, 0.625), y1 = random.number(0.875, 1.0);
  Points points{Point{x0, y0}, Point{x1, y0}, Point{x1, y1}, Point{x0, y1}};
  std::rotate(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(random.index(4)), points.end());
  return points;
}

// The same with one corner off by one unit in the last place.
Points near_rectangle(Seeded& random, double x0_scale) {
  Points points = rectangle(random, x0_scale);
  points[3].x = std::nextafter(points[3].x, random.coin() ? 1.0 : 0.0);
  return points;
}

// Four random points, the first three counter-clockwise.
Points quadruple(Seeded& random) {
  Points points{random.point(), random.point(), random.point(), random.point()};
  if (orient2d(points[0], points[1], points[2]) < 0) std::swap(points[0], points[1]);
  return points;
}

constexpr double same_binade = 1.0, far_below = 0x1p-40;

void orient2d_filtered(benchmark::State& state) {
  each_call(state, made(triangle), orient_call);
}
BENCHMARK(orient2d_filtered);

void orient2d_exact_products(benchmark::State& state) {
  each_call(state, made([](Seeded& random) { return near_diagonal(random, same_binade); }), orient_call);
}
BENCHMARK(orient2d_exact_products);

void orient2d_exact_expansions(benchmark::State& state) {
  each_call(state, made([](Seeded& random) { return near_diagonal(random, far_below); }), orient_call);
}
BENCHMARK(orient2d_exact_expansions);

void incircle_filtered(benchmark::State& state) {
  each_call(state, made(quadruple), incircle);
}
BENCHMARK(incircle_filtered);

void incircle_exact_integers(benchmark::State& state) {
  each_call(state, made([](Seeded& random) { return near_rectangle(random, same_binade); }), incircle);
}
BENCHMARK(incircle_exact_integers);

void incircle_exact_expansions(benchmark::State& state) {
  each_call(state, made([](Seeded& random) { return near_rectangle(random, far_below); }), incircle);
}
BENCHMARK(incircle_exact_expansions);

void incircle_sos_tie_integers(benchmark::State& state) {
  each_call(state, made([](Seeded& random) { return rectangle(random, same_binade); }), incircle_sos);
}
BENCHMARK(incircle_sos_tie_integers);

void incircle_sos_tie_expansions(benchmark::State& state) {
  each_call(state, made([](Seeded& random) { return rectangle(random, far_below); }), incircle_sos);
}
BENCHMARK(incircle_sos_tie_expansions);

}  // namespace

}  // namespace remodel::bench
