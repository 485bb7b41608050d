// Trials, marks and changes of layered meshes, against what their frozen views say.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "remodel/airfoil.h"
#include "remodel/error.h"
#include "test_layers.h"

namespace remodel::test {
namespace {

Domain section(const char* name) {
  Domain domain = airfoil_domain(named_airfoil(name, 8));
  space_walls(domain, {.leading_edge = 0.004, .trailing_edge = 0.004, .most = 0.03, .growth = 0.2});
  return domain;
}
LayeredMesh mesh_of(const Domain& domain) {
  return generate_layered(domain, {.first_height = 1e-4, .growth = 1.4, .thickness = 0.02},
                          {.gradation = 4.0})
      .mesh;
}

// The wall as a polygon that runs the other way.
Domain described_otherwise(Domain domain) {
  std::vector<Point> points = domain.points(0);
  std::reverse(points.begin(), points.end());
  domain.loops[0] = polygon(points);
  return domain;
}

using Cells = std::multiset<std::vector<std::uint64_t>>;
Cells layer_cells(const FrozenMesh& mesh) {
  Cells cells;
  for (std::size_t i = 0; i < mesh.cell_count(); ++i) {
    if (i >= mesh.layer_triangles && i < mesh.triangles.size()) continue;
    std::vector<std::uint64_t> keys;
    for (const std::uint32_t p : mesh.cell(i)) keys.push_back(mesh.vertex_keys[p]);
    std::sort(keys.begin(), keys.end());
    cells.insert(keys);
  }
  return cells;
}

std::vector<std::uint64_t> numbers(const std::vector<VertexKey>& keys) {
  std::vector<std::uint64_t> values;
  for (const VertexKey key : keys) values.push_back(key.value());
  return values;
}

void expect_changes(const LayeredChanges& changes, const FrozenMesh& before, const FrozenMesh& after) {
  std::map<std::uint64_t, Point> then, now;
  for (std::size_t p = 0; p < before.points.size(); ++p) then[before.vertex_keys[p]] = before.points[p];
  for (std::size_t p = 0; p < after.points.size(); ++p) now[after.vertex_keys[p]] = after.points[p];
  std::vector<std::uint64_t> moved, inserted, removed;
  for (const auto& [key, point] : now) {
    const auto old = then.find(key);
    if (old == then.end())
      inserted.push_back(key);
    else if (old->second != point)
      moved.push_back(key);
  }
  for (const auto& [key, point] : then)
    if (!now.contains(key)) removed.push_back(key);
  EXPECT_EQ(numbers(changes.moved), moved);
  EXPECT_EQ(numbers(changes.inserted), inserted);
  EXPECT_EQ(numbers(changes.removed), removed);
  const Cells cells_then = layer_cells(before), cells_now = layer_cells(after);
  Cells born, gone;
  std::set_difference(cells_now.begin(), cells_now.end(), cells_then.begin(), cells_then.end(),
                      std::inserter(born, born.end()));
  std::set_difference(cells_then.begin(), cells_then.end(), cells_now.begin(), cells_now.end(),
                      std::inserter(gone, gone.end()));
  EXPECT_EQ(changes.layer_born, born.size());
  EXPECT_EQ(changes.layer_gone, gone.size());
  EXPECT_EQ(changes.same_connectivity(), before.vertex_keys == after.vertex_keys && cells_then == cells_now &&
                                             before.triangles == after.triangles);
}

TEST(LayeredChanges, AreThoseOfTheViewsOverAnyNumberOfSteps) {
  LayeredMesh mesh = mesh_of(section("rae2822"));
  const FrozenMesh first = mesh.freeze();
  const LayerMark start = mesh.mark();
  EXPECT_TRUE(mesh.changes_since(start).moved.empty());
  Domain finer = section("naca:2412");
  space_walls(finer, {.leading_edge = 0.003, .trailing_edge = 0.004, .most = 0.02, .growth = 0.2});
  const auto step = [&](const Domain& domain, Strategy strategy) {
    const FrozenMesh before = mesh.freeze();
    const LayerMark mark = mesh.mark();
    remodel(mesh, domain, {.strategy = strategy});
    const FrozenMesh after = mesh.freeze();
    expect_changes(mesh.changes_since(mark), before, after);
    expect_changes(mesh.changes_since(start), first, after);
  };
  for (const Strategy strategy : {Strategy::reference, Strategy::morph, Strategy::renew, Strategy::chain}) {
    SCOPED_TRACE(name_of(strategy));
    step(section("naca:0012"), strategy);
    step(section("naca:2412"), strategy);
    step(section("rae2822"), strategy);
  }
  CstAirfoil blunt = named_airfoil("naca:0012", 8);
  for (auto* surface : {&blunt.upper, &blunt.lower}) surface->back() *= 4.0;
  Domain other_fan = mesh.domain();
  other_fan.loops[0].curves[0].shape = blunt;
  step(other_fan, Strategy::morph);
  step(finer, Strategy::morph);
  step(described_otherwise(mesh.domain()), Strategy::morph);  // a fresh outer mesh
}

TEST(LayeredChanges, AreOfOneMesh) {
  LayeredMesh mesh = mesh_of(section("rae2822")), copy = mesh;
  const LayerMark mark = mesh.mark();
  EXPECT_THROW(copy.changes_since(mark), Error);
  EXPECT_THROW(mesh.changes_since(LayerMark()), Error);
}

TEST(LayeredTrial, ReturnsToTheLastBitWithItsMarks) {
  LayeredMesh mesh = mesh_of(section("rae2822"));
  remodel(mesh, section("naca:0012"), {.strategy = Strategy::reference});
  const LayeredState before = mesh.state();
  const FrozenMesh view = mesh.freeze();
  const LayerMark mark = mesh.mark();
  Domain finer = section("naca:2412");
  space_walls(finer, {.leading_edge = 0.003, .trailing_edge = 0.004, .most = 0.02, .growth = 0.2});
  for (const Domain& design : {section("rae2822"), finer, described_otherwise(mesh.domain())})
    for (const Strategy strategy : {Strategy::reference, Strategy::morph, Strategy::renew}) {
      SCOPED_TRACE(name_of(strategy));
      LayerMark within;
      LayeredMesh copy = mesh;
      {
        LayeredTrial trial(mesh, design, {.strategy = strategy});
        EXPECT_EQ(trial.result().triangles, mesh.cells());
        EXPECT_EQ(mesh.quick_check(), "");
        EXPECT_EQ(why_no_mesh(mesh.freeze(), design), "");
        expect_changes(mesh.changes_since(mark), view, mesh.freeze());
        within = mesh.mark();
      }
      EXPECT_EQ(mesh.state(), before);
      EXPECT_TRUE(mesh.changes_since(mark).same_connectivity());
      EXPECT_TRUE(mesh.changes_since(mark).moved.empty());
      EXPECT_THROW(mesh.changes_since(within), Error);
      // A step is the same as without the trial.
      LayeredMesh stepped = mesh;
      remodel(stepped, design, {.strategy = strategy});
      remodel(copy, design, {.strategy = strategy});
      EXPECT_EQ(stepped.state(), copy.state());
    }
}

TEST(LayeredTrial, StaysWhereItIsKept) {
  LayeredMesh mesh = mesh_of(section("rae2822")), copy = mesh;
  for (const Domain& design : {section("naca:0012"), described_otherwise(section("naca:0012"))}) {
    const LayerMark mark = mesh.mark();
    const FrozenMesh before = mesh.freeze();
    LayeredTrial trial(mesh, design, {.strategy = Strategy::morph});
    trial.keep();
    remodel(copy, design, {.strategy = Strategy::morph});
    EXPECT_EQ(mesh.state(), copy.state());
    expect_changes(mesh.changes_since(mark), before, mesh.freeze());
  }
}

TEST(LayeredTrial, LeavesTheMeshAloneWhereItIsRefused) {
  LayeredMesh mesh = mesh_of(section("rae2822"));
  const LayeredState before = mesh.state();
  Domain outside = mesh.domain();
  outside.loops[0].placement.position = {24.7, 0.0};
  EXPECT_THROW(LayeredTrial(mesh, outside), Error);
  EXPECT_EQ(mesh.state(), before);
  const LayeredTrial trial(mesh, section("naca:0012"));
  EXPECT_THROW(remodel(mesh, section("naca:2412")), Error);
}

TEST(LayeredMeshAt, HasTheSameConnectivityAtAnotherDesign) {
  LayeredMesh mesh = mesh_of(section("rae2822"));
  remodel(mesh, section("rae2822"), {.strategy = Strategy::reference});
  const FrozenMesh view = mesh.freeze();
  Domain near = mesh.domain();
  std::get<CstAirfoil>(near.loops[0].curves[0].shape).upper[1] += 1e-3;
  const LayeredMesh at = mesh_at(mesh, near);
  EXPECT_EQ(at.quick_check(), "");
  EXPECT_EQ(at.freeze().triangles, view.triangles);
  EXPECT_EQ(at.freeze().quads, view.quads);
  EXPECT_EQ(at.freeze().vertex_keys, view.vertex_keys);
  EXPECT_EQ(why_no_mesh(at.freeze(), near), "");
  EXPECT_EQ(mesh.freeze().points, view.points);
  Domain finer = near;
  space_walls(finer, {.leading_edge = 0.003, .trailing_edge = 0.004, .most = 0.02, .growth = 0.2});
  EXPECT_THROW(mesh_at(mesh, finer), TopologyChanged);
}

}  // namespace
}  // namespace remodel::test
