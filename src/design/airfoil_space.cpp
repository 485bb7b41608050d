#include "design/airfoil_space.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>

#include "base/checked_json.h"
#include "base/checksum.h"
#include "remodel/error.h"

namespace remodel {

void require_same_family(const CstAirfoil& from, const CstAirfoil& to) {
  if (from.e1 != to.e1 || from.e2 != to.e2 || from.te_upper != to.te_upper || from.te_lower != to.te_lower)
    throw Error(ErrorCode::argument, "start and target airfoils",
                "expected the same class exponents and trailing edges: only shape coefficients are searched");
  for (const auto& [airfoil, name] : {std::pair{&from, "start airfoil"}, std::pair{&to, "target airfoil"}}) {
    if (!surfaces_apart(*airfoil)) throw Error(ErrorCode::geometry, name, "its surfaces touch or cross");
  }
}

std::vector<double> coefficients_of(const CstAirfoil& airfoil) {
  std::vector<double> result = airfoil.upper;
  result.insert(result.end(), airfoil.lower.begin(), airfoil.lower.end());
  return result;
}

CstAirfoil with_coefficients(const CstAirfoil& like, std::span<const double> coefficients) {
  CstAirfoil result = like;
  const auto middle = coefficients.begin() + static_cast<std::ptrdiff_t>(like.upper.size());
  result.upper.assign(coefficients.begin(), middle);
  result.lower.assign(middle, coefficients.end());
  return result;
}

std::string place_to_json(const AirfoilPlace& place) {
  return nlohmann::ordered_json{{"loop", place.loop},
                                {"leading", {place.leading.x, place.leading.y}},
                                {"trailing", {place.trailing.x, place.trailing.y}},
                                {"parameters", place.parameters},
                                {"base", place.base},
                                {"names", place.names},
                                {"first", place.first},
                                {"backwards", place.backwards}}
      .dump();
}

AirfoilPlace place_from_json(const std::string& text) {
  const auto json = nlohmann::json::parse(text);
  const auto point = [&](const char* key) { return Point{json.at(key).at(0), json.at(key).at(1)}; };
  AirfoilPlace place{.loop = count_at(json, "loop"),
                     .leading = point("leading"),
                     .trailing = point("trailing"),
                     .parameters = json.at("parameters").get<std::vector<double>>(),
                     .base = json.at("base").get<std::vector<double>>(),
                     .names = json.at("names").get<std::vector<std::string>>(),
                     .first = count_at(json, "first"),
                     .backwards = json.at("backwards")};
  const std::size_t stations = place.parameters.size() + place.base.size();
  if (place.names.empty() || place.names.size() != stations || place.first >= stations)
    throw std::invalid_argument("place: its names, stations and first station do not fit each other");
  return place;
}

CachedStation::CachedStation(double t, const CstAirfoil& like) : row_(like.upper.size()) {
  station_ = cst_basis(t, like.degree(), like.e1, like.e2, row_);
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

struct AirfoilSpace::Impl {
  CstAirfoil like;
  AirfoilDomainOptions options{};
  std::optional<Feasibility> alone{};  // in a farfield
  std::optional<Domain> others{};      // otherwise: a domain with a place for the airfoil
  AirfoilPlace place{};
  std::vector<CachedStation> stations{};

  void add_stations(const std::vector<double>& parameters) {
    for (const double t : parameters) stations.emplace_back(t, like);
  }
};

AirfoilSpace::AirfoilSpace(const CstAirfoil& start, const AirfoilDomainOptions& options) {
  airfoil_domain(start, options);  // throws for options out of range
  if (options.turning_share.value_or(0.0) > 0.0)
    throw Error(ErrorCode::argument, "turning share",
                "given for designs of a section, expected none: their stations keep their parameters");
  auto impl = std::make_unique<Impl>(Impl{.like = start, .options = options});
  impl->alone.emplace(start, options);
  impl->add_stations(Parameters::uniform(static_cast<std::size_t>(options.points)));
  impl_ = std::move(impl);
}

AirfoilSpace::AirfoilSpace(const CstAirfoil& start, const Domain& others, const AirfoilPlace& place) {
  auto impl = std::make_unique<Impl>(Impl{.like = start, .others = others, .place = place});
  impl->add_stations(place.parameters);
  impl_ = std::move(impl);
}

AirfoilSpace::~AirfoilSpace() = default;

CstAirfoil AirfoilSpace::airfoil(std::span<const double> design) const {
  return with_coefficients(impl_->like, design);
}

std::vector<double> AirfoilSpace::start() const {
  return coefficients_of(impl_->like);
}

Domain AirfoilSpace::domain(std::span<const double> design) const {
  return impl_->others ? with_airfoil(*impl_->others, impl_->place, airfoil(design))
                       : airfoil_domain(airfoil(design), impl_->options);
}

bool AirfoilSpace::feasible(std::span<const double> design) const {
  const CstAirfoil shape = airfoil(design);
  return impl_->alone ? (*impl_->alone)(shape) : surfaces_apart(shape) && DesignSpace::feasible(design);
}

std::vector<Point> AirfoilSpace::outline(std::span<const double> design) const {
  const CstAirfoil shape = airfoil(design);
  std::vector<Point> points;
  points.reserve(impl_->stations.size());
  for (const CachedStation& station : impl_->stations) points.push_back({station.x(), station.height(shape)});
  return points;
}

std::string AirfoilSpace::text(std::span<const double> design) const {
  return airfoil_to_json(airfoil(design));
}

std::string AirfoilSpace::description() const {
  nlohmann::ordered_json json = {{"from", nlohmann::ordered_json::parse(airfoil_to_json(impl_->like))}};
  if (impl_->alone) {
    json["points"] = impl_->options.points;
    json["farfield_radius"] = impl_->options.farfield_radius;
    json["farfield_points"] = impl_->options.farfield_points;
    return json.dump();
  }
  const AirfoilPlace& place = impl_->place;
  Checksum sum;
  for (const double value : place.parameters) sum.add(value);
  for (const double value : place.base) sum.add(value);
  for (const std::string& name : place.names) sum.add(name);
  sum.add(std::uint64_t{place.loop});
  sum.add(domain_to_json(*impl_->others));
  json["place"] = sum.text();
  return json.dump();
}

}  // namespace remodel
