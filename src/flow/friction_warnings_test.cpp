// What is said of flows with friction before their coefficients are used.

#include "flow/friction_warnings.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "flow/solution.h"
#include "remodel/layers.h"

namespace remodel::flow {
namespace {

bool says(const std::vector<std::string>& warnings, const std::string& words) {
  return std::any_of(warnings.begin(), warnings.end(),
                     [&](const std::string& w) { return w.find(words) != std::string::npos; });
}

FrozenMesh layered_section(const LayerOptions& layer) {
  Domain domain = airfoil_domain(named_airfoil("naca:0012", 5), {});
  space_walls(domain, WallSpacing{}.times(3.0));
  return generate_layered(domain, layer, {.gradation = 8.0}).mesh.freeze();
}

TEST(FrictionWarnings, SayThatALayerIsTooThin) {
  const FlowConditions conditions = {.mach = 0.3, .alpha_deg = 2.0, .reynolds = 5e3};
  const FlowOptions options = {.model = FlowModel::laminar};
  LayerOptions layer = {.first_height = 1.4e-4, .growth = 1.3, .thickness = 0.085};
  const FlowResult whole = solve_flow(layered_section(layer), conditions, options, "mesh");
  EXPECT_EQ(whole.warnings, std::vector<std::string>{});
  layer.thickness = 0.004;
  const FlowResult cut = solve_flow(layered_section(layer), conditions, options, "mesh");
  ASSERT_TRUE(cut.converged());
  EXPECT_GT(std::abs(cut.cl / whole.cl - 1.0), 0.1);  // what nobody would find out otherwise
  EXPECT_TRUE(says(cut.warnings, "of the layer's top lies within the boundary layer"));
}

TEST(FrictionWarnings, SayThatBoundaryLayersAreLaminarOrTheLengthIsOdd) {
  const FrozenMesh mesh = layered_section({.first_height = 2e-4, .growth = 1.3, .thickness = 0.13});
  const FlowResult slow = solve_flow(mesh, {.mach = 0.3, .reynolds = 2e3}, {.model = FlowModel::sa}, "mesh");
  ASSERT_TRUE(slow.converged());
  EXPECT_TRUE(says(slow.warnings, "the Reynolds number by the walls' length is 2000"));
  const FlowResult odd = solve_flow(mesh, {.mach = 0.3, .reference_length = 10.0, .reynolds = 2e4},
                                    {.model = FlowModel::laminar}, "mesh");
  ASSERT_TRUE(odd.converged());
  EXPECT_TRUE(says(odd.warnings, "the reference length is 10 and the largest wall is 1 long"));
}

// Friction and pressure as around a section at incidence: gas divides on the lower side, at x = .02, and runs
// forward from there around the nose. On the upper side it flows back between `from` and `to`.
class Incidence {
 public:
  Incidence(double from, double to)
      : mesh_(layered_section({.first_height = 1e-4, .growth = 1.3, .thickness = 0.03})),
        dual_(dual_of(mesh_, {.mach = 0.3, .reynolds = 1e5}, {.model = FlowModel::sa}, "mesh")),
        friction_(dual_, {{0.3, 0.5}}) {
    flow_.friction.emplace();
    flow_.friction->transition = {{0.3, 0.5}};
    flow_.friction->cf.assign(dual_.size(), 0.0);
    flow_.pressure.assign(dual_.size(), 0.5);
    for (std::uint32_t v = 0; v < dual_.size(); ++v) {
      if (!friction_.sticks(v)) continue;
      const Point p = dual_.points()[v];
      const bool runs_forward = p.y < 0.0 && p.x<0.02, is_apart = p.y> 0.0 && p.x > from && p.x < to;
      flow_.friction->cf[v] = runs_forward || is_apart ? -0.01 : 0.01;
      if (p.y < 0.0) flow_.pressure[v] = 1.0 - std::abs(p.x - 0.02);
    }
  }
  std::vector<Separation> found() const { return separations(friction_, flow_); }
  double x(std::uint32_t v) const { return dual_.points()[v].x; }

 private:
  FrozenMesh mesh_;
  FlowMesh dual_;
  FrictionMesh friction_;
  FlowResult flow_;
};

TEST(FrictionWarnings, KnowASeparationFromTheNose) {
  EXPECT_TRUE(Incidence(2.0, 2.0).found().empty());  // attached
  const Incidence bubble(0.05, 0.12);
  const auto found = bubble.found();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(bubble.x(found[0].from), 0.05, 0.02);
  ASSERT_NE(found[0].to, no_index);
  EXPECT_NEAR(bubble.x(found[0].to), 0.12, 0.02);
  EXPECT_NEAR(found[0].length, 0.08, 0.03);
  EXPECT_TRUE(found[0].laminar);
  const auto stalled = Incidence(0.05, 2.0).found();
  ASSERT_EQ(stalled.size(), 1u);
  EXPECT_EQ(stalled[0].to, no_index);
  EXPECT_NEAR(stalled[0].length, 0.95, 0.06);
  const auto turbulent = Incidence(0.5, 0.8).found();
  ASSERT_EQ(turbulent.size(), 1u);
  EXPECT_FALSE(turbulent[0].laminar);
}

// Two walls that touch at a point: what goes on there is not known, and the walk ends. A grid of 4 by 4 cells
// without two that have a corner in common.
TEST(FrictionWarnings, EndWhereWallsTouch) {
  FrozenMesh mesh;
  const auto at = [](std::uint32_t i, std::uint32_t j) { return 5 * j + i; };
  for (std::uint32_t j = 0; j < 5; ++j)
    for (std::uint32_t i = 0; i < 5; ++i) mesh.points.push_back({1.0 * i, 1.0 * j});
  FrozenBoundary walls{.name = "wall", .edges = {}}, farfield{.name = "farfield", .edges = {}};
  for (std::uint32_t j = 0; j < 4; ++j)
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::array<std::uint32_t, 4> cell = {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
      if (i == j && (i == 1 || i == 2))
        for (std::size_t k = 0; k < 4; ++k) walls.edges.push_back({cell[(k + 1) % 4], cell[k]});
      else
        mesh.quads.push_back(cell);
    }
  for (std::uint32_t k = 0; k < 4; ++k) {
    farfield.edges.push_back({at(k, 0), at(k + 1, 0)}), farfield.edges.push_back({at(4, k), at(4, k + 1)});
    farfield.edges.push_back({at(k + 1, 4), at(k, 4)}), farfield.edges.push_back({at(0, k + 1), at(0, k)});
  }
  mesh.boundaries = {walls, farfield};
  const FlowMesh dual = dual_of(mesh, {.mach = 0.3, .reynolds = 1e3}, {.model = FlowModel::sa}, "mesh");
  const FrictionMesh friction(dual, {{0.5, 0.5}});
  FlowResult flow;
  flow.friction.emplace();
  flow.friction->cf.assign(dual.size(), 0.01);
  flow.pressure.assign(dual.size(), 0.5);
  EXPECT_LE(separations(friction, flow).size(), 4u);
}

}  // namespace
}  // namespace remodel::flow
