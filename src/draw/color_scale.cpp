#include "draw/color_scale.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <span>

#include "remodel/error.h"

namespace remodel::draw_detail {

namespace {

double min_angle_deg(const FrozenMesh& mesh, std::span<const std::uint32_t> corners) {
  const std::size_t n = corners.size();
  double least = std::numbers::pi;
  for (std::size_t k = 0; k < n; ++k) {
    const Point at = mesh.points[corners[k]];
    const Point p = mesh.points[corners[(k + 1) % n]] - at, q = mesh.points[corners[(k + n - 1) % n]] - at;
    least = std::min(least, std::atan2(std::abs(cross(p, q)), dot(p, q)));
  }
  return least * 180.0 / std::numbers::pi;
}

ColorScale quality_scale(const FrozenMesh& mesh, const std::vector<std::uint32_t>& cells) {
  constexpr double worst = 20.0;
  constexpr double best = 60.0;
  ColorScale scale{"Minimum angle", "20\u00b0", "60\u00b0", {}};
  for (const auto cell : cells) {
    const double angle = min_angle_deg(mesh, mesh.cell(cell));
    scale.positions.push_back(std::clamp((angle - worst) / (best - worst), 0.0, 1.0));
  }
  return scale;
}

ColorScale length_scale_scale(const FrozenMesh& mesh, const std::vector<std::uint32_t>& cells) {
  if (mesh.length_scale.empty()) {
    throw Error(ErrorCode::argument, "color length-scale",
                "a mesh without length scales found, one with them expected");
  }
  std::vector<double> logarithms;
  for (const auto cell : cells) {
    double sum = 0.0;
    for (const auto vertex : mesh.cell(cell)) sum += mesh.length_scale[vertex];
    logarithms.push_back(std::log(std::max(sum / static_cast<double>(mesh.cell(cell).size()), 1e-300)));
  }
  if (logarithms.empty()) return {"Length scale (logarithmic)", "", "", {}};
  const auto [low, high] = std::minmax_element(logarithms.begin(), logarithms.end());
  ColorScale scale{"Length scale (logarithmic)", label_of(std::exp(*low)), label_of(std::exp(*high)), {}};
  const double range = std::max(*high - *low, 1e-12);
  for (const double value : logarithms) scale.positions.push_back((value - *low) / range);
  return scale;
}

ColorScale age_scale(const FrozenMesh& mesh, const std::vector<std::uint32_t>& cells) {
  if (mesh.birth.empty()) {
    throw Error(ErrorCode::argument, "color age", "a mesh without birth steps found, one with them expected");
  }
  const auto [oldest, newest] = std::minmax_element(mesh.birth.begin(), mesh.birth.end());
  const double range = std::max(1.0, static_cast<double>(*newest - *oldest));
  ColorScale scale{"Age in remodelling steps", std::to_string(*newest - *oldest), "0", {}};
  for (const auto cell : cells) {
    // Cells of layers have no births: they are there from the beginning.
    const std::uint32_t birth = cell < mesh.birth.size() ? mesh.birth[cell] : *oldest;
    scale.positions.push_back(1.0 - static_cast<double>(*newest - birth) / range);
  }
  return scale;
}

// From half of the size that the design allows to twice that: what is beyond has the colour of the end.
ColorScale gradation_scale(const FrozenMesh& mesh, const std::vector<std::uint32_t>& cells) {
  if (mesh.gradation_error.empty()) {
    throw Error(ErrorCode::argument, "color gradation",
                "a mesh without gradation errors found, one with them expected");
  }
  constexpr double most = std::numbers::ln2;
  ColorScale scale{"ln(r / (H mean LS*))", "\u2212ln 2: half", "ln 2: twice", {}, ColorMap::diverging};
  for (const auto cell : cells)
    scale.positions.push_back(cell < mesh.gradation_error.size()
                                  ? std::clamp(0.5 + 0.5 * mesh.gradation_error[cell] / most, 0.0, 1.0)
                                  : 0.5);
  return scale;
}

ColorScale fate_scale(const FrozenMesh& mesh, const std::vector<std::uint32_t>& cells) {
  if (mesh.fate.empty()) {
    throw Error(ErrorCode::argument, "color fate", "a mesh without fates found, one with them expected");
  }
  ColorScale scale{"Kept, moved, new:", "", "", {}, ColorMap::embers, 3};
  for (const auto cell : cells) scale.positions.push_back(0.5 * static_cast<double>(mesh.fate[cell]));
  return scale;
}

ColorScale region_scale(const FrozenMesh& mesh, const std::vector<std::uint32_t>& cells) {
  if (mesh.region.empty())
    throw Error(ErrorCode::argument, "color region", "a mesh of one region found, one with several expected");
  const auto last = static_cast<double>(std::max<std::size_t>(mesh.region_names.size(), 2) - 1);
  ColorScale scale{"Regions", "", "", {}, ColorMap::tints, static_cast<int>(last) + 1};
  for (std::size_t i = 0; i < mesh.region_names.size(); ++i)
    scale.title += (i == 0 ? " " : ", ") + mesh.region_names[i];
  scale.title += ":";
  for (const auto cell : cells) scale.positions.push_back(mesh.region[cell] / last);
  return scale;
}

// Linear between samples at equal distances.
template <std::size_t n>
Color between(const std::array<std::array<int, 3>, n>& samples, double t) {
  const double at = std::clamp(t, 0.0, 1.0) * (n - 1);
  const auto below = std::min(static_cast<std::size_t>(at), n - 2);
  const double part = at - static_cast<double>(below);
  const auto mixed = [&](std::size_t k) {
    return ((1.0 - part) * samples[below][k] + part * samples[below + 1][k]) / 255.0;
  };
  return {mixed(0), mixed(1), mixed(2)};
}

// Seventeen samples of the map "viridis" (van der Walt and Smith 2015, public domain).
constexpr std::array<std::array<int, 3>, 17> viridis = {{{68, 1, 84},
                                                         {72, 24, 106},
                                                         {71, 45, 123},
                                                         {66, 64, 134},
                                                         {59, 82, 139},
                                                         {51, 99, 141},
                                                         {44, 114, 142},
                                                         {38, 130, 142},
                                                         {33, 145, 140},
                                                         {31, 160, 136},
                                                         {40, 174, 128},
                                                         {63, 188, 115},
                                                         {94, 201, 98},
                                                         {132, 212, 75},
                                                         {173, 220, 48},
                                                         {216, 226, 25},
                                                         {253, 231, 37}}};
// Blue to red over grey, as light at both ends.
constexpr std::array<std::array<int, 3>, 9> blue_to_red = {{{59, 76, 192},
                                                            {98, 130, 234},
                                                            {141, 176, 254},
                                                            {184, 208, 249},
                                                            {221, 221, 221},
                                                            {245, 196, 173},
                                                            {244, 154, 123},
                                                            {222, 96, 77},
                                                            {180, 4, 38}}};

// What stays is calm, what is new glows.
constexpr std::array<std::array<int, 3>, 3> embers = {{{236, 240, 244}, {253, 200, 110}, {222, 60, 30}}};

// As light as each other, so that the edges are seen on all of them.
constexpr std::array<std::array<int, 3>, 5> tints = {
    {{158, 202, 240}, {252, 194, 120}, {160, 216, 160}, {240, 170, 190}, {205, 205, 205}}};

}  // namespace

Color color_at(ColorMap map, double t) {
  switch (map) {
    case ColorMap::sequential:
      break;
    case ColorMap::diverging:
      return between(blue_to_red, t);
    case ColorMap::embers:
      return between(embers, t);
    case ColorMap::tints:
      return between(tints, t);
  }
  return between(viridis, t);
}

double dark_end(ColorMap map) {
  return map == ColorMap::sequential ? 0.2 : 0.0;
}

ColorScale color_scale(const FrozenMesh& mesh, const std::vector<std::uint32_t>& cells, DrawColor color) {
  switch (color) {
    case DrawColor::quality:
      break;
    case DrawColor::length_scale:
      return length_scale_scale(mesh, cells);
    case DrawColor::age:
      return age_scale(mesh, cells);
    case DrawColor::fate:
      return fate_scale(mesh, cells);
    case DrawColor::region:
      return region_scale(mesh, cells);
    case DrawColor::gradation:
      return gradation_scale(mesh, cells);
  }
  return quality_scale(mesh, cells);
}

std::string label_of(double value) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.4g", value);
  return digits;
}

}  // namespace remodel::draw_detail
