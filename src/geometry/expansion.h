#pragma once

// Exact arithmetic on expansions: sums of doubles whose bits do not overlap, least significant first.
//
// J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates",
// Discrete & Computational Geometry 18 (1997). Sizes are bounded at compile time and everything lies on the
// stack. Exact while no operation overflows or underflows, and only in round-to-nearest double arithmetic
// without contraction (the build sets -ffp-contract=off).

#include <array>
#include <cmath>

namespace remodel::geometry {

// high + low is exactly the result of the operation; high is the rounded result.
struct Rounded {
  double high;
  double low;
};

// Knuth; any order of magnitudes.
inline Rounded two_sum(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  const double a_part = sum - b_part;
  return {sum, (a - a_part) + (b - b_part)};
}

inline Rounded two_difference(double a, double b) {
  return two_sum(a, -b);
}

// Dekker; |a| >= |b|.
inline Rounded fast_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

// Veltkamp: both halves have at most 26 bits, so that products of halves are exact.
inline Rounded split(double a) {
  constexpr double splitter = 134217729.0;  // 2^27 + 1
  const double scaled = splitter * a;
  const double high = scaled - (scaled - a);
  return {high, a - high};
}

// Dekker.
inline Rounded two_product(double a, double b) {
  const double product = a * b;
  const Rounded u = split(a);
  const Rounded v = split(b);
  const double error = ((product - u.high * v.high) - u.low * v.high) - u.high * v.low;
  return {product, u.low * v.low - error};
}

// Terms in increasing magnitude, zeros left out: zero is the empty expansion.
template <int Capacity>
class Expansion {
 public:
  void append(double term) {
    if (term != 0.0) terms_[static_cast<std::size_t>(size_++)] = term;
  }
  int size() const { return size_; }
  double operator[](int i) const { return terms_[static_cast<std::size_t>(i)]; }
  int sign() const { return size_ == 0 ? 0 : (terms_[static_cast<std::size_t>(size_ - 1)] > 0.0 ? 1 : -1); }

  Expansion operator-() const {
    Expansion negated;
    for (int i = 0; i < size_; ++i) negated.append(-(*this)[i]);
    return negated;
  }

 private:
  std::array<double, Capacity> terms_;  // the first size_ are set
  int size_ = 0;
};

inline Expansion<2> product(double a, double b) {
  const Rounded p = two_product(a, b);
  Expansion<2> result;
  result.append(p.low);
  result.append(p.high);
  return result;
}

// FAST-EXPANSION-SUM with zero elimination (section 2.4): merge by magnitude, carry upwards.
template <int A, int B>
Expansion<A + B> operator+(const Expansion<A>& e, const Expansion<B>& f) {
  Expansion<A + B> result;
  double carry = 0.0;
  for (int i = 0, j = 0; i < e.size() || j < f.size();) {
    const bool take_e = j == f.size() || (i < e.size() && std::abs(e[i]) < std::abs(f[j]));
    const Rounded sum = two_sum(carry, take_e ? e[i++] : f[j++]);
    result.append(sum.low);
    carry = sum.high;
  }
  result.append(carry);
  return result;
}

template <int A, int B>
Expansion<A + B> operator-(const Expansion<A>& e, const Expansion<B>& f) {
  return e + (-f);
}

// SCALE-EXPANSION with zero elimination (section 2.5).
template <int A>
Expansion<2 * A> operator*(const Expansion<A>& e, double factor) {
  Expansion<2 * A> result;
  double carry = 0.0;
  for (int i = 0; i < e.size(); ++i) {
    const Rounded term = two_product(e[i], factor);
    const Rounded low = two_sum(carry, term.low);
    result.append(low.low);
    const Rounded high = fast_two_sum(term.high, low.high);
    result.append(high.low);
    carry = high.high;
  }
  result.append(carry);
  return result;
}

}  // namespace remodel::geometry
