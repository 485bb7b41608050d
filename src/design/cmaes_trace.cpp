// Prints every sample of long CMA-ES runs as exact hexadecimal numbers, for cmaes_determinism_test. They go
// through fast progress, an ill-conditioned valley and the numerical floor; samples above 4 in the first
// coordinate are refused. The second run has two constraints.

#include <cstdio>

#include "design/augmented_lagrangian.h"
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

void print(const std::vector<double>& x) {
  for (const double value : x) std::printf("%a ", value);
  std::printf("\n");
}

void trace() {
  remodel::Cmaes search(std::vector<double>(12, 0.0), {.sigma = 0.25, .seed = 42});
  for (int told = 0; told < 30000;) {
    const std::vector<double> x = search.ask();
    if (x[0] > 4.0) continue;
    print(x);
    search.tell(x, valley(x));
    ++told;
  }
  std::printf("%s\n", search.state().c_str());
}

void trace_constrained() {
  remodel::Cmaes search(std::vector<double>(12, 0.0), {.sigma = 0.25, .seed = 43});
  remodel::AugmentedLagrangian lagrangian(search.dimension());
  for (int generation = 0; generation < 1000; ++generation) {
    std::vector<std::vector<double>> samples;
    std::vector<remodel::Evaluation> evaluations;
    for (int i = 0; i < search.population(); ++i) {
      const std::vector<double> x = search.ask();
      print(x);
      samples.push_back(x);
      evaluations.push_back({.objective = valley(x), .constraints = {x[0] + x[1] - 1.0, 0.25 - x[2] * x[2]}});
    }
    const std::vector<double> values = lagrangian.rank(evaluations, search.weights());
    print(values);
    for (std::size_t i = 0; i < samples.size(); ++i) search.tell(samples[i], values[i]);
  }
}

}  // namespace

int main() {
  trace();
  trace_constrained();
  return 0;
}
