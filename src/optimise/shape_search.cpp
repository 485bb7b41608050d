#include "optimise/shape_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "remodel/error.h"

namespace remodel {
namespace {

// Bernstein degree elevation by one: b_i = i/(n+1) a_{i-1} + (1 - i/(n+1)) a_i.
void raise(std::vector<double>& coefficients) {
  const std::size_t n = coefficients.size();  // degree + 1 of the old and the degree of the new
  std::vector<double> raised(n + 1);
  raised.front() = coefficients.front();
  raised.back() = coefficients.back();
  for (std::size_t i = 1; i < n; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(n);
    raised[i] = share * coefficients[i - 1] + (1.0 - share) * coefficients[i];
  }
  coefficients = std::move(raised);
}

}  // namespace

void require_same_family(const CstAirfoil& from, const CstAirfoil& to) {
  if (from.e1 != to.e1 || from.e2 != to.e2 || from.te_upper != to.te_upper || from.te_lower != to.te_lower)
    throw Error(ErrorCode::argument, "start and target airfoils",
                "expected the same class exponents and trailing edges: only shape coefficients are searched");
  for (const auto& [airfoil, name] : {std::pair{&from, "start airfoil"}, std::pair{&to, "target airfoil"}}) {
    if (!surfaces_apart(*airfoil)) throw Error(ErrorCode::geometry, name, "its surfaces touch or cross");
  }
}

CstAirfoil raise_degree(const CstAirfoil& airfoil, int degree) {
  CstAirfoil result = airfoil;
  while (result.degree() < degree) {
    raise(result.upper);
    raise(result.lower);
  }
  return result;
}

std::vector<double> coefficients_of(const CstAirfoil& airfoil) {
  std::vector<double> result = airfoil.upper;
  result.insert(result.end(), airfoil.lower.begin(), airfoil.lower.end());
  return result;
}

CstAirfoil with_coefficients(const CstAirfoil& like, const std::vector<double>& coefficients) {
  CstAirfoil result = like;
  const auto middle = coefficients.begin() + static_cast<std::ptrdiff_t>(like.upper.size());
  result.upper.assign(coefficients.begin(), middle);
  result.lower.assign(middle, coefficients.end());
  return result;
}

CachedStation::CachedStation(double t, const CstAirfoil& like) : row_(like.upper.size()) {
  station_ = cst_basis(t, like.degree(), like.e1, like.e2, row_);
}

InterpolationObjective::InterpolationObjective(const CstAirfoil& target) {
  const int all = 2 * stations_per_surface + 2;  // with the trailing and the leading edge, which never move
  for (int i = 1; i < all; ++i) {
    if (i != all / 2) stations_.emplace_back(static_cast<double>(i) / all, target);
  }
  for (const CachedStation& station : stations_) heights_.push_back(station.height(target));
}

double InterpolationObjective::mean_square(const CstAirfoil& design) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    const double distance = stations_[i].height(design) - heights_[i];
    sum += distance * distance;
  }
  return sum / static_cast<double>(stations_.size());
}

double InterpolationObjective::max_error(const CstAirfoil& design) const {
  double largest = 0.0;
  for (std::size_t i = 0; i < stations_.size(); ++i)
    largest = std::max(largest, std::abs(stations_[i].height(design) - heights_[i]));
  return largest;
}

Feasibility::Feasibility(const CstAirfoil& like, const AirfoilDomainOptions& options)
    : farfield_(options.farfield_radius * std::cos(std::numbers::pi / options.farfield_points)) {
  for (int i = 1; i < options.points / 2; ++i) {
    const double t = static_cast<double>(i) / options.points;
    pairs_.push_back({CachedStation(t, like), CachedStation(1.0 - t, like)});
  }
}

bool Feasibility::operator()(const CstAirfoil& design) const {
  if (!surfaces_apart(design)) return false;
  return std::all_of(pairs_.begin(), pairs_.end(), [&](const Pair& pair) {
    const double upper = pair.upper.height(design), lower = pair.lower.height(design);
    const double from_middle = pair.upper.x() - 0.5, reach = std::max(upper, -lower);
    return upper > lower && from_middle * from_middle + reach * reach < farfield_ * farfield_;
  });
}

Cmaes initial_distribution(const CstAirfoil& from, double sigma, std::uint64_t seed) {
  return Cmaes(coefficients_of(from), {.sigma = sigma, .seed = seed, .least_deviation = 1e-12});
}

ShapeSearch::ShapeSearch(const CstAirfoil& like, const AirfoilDomainOptions& domain, Cmaes cmaes)
    : ShapeSearch(like, std::move(cmaes), Feasibility(like, domain)) {}

ShapeSearch::ShapeSearch(const CstAirfoil& like, Cmaes cmaes, Feasible feasible)
    : like_(like), feasible_(std::move(feasible)), cmaes_(std::move(cmaes)) {}

std::optional<Sample> ShapeSearch::next(std::size_t limit) {
  for (std::uint64_t refused = 0; refused < limit; ++refused) {
    std::vector<double> coefficients = cmaes_.ask();
    CstAirfoil design = with_coefficients(like_, coefficients);
    if (feasible_(design)) return Sample{std::move(coefficients), std::move(design), refused};
  }
  return std::nullopt;
}

std::optional<CstAirfoil> ShapeSearch::mean_design() const {
  const auto mean = cmaes_.mean();
  CstAirfoil design = with_coefficients(like_, {mean.begin(), mean.end()});
  if (!feasible_(design)) return std::nullopt;
  return design;
}

}  // namespace remodel
