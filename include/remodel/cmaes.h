#pragma once

// CMA-ES, ask and tell. Source: N. Hansen, "The CMA Evolution Strategy: A Tutorial", arXiv:1604.00772 (2016),
// standard parameters, positive weights. Deterministic: the generator is part of the state; the same seed gives
// the same bytes with any compiler.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace remodel {

struct CmaesOptions {
  double sigma = 0.05;         // initial standard deviation; > 0
  std::uint64_t seed = 1;
  int population = 0;          // 0: 4 + floor(3 ln n)
};

class Cmaes {
 public:
  Cmaes(std::vector<double> start, const CmaesOptions& options);

  int dimension() const;
  int population() const;
  std::span<const double> mean() const;
  double sigma() const;
  std::uint64_t generation() const;

  // A sample of the current distribution. Refused samples are simply not told: ask again.
  std::vector<double> ask();
  // Tells one sample's objective value (smaller is better; infinity and NaN rank last). After `population` tells
  // the distribution is updated; returns true then.
  bool tell(std::span<const double> sample, double value);

  // The full state as JSON text, exact; restored it goes on to the same samples.
  std::string state() const;
  static Cmaes restore(std::string_view state, const std::string& source);  // throws Error (format)

 private:
  std::vector<double> mean_;
};

}  // namespace remodel
