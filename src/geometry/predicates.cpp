// Exact stages of the predicates, reached when the filters of filters.h cannot decide. See
// remodel/predicates.h for the contract and expansion.h for the arithmetic.

#include "remodel/predicates.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>

#include "geometry/expansion.h"
#include "geometry/filters.h"

namespace remodel {
namespace geometry {
namespace {

// p.x q.y - q.x p.y
Expansion<4> wedge(Point p, Point q) {
  return product(p.x, q.y) - product(q.x, p.y);
}

// e |p|^2
template <int A>
Expansion<8 * A> lifted(const Expansion<A>& e, Point p) {
  return e * p.x * p.x + e * p.y * p.y;
}

// The sign of p q - r s. Rounding is monotone: unequal rounded products are in the order of the exact ones,
// and of equal ones the rounding errors decide.
int compare_products(double p, double q, double r, double s) {
  const Rounded left = two_product(p, q);
  const Rounded right = two_product(r, s);
  if (left.high != right.high) return left.high > right.high ? 1 : -1;
  return static_cast<int>(left.low > right.low) - static_cast<int>(left.low < right.low);
}

// The 4 x 4 determinant of rows (x, y, x^2 + y^2, 1), expanded by its third column (Shewchuk, section 4.4):
// no differences, so that it is exact for all points. 384 terms at most.
int incircle_by_expansions(Point a, Point b, Point c, Point d) {
  const auto ab = wedge(a, b), ac = wedge(a, c), ad = wedge(a, d);
  const auto bc = wedge(b, c), bd = wedge(b, d), cd = wedge(c, d);
  const auto left = lifted(bc + cd - bd, a) - lifted(ac + cd - ad, b);
  const auto right = lifted(ab + bd - ad, c) - lifted(ab + bc - ac, d);
  return (left + right).sign();
}

// ---- The integer stage of incircle ----
//
// Exact ties come in masses: symmetric airfoils, circles, grids. There the six coordinate differences are
// short numbers of similar size, so that as multiples of their common lowest bit they fit 62 bits, and the
// determinant fits 256: several times faster than expansions.

__extension__ using Int128 = __int128;
__extension__ using Unsigned128 = unsigned __int128;

// Two's complement, 256 bits.
struct Int256 {
  Unsigned128 high = 0;
  Unsigned128 low = 0;

  friend Int256 operator+(Int256 a, Int256 b) {
    const Unsigned128 low = a.low + b.low;
    return {a.high + b.high + static_cast<unsigned>(low < a.low), low};
  }
  Int256 operator-() const { return Int256{~high, ~low} + Int256{0, 1}; }
  int sign() const {
    if ((high | low) == 0) return 0;
    return static_cast<Int128>(high) < 0 ? -1 : 1;
  }
};

Int256 multiply_unsigned(Unsigned128 a, Unsigned128 b) {
  const auto a0 = static_cast<std::uint64_t>(a), a1 = static_cast<std::uint64_t>(a >> 64);
  const auto b0 = static_cast<std::uint64_t>(b), b1 = static_cast<std::uint64_t>(b >> 64);
  const Unsigned128 low = Unsigned128{a0} * b0;
  const Unsigned128 middle = Unsigned128{a0} * b1 + (low >> 64);
  const Unsigned128 other = Unsigned128{a1} * b0 + static_cast<std::uint64_t>(middle);
  const Unsigned128 high = Unsigned128{a1} * b1 + (middle >> 64) + (other >> 64);
  return {high, (other << 64) | static_cast<std::uint64_t>(low)};
}

Int256 multiply(Int128 a, Int128 b) {
  const auto magnitude = [](Int128 v) {
    return v < 0 ? -static_cast<Unsigned128>(v) : static_cast<Unsigned128>(v);
  };
  const Int256 product = multiply_unsigned(magnitude(a), magnitude(b));
  return (a < 0) != (b < 0) ? -product : product;
}

constexpr int mantissa_bits = 52;
constexpr int exponent_bias = 1023;

int biased_exponent(double v) {
  return static_cast<int>((std::bit_cast<std::uint64_t>(v) >> mantissa_bits) & 0x7ff);
}

// The biased exponent of the lowest set bit of a normal number.
int lowest_bit(double v) {
  constexpr std::uint64_t hidden = std::uint64_t{1} << mantissa_bits;
  const std::uint64_t mantissa = std::bit_cast<std::uint64_t>(v) & (hidden - 1);
  return biased_exponent(v) - mantissa_bits + std::countr_zero(mantissa | hidden);
}

// The differences as integers, all scaled by the same power of two; nothing if one could be above 2^62.
std::optional<std::array<std::int64_t, 6>> as_integers(const std::array<Rounded, 6>& differences) {
  int lowest = 2 * exponent_bias;
  int highest = 0;
  for (const Rounded& d : differences) {
    if (d.high == 0.0) continue;
    highest = std::max(highest, biased_exponent(d.high));
    lowest = std::min(lowest, lowest_bit(d.low != 0.0 ? d.low : d.high));
  }
  // In units of the lowest bit, every high is below 2^(highest - lowest + 1), and adding low, which was
  // rounded away, cannot cross that power of two.
  const bool fits = highest - lowest + 1 <= 62;
  const bool scale_is_normal = lowest >= 1 && lowest < 2 * exponent_bias;
  if (!fits || !scale_is_normal) return std::nullopt;
  const auto scale_bits = static_cast<std::uint64_t>(2 * exponent_bias - lowest) << mantissa_bits;
  const auto scale = std::bit_cast<double>(scale_bits);
  std::array<std::int64_t, 6> integers{};
  for (std::size_t i = 0; i < integers.size(); ++i) {
    integers[i] = static_cast<std::int64_t>(differences[i].high * scale) +
                  static_cast<std::int64_t>(differences[i].low * scale);
  }
  return integers;
}

// For integers up to 2^62, products are at most 2^124 and sums of two products 2^125: minors and lifts fit
// 128 bits. Their products are at most 2^250, the sum of three is below 2^252.
int incircle_of_integers(const std::array<std::int64_t, 6>& differences) {
  const auto [ux, uy, vx, vy, wx, wy] = differences;
  const auto times = [](std::int64_t p, std::int64_t q) { return Int128{p} * q; };
  const Int256 u = multiply(times(ux, ux) + times(uy, uy), times(vx, wy) - times(wx, vy));
  const Int256 v = multiply(times(vx, vx) + times(vy, vy), times(wx, uy) - times(ux, wy));
  const Int256 w = multiply(times(wx, wx) + times(wy, wy), times(ux, vy) - times(vx, uy));
  return (u + v + w).sign();
}

}  // namespace

int orient2d_exact(Point a, Point b, Point c) {
  REMODEL_COUNT_PREDICATE(orient_exact);
  const Rounded ux = two_difference(a.x, c.x), uy = two_difference(a.y, c.y);
  const Rounded vx = two_difference(b.x, c.x), vy = two_difference(b.y, c.y);
  const bool differences_are_exact = ux.low == 0.0 && uy.low == 0.0 && vx.low == 0.0 && vy.low == 0.0;
  if (differences_are_exact) return compare_products(ux.high, vy.high, uy.high, vx.high);
  return (wedge(a, b) + wedge(b, c) + wedge(c, a)).sign();
}

int incircle_exact(Point a, Point b, Point c, Point d) {
  const auto integers =
      as_integers({two_difference(a.x, d.x), two_difference(a.y, d.y), two_difference(b.x, d.x),
                   two_difference(b.y, d.y), two_difference(c.x, d.x), two_difference(c.y, d.y)});
  if (integers) {
    REMODEL_COUNT_PREDICATE(incircle_integer);
    return incircle_of_integers(*integers);
  }
  REMODEL_COUNT_PREDICATE(incircle_exact);
  return incircle_by_expansions(a, b, c, d);
}

// Lifting a point by an infinitesimal adds its cofactor in the third column of the 4 x 4 determinant.
// Distinct cocircular points have no three on a line, so that no cofactor is zero and the largest lift alone
// decides.
int incircle_tie(Point a, Point b, Point c, Point d) {
  REMODEL_COUNT_PREDICATE(incircle_ties);
  const auto smaller = [](Point p, Point q) { return p.x < q.x || (p.x == q.x && p.y < q.y); };
  const std::array<Point, 4> points{a, b, c, d};
  switch (std::max_element(points.begin(), points.end(), smaller) - points.begin()) {
    case 0:
      return orient2d_filtered(b, c, d);
    case 1:
      return -orient2d_filtered(a, c, d);
    case 2:
      return orient2d_filtered(a, b, d);
    default:
      return -orient2d_filtered(a, b, c);
  }
}

}  // namespace geometry

int orient2d(Point a, Point b, Point c) {
  return geometry::orient2d_filtered(a, b, c);
}

int incircle(Point a, Point b, Point c, Point d) {
  return geometry::incircle_filtered(a, b, c, d);
}

int incircle_sos(Point a, Point b, Point c, Point d) {
  return geometry::incircle_sos_filtered(a, b, c, d);
}

PredicateStatistics predicate_statistics() {
#ifdef REMODEL_PREDICATE_STATISTICS
  const geometry::PredicateCounters& counters = geometry::predicate_counters;
  return {counters.orient_filtered,  counters.orient_exact,   counters.incircle_filtered,
          counters.incircle_integer, counters.incircle_exact, counters.incircle_ties};
#else
  return {};
#endif
}

}  // namespace remodel
