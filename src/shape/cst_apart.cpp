// Whether an airfoil's surfaces are apart: the positivity of
//
//   f(x) = upper(x) - lower(x) = C(x) D(x) + x gap,   D = S_upper - S_lower,   gap = te_upper - te_lower
//
// on (0,1). Divided by the class function, which is positive there, this is D(x) + gap g(x) with
// g(x) = x^(1-e1) (1-x)^(-e2).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory_resource>
#include <span>
#include <vector>

#include "remodel/airfoil.h"

namespace remodel {
namespace {

using Coefficients = std::pmr::vector<double>;

// An interval halved this often is 1e-12 chords long. Surfaces that could not be told apart by then count as
// touching: a design is refused rather than meshed on a guess.
constexpr int depth_limit = 40;

bool all_finite(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

bool usable(const CstAirfoil& airfoil) {
  return airfoil.upper.size() >= 2 && airfoil.upper.size() == airfoil.lower.size() &&
         all_finite(airfoil.upper) && all_finite(airfoil.lower) && std::isfinite(airfoil.te_upper) &&
         std::isfinite(airfoil.te_lower) && std::isfinite(airfoil.e1) && std::isfinite(airfoil.e2) &&
         airfoil.e1 > 0.0 && airfoil.e2 > 0.0;
}

// Takes the factors 1-x out of D: where D's last coefficient is zero, D = (1-x) E with
// E_i = D_i n/(n-i). The trailing edge may close with zero angle, and E says how D approaches it.
void divide_out_trailing_edge(Coefficients& d) {
  while (d.size() > 1 && d.back() == 0.0) {
    const double n = static_cast<double>(d.size() - 1);
    d.pop_back();
    for (std::size_t i = 0; i < d.size(); ++i) d[i] *= n / (n - static_cast<double>(i));
  }
}

class Positivity {
 public:
  Positivity(const CstAirfoil& airfoil, const Coefficients& d)
      : gap_(airfoil.te_upper - airfoil.te_lower), p_(1.0 - airfoil.e1), q_(-airfoil.e2) {
    double largest = 0.0;
    for (const double v : d) largest = std::max(largest, std::abs(v));
    // One halving rounds every coefficient at most degree times by half an epsilon; the difference of the
    // surfaces and the division above add a few more.
    const double roundings = static_cast<double>(d.size() + 1) * (depth_limit + 2);
    margin_ = roundings * std::numeric_limits<double>::epsilon() * largest;
  }

  // d: D's Bernstein coefficients on [a,b]. The two ends of the whole chord are exact and only need to be
  // positive; everything else has to clear the rounding margin.
  bool holds(const Coefficients& d, double a, double b, int depth) const {
    const double help = gap_ > 0.0 ? gap_ * least_g(a, b) : 0.0;
    bool positive = true;
    for (std::size_t i = 0; i < d.size(); ++i) {
      const bool exact = (i == 0 && a == 0.0) || (i + 1 == d.size() && b == 1.0);
      if (!(d[i] + help > (exact ? 0.0 : margin_))) positive = false;
    }
    if (positive) return true;
    if (depth == depth_limit) return false;

    Coefficients left(d.size(), d.get_allocator());
    Coefficients right(d, d.get_allocator());
    for (std::size_t i = 0; i < d.size(); ++i) {  // de Casteljau at the middle
      left[i] = right[0];
      for (std::size_t j = 0; j + 1 + i < d.size(); ++j) right[j] = 0.5 * right[j] + 0.5 * right[j + 1];
    }
    const double middle = 0.5 * (a + b);
    if (!(right[0] + (gap_ > 0.0 ? gap_ * least_g(middle, middle) : 0.0) > margin_)) return false;
    return holds(left, a, middle, depth + 1) && holds(right, middle, b, depth + 1);
  }

 private:
  // A lower bound of g on [a,b]: each factor is monotone, whatever its exponent.
  double least_g(double a, double b) const {
    return std::min(std::pow(a, p_), std::pow(b, p_)) *
           std::min(std::pow(1.0 - a, q_), std::pow(1.0 - b, q_));
  }

  double gap_;
  double p_;
  double q_;
  double margin_ = 0.0;
};

}  // namespace

bool surfaces_apart(const CstAirfoil& airfoil) {
  if (!usable(airfoil)) return false;
  const double gap = airfoil.te_upper - airfoil.te_lower;
  if (gap < 0.0) return false;
  std::array<std::byte, 4096> storage;  // enough for most: each step of an optimiser asks
  std::pmr::monotonic_buffer_resource memory(storage.data(), storage.size());
  Coefficients d(airfoil.upper.size(), &memory);
  for (std::size_t i = 0; i < d.size(); ++i) d[i] = airfoil.upper[i] - airfoil.lower[i];
  if (!all_finite(d)) return false;
  if (gap == 0.0) divide_out_trailing_edge(d);
  if (!(d.front() > 0.0) || (gap == 0.0 && !(d.back() > 0.0))) return false;
  return Positivity(airfoil, d).holds(d, 0.0, 1.0, 0);
}

}  // namespace remodel
