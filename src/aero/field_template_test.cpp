#include "aero/field_template.h"

#include <gtest/gtest.h>

#include <cmath>

#include "remodel/airfoil.h"
#include "remodel/flow_layer.h"
#include "remodel/generate.h"
#include "remodel/layers.h"

namespace remodel {
namespace {

std::vector<Point> grid(double half, std::size_t count) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count; ++j)
      points.push_back({-half + 2.0 * half * double(i) / double(count - 1) + 0.5,
                        -half + 2.0 * half * double(j) / double(count - 1)});
  return points;
}

FrozenMesh layered(const CstAirfoil& airfoil) {
  const Domain walls = airfoil_domain(airfoil, {.points = 80, .farfield_radius = 5.0});
  return generate_layered(walls, {.first_height = 1e-3, .growth = 1.2, .thickness = 0.02}, {.gradation = 2.0})
      .mesh.freeze();
}

// In triangles and in quadrilaterals alike, which are most of the cells near the wall.
TEST(FieldTemplates, ReproduceALinearFieldExactly) {
  const CstAirfoil airfoil = named_airfoil("naca:0012", 5);
  const FrozenMesh mesh = layered(airfoil);
  ASSERT_GT(mesh.quads.size(), 100U);
  std::vector<double> values;
  for (const Point p : mesh.points) values.push_back(3.0 - 2.0 * p.x + 7.0 * p.y);
  std::vector<Point> points = grid(0.6, 61);
  for (const auto& quad : mesh.quads) {  // their middles too
    Point middle;
    for (const std::uint32_t v : quad)
      middle = {middle.x + mesh.points[v].x / 4, middle.y + mesh.points[v].y / 4};
    points.push_back(middle);
  }
  const std::vector<double> found = TemplatePlaces(mesh, points).at(values);
  std::size_t within = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::isnan(found[i])) continue;
    ++within;
    EXPECT_NEAR(found[i], 3.0 - 2.0 * points[i].x + 7.0 * points[i].y, 1e-12);
  }
  EXPECT_GT(within, points.size() * 9 / 10);
}

TEST(FieldTemplates, HaveNoValuesInTheBodyAndBeyondTheFarField) {
  const CstAirfoil airfoil = named_airfoil("naca:0012", 5);
  const FrozenMesh mesh = layered(airfoil);
  const std::vector<Point> points{{0.3, 0.0}, {0.3, 0.055}, {0.3, 0.065}, {0.5, 3.0}, {0.5, 9.0}};
  const std::vector<double> found =
      TemplatePlaces(mesh, points).at(std::vector<double>(mesh.points.size(), 1.0));
  const bool expected[] = {false, false, true, true, false};  // half of the thickness is 0.06 there
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(!std::isnan(found[i]), expected[i]) << i;
}

}  // namespace
}  // namespace remodel
