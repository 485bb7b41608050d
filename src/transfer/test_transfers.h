#pragma once

// Designs and values that the tests of transfers share.

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "mesh/mesh_data.h"
#include "remodel/airfoil.h"
#include "remodel/domain.h"
#include "remodel/field.h"
#include "remodel/mesh.h"
#include "step/test_designs.h"
#include "support.h"

namespace remodel::test {

inline double linear(Point p) {
  return 1.0 + 0.3 * p.x - 0.7 * p.y;
}

// Values of a living mesh by ids, value(point, component): at vertices, or at the centroids of triangles.
template <class Value>
std::vector<double> values_by_id(const Mesh& mesh, FieldPlace place, std::size_t components, Value value) {
  const Triangulation& triangulation = mesh.data().triangulation;
  const FrozenMesh frozen = mesh.freeze();
  const bool at_vertices = place == FieldPlace::vertices;
  std::vector<double> values(
      components * (at_vertices ? triangulation.vertex_slots() : triangulation.triangle_slots()), 0.0);
  const std::vector<std::uint32_t>& ids = at_vertices ? frozen.vertex_ids : frozen.triangle_ids;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    Point p = at_vertices ? frozen.points[i] : Point{};
    if (!at_vertices)
      for (const std::uint32_t v : frozen.triangles[i]) p = p + (1.0 / 3.0) * frozen.points[v];
    for (std::size_t k = 0; k < components; ++k) values[components * ids[i] + k] = value(p, k);
  }
  return values;
}

enum class Family { airfoils, flaps, ducts };
inline std::string name_of(Family family) {
  return family == Family::airfoils ? "airfoils" : family == Family::flaps ? "flaps" : "ducts";
}

// One design after another: small steps, and a large one now and then.
class Designs {
 public:
  Designs(Family family, std::mt19937_64& random)
      : family_(family), random_(random), walk_(2, 0.06, random) {}

  Domain next() {
    const double size = count_++ % 7 == 0 ? 1.0 : 0.05;
    if (family_ == Family::airfoils) {
      if (size == 1.0) walk_.next();
      return airfoil_domain(size == 1.0 ? walk_.airfoil() : walk_.sample(1e-3),
                            {.points = 40, .farfield_points = 16});
    }
    for (double& setting : settings_)
      setting = size == 1.0 ? uniform(random_, -1.0, 1.0)
                            : std::clamp(setting + size * uniform(random_, -1.0, 1.0), -1.0, 1.0);
    return family_ == Family::flaps ? flap() : duct();
  }

 private:
  Domain flap() const {
    const CstAirfoil section = airfoil_catalogue()[2].airfoil();
    return airfoils_domain({{.name = "main", .airfoil = section},
                            {.name = "flap",
                             .airfoil = section,
                             .placement = {0.3,
                                           -20.0 - 10.0 * settings_[0],
                                           {1.02 + 0.02 * settings_[1], -0.06 - 0.02 * settings_[2]}}}},
                           {.points = 40, .farfield_points = 16});
  }

  // A channel whose upper wall has a throat, with a strut behind it.
  Domain duct() const {
    Domain domain{{polygon(LoopRole::outer, "wall",
                           {{0, 0},
                            {3, 0},
                            {3, 1},
                            {2, 1},
                            {1.2 + 0.1 * settings_[0], 0.6 + 0.1 * settings_[1]},
                            {0.5, 1},
                            {0, 1}},
                           4)}};
    domain.loops.push_back(circle_hole(2.2 + 0.1 * settings_[2], 0.45, 0.12));
    return domain;
  }

  Family family_;
  std::mt19937_64& random_;
  Walk walk_;
  int count_ = 0;
  double settings_[3] = {0.0, 0.0, 0.0};
};

}  // namespace remodel::test
