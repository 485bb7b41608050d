#pragma once

// CMA-ES, ask and tell. Source: N. Hansen, "The CMA Evolution Strategy: A Tutorial", arXiv:1604.00772 (2016),
// standard parameters (its table 1), positive weights. Deterministic: the generator is part of the state; the
// same seed gives the same bytes with any compiler and optimisation level (src/design/cmaes.cpp says how).

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace remodel {

struct CmaesOptions {
  double sigma = 0.05;              // initial standard deviation of every coordinate; > 0 and finite
  std::uint64_t seed = 1;           // of the generator: every value is allowed
  int population = 0;               // samples per generation, at least 4; 0: 4 + floor(3 ln n)
  double least_deviation = 1e-150;  // the largest standard deviation never falls below; 1e-150 to 1e50
};

class Cmaes {
 public:
  // start has 1 to 1000 finite coordinates. Throws Error (argument).
  Cmaes(std::vector<double> start, const CmaesOptions& options);
  ~Cmaes();
  Cmaes(Cmaes&&) noexcept;
  Cmaes& operator=(Cmaes&&) noexcept;

  int dimension() const;
  int population() const;
  std::span<const double> mean() const;  // valid until the next tell
  double sigma() const;
  double largest_deviation() const;  // of any direction: sigma times the longest axis
  std::uint64_t generation() const;  // updates so far
  std::size_t told() const;          // samples of this generation so far
  std::span<const double> weights() const;  // of the best samples in the mean's update, best first; their sum is 1

  // A sample of the current distribution. Refused samples are simply not told: ask again.
  std::vector<double> ask();
  // Tells one sample's objective value (smaller is better; infinity and NaN rank last, equal values in the
  // order in which they were told). After `population` tells the distribution is updated; returns true then.
  // Throws Error (argument) for a sample of another dimension or with a coordinate that is not finite.
  bool tell(std::span<const double> sample, double value);

  // Each update applies what keeps a long run in order:
  //  (1) eigenvalues of the covariance below 1e-14 of the largest are raised to that,
  //  (2) the largest standard deviation stays at or above 4 epsilon times the largest magnitude in the mean
  //      (and 1e-150), so that samples of a converged run still differ from the mean,
  //  (3) it stays at or below 1e50,
  //  (4) the covariance is rescaled against sigma where its largest eigenvalue leaves [1e-20, 1e20].

  // The full state as JSON text, exact; restored it goes on to the same samples, also between two tells.
  std::string state() const;
  static Cmaes restore(std::string_view state, const std::string& source);  // throws Error (format)

 private:
  struct State;
  explicit Cmaes(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace remodel
