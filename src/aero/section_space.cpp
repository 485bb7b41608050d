#include "aero/section_space.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

namespace remodel {

namespace {

// The upper surface is a polyline of this many pieces between stations, evenly in the section's own
// parameter: vertices that refinement adds in the middle of edges lie on the section too.
constexpr int pieces_between = 8;

// From the trailing edge to the leading edge.
std::vector<double> parameters_of(int points) {
  const int pieces = points / 2 * pieces_between;
  std::vector<double> list;
  for (int i = 0; i <= pieces; ++i) list.push_back(0.5 * i / pieces);
  return list;
}

Domain half_domain(const CstAirfoil& airfoil, const AirfoilDomainOptions& options) {
  std::vector<Point> upper;
  for (const double t : parameters_of(options.points)) upper.push_back(airfoil.at(t));
  upper.front().y = upper.back().y = 0.0;
  const double radius = options.farfield_radius;
  const Point front = {0.5 - radius, 0.0}, behind = {0.5 + radius, 0.0};
  const Point leading = upper.back(), trailing = upper.front();
  return {{Loop{.role = LoopRole::outer,
                .curves = {{"airfoil", Polyline{std::move(upper)},
                            Parameters::uniform(static_cast<std::size_t>(options.points / 2))},
                           {"symmetry", Line{leading, front}, {0.0}},
                           {"farfield", Arc{{0.5, 0.0}, radius, std::numbers::pi, -std::numbers::pi},
                            Parameters::uniform(static_cast<std::size_t>(options.farfield_points / 2))},
                           {"symmetry", Line{behind, trailing}, {0.0}}}}}};
}

}  // namespace

SectionSpace::SectionSpace(const CstAirfoil& start, const SectionSpaceOptions& options)
    : like_(start), options_(options), space_(start, options.domain) {
  if (!options_.half) return;
  for (const double t : parameters_of(options_.domain.points)) {
    rows_.emplace_back(like_.upper.size());
    cst_basis(t, like_.degree(), like_.e1, like_.e2, rows_.back());
  }
}

std::vector<double> SectionSpace::coefficients(std::span<const double> design) const {
  std::vector<double> both(design.begin(), design.end());
  if (options_.symmetric)
    for (const double x : design) both.push_back(-x);
  return both;
}

std::vector<double> SectionSpace::gradient(std::span<const double> by_coefficients) const {
  const std::size_t n = like_.upper.size();
  std::vector<double> result(by_coefficients.begin(),
                             by_coefficients.begin() + static_cast<std::ptrdiff_t>(2 * n));
  if (!options_.symmetric) return result;
  for (std::size_t i = 0; i < n; ++i) result[i] -= result[n + i];
  result.resize(n);
  return result;
}

std::vector<double> SectionSpace::gradient_of_domain(std::span<const double> by_numbers) const {
  // A whole domain begins with the coefficients of its airfoil, a half one with x and y of the polyline's
  // points.
  if (!options_.half) return gradient(by_numbers);
  std::vector<double> result(like_.upper.size(), 0.0);
  for (std::size_t j = 0; j < rows_.size(); ++j)
    for (std::size_t i = 0; i < result.size(); ++i) result[i] += by_numbers[2 * j + 1] * rows_[j][i];
  return result;
}

Domain SectionSpace::domain_of(const CstAirfoil& airfoil, int points) const {
  AirfoilDomainOptions domain = options_.domain;
  domain.points = points;
  return options_.half ? half_domain(airfoil, domain) : airfoil_domain(airfoil, domain);
}

DesignBounds SectionSpace::bounds(double coefficients) const {
  DesignBounds result{start(), start()};
  for (double& x : result.low) x -= coefficients;
  for (double& x : result.high) x += coefficients;
  return result;
}

std::vector<double> SectionSpace::metric() const {
  constexpr int pieces = 400;
  constexpr double floor = 1e-3;  // in parts of the mean of the diagonal
  const std::size_t n = like_.upper.size(), all = options_.symmetric ? n : 2 * n;
  std::vector<double> of_surface(n * n, 0.0), row(n), before(n);
  for (int i = 0; i <= pieces; ++i) {
    cst_basis(0.5 * i / pieces, like_.degree(), like_.e1, like_.e2, row);
    for (std::size_t j = 0; i > 0 && j < n; ++j)
      for (std::size_t k = 0; k < n; ++k)
        of_surface[j * n + k] += (row[j] - before[j]) * (row[k] - before[k]);
    std::swap(row, before);
  }
  double mean = 0.0;
  for (std::size_t j = 0; j < n; ++j) mean += of_surface[j * n + j] / static_cast<double>(n);
  std::vector<double> result(all * all, 0.0);
  for (std::size_t j = 0; j < all; ++j)
    for (std::size_t k = 0; k < n; ++k)
      result[j * all + (j < n ? 0 : n) + k] = of_surface[j % n * n + k] / mean + (j % n == k ? floor : 0.0);
  return result;
}

std::vector<double> SectionSpace::start() const {
  std::vector<double> both = space_.start();
  if (options_.symmetric) both.resize(like_.upper.size());
  return both;
}

std::string SectionSpace::description() const {
  return nlohmann::ordered_json{{"half", options_.half},
                                {"space", nlohmann::ordered_json::parse(space_.description())}}
      .dump();
}

CstAirfoil symmetric_start(CstAirfoil airfoil, const ProblemPlace& place) {
  constexpr double rounding = 1e-4;  // of files with four decimals, in chords
  constexpr int stations = 40;
  double worst = std::fabs(airfoil.te_upper + airfoil.te_lower);
  for (int i = 1; i < stations; ++i) {
    const double t = 0.5 * i / stations;
    worst = std::max(worst, std::fabs(airfoil.at(t).y + airfoil.at(1.0 - t).y));
  }
  if (worst > rounding)
    place.fail("found an airfoil as 'airfoil' whose surfaces differ by " + shown(worst) +
               " chords, expected a symmetric one for 'symmetric'");
  airfoil.te_lower = -airfoil.te_upper;
  for (std::size_t i = 0; i < airfoil.upper.size(); ++i) airfoil.lower[i] = -airfoil.upper[i];
  return airfoil;
}

FrozenMesh mirrored(const FrozenMesh& half) {
  FrozenMesh whole;
  whole.points = half.points;
  whole.triangles = half.triangles;
  std::vector<std::uint32_t> image(half.points.size());
  for (std::uint32_t p = 0; p < image.size(); ++p) {
    image[p] = p;
    if (half.points[p].y == 0.0) continue;
    image[p] = static_cast<std::uint32_t>(whole.points.size());
    whole.points.push_back({half.points[p].x, -half.points[p].y});
  }
  whole.fate = half.fate;
  whole.fate.insert(whole.fate.end(), half.fate.begin(), half.fate.end());
  for (const auto& [a, b, c] : half.triangles) whole.triangles.push_back({image[a], image[c], image[b]});
  for (const auto& boundary : half.boundaries) {
    if (boundary.name == "symmetry") continue;
    whole.boundaries.push_back(boundary);
    // Backwards, so that they go on where the others end.
    for (auto edge = boundary.edges.rbegin(); edge != boundary.edges.rend(); ++edge)
      whole.boundaries.back().edges.push_back({image[(*edge)[1]], image[(*edge)[0]]});
  }
  return whole;
}

std::vector<double> mirrored(const FrozenMesh& half, const std::vector<double>& values, double sign) {
  std::vector<double> whole = values;
  for (std::size_t p = 0; p < values.size(); ++p)
    if (half.points[p].y != 0.0) whole.push_back(sign * values[p]);
  return whole;
}

}  // namespace remodel
