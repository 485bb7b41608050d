#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "remodel/airfoil.h"
#include "remodel/error.h"
#include "test_layers.h"

namespace remodel::test {
namespace {

Domain section_with(const char* name, double thickness) {
  Domain domain = airfoil_domain(named_airfoil(name, 8));
  space_walls(domain, {.leading_edge = 0.004, .trailing_edge = 0.004, .most = 0.03, .growth = 0.2});
  add_wake(domain, {.length = 1.0, .direction = {1.0, 0.05}}, {.first_height = 1e-4, .thickness = thickness});
  return domain;
}

std::size_t edges_of_wake(const FrozenMesh& mesh) {
  const auto wake = std::find_if(mesh.boundaries.begin(), mesh.boundaries.end(),
                                 [](const FrozenBoundary& boundary) { return boundary.name == "wake"; });
  return wake == mesh.boundaries.end() ? 0 : wake->edges.size();
}

// The outer mesh keeps a loop that is its own but for rounding: so have the walls to.
TEST(Wake, ALineThatIsOffByARoundingStaysTheOneOfTheMesh) {
  const LayerOptions layers{.first_height = 1e-4, .growth = 1.4, .thickness = 0.02};
  LayeredMesh mesh =
      generate_layered(section_with("rae2822", layers.thickness), layers, {.gradation = 8.0}).mesh;
  Domain design = section_with("naca:2412", layers.thickness);
  design.loops.back() = mesh.domain().loops.back();
  const Loop own = design.loops.back();
  Point& end = std::get<Line>(design.loops.back().curves.front().shape).to;
  end.x = std::nextafter(end.x, 3.0), end.y = std::nextafter(end.y, 1.0);
  remodel(mesh, design);
  EXPECT_EQ(mesh.domain().loops.back(), own);
  EXPECT_EQ(mesh.outer().domain().loops.back(), own);
  EXPECT_NO_THROW(LayeredMesh::restore(mesh.state(), "mesh"));
}

TEST(Wake, LiesBehindTheEdgeAndLeavesTheLayerAsItIs) {
  const LayerOptions layers{.first_height = 1e-4, .growth = 1.4, .thickness = 0.02};
  const Domain domain = section_with("rae2822", layers.thickness);
  Domain without = domain;
  without.loops.pop_back();
  LayeredMesh mesh = generate_layered(domain, layers, {.gradation = 8.0}).mesh;
  const LayeredMesh plain = generate_layered(without, layers, {.gradation = 8.0}).mesh;
  EXPECT_EQ(mesh.statistics().thickness.least, plain.statistics().thickness.least);
  const std::vector<Point> wake = domain.points(domain.loops.size() - 1);
  EXPECT_GT(wake.front().x, 1.0 + layers.thickness);
  EXPECT_NEAR(distance(wake.front(), wake.back()), 1.0, 1e-12);
  for (std::size_t i = 2; i < wake.size(); ++i)
    EXPECT_LT(distance(wake[i], wake[i - 1]), 1.6 * distance(wake[i - 1], wake[i - 2]));
  const std::size_t stations = wake.size() - 1;
  EXPECT_GE(edges_of_wake(mesh.freeze()), stations);
  for (const Strategy strategy : {Strategy::reference, Strategy::morph, Strategy::renew})
    for (const char* name : {"naca:2412", "rae2822"}) {
      const LayeredRemodelResult result =
          remodel(mesh, section_with(name, layers.thickness), {.strategy = strategy});
      EXPECT_FALSE(result.regenerated);
      EXPECT_EQ(mesh.quick_check(), "");
      EXPECT_GE(edges_of_wake(mesh.freeze()), stations);
    }
}

TEST(Wake, RefusesWhatMakesNoLine) {
  Domain domain = airfoil_domain(named_airfoil("rae2822", 8));
  const LayerOptions layers{.first_height = 1e-4};
  EXPECT_THROW(add_wake(domain, {.length = 0.0}, layers), Error);
  EXPECT_THROW(add_wake(domain, {.direction = {0.0, 0.0}}, layers), Error);
  EXPECT_THROW(add_wake(domain, {.growth = 0.5}, layers), Error);
  EXPECT_THROW(add_wake(domain, {.first = 0.1, .most = 0.01}, layers), Error);
  EXPECT_EQ(domain.loops.size(), 2U);
}

}  // namespace
}  // namespace remodel::test
