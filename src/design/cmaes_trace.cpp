// Prints every sample of a long CMA-ES run as exact hexadecimal numbers, for cmaes_determinism_test. The run
// goes through fast progress, an ill-conditioned valley and the numerical floor; samples above 4 in the first
// coordinate are refused.

#include <cstdio>

#include "remodel/cmaes.h"

namespace {

// Rosenbrock's function; nothing that a compiler or library may round differently.
double valley(const std::vector<double>& x) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const double across = x[i + 1] - x[i] * x[i], along = 1.0 - x[i];
    sum += 100.0 * across * across + along * along;
  }
  return sum;
}

}  // namespace

int main() {
  remodel::Cmaes search(std::vector<double>(12, 0.0), {.sigma = 0.25, .seed = 42});
  for (int told = 0; told < 30000;) {
    const std::vector<double> x = search.ask();
    if (x[0] > 4.0) continue;
    for (const double value : x) std::printf("%a ", value);
    std::printf("\n");
    search.tell(x, valley(x));
    ++told;
  }
  std::printf("%s\n", search.state().c_str());
  return 0;
}
