// bench/compare: measures speed as ratios to the yardstick Y of the same run. Prints Markdown, or JSON with
// --json.

#include <cstdio>
#include <iostream>

#include <CLI/CLI.hpp>

#include "measurements.h"

namespace {

using remodel::bench::Rows;

std::string text(const nlohmann::ordered_json& value) {
  if (!value.is_number_float()) return value.dump();
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.4g", value.get<double>());
  return digits;
}

void print_table(const std::string& title, const Rows& rows) {
  std::cout << "## " << title << "\n\n|";
  for (const auto& column : rows.front().items()) std::cout << ' ' << column.key() << " |";
  std::cout << "\n|";
  for (std::size_t i = 0; i < rows.front().size(); ++i) std::cout << "---|";
  std::cout << '\n';
  for (const auto& row : rows) {
    std::cout << '|';
    for (const auto& column : row.items()) std::cout << ' ' << text(column.value()) << " |";
    std::cout << '\n';
  }
  std::cout << '\n';
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app{"Measures generation and remodelling against CGAL and Gmsh"};
  int rounds = 9;
  std::string only = "generation,large,adjustment,steps";
  bool json = false, others = false, ten_million = false;
  app.add_option("--rounds", rounds, "Rounds of measurements: medians are of these")
      ->check(CLI::PositiveNumber);
  app.add_option("--only", only, "Some of: generation,large,adjustment,steps");
  app.add_flag("--others", others, "CGAL's Mesh_2 and Gmsh too");
  app.add_flag("--ten-million", ten_million, "A mesh of 10 million triangles too");
  app.add_flag("--json", json, "One JSON object on standard output");
  CLI11_PARSE(app, argc, argv);

  nlohmann::ordered_json all;
  const auto measure = [&](const std::string& name, auto&& rows) {
    if (only.find(name) != std::string::npos) all[name] = rows();
  };
  using namespace remodel::bench;
  measure("generation", [&] { return generation(rounds, others); });
  measure("large", [&] { return large_generation(rounds, ten_million); });
  measure("adjustment", [&] { return adjustment(rounds); });
  measure("steps", [&] { return step_scale(rounds); });
  if (json) {
    std::cout << all.dump(2) << '\n';
    return 0;
  }
  for (const auto& [name, rows] : all.items()) print_table(name, rows.get<Rows>());
} catch (const std::exception& error) {
  std::cerr << "compare: " << error.what() << '\n';
  return 1;
}
