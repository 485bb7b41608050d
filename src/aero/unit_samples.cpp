#include "aero/unit_samples.h"

#include <algorithm>
#include <boost/random/sobol.hpp>
#include <numeric>
#include <utility>

#include "design/portable_math.h"

namespace remodel {
namespace {

using Samples = std::vector<std::vector<double>>;

Samples shifted_sobol(std::size_t count, std::size_t dimensions, portable::Generator& random) {
  std::vector<double> shift(dimensions);
  for (double& x : shift) x = random.uniform();
  boost::random::sobol sequence(dimensions);
  Samples samples(count, std::vector<double>(dimensions));
  for (std::vector<double>& sample : samples) {
    for (std::size_t d = 0; d < dimensions; ++d) {
      const double x = static_cast<double>(sequence() >> 11) * 0x1p-53 + shift[d];
      sample[d] = x < 1.0 ? x : x - 1.0;
    }
  }
  return samples;
}

Samples latin_hypercube(std::size_t count, std::size_t dimensions, portable::Generator& random) {
  Samples samples(count, std::vector<double>(dimensions));
  std::vector<std::size_t> interval(count);
  for (std::size_t d = 0; d < dimensions; ++d) {
    std::iota(interval.begin(), interval.end(), std::size_t{0});
    portable::shuffle(interval, random);
    for (std::size_t i = 0; i < count; ++i)
      samples[i][d] = (static_cast<double>(interval[i]) + random.uniform()) / static_cast<double>(count);
  }
  return samples;
}

}  // namespace

const char* name_of(Sampling sampling) {
  return sampling == Sampling::sobol ? "sobol" : "latin-hypercube";
}

Samples unit_samples(Sampling sampling, std::size_t count, std::size_t dimensions, std::uint64_t seed) {
  portable::Generator random(seed);
  return sampling == Sampling::sobol ? shifted_sobol(count, dimensions, random)
                                     : latin_hypercube(count, dimensions, random);
}

}  // namespace remodel
