#include "remodel/mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

#include "mesh/mesh_data.h"
#include "remodel/check.h"
#include "remodel/error.h"
#include "remodel/generate.h"
#include "remodel/remodel.h"
#include "step/test_designs.h"

namespace remodel {
namespace {

using test::catalogue_domain;

// A mesh with free slots, Steiner vertices and several steps behind it.
Mesh used_mesh() {
  Mesh mesh = generate(catalogue_domain(0, 50)).mesh;
  for (const std::size_t to : {1U, 3U, 5U})
    remodel(mesh, catalogue_domain(to, 50), {.strategy = Strategy::chain});
  return mesh;
}

// ---- state

TEST(MeshState, IsRestoredToTheLastBit) {
  const Domain holes = test::with_holes({test::star_hole(0.3, 0.3, 0.2), test::circle_hole(0.7, 0.7, 0.1)});
  for (const Mesh& mesh : {used_mesh(), generate(holes).mesh}) {
    const MeshState state = mesh.state();
    const Mesh restored = Mesh::restore(state, "state");
    EXPECT_TRUE(restored.state() == state);
    EXPECT_EQ(restored.quick_check(), "");
    EXPECT_EQ(restored.triangle_count(), mesh.triangle_count());
    EXPECT_EQ(restored.step(), mesh.step());
    EXPECT_EQ(restored.domain(), mesh.domain());
    EXPECT_EQ(restored.options(), mesh.options());
    EXPECT_EQ(restored.freeze().parameter, mesh.freeze().parameter);
  }
}

TEST(MeshState, OfACopyIsTheSameAndItsOwn) {
  Mesh mesh = used_mesh();
  const MeshState state = mesh.state();
  Mesh copy = mesh, assigned;
  assigned = mesh;
  EXPECT_TRUE(copy.state() == state);
  EXPECT_TRUE(assigned.state() == state);
  remodel(copy, catalogue_domain(9, 50), {.strategy = Strategy::chain});
  EXPECT_TRUE(mesh.state() == state);
  remodel(mesh, catalogue_domain(9, 50), {.strategy = Strategy::chain});
  EXPECT_TRUE(mesh.state() == copy.state());
  const Mesh moved = std::move(copy);
  EXPECT_TRUE(moved.state() == mesh.state());
}

TEST(MeshState, ThatIsDamagedIsRefused) {
  const MeshState whole = used_mesh().state();
  std::size_t inner = 1, boundary = 1, triangle = 0;
  while (whole.vertex_stars[inner] == no_index || whole.vertex_curves[inner] >= 0) ++inner;
  while (whole.vertex_stars[boundary] == no_index || whole.vertex_curves[boundary] < 0) ++boundary;
  while (whole.triangle_vertices[3 * triangle] == no_index || whole.triangle_regions[triangle] != 1)
    ++triangle;
  ASSERT_FALSE(whole.free_vertices.empty() && whole.free_triangles.empty());
  const struct {
    const char* what;
    std::function<void(MeshState&)> damage;
  } cases[] = {
      {"a coordinate array too short", [&](MeshState& s) { s.coordinates.pop_back(); }},
      {"a length scale too many", [&](MeshState& s) { s.length_scales.push_back(1); }},
      {"a generation missing", [&](MeshState& s) { s.vertex_generations.pop_back(); }},
      {"a curve missing", [&](MeshState& s) { s.vertex_curves.pop_back(); }},
      {"a parameter missing", [&](MeshState& s) { s.vertex_parameters.pop_back(); }},
      {"a factor missing", [&](MeshState& s) { s.vertex_scale_factors.pop_back(); }},
      {"a triangle vertex missing", [&](MeshState& s) { s.triangle_vertices.pop_back(); }},
      {"a link missing", [&](MeshState& s) { s.triangle_links.pop_back(); }},
      {"a birth missing", [&](MeshState& s) { s.triangle_births.pop_back(); }},
      {"nothing but a domain",
       [&](MeshState& s) {
         MeshState empty;
         empty.domain = s.domain;
         s = empty;
       }},
      {"a coordinate that is no number", [&](MeshState& s) { s.coordinates[2 * inner] = std::nan(""); }},
      {"a vertex far away", [&](MeshState& s) { s.coordinates[2 * inner] += 100.0; }},
      {"a boundary vertex off its curve", [&](MeshState& s) { s.coordinates[2 * boundary] += 1e-9; }},
      {"a boundary vertex without scale", [&](MeshState& s) { s.length_scales[boundary] = 0.0; }},
      {"a boundary vertex with scale nan", [&](MeshState& s) { s.length_scales[boundary] = std::nan(""); }},
      {"an inner vertex without scale", [&](MeshState& s) { s.length_scales[inner] = -1.0; }},
      {"a factor below 0", [&](MeshState& s) { s.vertex_scale_factors[boundary] = -1e305; }},
      {"a factor that is not finite", [&](MeshState& s) { s.vertex_scale_factors[boundary] = HUGE_VAL; }},
      {"a star out of range", [&](MeshState& s) { s.vertex_stars[inner] = 8 * 1000000; }},
      {"a star at another vertex", [&](MeshState& s) { s.vertex_stars[inner] = s.vertex_stars[boundary]; }},
      {"a live vertex without a star", [&](MeshState& s) { s.vertex_stars[inner] = no_index; }},
      {"a curve that is not there", [&](MeshState& s) { s.vertex_curves[boundary] = 17; }},
      {"an inner vertex on a curve", [&](MeshState& s) { s.vertex_curves[inner] = 0; }},
      {"a boundary vertex on no curve", [&](MeshState& s) { s.vertex_curves[boundary] = -1; }},
      {"a parameter moved", [&](MeshState& s) { s.vertex_parameters[boundary] += 1e-4; }},
      {"a parameter that is no number", [&](MeshState& s) { s.vertex_parameters[boundary] = std::nan(""); }},
      {"a parameter below 0", [&](MeshState& s) { s.vertex_parameters[boundary] = -0.25; }},
      {"a parameter above 1", [&](MeshState& s) { s.vertex_parameters[boundary] = 1e300; }},
      {"a corner out of range", [&](MeshState& s) { s.triangle_vertices[3 * triangle] = 1000000; }},
      {"corners in another order",
       [&](MeshState& s) {
         std::swap(s.triangle_vertices[3 * triangle], s.triangle_vertices[3 * triangle + 1]);
       }},
      {"a link out of range", [&](MeshState& s) { s.triangle_links[3 * triangle] = 8 * 1000000; }},
      {"a link to itself",
       [&](MeshState& s) { s.triangle_links[3 * triangle] = static_cast<std::uint32_t>(8 * triangle); }},
      {"a constraint on one side", [&](MeshState& s) { s.triangle_links[3 * triangle] ^= 4U; }},
      {"a corner of 3", [&](MeshState& s) { s.triangle_links[3 * triangle] |= 3U; }},
      {"an unknown region", [&](MeshState& s) { s.triangle_regions[triangle] = 2; }},
      {"a free slot that is alive",
       [&](MeshState& s) { s.free_vertices.push_back(static_cast<std::uint32_t>(inner)); }},
      {"a free slot out of range", [&](MeshState& s) { s.free_triangles.push_back(1000000); }},
      {"a free triangle that is alive",
       [&](MeshState& s) { s.free_triangles.push_back(static_cast<std::uint32_t>(triangle)); }},
      {"a count factor that is no number", [&](MeshState& s) { s.renewal.count_factor = std::nan(""); }},
      {"a negative count factor", [&](MeshState& s) { s.renewal.count_factor = -1.0; }},
      {"an unknown end of refinement", [&](MeshState& s) { s.stopped = 3; }},
      {"a keep below 1", [&](MeshState& s) { s.keep = 0.5; }},
      {"a keep that is no number", [&](MeshState& s) { s.keep = std::nan(""); }},
      {"a renewal too far away", [&](MeshState& s) { s.renewal.until_renewal = 15; }},
      {"a pending vertex out of range", [&](MeshState& s) { s.renewal.pending_vertices = {1000000}; }},
      {"the infinite vertex pending", [&](MeshState& s) { s.renewal.pending_vertices = {0}; }},
      {"a pending loop twice",
       [&](MeshState& s) {
         s.renewal.pending_loops = {1, 1};
       }},
      {"a pending loop out of range",
       [&](MeshState& s) {
         s.renewal.pending_loops = {0, 2};
       }},
      {"another design", [&](MeshState& s) { s.domain = catalogue_domain(9, 50); }},
      {"another discretisation", [&](MeshState& s) { s.domain = catalogue_domain(5, 52); }},
      {"a design without loops", [&](MeshState& s) { s.domain.loops.clear(); }},
      {"a design with a loop too many",
       [&](MeshState& s) { s.domain.loops.push_back(test::square_hole(5, 5, 1)); }},
      {"the roles swapped", [&](MeshState& s) { std::swap(s.domain.loops[0].role, s.domain.loops[1].role); }},
  };
  for (const auto& damaged : cases) {
    MeshState state = whole;
    damaged.damage(state);
    try {
      Mesh::restore(state, "a file");
      ADD_FAILURE() << damaged.what << " was taken";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::format) << damaged.what;
      EXPECT_EQ(std::string(error.what()).rfind("a file: ", 0), 0U) << error.what();
    }
  }
}

// ---- the frozen view

TEST(FrozenView, AgreesWithItselfAndTheStatistics) {
  for (const Mesh& mesh : {used_mesh(), generate(test::with_holes({test::star_hole(0.5, 0.5, 0.3)})).mesh}) {
    const FrozenMesh frozen = mesh.freeze();
    EXPECT_EQ(frozen.triangles.size(), mesh.triangle_count());
    EXPECT_EQ(frozen.triangle_ids.size(), frozen.triangles.size());
    EXPECT_EQ(frozen.birth.size(), frozen.triangles.size());
    for (const std::size_t size :
         {frozen.length_scale.size(), frozen.vertex_ids.size(), frozen.curve.size(), frozen.parameter.size()})
      EXPECT_EQ(size, frozen.points.size());
    EXPECT_TRUE(std::is_sorted(frozen.vertex_ids.begin(), frozen.vertex_ids.end()));
    EXPECT_TRUE(std::is_sorted(frozen.triangle_ids.begin(), frozen.triangle_ids.end()));
    for (std::size_t p = 0; p < frozen.points.size(); ++p) {
      if (frozen.curve[p] < 0) continue;
      EXPECT_EQ(frozen.points[p],
                mesh.domain().at({static_cast<std::size_t>(frozen.curve[p]), frozen.parameter[p]}));
    }
    const MeshStatistics statistics = mesh.statistics();
    const CheckResult checked = check(frozen, {.min_angle_deg = 30.0, .design = &mesh.domain()});
    EXPECT_TRUE(checked.valid);
    EXPECT_EQ(statistics.triangles, checked.triangles);
    EXPECT_EQ(statistics.vertices, checked.vertices);
    EXPECT_NEAR(statistics.min_angle_deg, checked.min_angle_deg, 1e-9);
    EXPECT_NEAR(statistics.max_gradation, checked.max_gradation, 1e-9);
    std::size_t edges = 0, stations = 0;
    for (const FrozenBoundary& boundary : frozen.boundaries) edges += boundary.edges.size();
    for (std::size_t loop = 0; loop < mesh.domain().loops.size(); ++loop)
      stations += mesh.domain().stations(loop).size();
    EXPECT_EQ(edges, stations + statistics.steiner_boundary_vertices);
  }
}

TEST(FrozenView, NamesEachBoundaryOnceWithTheDomainOnItsLeft) {
  const FrozenMesh frozen =
      generate(test::with_holes({test::square_hole(0.3, 0.3, 0.1), test::circle_hole(0.7, 0.7, 0.1)}))
          .mesh.freeze();
  ASSERT_EQ(frozen.boundaries.size(), 2U);
  EXPECT_EQ(frozen.boundaries[0].name, "outer");
  EXPECT_EQ(frozen.boundaries[1].name, "hole");
  std::set<std::array<std::uint32_t, 2>> directed;
  for (const auto& t : frozen.triangles)
    for (std::size_t k = 0; k < 3; ++k) directed.insert({t[k], t[(k + 1) % 3]});
  for (const FrozenBoundary& boundary : frozen.boundaries)
    for (const auto& [a, b] : boundary.edges) {
      EXPECT_TRUE(directed.contains({a, b}));
      EXPECT_FALSE(directed.contains({b, a}));
    }
}

// ---- the quick validation finds what is broken on purpose

class BrokenMesh : public testing::Test {
 protected:
  BrokenMesh() : mesh(used_mesh()), data(mesh.data()) {
    EXPECT_EQ(mesh.quick_check(), "");
    while (!alive(inner) || data.triangulation[inner].boundary != no_index) ++inner.index;
    while (!data.triangulation[triangle].alive() || data.triangulation[triangle].region != Region::domain)
      ++triangle.index;
    boundary = data.loop_heads[0];
  }
  bool alive(VertexId v) const { return data.triangulation[v].alive(); }
  void expect(const std::string& rule) const {
    const std::string found = mesh.quick_check();
    EXPECT_NE(found.find(rule), std::string::npos) << "found '" << found << "', expected '" << rule << "'";
  }

  Mesh mesh;
  MeshData& data;
  VertexId inner{1};
  TriangleId triangle{0};
  std::uint32_t boundary = 0;
};

TEST_F(BrokenMesh, ByAVertexThatMovedAcrossAnEdge) {
  data.triangulation.move(inner, {30.0, 30.0}, data.triangulation[inner].length_scale);
  expect("not counter-clockwise");
}

TEST_F(BrokenMesh, ByAVertexThatMovedALittle) {
  // Far enough that an edge is not Delaunay or a triangle not good, not as far as the next edge.
  const Triangle& t = data.triangulation[data.triangulation[inner].star.triangle()];
  Point sum{0, 0};
  for (const VertexId v : t.vertex) sum = sum + data.triangulation.point(v);
  const Point centroid{sum.x / 3, sum.y / 3}, p = data.triangulation.point(inner);
  data.triangulation.move(inner, {p.x + 0.9 * (centroid.x - p.x), p.y + 0.9 * (centroid.y - p.y)},
                          data.triangulation[inner].length_scale);
  const Corner first = data.triangulation.star(inner);
  Corner c = first;
  do data.triangulation.refresh_circle(c.triangle), c = data.triangulation.counterclockwise(c);
  while (c.triangle != first.triangle);
  const std::string found = mesh.quick_check();
  EXPECT_TRUE(found.find("locally Delaunay") != std::string::npos ||
              found.find("quality") != std::string::npos)
      << found;
}

TEST_F(BrokenMesh, ByACircleThatIsNotTheTriangles) {
  Circle circle = data.triangulation[triangle].circle;
  circle.inside *= 4.0;
  circle.outside *= 4.0;
  data.triangulation.set_moved(triangle, circle, data.triangulation[triangle].birth);
  EXPECT_NE(mesh.quick_check(), "");
}

TEST_F(BrokenMesh, ByALengthScaleThatIsTooSmall) {
  data.triangulation.set_length_scale(inner, 1e-6);
  expect("below the promised quality");
}

TEST_F(BrokenMesh, ByATriangleOfAnotherRegion) {
  data.triangulation.set_region(triangle, Region::outside);
  expect("region changes across an unconstrained edge");
}

TEST_F(BrokenMesh, ByATriangleOfNoRegion) {
  data.triangulation.set_region(triangle, Region::unknown);
  expect("no region");
}

TEST_F(BrokenMesh, ByAGhostInTheDomain) {
  TriangleId ghost{0};
  while (!data.triangulation[ghost].alive() || !data.triangulation[ghost].ghost()) ++ghost.index;
  data.triangulation.set_region(ghost, Region::domain);
  expect("outside the hull, labelled domain");
}

TEST_F(BrokenMesh, ByAMarkOfRefinementThatStayed) {
  data.triangulation.set_badness(triangle, 3);
  expect("still marked as bad");
}

TEST_F(BrokenMesh, ByAWrongCount) {
  ++data.domain_triangles;
  expect("triangle count");
}

TEST_F(BrokenMesh, ByADesignThatItIsNotOf) {
  data.domain = catalogue_domain(2, 50);
  expect("not on the design");
}

TEST_F(BrokenMesh, ByABoundaryEdgeThatWasReleased) {
  data.triangulation.release(data.at(boundary).vertex, data.at(data.at(boundary).next).vertex);
  EXPECT_NE(mesh.quick_check(), "");
}

TEST_F(BrokenMesh, ByAConstraintTooMany) {
  const Corner c = data.triangulation.star(inner);
  data.triangulation.constrain(inner, data.triangulation.following(c));
  expect("constrained, but no boundary edge");
}

TEST_F(BrokenMesh, ByARecordOfAnotherVertex) {
  data.triangulation.set_boundary(data.at(boundary).vertex, data.at(boundary).next);
  expect("is constrained, but no boundary edge");
}

TEST_F(BrokenMesh, ByAnInnerVertexWithABoundaryRecord) {
  data.triangulation.set_boundary(inner, boundary);
  expect("no loop has them");
}

TEST_F(BrokenMesh, ByABoundaryVertexWithoutALengthScale) {
  // The steps before it are about quality: they are satisfied with any scale when there is no bound.
  data.options.max_gradation = 1e9;
  data.triangulation.set_length_scale(data.at(boundary).vertex, 0.0);
  expect("no length scale");
}

TEST_F(BrokenMesh, ByAStationThatBecameSteiner) {
  data.boundary.edit(boundary).steiner = true;
  expect("stations of the design are missing");
}

TEST_F(BrokenMesh, ByALoopThatRunsTheOtherWay) {
  std::swap(data.sides[0].left, data.sides[0].right);
  expect("regions beside its edge are wrong");
}

TEST_F(BrokenMesh, ByAVertexSplitOffTheBoundary) {
  data.boundary.edit(data.at(boundary).previous).next = data.at(boundary).next;
  EXPECT_NE(mesh.quick_check(), "");
}

TEST_F(BrokenMesh, ByAHigherPromise) {
  data.options.min_angle_deg = 33.9;
  expect("below the promised quality");
}

}  // namespace
}  // namespace remodel
