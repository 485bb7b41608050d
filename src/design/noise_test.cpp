#include "remodel/noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "remodel/error.h"
#include "support.h"

namespace remodel {
namespace {

std::vector<double> places_around_0(int count, double spacing) {
  std::vector<double> places;
  for (int i = 0; i < count; ++i) places.push_back((i - 0.5 * (count - 1)) * spacing);
  return places;
}

double cubic(double x) {
  return 0.3 + 2.0 * x - 5.0 * x * x + 7.0 * x * x * x;
}

TEST(LineFit, LeavesNothingOfAPolynomialOfItsDegree) {
  const std::vector<double> places = places_around_0(11, 1e-3);
  std::vector<double> values;
  for (const double x : places) values.push_back(cubic(x));
  const LineFit fit = fit_line(places, values, 3);
  EXPECT_LT(fit.rms, 1e-15);
  EXPECT_NEAR(fit.slope, 2.0, 1e-11);
  EXPECT_GT(fit_line(places, values, 1).rms, 1e-6);
}

TEST(LineFit, FindsTheNoiseAndHowFarTheSlopeIsOff) {
  const auto seed = test::seed(251);
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  const std::vector<double> places = places_around_0(21, 1e-2);
  double squared_error = 0.0, squared_estimate = 0.0, squared_rms = 0.0;
  constexpr int trials = 400;
  const double amplitude = 1e-4, deviation = amplitude / std::sqrt(3.0);  // of uniform noise
  for (int i = 0; i < trials; ++i) {
    std::vector<double> values;
    for (const double x : places) values.push_back(cubic(x) + test::uniform(random, -amplitude, amplitude));
    const LineFit fit = fit_line(places, values, 3);
    squared_error += (fit.slope - 2.0) * (fit.slope - 2.0);
    squared_estimate += fit.slope_error * fit.slope_error;
    squared_rms += fit.rms * fit.rms;
  }
  EXPECT_NEAR(std::sqrt(squared_rms / trials), deviation, 0.1 * deviation);
  EXPECT_NEAR(std::sqrt(squared_error / squared_estimate), 1.0, 0.15);
}

// Central differences of the cubic with noise in the sign that hurts most.
TEST(LineFit, NamesTheStepWithTheLeastError) {
  std::vector<double> places = places_around_0(41, 1e-2), values;
  for (std::size_t i = 0; i < places.size(); ++i)
    values.push_back(cubic(places[i]) + (i % 2 == 0 ? 1e-6 : -1e-6));
  const LineFit fit = fit_line(places, values, 3);
  const auto error = [&](double h) { return fit.rms / std::sqrt(2.0) / h + 7.0 * h * h; };
  EXPECT_NEAR(fit.step_error, error(fit.step), 0.05 * fit.step_error);
  for (const double factor : {0.5, 0.8, 1.25, 2.0})
    EXPECT_GT(error(factor * fit.step), 0.99 * fit.step_error);
}

TEST(LineFit, RefusesWhatDeterminesNoPolynomial) {
  const std::vector<double> places{-1.0, 0.0, 1.0, 2.0}, twice{-1.0, 0.0, 0.0, 2.0},
      values{1.0, 2.0, 3.0, 4.0};
  EXPECT_NO_THROW(fit_line(places, values, 2));
  EXPECT_THROW(fit_line(places, values, 3), Error);
  EXPECT_THROW(fit_line(places, values, 0), Error);
  EXPECT_THROW(fit_line(twice, values, 2), Error);
  EXPECT_THROW(fit_line(places, std::vector<double>{1.0, 2.0, NAN, 4.0}, 2), Error);
}

}  // namespace
}  // namespace remodel
