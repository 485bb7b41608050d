#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "remodel/airfoil.h"
#include "remodel/error.h"
#include "test_layers.h"

namespace remodel::test {
namespace {

const QualityOptions quality{.gradation = 8.0};

Domain around(const CstAirfoil& airfoil) {
  Domain domain = airfoil_domain(airfoil);
  space_walls(domain, {});
  return domain;
}
Domain rae() {
  return around(named_airfoil("rae2822", 8));
}

bool same_bytes(const FrozenMesh& a, const FrozenMesh& b) {
  return a.points == b.points && a.triangles == b.triangles && a.quads == b.quads && a.vertex_keys == b.vertex_keys &&
         a.curve == b.curve && a.parameter == b.parameter && a.steiner == b.steiner;
}

TEST(LayeredMesh, PointsOfTheLayerComeFirstColumnByColumn) {
  const LayeredMesh mesh = generate_layered(rae(), layer_options(), quality).mesh;
  const FrozenMesh view = mesh.freeze();
  const LayerTopology topology = mesh.topology();
  ASSERT_EQ(topology.wall.size(), mesh.columns());
  for (std::uint32_t p = 0; p < topology.column.size(); ++p)
    EXPECT_EQ(topology.point(topology.column[p], topology.level[p]), p);
  for (std::uint32_t c = 0; c < mesh.columns(); ++c) {
    EXPECT_NEAR(distance(view.points[topology.wall[c]], view.points[topology.point(c, 1)]), 4.5e-6, 1e-10);
    EXPECT_NEAR(distance(view.points[topology.wall[c]], view.points[topology.point(c, mesh.levels())]), 0.02, 1e-12);
    EXPECT_EQ(view.curve[topology.wall[c]], 0);
    EXPECT_EQ(view.curve[topology.point(c, 1)], -1);
  }
  EXPECT_EQ(mesh.cells(), view.triangles.size() + view.quads.size());
  EXPECT_EQ(mesh.layer_cells(), mesh.statistics().cells);
  const std::set<std::uint64_t> keys(view.vertex_keys.begin(), view.vertex_keys.end());
  EXPECT_EQ(keys.size(), view.points.size());
  const FrozenMesh triangles = mesh.freeze(LayerCells::triangles);
  EXPECT_EQ(triangles.points, view.points);
  EXPECT_EQ(triangles.triangles.size(), view.triangles.size() + 2 * view.quads.size());
}

TEST(LayeredMesh, BoundariesAreThoseOfTheWalls) {
  Domain domain = rae();
  const FrozenMesh view = generate_layered(domain, layer_options(), quality).mesh.freeze();
  ASSERT_EQ(view.boundaries.size(), 2);
  EXPECT_EQ(view.boundaries[0].name, "airfoil");
  EXPECT_EQ(view.boundaries[0].edges.size(), domain.stations(0).size());
  for (std::size_t i = 0; i + 1 < view.boundaries[0].edges.size(); ++i)
    EXPECT_EQ(view.boundaries[0].edges[i][1], view.boundaries[0].edges[i + 1][0]);
  EXPECT_EQ(view.boundaries[1].name, "farfield");
}

TEST(LayeredMesh, RegionsHoldForTheLayerToo) {
  Domain domain = rae();
  domain.loops[0].region = "air";
  const FrozenMesh view = generate_layered(domain, layer_options(), quality).mesh.freeze();
  ASSERT_EQ(view.region.size(), view.triangles.size() + view.quads.size());
  for (const std::uint32_t region : view.region) EXPECT_EQ(view.region_names[region], "air");
}

TEST(LayeredMesh, CopiesAndStatesGoOnToTheSameBytes) {
  LayeredMesh mesh = generate_layered(rae(), layer_options(), quality).mesh;
  const Domain next = around(named_airfoil("naca:2412", 8));
  remodel(mesh, next, {.strategy = Strategy::reference});
  LayeredMesh copy = mesh, restored = LayeredMesh::restore(mesh.state(), "state");
  EXPECT_EQ(restored.state(), mesh.state());
  EXPECT_TRUE(same_bytes(restored.freeze(), mesh.freeze()));
  Domain last = rae();
  last.loops[0].placement.rotation_deg = -2.0;
  for (LayeredMesh* each : {&mesh, &copy, &restored}) remodel(*each, last, {.strategy = Strategy::morph});
  EXPECT_TRUE(same_bytes(copy.freeze(), mesh.freeze()));
  EXPECT_TRUE(same_bytes(restored.freeze(), mesh.freeze()));
}

TEST(LayeredMesh, ForeignStatesAreRefused) {
  const LayeredState state = generate_layered(rae(), layer_options(), quality).mesh.state();
  const auto refused = [](const LayeredState& wrong) {
    try {
      LayeredMesh::restore(wrong, "file");
    } catch (const Error& error) {
      return error.code() == ErrorCode::format && std::string(error.what()).starts_with("file: ");
    }
    return false;
  };
  LayeredState wrong = state;
  wrong.options.first_height *= 2.0;  // as if it were of other columns: their tops are the same
  wrong.options.thickness *= 1.5;
  EXPECT_TRUE(refused(wrong));
  wrong = state, wrong.levels = 0;
  EXPECT_TRUE(refused(wrong));
  wrong = state, wrong.fans[0].pop_back();
  EXPECT_TRUE(refused(wrong));
  wrong = state, wrong.fans.clear();
  EXPECT_TRUE(refused(wrong));
  wrong = state, wrong.columns[0].pop_back();
  EXPECT_TRUE(refused(wrong));
  wrong = state, wrong.columns[0][1] = wrong.columns[0][0];
  EXPECT_TRUE(refused(wrong));
  wrong = state, wrong.next_column = 5;
  EXPECT_TRUE(refused(wrong));
  wrong = state, wrong.options.walls = {"wing"};
  EXPECT_TRUE(refused(wrong));
  wrong = state, wrong.walls.loops[0].placement.rotation_deg = 1.0;
  EXPECT_TRUE(refused(wrong));
}

struct Cancelled : StepObserver {
  bool cancelled() override { return true; }
};

TEST(LayeredMesh, ARefusedStepLeavesTheMeshAsItWas) {
  LayeredMesh mesh = generate_layered(rae(), layer_options(), quality).mesh;
  const LayeredState before = mesh.state();
  CstAirfoil crossed = named_airfoil("rae2822", 8);
  for (double& y : crossed.lower) y = -y;
  Domain wrong = mesh.domain();
  std::get<CstAirfoil>(wrong.loops[0].curves[0].shape) = crossed;
  EXPECT_THROW(remodel(mesh, wrong), Error);
  EXPECT_EQ(mesh.state(), before);
  Domain outside = mesh.domain();
  outside.loops[0].placement.position = {24.7, 0.0};
  EXPECT_THROW(remodel(mesh, outside), Error);
  EXPECT_EQ(mesh.state(), before);
  Domain moved = mesh.domain();
  moved.loops[0].placement.rotation_deg = 40.0;
  Cancelled observer;
  const LayeredRemodelResult result = remodel(mesh, moved, {.observer = &observer});
  EXPECT_EQ(result.stopped, Stopped::interrupted);
  EXPECT_EQ(result.preserved, mesh.cells());
  EXPECT_EQ(mesh.state(), before);
  LayeredMesh empty;
  EXPECT_THROW(remodel(empty, moved), Error);
}

TEST(LayeredMesh, TheSameDesignChangesNothing) {
  LayeredMesh mesh = generate_layered(rae(), layer_options(), quality).mesh;
  const FrozenMesh before = mesh.freeze();
  const LayeredRemodelResult result = remodel(mesh, mesh.domain(), {.strategy = Strategy::morph});
  EXPECT_EQ(result.preserved, mesh.cells());
  EXPECT_EQ(result.triangles, mesh.cells());
  EXPECT_EQ(result.moved, 0);
  EXPECT_TRUE(same_bytes(mesh.freeze(), before));
}

TEST(LayeredMesh, LoopsInAnotherOrderAndDirectionAreTheSame) {
  Domain domain = rae();
  domain.loops[0] = polygon(domain.points(0));
  LayeredMesh mesh = generate_layered(domain, layer_options(), quality).mesh;
  const FrozenMesh before = mesh.freeze();
  Domain other = mesh.domain();
  std::vector<Point> points = other.points(0);
  std::reverse(points.begin(), points.end());
  std::rotate(points.begin(), points.begin() + 50, points.end());
  other.loops[0] = polygon(points);
  std::swap(other.loops[0], other.loops[1]);
  const LayeredRemodelResult result = remodel(mesh, other, {.strategy = Strategy::morph});
  EXPECT_FALSE(result.regenerated);
  EXPECT_TRUE(result.same_columns);
  EXPECT_EQ(result.preserved, mesh.cells());
  EXPECT_EQ(mesh.freeze().points, before.points);
  EXPECT_EQ(mesh.quick_check(), "");
}

// The same stations by other curves: the tops are at the same places, in another order.
TEST(LayeredMesh, AWallThatIsDescribedInAnotherWayGetsAFreshMesh) {
  LayeredMesh mesh = generate_layered(rae(), layer_options(), quality).mesh;
  const LayeredState before = mesh.state();
  Domain other = mesh.domain();
  std::vector<Point> points = other.points(0);
  std::reverse(points.begin(), points.end());
  other.loops[0] = polygon(points);
  EXPECT_TRUE(remodel(mesh, other, {.regenerate = false}).abandoned);
  EXPECT_EQ(mesh.state(), before);
  EXPECT_TRUE(remodel(mesh, other).regenerated);
  EXPECT_EQ(mesh.quick_check(), "");
  EXPECT_EQ(why_no_mesh(mesh.freeze(), other), "");
}

// A trailing edge that becomes much blunter has another fan; all columns elsewhere keep their numbers.
TEST(LayeredMesh, AFanWithOtherSectorsLeavesAllOtherColumnsAsTheyAre) {
  CstAirfoil blunt = named_airfoil("naca:0012", 8);
  for (auto* surface : {&blunt.upper, &blunt.lower}) surface->back() *= 4.0;
  LayeredMesh mesh = generate_layered(around(named_airfoil("naca:0012", 8)), layer_options(), quality).mesh;
  const LayeredState before = mesh.state();
  Domain next = mesh.domain();
  next.loops[0].curves[0].shape = blunt;
  const LayeredRemodelResult result = remodel(mesh, next, {.strategy = Strategy::morph});
  const LayeredState after = mesh.state();
  ASSERT_NE(after.fans, before.fans);
  EXPECT_FALSE(result.same_columns);
  std::size_t same = 0;
  for (const std::uint32_t column : after.columns[0])
    same += std::find(before.columns[0].begin(), before.columns[0].end(), column) != before.columns[0].end();
  EXPECT_EQ(same, mesh.domain().stations(0).size() - 1);
  EXPECT_GT(result.connected, (same - 1) * mesh.levels());
  EXPECT_EQ(mesh.quick_check(), "");
  EXPECT_EQ(why_no_mesh(mesh.freeze(), next), "");
  EXPECT_EQ(result.triangles, mesh.cells());
}

TEST(LayeredMesh, OtherStationsMakeOtherColumns) {
  LayeredMesh mesh = generate_layered(rae(), layer_options(), quality).mesh;
  Domain finer = mesh.domain();
  space_walls(finer, {.most = 0.006});
  const LayeredRemodelResult result = remodel(mesh, finer, {.strategy = Strategy::morph});
  EXPECT_FALSE(result.same_columns);
  EXPECT_EQ(mesh.quick_check(), "");
  EXPECT_EQ(why_no_mesh(mesh.freeze(), finer), "");
  EXPECT_EQ(result.triangles, mesh.cells());
}

}  // namespace
}  // namespace remodel::test
