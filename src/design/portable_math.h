#pragma once

// Logarithm and exponential by +, -, *, / alone, and the generator: the same bits on every IEEE machine, with
// any compiler and any C library. std::log and std::exp may differ in the last bit from one libm to the next,
// and std::normal_distribution is another algorithm in every standard library.

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace remodel::portable {

// ln 2 as the sum of a double of 33 bits, so that its product with an exponent is exact, and the rest.
inline constexpr double ln2_high = 6.93147180369123816490e-01;
inline constexpr double ln2_low = 1.90821492927058770002e-10;

// For finite x > 0; within 2 ulp. x = m 2^e with m in [sqrt(1/2), sqrt 2), ln m = 2 artanh((m-1)/(m+1)): the
// argument s is at most 0.1716, so that the first neglected term, s^24/25 of the sum, is below 1e-19.
inline double log(double x) {
  int e = 0;
  double m = std::frexp(x, &e);
  if (m < 0.70710678118654752) {
    m *= 2.0;
    --e;
  }
  const double s = (m - 1.0) / (m + 1.0);
  const double s2 = s * s;
  double sum = 0.0;
  for (int k = 11; k >= 1; --k) sum = (sum + 1.0 / (2 * k + 1)) * s2;
  const double exponent = e;
  return exponent * ln2_high + (2.0 * s + (2.0 * s * sum + exponent * ln2_low));
}

// For |x| <= 700; within 2 ulp. x = k ln 2 + r with |r| <= 0.347; Taylor's series to r^14, whose rest is
// below 1e-18.
inline double exp(double x) {
  const double k = std::floor(x / ln2_high + 0.5);
  const double r = (x - k * ln2_high) - k * ln2_low;
  double sum = 1.0;
  for (int i = 14; i >= 1; --i) sum = 1.0 + sum * r / i;
  return std::ldexp(sum, static_cast<int>(k));
}

// xoshiro256++ 1.0, seeded by splitmix64. Source: D. Blackman and S. Vigna, "Scrambled linear pseudorandom
// number generators", 2021.
class Generator {
 public:
  using State = std::array<std::uint64_t, 4>;

  explicit Generator(std::uint64_t seed) {
    for (std::uint64_t& word : state_) {
      seed += 0x9e3779b97f4a7c15U;
      std::uint64_t z = seed;
      z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
      z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
      word = z ^ (z >> 31);
    }
  }
  explicit Generator(const State& state) : state_(state) {}
  const State& state() const { return state_; }

  std::uint64_t next() {
    const std::uint64_t result = rotate(state_[0] + state_[3], 23) + state_[0];
    const std::uint64_t shifted = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = rotate(state_[3], 45);
    return result;
  }

  // In [0,1), a multiple of 2^-53.
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }

  // Standard normal, by the polar method (G. Marsaglia and T. A. Bray, 1964). The method's second value is
  // dropped: keeping it would save little and be one more thing in the state.
  double normal() {
    while (true) {
      const double u = 2.0 * uniform() - 1.0;
      const double v = 2.0 * uniform() - 1.0;
      const double s = u * u + v * v;
      if (s > 0.0 && s < 1.0) return u * std::sqrt(-2.0 * portable::log(s) / s);
    }
  }

 private:
  static std::uint64_t rotate(std::uint64_t x, int k) { return (x << k) | (x >> (64 - k)); }
  State state_{};
};

// Every order with the same probability (R. Durstenfeld, Comm. ACM 7, 1964).
template <class Value>
void shuffle(std::vector<Value>& values, Generator& random) {
  for (std::size_t i = values.size(); i > 1; --i) std::swap(values[i - 1], values[random.next() % i]);
}

}  // namespace remodel::portable
