// Prints a walk of designs and the hash of the living mesh after each: a line for a step, the coefficients
// (exact, as JSON), the hash, and the milliseconds of the step and of a flow. hashes.mjs takes the same walk
// in WebAssembly.
//   live_hashes [POINTS [STEPS [SIGMA [REYNOLDS]]]]    with a Reynolds number: of a mesh with layers for it

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "design/portable_math.h"
#include "live/core.h"

namespace {

struct Walk {
  std::uint32_t points = 60;
  int steps = 1000;
  double sigma = 0.02;    // of each coefficient, a step
  double reynolds = 0.0;  // that the layers are for; 0: none
  double gradation() const { return points / 50.0; }
};

template <typename Work>
double milliseconds(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void print_step(const Walk& walk, const std::vector<double>& design, double step) {
  const double flow = milliseconds([] { live_flow(2.0, 0.0); });
  std::printf("{\"design\": [");
  for (std::size_t i = 0; i < design.size(); ++i) std::printf("%s%.17g", i == 0 ? "" : ", ", design[i]);
  std::printf(
      "], \"points\": %u, \"gradation\": %.17g, \"reynolds\": %.17g, \"hash\": \"%s\", \"step_ms\": %.4f, "
      "\"flow_ms\": %.4f}\n",
      walk.points, walk.gradation(), walk.reynolds, live_hash(), step, flow);
}

int fail(const char* what) {
  std::fprintf(stderr, "live_hashes: %s: %s\n", what, live_error());
  return EXIT_FAILURE;
}

}  // namespace

int main(int count, char** arguments) {
  Walk walk;
  if (count > 1) walk.points = static_cast<std::uint32_t>(std::atoi(arguments[1]));
  if (count > 2) walk.steps = std::atoi(arguments[2]);
  if (count > 3) walk.sigma = std::atof(arguments[3]);
  if (count > 4) walk.reynolds = std::atof(arguments[4]);
  remodel::portable::Generator random(7);
  const std::vector<double> design = {0.17,  0.15,  0.16,  0.13,  0.15,  0.14, -0.17,
                                      -0.15, -0.16, -0.13, -0.15, -0.14, 0,    0};
  const auto length = static_cast<std::uint32_t>(design.size());
  std::uint32_t done = 0;
  const double first = milliseconds(
      [&] { done = live_generate(design.data(), length, walk.points, walk.gradation(), walk.reynolds); });
  if (done == 0) return fail("generate");
  print_step(walk, design, first);
  for (int k = 0; k < walk.steps; ++k) {
    std::vector<double> next = design;
    for (std::size_t i = 0; i + 2 < next.size(); ++i) next[i] += walk.sigma * random.normal();
    const double step = milliseconds([&] { done = live_update(next.data(), length); });
    // Designs that cross themselves are refused on both sides, or the walk would be others.
    if (done != 0) print_step(walk, next, step);
  }
  return EXIT_SUCCESS;
}
