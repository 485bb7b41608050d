#pragma once

// Designs that several tests remodel to.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "remodel/airfoil.h"
#include "remodel/domain.h"
#include "remodel/generate.h"

namespace remodel::test {

inline Domain catalogue_domain(std::size_t airfoil, int points) {
  return airfoil_domain(airfoil_catalogue()[airfoil].airfoil(), {.points = points});
}

inline Mesh generated(const Domain& domain, const QualityOptions& options) {
  GenerateResult result = generate(domain, options);
  EXPECT_EQ(result.stopped, Stopped::done);
  return std::move(result.mesh);
}

inline Loop loop(LoopRole role, std::string name, Shape shape, std::size_t stations) {
  return {role, {{std::move(name), std::move(shape), Parameters::uniform(stations)}}};
}

// A closed polygon with every side in the given number of pieces.
inline Loop polygon(LoopRole role, std::string name, std::vector<Point> corners, std::size_t pieces = 1) {
  const std::size_t sides = corners.size();
  corners.push_back(corners.front());
  return loop(role, std::move(name), Polyline{std::move(corners)}, sides * pieces);
}

inline Loop rectangle(LoopRole role, std::string name, Point low, Point high, std::size_t pieces = 1) {
  return polygon(role, std::move(name), {low, {high.x, low.y}, high, {low.x, high.y}}, pieces);
}

inline Loop square_hole(double x, double y, double r, std::size_t pieces = 2) {
  return rectangle(LoopRole::hole, "hole", {x - r, y - r}, {x + r, y + r}, pieces);
}

inline Loop circle_hole(double x, double y, double r, std::size_t stations = 16) {
  return loop(LoopRole::hole, "hole", Arc{.centre = {x, y}, .radius = r}, stations);
}

inline Loop star_hole(double x, double y, double r, std::size_t tips = 5) {
  std::vector<Point> corners;
  for (std::size_t i = 0; i < 2 * tips; ++i) {
    const double angle = std::numbers::pi * static_cast<double>(i) / static_cast<double>(tips);
    const double radius = i % 2 == 0 ? r : 0.5 * r;
    corners.push_back({x + radius * std::cos(angle), y + radius * std::sin(angle)});
  }
  return polygon(LoopRole::hole, "hole", corners);
}

// The unit square with holes in it.
inline Domain with_holes(std::vector<Loop> holes) {
  Domain domain{{rectangle(LoopRole::outer, "outer", {0, 0}, {1, 1}, 4)}};
  for (Loop& hole : holes) domain.loops.push_back(std::move(hole));
  return domain;
}

// Designs as an optimiser samples them: about a mean that drifts, airfoils with crossing surfaces left out.
class Walk {
 public:
  Walk(std::size_t airfoil, double sigma, std::mt19937_64& random)
      : mean_(airfoil_catalogue()[airfoil].airfoil()), here_(mean_), sigma_(sigma), random_(random) {}

  Domain domain(int points) const { return airfoil_domain(here_, {.points = points}); }
  const CstAirfoil& airfoil() const { return here_; }
  CstAirfoil sample(double sigma) {
    for (;;) {
      CstAirfoil result = mean_;
      for (std::vector<double>* surface : {&result.upper, &result.lower})
        for (double& c : *surface) c += sigma * normal();
      if (surfaces_apart(result)) return result;
    }
  }
  void next() {
    here_ = sample(sigma_);
    if (random_() % 8 == 0) mean_ = here_;
  }

 private:
  // Twelve uniform numbers: the same on every machine, unlike std::normal_distribution.
  double normal() {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += static_cast<double>(random_() >> 11) * 0x1p-53;
    return sum;
  }

  CstAirfoil mean_, here_;
  double sigma_;
  std::mt19937_64& random_;
};

}  // namespace remodel::test
