#pragma once

// Forward-mode automatic differentiation: a value with its derivatives by N variables. Source: A. Griewank
// and A. Walther, "Evaluating Derivatives", 2008, chapter 3.

#include <array>
#include <cmath>
#include <cstddef>

namespace remodel::flow {

template <std::size_t N>
struct Dual {
  double value = 0.0;
  std::array<double, N> slope = {};

  Dual() = default;
  Dual(double constant) : value(constant) {}
  static Dual variable(double v, std::size_t index) {
    Dual result(v);
    result.slope[index] = 1.0;
    return result;
  }
  // f(*this) for a function of this value and derivative there.
  Dual chain(double v, double derivative) const {
    Dual result(v);
    for (std::size_t i = 0; i < N; ++i) result.slope[i] = derivative * slope[i];
    return result;
  }

  friend Dual operator+(Dual a, const Dual& b) {
    a.value += b.value;
    for (std::size_t i = 0; i < N; ++i) a.slope[i] += b.slope[i];
    return a;
  }
  friend Dual operator-(Dual a, const Dual& b) {
    a.value -= b.value;
    for (std::size_t i = 0; i < N; ++i) a.slope[i] -= b.slope[i];
    return a;
  }
  friend Dual operator-(const Dual& a) { return a.chain(-a.value, -1.0); }
  friend Dual operator*(const Dual& a, const Dual& b) {
    Dual result(a.value * b.value);
    for (std::size_t i = 0; i < N; ++i) result.slope[i] = a.slope[i] * b.value + a.value * b.slope[i];
    return result;
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const double inverse = 1.0 / b.value;
    Dual result(a.value * inverse);
    for (std::size_t i = 0; i < N; ++i) result.slope[i] = (a.slope[i] - result.value * b.slope[i]) * inverse;
    return result;
  }
  friend Dual operator+(Dual a, double b) { return a.value += b, a; }
  friend Dual operator+(double b, Dual a) { return a.value += b, a; }
  friend Dual operator-(Dual a, double b) { return a.value -= b, a; }
  friend Dual operator-(double b, const Dual& a) { return a.chain(b - a.value, -1.0); }
  friend Dual operator*(const Dual& a, double b) { return a.chain(a.value * b, b); }
  friend Dual operator*(double b, const Dual& a) { return a.chain(a.value * b, b); }
  friend Dual operator/(const Dual& a, double b) { return a * (1.0 / b); }

  friend Dual sqrt(const Dual& a) {
    const double root = std::sqrt(a.value);
    return a.chain(root, 0.5 / root);
  }
  friend Dual sin(const Dual& a) { return a.chain(std::sin(a.value), std::cos(a.value)); }
  friend Dual cos(const Dual& a) { return a.chain(std::cos(a.value), -std::sin(a.value)); }
  friend Dual exp(const Dual& a) {
    const double power = std::exp(a.value);
    return a.chain(power, power);
  }
  friend Dual pow(const Dual& a, double exponent) {
    const double power = std::pow(a.value, exponent);
    return a.chain(power, exponent * power / a.value);
  }
};

// The number that decides a branch.
inline double value_of(double x) {
  return x;
}
template <std::size_t N>
double value_of(const Dual<N>& x) {
  return x.value;
}

}  // namespace remodel::flow
