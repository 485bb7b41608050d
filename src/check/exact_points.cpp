#include "check/exact_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace remodel::checker {
namespace {

namespace mp = boost::multiprecision;

// On the stack, for meshes whose coordinates span up to 125 bits; others take integers without bound.
constexpr int fixed_bits = 512;
using Fixed =
    mp::number<mp::cpp_int_backend<fixed_bits, fixed_bits, mp::signed_magnitude, mp::unchecked, void>>;

// v == mantissa 2^exponent, with an odd mantissa unless v is zero.
struct Dyadic {
  std::int64_t mantissa = 0;
  int exponent = 0;
};

Dyadic dyadic(double v) {
  if (v == 0.0) return {};
  int exponent = 0;
  constexpr int digits = std::numeric_limits<double>::digits;
  auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(v, &exponent), digits));
  exponent -= digits;
  for (; mantissa % 2 == 0; mantissa /= 2) ++exponent;
  return {mantissa, exponent};
}

// All coordinates are multiples of 2^lowest and of magnitude below 2^highest.
struct Span {
  int lowest = std::numeric_limits<int>::max();
  int highest = std::numeric_limits<int>::min();

  void include(double v) {
    if (v == 0.0) return;
    lowest = std::min(lowest, dyadic(v).exponent);
    highest = std::max(highest, std::ilogb(v) + 1);
  }
};

Span span_of(const std::vector<Point>& points) {
  Span span;
  for (const Point& p : points) {
    span.include(p.x);
    span.include(p.y);
  }
  return span.lowest > span.highest ? Span{0, 0} : span;
}

// Differences have one bit more than coordinates; minors and lifts are sums of two products of two
// differences, the incircle determinant is a sum of three products of those: 4 (n + 1) + 2 + 2 bits.
bool fits_fixed(Span span) {
  return 4 * (span.highest - span.lowest + 1) + 4 <= fixed_bits;
}

template <class Number>
class ScaledPoints : public ExactPoints {
 public:
  ScaledPoints(const std::vector<Point>& points, int unit_exponent) : unit_exponent_(unit_exponent) {
    scaled_.reserve(points.size());
    for (const Point& p : points) scaled_.push_back({scaled(p.x), scaled(p.y)});
  }

  Integer twice_area(std::uint32_t a, std::uint32_t b, std::uint32_t c) const override {
    return Integer(area_of(a, b, c));
  }

  Integer dot(std::uint32_t a, std::uint32_t b, std::uint32_t c) const override {
    const Vector u = difference(b, a), v = difference(c, a);
    return Integer(Number(u.x * v.x + u.y * v.y));
  }

  int orientation(std::uint32_t a, std::uint32_t b, std::uint32_t c) const override {
    return area_of(a, b, c).sign();
  }

  Integer cross(std::uint32_t a, std::uint32_t b) const override {
    const Number product = scaled_[a].x * scaled_[b].y - scaled_[a].y * scaled_[b].x;
    return Integer(product);
  }

  int in_circle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const override {
    const Vector u = difference(a, d), v = difference(b, d), w = difference(c, d);
    const Number determinant =
        squared(u) * crossed(v, w) + squared(v) * crossed(w, u) + squared(w) * crossed(u, v);
    return determinant.sign();
  }

  double half_in_mesh_units(const Integer& twice_area) const override {
    const Integer magnitude = abs(twice_area);
    if (magnitude == 0) return 0.0;
    constexpr unsigned kept_bits = 63;
    const unsigned bits = static_cast<unsigned>(mp::msb(magnitude));
    const unsigned dropped = bits > kept_bits ? bits - kept_bits : 0;
    const Integer leading = magnitude >> dropped;
    const double half =
        std::ldexp(leading.template convert_to<double>(), 2 * unit_exponent_ + static_cast<int>(dropped) - 1);
    return twice_area < 0 ? -half : half;
  }

 private:
  struct Vector {
    Number x, y;
  };

  Number scaled(double v) const {
    const Dyadic d = dyadic(v);
    if (d.mantissa == 0) return Number(0);
    const Number magnitude = Number(std::abs(d.mantissa))
                             << static_cast<unsigned>(d.exponent - unit_exponent_);
    return d.mantissa < 0 ? Number(-magnitude) : magnitude;
  }
  Vector difference(std::uint32_t a, std::uint32_t b) const {
    return {scaled_[a].x - scaled_[b].x, scaled_[a].y - scaled_[b].y};
  }
  static Number crossed(const Vector& u, const Vector& v) { return u.x * v.y - u.y * v.x; }
  static Number squared(const Vector& u) { return u.x * u.x + u.y * u.y; }
  Number area_of(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return crossed(difference(b, a), difference(c, a));
  }

  std::vector<Vector> scaled_;
  int unit_exponent_;
};

}  // namespace

std::unique_ptr<ExactPoints> exact_points(const std::vector<Point>& points) {
  const Span span = span_of(points);
  if (fits_fixed(span)) return std::make_unique<ScaledPoints<Fixed>>(points, span.lowest);
  return std::make_unique<ScaledPoints<ExactPoints::Integer>>(points, span.lowest);
}

}  // namespace remodel::checker
