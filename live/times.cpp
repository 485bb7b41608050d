// Takes a row of designs natively, as the page takes them, and prints the median milliseconds as JSON: of
// steps, of potential flows and, at Mach numbers above 0, of Euler's flows and of the first of these.
//   live_times POINTS ALPHA MACH <designs    a design a line, the first one generated

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "live/core.h"

namespace {

template <typename Work>
double milliseconds(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

std::vector<std::vector<double>> read_designs() {
  std::vector<std::vector<double>> designs;
  for (std::string line; std::getline(std::cin, line);) {
    std::istringstream numbers(line);
    designs.emplace_back();
    for (double number = 0.0; numbers >> number;) designs.back().push_back(number);
  }
  return designs;
}

std::uint32_t solve_euler(double alpha_deg, double mach) {
  const double* figures = live_figures();
  const auto count = [&](LiveFigure figure) { return static_cast<std::uint32_t>(figures[figure]); };
  const std::uint32_t vertices = count(live_vertex_count), triangles = count(live_triangle_count);
  const std::uint32_t* edges = live_edges();
  std::vector<std::uint32_t> numbers{vertices, triangles, 0, live_airfoil_edges(), live_farfield_edges()};
  numbers.insert(numbers.end(), live_triangles(), live_triangles() + 3 * triangles);
  numbers.insert(numbers.end(), edges, edges + 2 * (live_airfoil_edges() + live_farfield_edges()));
  numbers.insert(numbers.end(), live_keys(), live_keys() + 2 * vertices);
  if (live_solver_mesh(live_points(), numbers.data()) == 0) return 0;
  return live_solve(live_euler, alpha_deg, mach, 0.0);
}

int fail(const char* what, const char* why) {
  std::fprintf(stderr, "live_times: %s: %s\n", what, why);
  return EXIT_FAILURE;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 4) return fail("arguments", "expected POINTS ALPHA MACH");
  const auto points = static_cast<std::uint32_t>(std::atoi(arguments[1]));
  const double alpha_deg = std::atof(arguments[2]), mach = std::atof(arguments[3]);
  std::vector<double> steps, flows, eulers;
  double cold = 0.0;
  bool is_first = true;
  for (const std::vector<double>& design : read_designs()) {
    const auto length = static_cast<std::uint32_t>(design.size());
    std::uint32_t done = 0;
    const double step = milliseconds([&] {
      done = is_first ? live_generate(design.data(), length, points, points / 50.0, 0.0)
                      : live_update(design.data(), length);
    });
    if (done == 0) return fail("design", live_error());
    const double flow = milliseconds([&] { done = live_flow(alpha_deg, mach); });
    if (done == 0) return fail("flow", live_error());
    const double euler = mach > 0.0 ? milliseconds([&] { done = solve_euler(alpha_deg, mach); }) : 0.0;
    if (done == 0) return fail("Euler's flow", live_solver_reason());
    if (is_first) {
      cold = euler;
    } else {
      steps.push_back(step), flows.push_back(flow), eulers.push_back(euler);
    }
    is_first = false;
  }
  std::printf("{\"step\": %.3f, \"flow\": %.3f, \"euler\": %.1f, \"cold\": %.1f}\n", median(steps),
              median(flows), median(eulers), cold);
  return EXIT_SUCCESS;
}
