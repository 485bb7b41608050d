// Layers that follow designs: valid after every step, with the same columns for a whole run.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>

#include "remodel/airfoil.h"
#include "test_layers.h"

namespace remodel::test {
namespace {

const QualityOptions slack{.gradation = 8.0, .refine_angle_deg = 32.0};

Domain walls_of(const CstAirfoil& airfoil) {
  Domain domain = airfoil_domain(airfoil);
  space_walls(domain, {});
  return domain;
}

Domain with_airfoil(Domain domain, const CstAirfoil& airfoil) {
  domain.loops[0].curves[0].shape = airfoil;
  return domain;
}

class Walk {
 public:
  explicit Walk(unsigned seed) : random_(seed) {}
  // Each coefficient by a normal deviate; the sum of twelve uniform ones is near enough, and the same everywhere.
  CstAirfoil near(const CstAirfoil& airfoil, double sigma) {
    CstAirfoil result = airfoil;
    for (auto* surface : {&result.upper, &result.lower})
      for (double& y : *surface) {
        double sum = -6.0;
        for (int k = 0; k < 12; ++k) sum += static_cast<double>(random_()) / 4294967296.0;
        y += sigma * sum;
      }
    return result;
  }

 private:
  std::mt19937 random_;
};

void expect_sound(const LayeredMesh& mesh, const LayeredRemodelResult& result, const std::string& place) {
  ASSERT_EQ(mesh.quick_check(), "") << place;
  ASSERT_EQ(why_no_mesh(mesh.freeze(), mesh.domain()), "") << place;
  ASSERT_TRUE(result.same_columns) << place;
  ASSERT_FALSE(result.regenerated || result.abandoned) << place;
  ASSERT_EQ(mesh.shrunk(), 0) << place;
  ASSERT_EQ(result.triangles, mesh.cells()) << place;
}

TEST(LayerWalk, EveryMeshOfEveryStrategyIsValidAndKeepsItsLayer) {
  for (const Strategy strategy : {Strategy::renew, Strategy::morph, Strategy::reference}) {
    const CstAirfoil airfoil = named_airfoil("naca:0012", 8);
    LayeredMesh mesh = generate_layered(walls_of(airfoil), layer_options(), slack).mesh;
    const LayerTopology columns = mesh.topology();
    const Domain domain = mesh.domain();
    Walk walk(1);
    double least = 100.0;
    for (int step = 0; step < 15; ++step) {
      const LayeredRemodelResult result =
          remodel(mesh, with_airfoil(domain, walk.near(airfoil, 0.02)), {.strategy = strategy});
      expect_sound(mesh, result, std::string(name_of(strategy)) + ", step " + std::to_string(step));
      if (testing::Test::HasFatalFailure()) return;
      least = std::min(least, result.connectivity_percent());
      ASSERT_EQ(mesh.topology().wall, columns.wall);
    }
    EXPECT_GT(least, strategy == Strategy::renew ? 95.0 : 99.5) << name_of(strategy);
  }
}

TEST(LayerWalk, AFlapMovesInItsGap) {
  for (const Strategy strategy : {Strategy::morph, Strategy::reference}) {
    const auto design = [](double gap, double deflection) {
      return airfoils_domain({{.name = "main", .airfoil = named_airfoil("naca:4412", 8)},
                              {.name = "flap",
                               .airfoil = named_airfoil("naca:0012", 8),
                               .placement = {.chord = 0.3, .rotation_deg = -deflection, .position = {0.97, -0.02 - gap}}}});
    };
    Domain domain = design(0.02, 20.0);
    space_walls(domain, {});
    LayeredMesh mesh = generate_layered(domain, layer_options(), slack).mesh;
    for (int step = 0; step < 12; ++step) {
      Domain next = domain;
      next.loops[1].placement = design(0.02 - 0.0013 * step, 20.0 + 0.5 * (step % 7)).loops[1].placement;
      const LayeredRemodelResult result = remodel(mesh, next, {.strategy = strategy});
      expect_sound(mesh, result, std::string(name_of(strategy)) + ", step " + std::to_string(step));
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

TEST(LayerWalk, FromSectionToSectionFansFollowTheirCorners) {
  LayeredMesh mesh = generate_layered(walls_of(named_airfoil("naca:0012", 8)), layer_options(), slack).mesh;
  const Domain domain = mesh.domain();
  for (const CatalogueEntry& entry : airfoil_catalogue()) {
    remodel(mesh, with_airfoil(domain, entry.airfoil()), {.strategy = Strategy::morph});
    ASSERT_EQ(mesh.quick_check(), "") << entry.name;
    ASSERT_EQ(why_no_mesh(mesh.freeze(), mesh.domain()), "") << entry.name;
  }
}

// Seven designs in a row: where coordinates are an analytic function of the design, the sixth differences are
// rounding.
TEST(LayerWalk, UnderReferenceCoordinatesAreASmoothFunctionOfTheDesign) {
  const CstAirfoil airfoil = named_airfoil("rae2822", 8);
  LayeredMesh mesh = generate_layered(walls_of(airfoil), layer_options(), slack).mesh;
  const Domain domain = mesh.domain();
  std::vector<std::vector<Point>> row;
  for (int k = 0; k < 7; ++k) {
    CstAirfoil design = airfoil;
    for (std::size_t i = 0; i < design.upper.size(); ++i) {
      design.upper[i] += 0.001 * k * (i % 2 == 0 ? 1.0 : 0.6);
      design.lower[i] += 0.001 * k * (i % 3 == 0 ? -0.3 : 0.4);
    }
    const LayeredRemodelResult result =
        remodel(mesh, with_airfoil(domain, design), {.strategy = Strategy::reference});
    ASSERT_TRUE(result.held);
    ASSERT_TRUE(result.same_columns);
    row.push_back(mesh.freeze().points);
    ASSERT_EQ(row.back().size(), row.front().size());
  }
  double sixth = 0.0, first = 0.0;
  constexpr std::array binomials{1.0, -6.0, 15.0, -20.0, 15.0, -6.0, 1.0};
  for (std::size_t p = 0; p < row[0].size(); ++p) {
    Point sum;
    for (std::size_t k = 0; k < 7; ++k) sum = sum + binomials[k] * row[k][p];
    sixth = std::max(sixth, std::max(std::abs(sum.x), std::abs(sum.y)));
    first = std::max(first, distance(row[0][p], row[1][p]));
  }
  EXPECT_GT(first, 1e-4);
  EXPECT_LT(sixth, 2e-12);
}

}  // namespace
}  // namespace remodel::test
