// Prints a walk of a thousand designs and the hash of the living mesh after each: a line for a step, the
// coefficients (exact, as JSON), then the hash. hashes.mjs takes the same walk in WebAssembly.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "design/portable_math.h"
#include "live/core.h"

namespace {

constexpr std::uint32_t points = 60;
constexpr double gradation = 1.2;
constexpr int steps = 1000;

void print_step(const std::vector<double>& design) {
  std::printf("{\"design\": [");
  for (std::size_t i = 0; i < design.size(); ++i) std::printf("%s%.17g", i == 0 ? "" : ", ", design[i]);
  std::printf("], \"points\": %u, \"gradation\": %.17g, \"hash\": \"%s\"}\n", points, gradation, live_hash());
}

int fail(const char* what) {
  std::fprintf(stderr, "live_hashes: %s: %s\n", what, live_error());
  return EXIT_FAILURE;
}

}  // namespace

int main() {
  remodel::portable::Generator random(7);
  std::vector<double> design = {0.17,  0.15,  0.16,  0.13,  0.15,  0.14, -0.17,
                                -0.15, -0.16, -0.13, -0.15, -0.14, 0,    0};
  const auto count = static_cast<std::uint32_t>(design.size());
  if (live_generate(design.data(), count, points, gradation) == 0) return fail("generate");
  print_step(design);
  for (int k = 0; k < steps; ++k) {
    std::vector<double> next = design;
    for (std::size_t i = 0; i + 2 < next.size(); ++i) next[i] += 0.02 * random.normal();
    // Designs that cross themselves are refused on both sides, or the walk would be others.
    if (live_update(next.data(), count) == 0) continue;
    print_step(next);
  }
  return EXIT_SUCCESS;
}
