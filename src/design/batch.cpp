#include "remodel/batch.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "design/airfoil_space.h"
#include "design/design_profile.h"
#include "remodel/error.h"

namespace remodel {
namespace {

// distance(i, j) of two designs by index.
template <class Distance>
std::vector<std::size_t> nearest_neighbours(std::size_t start, std::vector<std::size_t> left,
                                            Distance distance) {
  std::vector<std::size_t> order;
  order.reserve(left.size());
  while (!left.empty()) {
    const std::size_t last = order.empty() ? start : order.back();
    auto nearest = left.end();
    double least = std::numeric_limits<double>::infinity();
    for (auto candidate = left.begin(); candidate != left.end(); ++candidate) {
      const double d = distance(last, *candidate);
      if (nearest != left.end() && !(d < least)) continue;
      nearest = candidate;
      least = d;
    }
    order.push_back(*nearest);
    left.erase(nearest);  // keeps the order of the others: of several the first is taken
  }
  return order;
}

std::vector<DesignProfile> profiles_of(const std::vector<const CstAirfoil*>& designs, int points) {
  if (points < 8 || points % 2 != 0)
    throw Error(ErrorCode::argument, "points",
                "found " + std::to_string(points) + ", expected an even number, at least 8");
  const Parameters parameters = Parameters::uniform(static_cast<std::size_t>(points));
  std::vector<DesignProfile> profiles;
  for (const CstAirfoil* design : designs) {
    std::vector<Point> outline;
    for (const double t : parameters) outline.push_back(design->at(t));
    profiles.emplace_back(std::move(outline));
  }
  return profiles;
}

std::vector<std::vector<double>> coefficients_of_all(const std::vector<const CstAirfoil*>& designs) {
  int degree = 0;
  for (const CstAirfoil* design : designs) {
    if (design->e1 != designs.front()->e1 || design->e2 != designs.front()->e2)
      throw Error(ErrorCode::argument, "designs",
                  "found other class exponents, expected the same in all for a distance of coefficients");
    degree = std::max(degree, design->degree());
  }
  std::vector<std::vector<double>> result;
  for (const CstAirfoil* design : designs) result.push_back(coefficients_of(raise_degree(*design, degree)));
  return result;
}

}  // namespace

std::vector<std::size_t> order_designs(const CstAirfoil& start, const std::vector<CstAirfoil>& designs,
                                       const OrderOptions& options) {
  std::vector<const CstAirfoil*> all;
  for (const CstAirfoil& design : designs) all.push_back(&design);
  all.push_back(&start);
  std::vector<std::size_t> indices(designs.size());
  std::iota(indices.begin(), indices.end(), std::size_t{0});

  if (options.distance == DesignDistance::displacement) {
    const std::vector<DesignProfile> profiles = profiles_of(all, options.points);
    return nearest_neighbours(designs.size(), std::move(indices), [&](std::size_t a, std::size_t b) {
      return squared_displacement(profiles[a], profiles[b]);
    });
  }
  const std::vector<std::vector<double>> coefficients = coefficients_of_all(all);
  return nearest_neighbours(designs.size(), std::move(indices), [&](std::size_t a, std::size_t b) {
    return std::transform_reduce(coefficients[a].begin(), coefficients[a].end(), coefficients[b].begin(), 0.0,
                                 std::plus<>(), [](double x, double y) { return (x - y) * (x - y); });
  });
}

}  // namespace remodel
