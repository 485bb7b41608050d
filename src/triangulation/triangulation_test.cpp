#include "triangulation/triangulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "remodel/predicates.h"
#include "support.h"

namespace remodel {
namespace {

using Triple = std::array<std::pair<double, double>, 3>;

// The finite triangles as sets of coordinates: what must not depend on ids or history.
std::set<Triple> triangle_set(const Triangulation& t) {
  std::set<Triple> result;
  for (std::uint32_t i = 0; i < t.triangle_slots(); ++i) {
    const Triangle& triangle = t[TriangleId{i}];
    if (!triangle.alive() || triangle.ghost()) continue;
    Triple triple;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point p = t.point(triangle.vertex[k]);
      triple[k] = {p.x, p.y};
    }
    std::sort(triple.begin(), triple.end());
    result.insert(triple);
  }
  return result;
}

TriangleId any_triangle(const Triangulation& t) {
  std::uint32_t i = 0;
  while (!t[TriangleId{i}].alive()) ++i;
  return TriangleId{i};
}

// Point families, each a different kind of trouble.
Point random_point(std::mt19937_64& random, int family) {
  const auto whole = [&](int n) { return static_cast<double>(random() % static_cast<unsigned>(n)); };
  switch (family) {
    case 0:
      return {whole(1 << 20) / (1 << 20), whole(1 << 20) / (1 << 20)};
    case 1:
      return {whole(12), whole(12)};  // grid: cocircular and collinear by the dozen
    case 2: {                         // integer points of the circle of radius 65^2
      static const std::array<std::array<int, 2>, 5> pairs{{{16, 63}, {33, 56}, {39, 52}, {25, 60}, {65, 0}}};
      const auto& pair = pairs[random() % 5];
      const double sx = random() % 2 ? 1 : -1, sy = random() % 2 ? 1 : -1;
      return random() % 2 ? Point{sx * pair[0], sy * pair[1]} : Point{sx * pair[1], sy * pair[0]};
    }
    case 3:
      return {whole(2000), whole(3) * 0x1p-40};  // nearly collinear
    default:
      return {1.0 + whole(8) * 0x1p-52, 1.0 + whole(8) * 0x1p-52};  // a grid of ulps
  }
}

Triangulation started(std::mt19937_64& random, int family) {
  for (;;) {
    const Point a = random_point(random, family), b = random_point(random, family),
                c = random_point(random, family);
    if (orient2d(a, b, c) == 0) continue;
    Triangulation t;
    t.start(a, b, c);
    return t;
  }
}

// A triangulation of the first family's start and so many more of its random points.
Triangulation triangulation_of(std::mt19937_64& random, int points) {
  Triangulation t = started(random, 0);
  for (int i = 0; i < points; ++i) t.insert(random_point(random, 0), any_triangle(t));
  return t;
}

// Removes one of the vertices, one time in `removal_in` while there are more than three, or inserts one.
void insert_or_remove(Triangulation& t, std::vector<VertexId>& vertices, int family, unsigned removal_in,
                      std::mt19937_64& random) {
  if (vertices.size() > 3 && random() % removal_in == 0) {
    const std::size_t k = random() % vertices.size();
    t.remove(vertices[k]);
    vertices.erase(vertices.begin() + static_cast<std::ptrdiff_t>(k));
  } else {
    const auto inserted = t.insert(random_point(random, family), any_triangle(t));
    if (inserted.is_new) vertices.push_back(inserted.vertex);
  }
}

class KernelOnFamily : public testing::TestWithParam<int> {};

TEST_P(KernelOnFamily, StaysValidUnderRandomInsertionAndRemoval) {
  const auto seed = test::seed(1 + static_cast<unsigned long long>(GetParam()));
  SCOPED_TRACE("REMODEL_TEST_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  Triangulation t = started(random, GetParam());
  std::vector<VertexId> vertices;
  for (int step = 0; step < 600; ++step) {
    insert_or_remove(t, vertices, GetParam(), 3, random);
    ASSERT_EQ(t.check(), "") << "step " << step;
  }
}

TEST_P(KernelOnFamily, HasTheTrianglesOfARebuildFromTheSameVertices) {
  const auto seed = test::seed(11 + static_cast<unsigned long long>(GetParam()));
  SCOPED_TRACE("REMODEL_TEST_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  Triangulation t = started(random, GetParam());
  std::vector<VertexId> vertices;
  for (int step = 0; step < 200; ++step) {
    const auto inserted = t.insert(random_point(random, GetParam()), any_triangle(t));
    if (inserted.is_new) vertices.push_back(inserted.vertex);
  }
  while (vertices.size() > 60 || (vertices.size() > 20 && vertices.size() % 2 == 1)) {
    const std::size_t k = random() % vertices.size();
    t.remove(vertices[k]);
    vertices.erase(vertices.begin() + static_cast<std::ptrdiff_t>(k));
  }
  std::vector<Point> points;
  for (std::uint32_t i = 1; i < t.vertex_slots(); ++i)
    if (t[VertexId{i}].alive()) points.push_back(t.point(VertexId{i}));
  std::shuffle(points.begin(), points.end(), random);
  std::size_t third = 2;
  while (orient2d(points[0], points[1], points[third]) == 0) ++third;
  Triangulation rebuilt;
  rebuilt.start(points[0], points[1], points[third]);
  for (const Point p : points) rebuilt.insert(p, any_triangle(rebuilt));
  EXPECT_EQ(triangle_set(t), triangle_set(rebuilt));
}

TEST_P(KernelOnFamily, IsAsItWasAfterAnInsertionAndTheRemovalOfTheSamePoint) {
  const auto seed = test::seed(41 + static_cast<unsigned long long>(GetParam()));
  SCOPED_TRACE("REMODEL_TEST_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  Triangulation t = started(random, GetParam());
  int there_and_back = 0;
  for (int step = 0; step < 300; ++step) {
    const std::set<Triple> before = triangle_set(t);
    const auto inserted = t.insert(random_point(random, GetParam()), any_triangle(t));
    if (!inserted.is_new) continue;
    if (step % 4 == 0) continue;  // so that it grows
    t.remove(inserted.vertex);
    ASSERT_EQ(triangle_set(t), before) << "step " << step;
    ++there_and_back;
  }
  EXPECT_GT(there_and_back, 5);
}

// Scaling by a power of two and translations without rounding keep every sign and every tie: the same
// triangles, ids included. Mirroring keeps the signs, but a tie is broken by the order of coordinates: the
// same triangles only where there are no ties.
TEST_P(KernelOnFamily, HasTheTransformedTrianglesOfTransformedPoints) {
  const auto seed = test::seed(51 + static_cast<unsigned long long>(GetParam()));
  SCOPED_TRACE("REMODEL_TEST_SEED=" + std::to_string(seed));
  struct Case {
    double scale_x, scale_y, shift_x, shift_y;
    bool exact;  // for this family
  };
  const bool ulps = GetParam() == 4, ties = GetParam() != 0;
  for (const Case& c :
       {Case{0x1p-90, 0x1p-90, 0, 0, true}, Case{0x1p100, 0x1p100, 0, 0, true}, Case{1, 1, 3, -5, !ulps},
        Case{1, 1, 0.25, 0.5, true}, Case{-1, 1, 0, 0, !ties}, Case{1, -1, 0, 0, !ties}}) {
    if (!c.exact) continue;
    std::mt19937_64 random(seed);
    const auto image = [&](Point p) {
      return Point{c.scale_x * p.x + c.shift_x, c.scale_y * p.y + c.shift_y};
    };
    Triangulation one = started(random, GetParam()), other;
    other.start(image(one.point(VertexId{1})), image(one.point(VertexId{2})), image(one.point(VertexId{3})));
    std::vector<VertexId> vertices;
    for (int step = 0; step < 400; ++step) {
      if (vertices.size() > 3 && random() % 3 == 0) {
        const std::size_t k = random() % vertices.size();
        one.remove(vertices[k]);
        other.remove(vertices[k]);
        vertices.erase(vertices.begin() + static_cast<std::ptrdiff_t>(k));
      } else {
        const Point p = random_point(random, GetParam());
        const auto inserted = one.insert(p, any_triangle(one));
        const auto same = other.insert(image(p), any_triangle(other));
        ASSERT_EQ(inserted.vertex, same.vertex);
        ASSERT_EQ(inserted.is_new, same.is_new);
        if (inserted.is_new) vertices.push_back(inserted.vertex);
      }
      if (step % 10 != 9) continue;
      std::set<Triple> expected;
      for (Triple triple : triangle_set(one)) {
        for (auto& [x, y] : triple) {
          const Point p = image({x, y});
          x = p.x, y = p.y;
        }
        std::sort(triple.begin(), triple.end());
        expected.insert(triple);
      }
      ASSERT_EQ(triangle_set(other), expected) << "step " << step;
    }
  }
}

TEST_P(KernelOnFamily, ComesBackToTheSameBitsAfterRollback) {
  const auto seed = test::seed(21 + static_cast<unsigned long long>(GetParam()));
  SCOPED_TRACE("REMODEL_TEST_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  Triangulation t = started(random, GetParam());
  std::vector<VertexId> vertices;
  for (int round = 0; round < 20; ++round) {
    for (int step = 0; step < 20; ++step) {
      const auto inserted = t.insert(random_point(random, GetParam()), any_triangle(t));
      if (inserted.is_new) vertices.push_back(inserted.vertex);
    }
    for (int i = 0; i < 8 && vertices.size() > 6; ++i) {  // slots that the step gives out again
      const std::size_t k = random() % vertices.size();
      t.remove(vertices[k]);
      vertices.erase(vertices.begin() + static_cast<std::ptrdiff_t>(k));
    }
    const Triangulation before = t;
    t.begin();
    std::vector<VertexId> now = vertices;
    for (int step = 0; step < 30; ++step) {
      insert_or_remove(t, now, GetParam(), 2, random);
      // A circle that is sure of nothing is right for any triangle.
      const TriangleId moved{static_cast<std::uint32_t>(random() % t.triangle_slots())};
      if (t[moved].alive()) t.set_moved(moved, {}, 1000U + static_cast<std::uint32_t>(step));
    }
    t.rollback();
    ASSERT_EQ(t.vertex_slots(), before.vertex_slots());
    ASSERT_EQ(t.triangle_slots(), before.triangle_slots());
    for (std::uint32_t i = 0; i < t.triangle_slots(); ++i)
      for (int k = 0; k < 3; ++k) {
        ASSERT_EQ(t[TriangleId{i}].vertex[k], before[TriangleId{i}].vertex[k]);
        ASSERT_EQ(t[TriangleId{i}].link[k], before[TriangleId{i}].link[k]);
      }
    for (std::uint32_t i = 0; i < t.triangle_slots(); ++i) {
      ASSERT_EQ(t[TriangleId{i}].birth, before[TriangleId{i}].birth);
      ASSERT_EQ(t[TriangleId{i}].circle.outside, before[TriangleId{i}].circle.outside);
    }
    for (std::uint32_t i = 0; i < t.vertex_slots(); ++i) {
      ASSERT_EQ(t[VertexId{i}].star, before[VertexId{i}].star);
      ASSERT_EQ(t.generation(VertexId{i}), before.generation(VertexId{i}));
    }
    ASSERT_EQ(t.check(), "");
  }
}

TEST_P(KernelOnFamily, KnowsTheVerticesOfTheBeginningOfAJournal) {
  const auto seed = test::seed(26 + static_cast<unsigned long long>(GetParam()));
  SCOPED_TRACE("REMODEL_TEST_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  Triangulation t = started(random, GetParam());
  std::vector<VertexId> vertices;
  const auto change = [&](int steps) {
    for (int step = 0; step < steps; ++step) {
      insert_or_remove(t, vertices, GetParam(), 2, random);
      if (!vertices.empty())
        t.set_length_scale(vertices[random() % vertices.size()], static_cast<double>(random() % 1000));
    }
  };
  for (int round = 0; round < 20; ++round) {
    change(10);
    const Triangulation first = t;
    t.begin();
    change(10);
    std::map<std::uint32_t, Vertex> earlier;
    for (const auto& [id, vertex] : t.earlier_vertices())
      ASSERT_TRUE(earlier.emplace(id.index, vertex).second);
    for (std::uint32_t i = 0; i < first.vertex_slots(); ++i) {
      const auto entry = earlier.find(i);
      const Vertex& found = entry == earlier.end() ? t[VertexId{i}] : entry->second;
      ASSERT_EQ(found.star, first[VertexId{i}].star);
      ASSERT_EQ(found.point, first[VertexId{i}].point);
      ASSERT_EQ(found.length_scale, first[VertexId{i}].length_scale);
    }
    t.commit();
  }
}

TEST(Moves, LeaveADelaunayTriangulationOnceItIsRestored) {
  const auto seed = test::seed(15);
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  Triangulation t = triangulation_of(random, 400);
  for (int round = 0; round < 20; ++round) {
    std::set<TriangleId> moved;
    for (std::uint32_t i = 1; i < t.vertex_slots(); ++i) {
      const VertexId v{i};
      bool inner = true;
      t.for_each_corner(v, [&](Corner c) { inner &= !t[c.triangle].ghost(); });
      if (!inner) continue;
      const Point before = t.point(v), there = random_point(random, 0);
      const auto valid = [&] {
        bool result = true;
        t.for_each_corner(v, [&](Corner c) {
          const Triangle& star = t[c.triangle];
          result &= orient2d(t.point(star.vertex[0]), t.point(star.vertex[1]), t.point(star.vertex[2])) > 0;
        });
        return result;
      };
      t.move(v, before + 0.03 * (there - before), 0.0);
      if (!valid()) t.move(v, before, 0.0);
      t.for_each_corner(v, [&](Corner c) { moved.insert(c.triangle); });
    }
    for (const TriangleId triangle : moved) t.refresh_circle(triangle);
    ASSERT_NE(t.check(), "");  // or nothing is tested
    t.restore_delaunay(std::vector<TriangleId>(moved.begin(), moved.end()));
    ASSERT_EQ(t.check(), "");
  }
}

TEST(Journal, GivesFreedTrianglesOutAgain) {
  const auto seed = test::seed(29);
  SCOPED_TRACE("REMODEL_TEST_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  Triangulation t = triangulation_of(random, 100);
  const std::size_t slots = t.triangle_slots();
  t.begin();
  for (int i = 0; i < 100; ++i) t.remove(t.insert(random_point(random, 0), any_triangle(t)).vertex);
  EXPECT_LE(t.triangle_slots(), slots + 2);
  t.rollback();
  EXPECT_EQ(t.check(), "");
}

bool same_record(const Triangle& a, const Triangle& b) {
  return std::ranges::equal(a.vertex, b.vertex) && std::ranges::equal(a.link, b.link);
}

// With more marks than there are numbers, so that they are given out anew within a journal.
TEST(Journal, ListsWhatChangedSinceAMarkAndComesBackFromBeforeIt) {
  const auto seed = test::seed(30);
  SCOPED_TRACE("REMODEL_TEST_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  Triangulation t = triangulation_of(random, 60);
  const Triangulation before = t;
  t.begin();
  std::vector<VertexId> vertices;
  std::set<TriangleId> touched;
  for (int mark = 0; mark < 70000; ++mark) {
    t.mark();
    if (mark % 500 != 0) continue;
    const Triangulation at_mark = t;
    insert_or_remove(t, vertices, 0, 2, random);
    std::set<TriangleId> since;
    for (const TriangleId id : t.touched_since_mark()) ASSERT_TRUE(since.insert(id).second);
    for (std::uint32_t i = 0; i < t.triangle_slots(); ++i) {
      const bool same = i < at_mark.triangle_slots() && same_record(t[TriangleId{i}], at_mark[TriangleId{i}]);
      ASSERT_TRUE(same || since.contains(TriangleId{i})) << i;
    }
    touched.insert(since.begin(), since.end());
  }
  EXPECT_EQ(std::set<TriangleId>(t.touched().begin(), t.touched().end()), touched);
  EXPECT_EQ(t.touched().size(), touched.size());
  t.rollback();
  EXPECT_EQ(t.check(), "");
  ASSERT_EQ(t.triangle_slots(), before.triangle_slots());
  for (std::uint32_t i = 0; i < t.triangle_slots(); ++i)
    EXPECT_TRUE(same_record(t[TriangleId{i}], before[TriangleId{i}])) << i;
  // What came back is touched anew by the next journal, and comes back once more.
  t.begin();
  for (std::uint32_t i = 0; i < t.triangle_slots(); ++i) ASSERT_FALSE(t.is_touched(TriangleId{i})) << i;
  vertices.clear();
  for (int i = 0; i < 20; ++i) insert_or_remove(t, vertices, 0, 2, random);
  EXPECT_FALSE(t.touched().empty());
  t.rollback();
  EXPECT_EQ(t.check(), "");
}

INSTANTIATE_TEST_SUITE_P(Families, KernelOnFamily, testing::Range(0, 5));

TEST(Constraints, OfRandomSegmentsAreKeptThroughInsertionAndRemoval) {
  const auto seed = test::seed(31);
  SCOPED_TRACE("REMODEL_TEST_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  for (int round = 0; round < 30; ++round) {
    const int family = round % 2;
    Triangulation t = started(random, family);
    std::vector<VertexId> vertices;
    for (int i = 0; i < 80; ++i) {
      const auto inserted = t.insert(random_point(random, family), any_triangle(t));
      if (inserted.is_new) vertices.push_back(inserted.vertex);
    }
    std::vector<std::pair<VertexId, VertexId>> segments;
    std::set<VertexId> ends;
    for (int i = 0; i < 12; ++i) {
      const VertexId a = vertices[random() % vertices.size()], b = vertices[random() % vertices.size()];
      if (a == b || t.constrain(a, b).kind != ConstrainResult::Kind::done) continue;
      segments.emplace_back(a, b);
      ends.insert(a);
      ends.insert(b);
      ASSERT_EQ(t.check(), "");
    }
    ASSERT_FALSE(segments.empty());
    for (int i = 0; i < 60; ++i) {
      const VertexId v = vertices[random() % vertices.size()];
      if (t[v].alive() && !ends.contains(v) && random() % 2 == 0) {
        bool constrained = false;  // v may have been inserted onto a constrained edge
        Corner c = t.star(v);
        const TriangleId first = c.triangle;
        do {
          constrained |= t.link({c.triangle, next3(c.index)}).constrained();
          c = t.counterclockwise(c);
        } while (c.triangle != first);
        if (!constrained) t.remove(v);
      } else {
        t.insert(random_point(random, 0), any_triangle(t));
      }
      ASSERT_EQ(t.check(), "") << "round " << round << " step " << i;
    }
    if (family == 0)
      for (const auto& [a, b] : segments) {
        const auto edge = t.find_edge(a, b);
        if (edge) {
          EXPECT_TRUE(t.link(*edge).constrained());
        }
      }
    for (const auto& [a, b] : segments)
      if (t.find_edge(a, b)) t.release(a, b);
    EXPECT_EQ(t.check(), "");
  }
}

// A square with its diagonal constrained, domain on one side: what is inserted into a region, and what its
// removal leaves, has that region.
TEST(Regions, AreThoseOfTheSurroundingsAfterInsertionAndRemoval) {
  Triangulation t;
  t.start({0, 0}, {8, 0}, {8, 8});
  t.insert({0, 8}, any_triangle(t));
  ASSERT_EQ(t.constrain(VertexId{1}, VertexId{3}).kind, ConstrainResult::Kind::done);
  const auto below = [&](const Triangle& triangle) {  // the diagonal
    Point sum{0, 0};
    for (const VertexId v : triangle.vertex) sum = sum + t.point(v);
    return sum.x > sum.y;
  };
  for (std::uint32_t i = 0; i < t.triangle_slots(); ++i)
    if (t[TriangleId{i}].alive() && !t[TriangleId{i}].ghost())
      t.set_region(TriangleId{i}, below(t[TriangleId{i}]) ? Region::domain : Region::outside);
  const auto expect_regions = [&] {
    for (std::uint32_t i = 0; i < t.triangle_slots(); ++i) {
      const Triangle& triangle = t[TriangleId{i}];
      if (triangle.alive() && !triangle.ghost()) {
        ASSERT_EQ(triangle.region, below(triangle) ? Region::domain : Region::outside) << "triangle " << i;
      }
    }
  };
  const auto seed = test::seed(61);
  SCOPED_TRACE("REMODEL_TEST_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  std::vector<VertexId> inner;
  for (int step = 0; step < 200; ++step) {
    if (inner.size() > 5 && random() % 2 == 0) {
      const std::size_t k = random() % inner.size();
      t.remove(inner[k]);
      inner.erase(inner.begin() + static_cast<std::ptrdiff_t>(k));
    } else {
      const Point p{static_cast<double>(random() % 63 + 1) / 8, static_cast<double>(random() % 63 + 1) / 8};
      if (p.x == p.y) continue;
      const auto inserted = t.insert(p, any_triangle(t));
      if (inserted.is_new) inner.push_back(inserted.vertex);
    }
    ASSERT_NO_FATAL_FAILURE(expect_regions()) << "step " << step;
  }
}

// A random polygon that is star-shaped about the middle of the unit square, constrained among random points;
// the domain is inside.
struct PolygonAmongPoints {
  explicit PolygonAmongPoints(std::mt19937_64& random) {
    triangulation.start({0, 0}, {1, 0}, {1, 1});
    triangulation.insert({0, 1}, any_triangle(triangulation));
    const auto uniform = [&](double low, double high) { return test::uniform(random, low, high); };
    const std::size_t corners = 6 + random() % 30;
    for (std::size_t i = 0; i < corners; ++i) {
      const double angle = 6.283 * static_cast<double>(i) / static_cast<double>(corners);
      const double radius = uniform(0.3, 0.36);
      polygon.push_back(insert({0.5 + radius * std::cos(angle), 0.5 + radius * std::sin(angle)}));
    }
    for (std::size_t i = 0; i < corners; ++i)
      constrained &=
          triangulation.constrain(polygon[i], polygon[(i + 1) % corners]).kind == ConstrainResult::Kind::done;
    for (std::size_t i = random() % 200; i > 0; --i) insert({uniform(0.0, 1.0), uniform(0.0, 1.0)});
    for (std::uint32_t i = 0; i < triangulation.triangle_slots(); ++i)
      triangulation.set_region(TriangleId{i}, region_of(triangulation[TriangleId{i}]));
  }
  VertexId insert(Point p) { return triangulation.insert(p, any_triangle(triangulation)).vertex; }
  Region region_of(const Triangle& t) const {
    if (!t.alive() || t.ghost()) return Region::outside;
    Point p{0, 0};
    for (const VertexId v : t.vertex) p = p + (1.0 / 3.0) * triangulation.point(v);
    bool inside = false;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point a = triangulation.point(polygon[i]),
                  b = triangulation.point(polygon[(i + 1) % polygon.size()]);
      if ((a.y > p.y) != (b.y > p.y)) inside ^= (cross(b - a, p - a) > 0.0) == (b.y > a.y);
    }
    return inside ? Region::domain : Region::outside;
  }
  // The same vertices and polygon, put together from nothing.
  std::set<Triple> rebuilt() const {
    Triangulation t;
    t.start({0, 0}, {1, 0}, {1, 1});
    for (std::uint32_t i = 1; i < triangulation.vertex_slots(); ++i)
      if (const Vertex& v = triangulation[VertexId{i}]; v.alive()) t.insert(v.point, any_triangle(t));
    const auto copy_of = [&](VertexId v) { return t.insert(triangulation.point(v), any_triangle(t)).vertex; };
    for (std::size_t i = 0; i < polygon.size(); ++i)
      t.constrain(copy_of(polygon[i]), copy_of(polygon[(i + 1) % polygon.size()]));
    return triangle_set(t);
  }

  Triangulation triangulation;
  std::vector<VertexId> polygon;
  bool constrained = true;
};

TEST(Unsplitting, LeavesTheConstrainedTriangulationOfTheOthersWithRegionsOnTheirSides) {
  const auto seed = test::seed(67);
  SCOPED_TRACE("REMODEL_TEST_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  int done = 0, refused = 0;
  for (int round = 0; round < 60; ++round) {
    PolygonAmongPoints made(random);
    if (!made.constrained) continue;
    Triangulation& t = made.triangulation;
    for (int step = 0; step < 20 && made.polygon.size() > 4; ++step) {
      const auto place = made.polygon.begin() + static_cast<std::ptrdiff_t>(random() % made.polygon.size());
      const std::set<Triple> before = triangle_set(t);
      const bool back = random() % 2 == 0;
      if (back) t.begin();
      const std::vector<VertexId> polygon = made.polygon;
      if (t.unsplit(*place)) {
        ++done;
        EXPECT_FALSE(t[*place].alive());
        made.polygon.erase(place);
        EXPECT_EQ(triangle_set(t), made.rebuilt());
        for (std::uint32_t i = 0; i < t.triangle_slots(); ++i)
          ASSERT_EQ(t[TriangleId{i}].alive() ? t[TriangleId{i}].region : Region::outside,
                    made.region_of(t[TriangleId{i}]));
      } else {
        ++refused;
        EXPECT_EQ(triangle_set(t), before);
      }
      ASSERT_EQ(t.check(), "") << "round " << round << " step " << step;
      if (!back) continue;
      t.rollback();
      made.polygon = polygon;
      EXPECT_EQ(triangle_set(t), before);
      ASSERT_EQ(t.check(), "");
    }
  }
  EXPECT_GT(done, 100);
  EXPECT_GT(refused, 20);
}

TEST(Unsplitting, IsRefusedAtTheHullAndWhereThreeConstrainedEdgesMeet) {
  Triangulation t;
  t.start({0, 0}, {4, 0}, {4, 4});
  const VertexId a = t.insert({0, 0}, any_triangle(t)).vertex, b = t.insert({4, 0}, any_triangle(t)).vertex,
                 c = t.insert({4, 4}, any_triangle(t)).vertex, d = t.insert({0, 4}, any_triangle(t)).vertex,
                 m = t.insert({2, 1}, any_triangle(t)).vertex;
  t.insert({2, 3}, any_triangle(t));
  for (const VertexId v : {a, b}) t.constrain(v, m);
  t.constrain(a, d);
  EXPECT_FALSE(t.unsplit(a));
  t.constrain(m, c);
  EXPECT_FALSE(t.unsplit(m));
  t.release(m, c);
  EXPECT_FALSE(t.unsplit(m)) << "a-b is there already";
  EXPECT_EQ(t.check(), "");

  Triangulation wheel;
  wheel.start({0, 0}, {4, 0}, {4, 4});
  const auto add = [&](double x, double y) { return wheel.insert({x, y}, any_triangle(wheel)).vertex; };
  const VertexId middle = add(2, 2);
  for (const auto& [x, y] : {std::pair{0, 0}, {4, 0}, {4, 4}}) wheel.constrain(add(x, y), middle);
  for (const auto& [x, y] : {std::pair{2.0, -0.5}, {4.5, 2.0}, {2.0, 4.5}, {-0.5, 2.0}, {0.0, 4.0}})
    add(x, y);
  EXPECT_FALSE(wheel.unsplit(middle));
  wheel.release(middle, add(4, 0));
  EXPECT_TRUE(wheel.unsplit(middle));
  EXPECT_EQ(wheel.check(), "");
}

TEST(Constraints, AreRefusedWhereTheyCrossAnotherOrPassThroughAVertex) {
  Triangulation t;
  t.start({0, 0}, {2, 0}, {2, 2});
  const VertexId a = t.insert({0, 0}, any_triangle(t)).vertex, c = t.insert({2, 2}, any_triangle(t)).vertex;
  const VertexId b = t.insert({2, 0}, any_triangle(t)).vertex, d = t.insert({0, 2}, any_triangle(t)).vertex;
  EXPECT_EQ(t.constrain(a, c).kind, ConstrainResult::Kind::done);
  const ConstrainResult crossing = t.constrain(b, d);
  EXPECT_EQ(crossing.kind, ConstrainResult::Kind::blocked);
  EXPECT_TRUE((crossing.first == a && crossing.second == c) || (crossing.first == c && crossing.second == a));
  const auto middle = t.insert({1, 1}, any_triangle(t));
  EXPECT_TRUE(middle.is_new);
  EXPECT_TRUE(t.link(*t.find_edge(a, middle.vertex)).constrained());
  EXPECT_TRUE(t.link(*t.find_edge(middle.vertex, c)).constrained());
  EXPECT_EQ(t.constrain(b, d).kind, ConstrainResult::Kind::vertex);
  EXPECT_EQ(t.check(), "");
}

}  // namespace
}  // namespace remodel
