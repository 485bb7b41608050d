// Meshes of transformed domains are the transformed meshes, to the last bit and ids included, through
// generation and any chain of remodellings: where the transformation itself is exact, nothing else may depend
// on it.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mesh/mesh_data.h"
#include "remodel/generate.h"
#include "remodel/remodel.h"
#include "step/test_designs.h"
#include "support.h"

namespace remodel {
namespace {

struct Transformation {
  double scale_x = 1.0, scale_y = 1.0, shift_x = 0.0, shift_y = 0.0;
  Point operator()(Point p) const { return {scale_x * p.x + shift_x, scale_y * p.y + shift_y}; }
};

Domain transformed(Domain domain, const Transformation& transformation) {
  for (Loop& loop : domain.loops)
    for (Curve& curve : loop.curves)
      for (Point& p : std::get<Polyline>(curve.shape).points) p = transformation(p);
  return domain;
}

// A square of side 1/4 at (1, 1) with one or two polygons in it. All coordinates are multiples of 2^-22.
class Designs {
 public:
  explicit Designs(unsigned long long seed) : random_(seed) {}

  Domain next() {
    const double x = uniform(0.35, 0.6), y = uniform(0.35, 0.6), r = uniform(0.1, 0.25);
    std::vector<Loop> holes;
    if (random_() % 3 == 0)
      holes.push_back(test::square_hole(x, y, r));
    else
      holes.push_back(test::star_hole(x, y, r, 5 + random_() % 3));
    if (random_() % 2 == 0) holes.push_back(test::square_hole(0.92, 0.9, uniform(0.01, 0.04), 1));
    Domain domain = test::with_holes(holes);
    for (Loop& loop : domain.loops)
      for (Point& p : std::get<Polyline>(loop.curves[0].shape).points) p = {place(p.x), place(p.y)};
    return domain;
  }
  // The hole of `domain` moved a little: the specialised method's case.
  Domain nudged(Domain domain) {
    const double dx = place(uniform(0.0, 0.01)) - 1.0, dy = place(uniform(0.0, 0.01)) - 1.0;
    for (Point& p : std::get<Polyline>(domain.loops[1].curves[0].shape).points) p = {p.x + dx, p.y + dy};
    return domain;
  }

 private:
  static double place(double x) { return 1.0 + std::ldexp(std::round(std::ldexp(x, 20)), -22); }
  double uniform(double low, double high) { return test::uniform(random_, low, high); }
  std::mt19937_64 random_;
};

void expect_transformed(const MeshState& one, const MeshState& other, const Transformation& transformation) {
  ASSERT_EQ(other.triangle_vertices, one.triangle_vertices);
  ASSERT_EQ(other.triangle_links, one.triangle_links);
  ASSERT_EQ(other.triangle_regions, one.triangle_regions);
  ASSERT_EQ(other.triangle_births, one.triangle_births);
  ASSERT_EQ(other.vertex_stars, one.vertex_stars);
  ASSERT_EQ(other.vertex_generations, one.vertex_generations);
  ASSERT_EQ(other.vertex_parameters, one.vertex_parameters);
  ASSERT_EQ(other.free_vertices, one.free_vertices);
  ASSERT_EQ(other.free_triangles, one.free_triangles);
  for (std::size_t v = 1; v < one.vertex_stars.size(); ++v) {
    if (one.vertex_stars[v] == no_index) continue;
    const Point expected = transformation({one.coordinates[2 * v], one.coordinates[2 * v + 1]});
    ASSERT_EQ(other.coordinates[2 * v], expected.x) << "vertex " << v;
    ASSERT_EQ(other.coordinates[2 * v + 1], expected.y) << "vertex " << v;
    ASSERT_EQ(other.length_scales[v], std::abs(transformation.scale_x) * one.length_scales[v])
        << "vertex " << v;
  }
}

// The same chain of designs in both places; any method, nudges and changes of topology.
void expect_equivariance(const Transformation& transformation, unsigned long long fallback) {
  const auto seed = test::seed(fallback);
  SCOPED_TRACE("REMODEL_TEST_SEED=" + std::to_string(seed));
  for (unsigned long long chain = 0; chain < 4; ++chain) {
    Designs designs(seed + chain);
    Domain design = designs.next();
    Mesh one = generate(design).mesh, other = generate(transformed(design, transformation)).mesh;
    ASSERT_EQ(one.quick_check(), "");
    ASSERT_NO_FATAL_FAILURE(expect_transformed(one.state(), other.state(), transformation));
    for (int step = 0; step < 12; ++step) {
      SCOPED_TRACE("chain " + std::to_string(chain) + ", step " + std::to_string(step));
      design = step % 2 == 0 ? designs.nudged(design) : designs.next();
      const Method method = step % 5 == 2 ? Method::general : Method::automatic;
      const RemodelResult a = remodel(one, design, {.method = method, .strategy = Strategy::chain});
      const RemodelResult b = remodel(other, transformed(design, transformation),
                                      {.method = method, .strategy = Strategy::chain});
      ASSERT_EQ(a.preserved, b.preserved);
      ASSERT_EQ(a.moved, b.moved);
      ASSERT_EQ(a.inserted, b.inserted);
      ASSERT_EQ(a.removed, b.removed);
      ASSERT_FALSE(a.regenerated) << a.reason;
      ASSERT_NO_FATAL_FAILURE(expect_transformed(one.state(), other.state(), transformation));
    }
    EXPECT_EQ(other.quick_check(), "");
  }
}

TEST(Scaling, ByPowersOfTwoScalesTheMeshExactly) {
  for (const double factor : {0x1p-30, 0.5, 0x1p40})
    expect_equivariance({.scale_x = factor, .scale_y = factor}, 301);
}

// Within one binade: also the coordinates that refinement computes keep their last bit.
TEST(Translation, ThatKeepsCoordinatesExactMovesTheMeshExactly) {
  expect_equivariance({.shift_x = 0.5, .shift_y = 0.25}, 311);
  expect_equivariance({.shift_x = 0.0, .shift_y = 0.5}, 321);
}

// The order in which refinement looks at triangles follows their corners, which mirroring turns round: the
// mirrored domain's mesh is as good and about as large, but it has other vertices.
TEST(Mirroring, GivesAMeshAsGoodAndAboutAsLarge) {
  const auto seed = test::seed(331);
  SCOPED_TRACE("REMODEL_TEST_SEED=" + std::to_string(seed));
  for (const Transformation& mirror : {Transformation{.scale_x = -1.0}, Transformation{.scale_y = -1.0}}) {
    std::size_t triangles = 0, mirrored = 0;
    for (unsigned long long chain = 0; chain < 4; ++chain) {
      Designs designs(seed + chain);
      Domain design = designs.next();
      Mesh one = generate(design).mesh, other = generate(transformed(design, mirror)).mesh;
      for (int step = 0; step < 12; ++step) {
        design = step % 2 == 0 ? designs.nudged(design) : designs.next();
        const RemodelResult a = remodel(one, design, {.strategy = Strategy::chain}),
                            b = remodel(other, transformed(design, mirror), {.strategy = Strategy::chain});
        EXPECT_EQ(a.method, b.method);
        EXPECT_EQ(other.quick_check(), "");
        triangles += a.triangles;
        mirrored += b.triangles;
      }
    }
    std::printf("%zu triangles, %zu mirrored\n", triangles, mirrored);
    EXPECT_NEAR(static_cast<double>(mirrored), static_cast<double>(triangles),
                0.05 * static_cast<double>(triangles));
  }
}

}  // namespace
}  // namespace remodel
