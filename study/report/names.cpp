#include "study/report/names.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <tuple>

#include "remodel/airfoil.h"
#include "study/study_report.h"

namespace remodel {

std::string_view key_of(StudyFigure figure) {
  static constexpr std::array<std::string_view, study_figure_count> keys = {"generation_triangles",
                                                                            "generation_ms",
                                                                            "remodelling_triangles",
                                                                            "remodelling_ms",
                                                                            "preservation_percent",
                                                                            "surplus_percent",
                                                                            "speedup",
                                                                            "lost_triangles",
                                                                            "full_adjustments_percent",
                                                                            "gradation_deviation",
                                                                            "generation_gradation_deviation"};
  return keys[static_cast<std::size_t>(figure)];
}

}  // namespace remodel

namespace remodel::report {

namespace {

const CatalogueEntry* entry_of(std::string_view name) {
  const std::string stem = std::filesystem::path(name).stem().string();
  for (const CatalogueEntry& entry : airfoil_catalogue())
    if (entry.name == name || entry.name == stem) return &entry;
  return nullptr;
}

}  // namespace

std::string catalogue_name(std::string_view name) {
  if (name == "naca:0012") return "naca0012";
  if (name == "naca:2412") return "naca2412";
  const CatalogueEntry* entry = entry_of(name);
  return entry ? std::string(entry->name) : std::string();
}

std::string title_of(std::string_view name) {
  const std::string known = catalogue_name(name);
  const CatalogueEntry* entry = known.empty() ? nullptr : entry_of(known);
  return std::string(entry ? entry->description : name);
}

bool before_by_name(std::string_view a, std::string_view b) {
  const auto rank = [](std::string_view name) {
    const std::string known = catalogue_name(name);
    const auto& catalogue = airfoil_catalogue();
    std::size_t i = 0;
    while (i < catalogue.size() && catalogue[i].name != known) ++i;
    return std::tuple(i, name);
  };
  return rank(a) < rank(b);
}

std::string file_name_of(std::string_view name) {
  std::string result;
  for (const char c : name) {
    const bool plain =
        (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '.';
    result += plain ? c : '_';
  }
  return result;
}

double papers_lost(const PaperRow& row) {
  return row.figures[2] * (1.0 - row.figures[4] / 100.0);
}

std::string exact(double value) {
  if (std::isnan(value)) return "";
  char digits[40];
  std::snprintf(digits, sizeof digits, "%.17g", value);
  return digits;
}

std::string fixed(double value, int decimals) {
  if (std::isnan(value)) return "-";
  char digits[400];
  std::snprintf(digits, sizeof digits, "%.*f", decimals, value);
  return digits;
}

std::string with_sign(double value, int decimals) {
  if (std::isnan(value)) return "-";
  char digits[400];
  std::snprintf(digits, sizeof digits, "%+.*f", decimals, value);
  return digits;
}

std::string short_number(double value) {
  char digits[40];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  return std::string(digits, end);
}

}  // namespace remodel::report
