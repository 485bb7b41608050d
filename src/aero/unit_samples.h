#pragma once

// Points of the unit cube that fill it evenly.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace remodel {

enum class Sampling { sobol, latin_hypercube };
const char* name_of(Sampling sampling);  // "sobol", "latin-hypercube"

// sobol: the first points of I. M. Sobol's sequence (USSR Comput. Math. Math. Phys. 7, 1967), with the
// directions of S. Joe and F. Y. Kuo (SIAM J. Sci. Comput. 30, 2008), all shifted by one random vector modulo
// 1 (R. Cranley and T. N. L. Patterson, SIAM J. Numer. Anal. 13, 1976): more of them begin with the same
// ones. latin_hypercube: each coordinate has one point in each of `count` equal intervals (M. D. McKay et
// al., Technometrics 21, 1979). The same seed gives the same bits on every machine. At most 3,000 dimensions.
std::vector<std::vector<double>> unit_samples(Sampling sampling, std::size_t count, std::size_t dimensions,
                                              std::uint64_t seed);

}  // namespace remodel
