// The predicates against arbitrary-precision integers, on families of near-degenerate points. Every finite
// double is an integer times a power of two, so that the oracle scales all coordinates of a case by a common
// power of two and needs no rationals.

#include "remodel/predicates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "support.h"

namespace remodel {
namespace {

namespace mp = boost::multiprecision;
using Wide = mp::number<mp::cpp_int_backend<512, 512, mp::signed_magnitude, mp::unchecked, void>>;
using Unbounded = mp::cpp_int;
using Quad = std::array<Point, 4>;
using Random = std::mt19937_64;

// ---- Oracle ----

template <class Integer>
struct ExactPoint {
  Integer x, y;
};

int lowest_exponent(double v) {
  return v == 0.0 ? 2000 : std::ilogb(v) - 52;
}

// 2^-exponent v, an integer.
template <class Integer>
Integer scaled(double v, int exponent) {
  if (v == 0.0) return Integer(0);
  const int own = lowest_exponent(v);
  return Integer(static_cast<std::int64_t>(std::ldexp(v, -own))) << static_cast<unsigned>(own - exponent);
}

template <class Integer>
std::array<ExactPoint<Integer>, 4> exact_points(const Quad& q, int exponent) {
  std::array<ExactPoint<Integer>, 4> result;
  for (std::size_t i = 0; i < 4; ++i)
    result[i] = {scaled<Integer>(q[i].x, exponent), scaled<Integer>(q[i].y, exponent)};
  return result;
}

struct Truth {
  int orient = 0;  // of the first three points
  int incircle = 0;
};

template <class Integer>
Truth truth_in(const Quad& q, int exponent) {
  const auto [a, b, c, d] = exact_points<Integer>(q, exponent);
  const Integer ax = a.x - d.x, ay = a.y - d.y, bx = b.x - d.x, by = b.y - d.y, cx = c.x - d.x,
                cy = c.y - d.y;
  const Integer bc = bx * cy - cx * by, ca = cx * ay - ax * cy, ab = ax * by - bx * ay;
  const Integer area = bc + ca + ab;
  const Integer circle = (ax * ax + ay * ay) * bc + (bx * bx + by * by) * ca + (cx * cx + cy * cy) * ab;
  return {area.sign(), circle.sign()};
}

Truth truth(const Quad& q) {
  int lowest = 2000;
  int highest = -2000;
  for (const Point p : q) {
    for (const double v : {p.x, p.y}) {
      lowest = std::min(lowest, lowest_exponent(v));
      if (v != 0.0) highest = std::max(highest, std::ilogb(v));
    }
  }
  // Differences have two bits more than the widest coordinate, the determinant four times as many and two.
  const bool fits = 4 * (highest - lowest + 3) + 2 <= 512;
  return fits ? truth_in<Wide>(q, lowest) : truth_in<Unbounded>(q, lowest);
}

// The determinant of the rows (x, y, lift, 1) by Laplace's rule.
Unbounded determinant(const std::array<std::array<Unbounded, 4>, 4>& m) {
  std::array<int, 4> order{0, 1, 2, 3};
  Unbounded sum = 0;
  do {
    int inversions = 0;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j) inversions += order[i] > order[j];
    Unbounded term = inversions % 2 == 0 ? 1 : -1;
    for (std::size_t i = 0; i < 4; ++i) term *= m[i][static_cast<std::size_t>(order[i])];
    sum += term;
  } while (std::next_permutation(order.begin(), order.end()));
  return sum;
}

// The sign after lifting the lexicographically largest point, for four cocircular points: the determinant is
// linear in each lift and zero without it, so that any positive amount shows the sign.
int lifted_truth(const Quad& q) {
  int lowest = 2000;
  for (const Point p : q) lowest = std::min({lowest, lowest_exponent(p.x), lowest_exponent(p.y)});
  const auto points = exact_points<Unbounded>(q, lowest);
  std::array<std::array<Unbounded, 4>, 4> rows;
  std::size_t largest = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    rows[i] = {points[i].x, points[i].y, points[i].x * points[i].x + points[i].y * points[i].y, 1};
    const auto& [x, y] = points[i];
    if (x > points[largest].x || (x == points[largest].x && y > points[largest].y)) largest = i;
  }
  rows[largest][2] += 1;
  return determinant(rows).sign();
}

// ---- Generators ----

constexpr double full_turn = 2 * std::numbers::pi;

using test::uniform;
int integer(Random& random, int low, int high) {
  return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
}
double nudged(Random& random, double v, int ulps) {
  const int steps = integer(random, -ulps, ulps);
  for (int i = 0; i < std::abs(steps); ++i) v = std::nextafter(v, steps > 0 ? 1e300 : -1e300);
  return v;
}
Point nudged(Random& random, Point p, int ulps) {
  return {nudged(random, p.x, ulps), nudged(random, p.y, ulps)};
}

Quad mapped(Quad q, const std::function<Point(Point)>& f) {
  std::transform(q.begin(), q.end(), q.begin(), f);
  return q;
}

Quad in_a_box(Random& random) {
  return mapped({}, [&](Point) { return Point{uniform(random, -1, 1), uniform(random, -1, 1)}; });
}

Quad on_a_small_grid(Random& random) {
  return mapped({}, [&](Point) {
    return Point{static_cast<double>(integer(random, 0, 7)), static_cast<double>(integer(random, 0, 7))};
  });
}

Quad nearly_collinear(Random& random) {
  const Quad ends = in_a_box(random);
  return mapped({}, [&](Point) {
    const double t = uniform(random, -2, 3);
    return nudged(random, ends[0] + t * (ends[1] - ends[0]), 2);
  });
}

Quad exactly_collinear(Random& random) {
  const Point start{static_cast<double>(integer(random, -1000, 1000)),
                    static_cast<double>(integer(random, -1000, 1000))};
  const Point step{static_cast<double>(integer(random, -99, 99)),
                   static_cast<double>(integer(random, -99, 99))};
  const double unit = std::ldexp(1.0, integer(random, -40, 10));
  return mapped({}, [&](Point) { return unit * (start + integer(random, -500, 500) * step); });
}

// Integer points on the circle of radius 5 * 13 * 17 * 29 = 32045 about the origin: 324 of them.
const std::vector<Point>& lattice_circle() {
  static const std::vector<Point> points = [] {
    constexpr std::int64_t radius = 32045;
    std::vector<Point> found;
    for (std::int64_t x = -radius; x <= radius; ++x) {
      const auto y =
          static_cast<std::int64_t>(std::llround(std::sqrt(static_cast<double>(radius * radius - x * x))));
      if (x * x + y * y != radius * radius) continue;
      found.push_back({static_cast<double>(x), static_cast<double>(y)});
      if (y != 0) found.push_back({static_cast<double>(x), static_cast<double>(-y)});
    }
    return found;
  }();
  return points;
}

// Four distinct integer points of one circle, in random order, moved and scaled exactly.
Quad exactly_cocircular(Random& random) {
  const auto& circle = lattice_circle();
  Quad q;
  for (std::size_t i = 0; i < 4;) {
    q[i] = circle[random() % circle.size()];
    if (std::find(q.begin(), q.begin() + static_cast<long>(i), q[i]) == q.begin() + static_cast<long>(i)) ++i;
  }
  const Point centre{static_cast<double>(integer(random, -1000000, 1000000)),
                     static_cast<double>(integer(random, -1000000, 1000000))};
  const double unit = std::ldexp(1.0, integer(random, -40, 40));
  return mapped(q, [&](Point p) { return unit * (centre + p); });
}

Quad one_ulp_off_an_exact_circle(Random& random) {
  Quad q = exactly_cocircular(random);
  Point& moved = q[random() % 4];
  moved = nudged(random, moved, 1);
  return q;
}

// Corners of a rectangle or of a trapezium with its axis on y = 0, as in the hole of a symmetric airfoil.
Quad symmetric(Random& random) {
  const Point p{uniform(random, 0, 1), uniform(random, 1e-4, 0.06)};
  const bool rectangle = random() % 2 == 0;
  const double x = p.x + uniform(random, 1e-5, 1e-2);
  const Point q{x, rectangle ? p.y : uniform(random, 1e-4, 0.06)};
  Quad result{p, q, Point{p.x, -p.y}, Point{q.x, -q.y}};
  std::shuffle(result.begin(), result.end(), random);
  return result;
}

Quad nearly_cocircular(Random& random) {
  const Point centre{uniform(random, -1, 1), uniform(random, -1, 1)};
  const double radius = std::exp(uniform(random, -10, 3));
  return mapped({}, [&](Point) {
    const double angle = uniform(random, 0, full_turn);
    return nudged(random, centre + radius * Point{std::cos(angle), std::sin(angle)}, 1);
  });
}

// Shapes of any size, some of only a few ulps of the offset.
Quad far_from_the_origin(Random& random) {
  const Quad local = random() % 2 == 0 ? nearly_cocircular(random) : on_a_small_grid(random);
  const Point offset{uniform(random, 1e6, 1e9), uniform(random, -1e9, -1e6)};
  const double size = std::ldexp(1.0, integer(random, -24, 10));
  return mapped(local, [&](Point p) { return offset + size * p; });
}

Quad tiny(Random& random) {
  const Quad q = random() % 2 == 0 ? nearly_cocircular(random) : exactly_cocircular(random);
  return mapped(q, [](Point p) { return 0x1p-150 * p; });
}

Quad huge(Random& random) {
  const Quad q = random() % 2 == 0 ? nearly_cocircular(random) : exactly_cocircular(random);
  return mapped(q, [](Point p) { return 0x1p150 * p; });
}

// A trailing-edge segment of 1e-5 chords seen from the farfield circle.
Quad farfield_and_trailing_edge(Random& random) {
  const auto far = [&] {
    const double angle = full_turn * integer(random, 0, 49) / 50;
    return Point{0.5 + 25 * std::cos(angle), 25 * std::sin(angle)};
  };
  const auto near = [&] { return Point{1.0 - uniform(random, 0, 1e-5), uniform(random, -1e-5, 1e-5)}; };
  Quad q = mapped({}, [&](Point) { return random() % 2 == 0 ? far() : near(); });
  if (random() % 2 == 0) q[0] = {q[1].x, -q[1].y};
  return q;
}

// Coordinates whose exponents lie far apart: nothing but expansions can decide these.
Quad mixed_magnitudes(Random& random) {
  const auto coordinate = [&] { return std::ldexp(uniform(random, -1, 1), integer(random, -60, 60)); };
  Quad q = mapped({}, [&](Point) { return Point{coordinate(), coordinate()}; });
  if (random() % 2 == 0) q[2] = {q[0].x, -q[0].y}, q[3] = {q[1].x, -q[1].y};
  return q;
}

struct Family {
  const char* name;
  Quad (*make)(Random&);
  int cases;
};
const std::array<Family, 13> families{{{"in a box", in_a_box, 300000},
                                       {"on a small grid", on_a_small_grid, 300000},
                                       {"nearly collinear", nearly_collinear, 300000},
                                       {"exactly collinear", exactly_collinear, 300000},
                                       {"exactly cocircular", exactly_cocircular, 300000},
                                       {"one ulp off an exact circle", one_ulp_off_an_exact_circle, 300000},
                                       {"symmetric", symmetric, 300000},
                                       {"nearly cocircular", nearly_cocircular, 300000},
                                       {"far from the origin", far_from_the_origin, 300000},
                                       {"tiny", tiny, 200000},
                                       {"huge", huge, 200000},
                                       {"farfield and trailing edge", farfield_and_trailing_edge, 300000},
                                       {"mixed magnitudes", mixed_magnitudes, 100000}}};

// ---- Reporting ----

std::string described(const Quad& q) {
  std::string text;
  for (const Point p : q) {
    std::array<char, 80> buffer;
    std::snprintf(buffer.data(), buffer.size(), "(%a, %a) ", p.x, p.y);
    text += buffer.data();
  }
  return text;
}

double percent(unsigned long long part, unsigned long long all) {
  return all == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(all);
}

void print_shares(const char* name, const PredicateStatistics& before, const PredicateStatistics& after) {
  const auto orient_filtered = after.orient_filtered - before.orient_filtered;
  const auto orient_exact = after.orient_exact - before.orient_exact;
  const auto filtered = after.incircle_filtered - before.incircle_filtered;
  const auto integers = after.incircle_integer - before.incircle_integer;
  const auto expansions = after.incircle_exact - before.incircle_exact;
  const auto all = filtered + integers + expansions;
  std::printf(
      "%-28s orient2d filter %5.1f %% exact %5.1f %%   incircle filter %5.1f %% integers %5.1f %% expansions "
      "%5.1f %%\n",
      name, percent(orient_filtered, orient_filtered + orient_exact),
      percent(orient_exact, orient_filtered + orient_exact), percent(filtered, all), percent(integers, all),
      percent(expansions, all));
}

bool distinct(const Quad& q) {
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j)
      if (q[i] == q[j]) return false;
  return true;
}

class EachFamily : public ::testing::TestWithParam<Family> {
 protected:
  unsigned long long seed_ = test::seed(20240611);
  Random random_{seed_};
};

// ---- Tests ----

TEST_P(EachFamily, AgreesWithExactArithmetic) {
  const PredicateStatistics before = predicate_statistics();
  for (int i = 0; i < GetParam().cases; ++i) {
    const Quad q = GetParam().make(random_);
    const auto [a, b, c, d] = q;
    const Truth expected = truth(q);
    ASSERT_EQ(orient2d(a, b, c), expected.orient)
        << "seed " << seed_ << " case " << i << ": " << described(q);
    ASSERT_EQ(incircle(a, b, c, d), expected.incircle)
        << "seed " << seed_ << " case " << i << ": " << described(q);
  }
  print_shares(GetParam().name, before, predicate_statistics());
}

TEST_P(EachFamily, SignsFollowThePermutationOfTheArguments) {
  for (int i = 0; i < 50000; ++i) {
    const Quad q = GetParam().make(random_);
    const auto [a, b, c, d] = q;
    SCOPED_TRACE("seed " + std::to_string(seed_) + " case " + std::to_string(i) + ": " + described(q));
    const int orient = orient2d(a, b, c);
    ASSERT_EQ(orient, orient2d(b, c, a));
    ASSERT_EQ(orient, -orient2d(b, a, c));
    const int circle = incircle(a, b, c, d);
    ASSERT_EQ(circle, incircle(b, c, a, d));
    ASSERT_EQ(circle, -incircle(b, a, c, d));
    ASSERT_EQ(circle, -incircle(b, c, d, a));
    ASSERT_EQ(orient2d(a, b, b), 0);
    ASSERT_EQ(incircle(a, b, c, a), 0);
  }
}

TEST_P(EachFamily, TiesAreBrokenByLiftingTheLargestPoint) {
  int ties = 0;
  for (int i = 0; i < 20000; ++i) {
    const Quad q = GetParam().make(random_);
    const auto [a, b, c, d] = q;
    if (!distinct(q) || orient2d(a, b, c) == 0) continue;
    SCOPED_TRACE("seed " + std::to_string(seed_) + " case " + std::to_string(i) + ": " + described(q));
    const int plain = incircle(a, b, c, d);
    const int broken = incircle_sos(a, b, c, d);
    ASSERT_EQ(broken, -incircle_sos(b, c, d, a));
    ties += plain == 0;
    const int expected = plain != 0 || ties > 2000 ? plain : lifted_truth(q);
    ASSERT_NE(broken, 0);
    ASSERT_TRUE(expected == 0 || broken == expected);
  }
}

INSTANTIATE_TEST_SUITE_P(Predicates, EachFamily, ::testing::ValuesIn(families), [](const auto& family) {
  std::string name = family.param.name;
  std::erase(name, ' ');
  return name;
});

TEST(Predicates, TieBreakIsAFunctionOfTheFourPointsAlone) {
  const unsigned long long seed = test::seed(7);
  Random random{seed};
  for (int i = 0; i < 2000; ++i) {
    const Quad q = exactly_cocircular(random);
    const int first = incircle_sos(q[0], q[1], q[2], q[3]);
    std::array<std::size_t, 4> order{0, 1, 2, 3};
    do {
      int inversions = 0;
      for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t k = j + 1; k < 4; ++k) inversions += order[j] > order[k];
      const int sign = inversions % 2 == 0 ? first : -first;
      ASSERT_EQ(incircle_sos(q[order[0]], q[order[1]], q[order[2]], q[order[3]]), sign)
          << "seed " << seed << " case " << i << ": " << described(q);
    } while (std::next_permutation(order.begin(), order.end()));
  }
}

TEST(Predicates, CocircularPointsHaveExactlyOneDelaunayTriangulation) {
  const unsigned long long seed = test::seed(11);
  Random random{seed};
  std::vector<Point> circle = lattice_circle();
  for (int round = 0; round < 50; ++round) {
    std::shuffle(circle.begin(), circle.end(), random);
    const std::size_t n = 4 + random() % 9;
    const auto empty = [&](Point a, Point b, Point c) {
      return std::all_of(circle.begin(), circle.begin() + static_cast<long>(n),
                         [&](Point d) { return d == a || d == b || d == c || incircle_sos(a, b, c, d) < 0; });
    };
    std::size_t delaunay = 0;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j)
        for (std::size_t k = j + 1; k < n; ++k) {
          const bool forward = orient2d(circle[i], circle[j], circle[k]) > 0;
          delaunay += empty(circle[i], forward ? circle[j] : circle[k], forward ? circle[k] : circle[j]);
        }
    ASSERT_EQ(delaunay, n - 2) << "seed " << seed << " round " << round;
  }
}

TEST(Predicates, ExtremesOfTheSafeRangeAreExact) {
  const double small = 1e-60;
  const double large = 1e60;
  const double below = std::nextafter(small, 0.0);
  EXPECT_EQ(orient2d({0, 0}, {small, small}, {below, small}), 1);
  EXPECT_EQ(orient2d({0, 0}, {large, large}, {std::nextafter(large, 0.0), large}), 1);
  EXPECT_EQ(incircle({small, 0}, {0, small}, {-small, 0}, {0, -below}), 1);
  EXPECT_EQ(incircle({small, 0}, {0, small}, {-small, 0}, {0, -small}), 0);
  EXPECT_EQ(incircle({large, 0}, {0, large}, {-large, 0}, {0, -large}), 0);
  EXPECT_EQ(incircle({large, 0}, {0, large}, {-large, 0}, {small, -large}), -1);
}

}  // namespace
}  // namespace remodel
