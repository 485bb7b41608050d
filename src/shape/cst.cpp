// Class-shape transformation: the paper's section 4.1.

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "cst_row.h"
#include "remodel/airfoil.h"
#include "turn.h"

namespace remodel {
namespace {

// Square roots and products are correctly rounded everywhere; std::pow is not, so the exponents of the
// paper's class do without it.
double power(double base, double exponent) {
  if (exponent == 0.5) return std::sqrt(base);
  if (exponent == 1.0) return base;
  return std::pow(base, exponent);
}

struct Abscissa {
  double x = 0.0;
  double rest = 0.0;  // 1 - x
};

// x = (1 + cos 2 pi t)/2 = cos^2 pi t and 1 - x = sin^2 pi t. The smaller of the two is computed first, so
// that it has full relative accuracy at its end of the chord; the larger one follows from it.
Abscissa abscissa(double t) {
  const double h = fold(t);
  const double s = sin_half_turns(h <= 0.25 ? h : 0.5 - h);
  const double smaller = s * s;
  if (h <= 0.25) return {.x = 1.0 - smaller, .rest = smaller};
  return {.x = smaller, .rest = 1.0 - smaller};
}

}  // namespace

void cst_row(double x, double rest, double e1, double e2, std::span<double> row) {
  row[0] = 1.0;
  for (std::size_t k = 1; k < row.size(); ++k) {  // Bernstein polynomials of degree k from those of k - 1
    double carried = 0.0;
    for (std::size_t i = 0; i < k; ++i) {
      const double lower = row[i];
      row[i] = carried + rest * lower;
      carried = x * lower;
    }
    row[k] = carried;
  }
  const double class_function = power(x, e1) * power(rest, e2);
  for (double& value : row) value *= class_function;
}

CstStation cst_basis(double t, int degree, double e1, double e2, std::span<double> row) {
  assert(t >= 0.0 && t <= 1.0);
  assert(degree >= 1 && row.size() > static_cast<std::size_t>(degree));
  const auto [x, rest] = abscissa(t);
  cst_row(x, rest, e1, e2, row.first(static_cast<std::size_t>(degree) + 1));
  return {.x = x, .upper = t < 0.5};
}

double cst_height(const CstAirfoil& airfoil, CstStation station, std::span<const double> row) {
  const std::vector<double>& coefficients = station.upper ? airfoil.upper : airfoil.lower;
  assert(coefficients.size() == row.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < row.size(); ++i) sum += row[i] * coefficients[i];
  return sum + station.x * (station.upper ? airfoil.te_upper : airfoil.te_lower);
}

Point CstAirfoil::at(double t) const {
  std::array<double, 32> buffer;
  std::vector<double> long_row;  // only for degrees that nobody should ask for
  std::span<double> row(buffer.data(), std::min(upper.size(), buffer.size()));
  if (upper.size() > buffer.size()) {
    long_row.resize(upper.size());
    row = long_row;
  }
  const CstStation station = cst_basis(t, degree(), e1, e2, row);
  return {station.x, cst_height(*this, station, row)};
}

}  // namespace remodel
