#include "remodel/noise.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>

#include "remodel/error.h"

namespace remodel {

namespace {

void require_line(std::span<const double> places, std::span<const double> values, int degree) {
  if (degree < 1)
    throw Error(ErrorCode::argument, "degree", "found " + std::to_string(degree) + ", expected 1 or more");
  if (places.size() != values.size() || values.size() < static_cast<std::size_t>(degree) + 2)
    throw Error(ErrorCode::argument, "values",
                "found " + std::to_string(places.size()) + " places and " + std::to_string(values.size()) +
                    " values, expected at least " + std::to_string(degree + 2) + " of each");
  const auto finite = [](double value) { return std::isfinite(value); };
  if (!std::all_of(places.begin(), places.end(), finite) ||
      !std::all_of(values.begin(), values.end(), finite))
    throw Error(ErrorCode::argument, "values", "found one that is not finite, expected finite ones");
  std::vector<double> sorted(places.begin(), places.end());
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
    throw Error(ErrorCode::argument, "places", "found one twice, expected different ones");
}

// The least of a / h + b h^2.
void choose_step(double rms, double third_derivative, LineFit& fit) {
  const double noise = rms / std::sqrt(2.0), bend = std::abs(third_derivative) / 6.0;
  if (noise == 0.0 || bend == 0.0) return;
  fit.step = std::cbrt(noise / (2.0 * bend));
  fit.step_error = noise / fit.step + bend * fit.step * fit.step;
}

}  // namespace

LineFit fit_line(std::span<const double> places, std::span<const double> values, int degree) {
  require_line(places, values, degree);
  double scale = 0.0;
  for (const double x : places) scale = std::max(scale, std::abs(x));
  const auto rows = static_cast<Eigen::Index>(values.size()), columns = static_cast<Eigen::Index>(degree) + 1;
  Eigen::MatrixXd powers(rows, columns);
  Eigen::VectorXd right(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    right[i] = values[static_cast<std::size_t>(i)];
    double power = 1.0;
    for (Eigen::Index k = 0; k < columns; ++k, power *= places[static_cast<std::size_t>(i)] / scale)
      powers(i, k) = power;
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(powers);
  const Eigen::VectorXd coefficients = qr.solve(right), residual = right - powers * coefficients;
  LineFit fit;
  fit.residuals.assign(residual.data(), residual.data() + rows);
  fit.rms = std::sqrt(residual.squaredNorm() / static_cast<double>(rows - columns));
  fit.slope = coefficients[1] / scale;
  const Eigen::MatrixXd covariance = (powers.transpose() * powers).inverse();
  fit.slope_error = fit.rms * std::sqrt(covariance(1, 1)) / scale;
  if (degree >= 3) choose_step(fit.rms, 6.0 * coefficients[3] / (scale * scale * scale), fit);
  return fit;
}

}  // namespace remodel
