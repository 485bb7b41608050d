#pragma once

// Functions to minimise, all with the minimum 0. Tests only.

#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace remodel::test {

inline double sphere(std::span<const double> x) {
  double sum = 0.0;
  for (const double v : x) sum += v * v;
  return sum;
}

// Axes with a condition number of 1e6.
inline double ellipsoid(std::span<const double> x) {
  double sum = 0.0;
  const double last = static_cast<double>(x.size()) - 1.0;
  for (std::size_t i = 0; i < x.size(); ++i)
    sum += std::pow(1e6, static_cast<double>(i) / last) * x[i] * x[i];
  return sum;
}

inline double rosenbrock(std::span<const double> x) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const double valley = x[i + 1] - x[i] * x[i], slope = 1.0 - x[i];
    sum += 100.0 * valley * valley + slope * slope;
  }
  return sum;
}

inline double rastrigin(std::span<const double> x) {
  double sum = 0.0;
  for (const double v : x) sum += v * v + 10.0 - 10.0 * std::cos(6.283185307179586 * v);
  return sum;
}

struct Problem {
  std::string name;
  std::function<double(std::span<const double>)> function;
  std::vector<double> start;
  double sigma;
  double target;
};

inline std::vector<Problem> smooth_problems() {
  return {{"sphere", sphere, std::vector<double>(12, 1.0), 0.5, 1e-10},
          {"ellipsoid", ellipsoid, std::vector<double>(12, 1.0), 0.5, 1e-10},
          {"rosenbrock", rosenbrock, std::vector<double>(8, 0.0), 0.3, 1e-10}};
}

}  // namespace remodel::test
