// Domains that are the mesh's own, or nearly, in another order: what did not change is kept bit for bit,
// whatever the order of the loops, their direction and their first corner.

#include "step/correspondence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <set>

#include "mesh/mesh_data.h"
#include "remodel/check.h"
#include "remodel/generate.h"
#include "remodel/remodel.h"
#include "step/test_designs.h"
#include "support.h"

namespace remodel {
namespace {

using Random = std::mt19937_64;

std::size_t below(Random& random, std::size_t end) {
  return random() % end;
}
double between(Random& random, double low, double high) {
  return test::uniform(random, low, high);
}

// ---- the same loops, written otherwise

Parameters mirrored(const Parameters& parameters) {
  if (parameters == Parameters::uniform(parameters.size())) return parameters;
  std::vector<double> values{0.0};
  for (std::size_t i = parameters.size(); i-- > 1;) values.push_back(1.0 - parameters[i]);
  return values;
}

std::optional<Curve> backwards(const Curve& curve) {
  Curve result = curve;
  result.parameters = mirrored(curve.parameters);
  if (auto* line = std::get_if<Line>(&result.shape)) {
    std::swap(line->from, line->to);
  } else if (auto* polyline = std::get_if<Polyline>(&result.shape)) {
    std::reverse(polyline->points.begin(), polyline->points.end());
  } else if (auto* arc = std::get_if<Arc>(&result.shape)) {
    arc->start += arc->sweep;
    arc->sweep = -arc->sweep;
  } else if (auto* spline = std::get_if<Spline>(&result.shape)) {
    std::vector<Point> points(spline->points.rbegin(), spline->points.rend());
    result.shape =
        spline_through(std::move(points), spline->corner ? SplineEnds::corner : SplineEnds::smooth);
  } else {
    return std::nullopt;
  }
  return result;
}

Loop backwards(const Loop& loop) {
  Loop result = loop;
  result.curves.clear();
  for (std::size_t c = loop.curves.size(); c-- > 0;) {
    const std::optional<Curve> curve = backwards(loop.curves[c]);
    if (!curve) return loop;
    result.curves.push_back(*curve);
  }
  if (loop.role == LoopRole::left) result.role = LoopRole::right;
  if (loop.role == LoopRole::right) result.role = LoopRole::left;
  if (loop.role == LoopRole::internal) std::swap(result.region, result.right_region);
  return result;
}

// A closed polygon, of which corners are the stations, or a circle: from another one of them on.
Loop from_another_corner(const Loop& loop, std::size_t shift) {
  Loop result = loop;
  if (loop.open) return loop;
  if (loop.curves.size() > 1) {
    std::rotate(result.curves.begin(), result.curves.begin() + static_cast<long>(shift % loop.curves.size()),
                result.curves.end());
    return result;
  }
  Curve& curve = result.curves[0];
  const std::size_t n = curve.parameters.size();
  if (auto* polyline = std::get_if<Polyline>(&curve.shape); polyline && polyline->points.size() == n + 1) {
    polyline->points.pop_back();
    std::rotate(polyline->points.begin(), polyline->points.begin() + static_cast<long>(shift % n),
                polyline->points.end());
    polyline->points.push_back(polyline->points.front());
  } else if (auto* arc = std::get_if<Arc>(&curve.shape)) {
    arc->start += arc->sweep * static_cast<double>(shift % n) / static_cast<double>(n);
  }
  return result;
}

Domain shuffled(const Domain& domain, Random& random) {
  Domain result = domain;
  std::shuffle(result.loops.begin(), result.loops.end(), random);
  for (Loop& loop : result.loops) {
    loop = from_another_corner(loop, below(random, 7));
    if (random() % 2 == 0) loop = backwards(loop);
  }
  return result;
}

// ---- random domains

Loop chain_through(std::vector<Point> points, const std::string& name) {
  const std::size_t pieces = points.size() - 1;
  Loop loop = test::loop(LoopRole::internal, name, Polyline{std::move(points)}, pieces);
  loop.open = true;
  return loop;
}

std::vector<Point> around(Point centre, double radius, std::size_t corners, Random& random) {
  std::vector<Point> points;
  const double turn = between(random, 0.0, 6.0);
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle =
        turn + 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners);
    points.push_back(centre + (radius * between(random, 0.6, 1.0)) * Point{std::cos(angle), std::sin(angle)});
  }
  return points;
}

// A feature in a cell of the unit square: a hole, an island in a hole is left out, a region, a chain or a
// point.
Loop feature(Point centre, double radius, Random& random) {
  const std::string name = random() % 2 == 0 ? "hole" : "h" + std::to_string(random() % 5);
  switch (random() % 8) {
    case 0:
      return test::loop(LoopRole::hole, name, Arc{.centre = centre, .radius = radius}, 6 + below(random, 20));
    case 1: {
      std::vector<Point> points = around(centre, radius, 5 + below(random, 4), random);
      points.push_back(points.front());
      return test::loop(LoopRole::hole, name, spline_through(std::move(points)), 12);
    }
    case 2: {
      const std::vector<Point> p = around(centre, radius, 4, random);
      Loop loop{.role = LoopRole::hole, .curves = {}};
      for (std::size_t i = 0; i < 4; ++i)
        loop.curves.push_back({name + (i % 2 == 0 ? "" : " side"), Line{p[i], p[(i + 1) % 4]},
                               Parameters::uniform(1 + below(random, 3))});
      return loop;
    }
    case 3: {
      Loop loop = test::polygon(LoopRole::internal, "patch", around(centre, radius, 5, random));
      loop.region = "inside " + name;
      loop.right_region = "around";
      return loop;
    }
    case 4:
      return chain_through(around(centre, radius, 3, random), "chain");
    case 5: {
      Loop loop = test::loop(LoopRole::internal, "point", Line{centre, centre}, 1);
      loop.open = true;
      return loop;
    }
    case 6: {
      const CstAirfoil section = airfoil_catalogue()[below(random, 10)].airfoil();
      Domain domain = airfoils_domain(
          {{.name = name, .airfoil = section, .placement = {radius, between(random, -20, 20), centre}}},
          {.points = 24});
      return domain.loops[0];
    }
    default:
      return test::polygon(LoopRole::hole, name, around(centre, radius, 3 + below(random, 6), random));
  }
}

Domain random_domain(Random& random, double shrink = 1.0) {
  const std::size_t n = 2 + below(random, 3);
  Domain domain;
  std::vector<Point> box{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  if (random() % 2 == 0) box.insert(box.begin() + 1, {{0.3, -0.1}, {0.6, 0.0}});
  domain.loops.push_back(test::polygon(LoopRole::outer, "outer", box, 1));
  const double cell = 1.0 / static_cast<double>(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      if (random() % 4 == 0) continue;
      const Point centre{(static_cast<double>(i) + 0.5) * cell, (static_cast<double>(j) + 0.5) * cell};
      domain.loops.push_back(feature(centre, shrink * 0.35 * cell, random));
    }
  // A chain from a corner of the outline: joined there.
  if (random() % 2 == 0)
    domain.loops.push_back(chain_through({{1, 1}, {1 - 0.1 * cell, 1 - 0.12 * cell}}, "joined"));
  return domain;
}

using Seen = std::array<std::uint64_t, 3>;
std::set<Seen> triangles_of(const FrozenMesh& mesh) {
  std::set<Seen> result;
  for (const auto& t : mesh.triangles) {
    Seen seen{mesh.vertex_keys[t[0]], mesh.vertex_keys[t[1]], mesh.vertex_keys[t[2]]};
    std::rotate(seen.begin(), std::min_element(seen.begin(), seen.end()), seen.end());
    result.insert(seen);
  }
  return result;
}

std::string fault_of(const Mesh& mesh) {
  if (std::string broken = mesh.quick_check(); !broken.empty()) return broken;
  const CheckResult result = check(mesh.freeze(), {.min_angle_deg = mesh.options().min_angle_deg,
                                                   .max_gradation = mesh.promised_gradation(),
                                                   .design = &mesh.domain(),
                                                   .max_violations = 1});
  if (result.valid) return {};
  return result.violations.empty() ? "not valid"
                                   : result.violations[0].rule + ": " + result.violations[0].detail;
}

constexpr Strategy every_strategy[] = {Strategy::chain, Strategy::renew, Strategy::morph,
                                       Strategy::reference};

std::multiset<std::string> names_and_regions(const Domain& domain) {
  std::multiset<std::string> result;
  for (const Loop& loop : domain.loops) {
    std::set<std::string> regions{loop.region, loop.right_region};
    std::string all;
    for (const std::string& region : regions) all += region + ",";
    result.insert(all);
    for (const Curve& curve : loop.curves) result.insert(curve.name);
  }
  return result;
}

TEST(Correspondence, TheSameDomainInAnyOrderDirectionAndFirstCornerKeepsEveryTriangle) {
  const unsigned long long seed = test::seed(42);
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  for (int i = 0; i < 1000 && !HasFailure(); ++i) {
    SCOPED_TRACE("domain " + std::to_string(i));
    const Domain domain = random_domain(random);
    Mesh mesh = generate(domain).mesh;
    const MeshState before = mesh.state();
    const Domain other = shuffled(domain, random);
    const RemodelOptions options{.strategy = every_strategy[i % 4]};
    { const Trial trial(mesh, other, options); }
    ASSERT_TRUE(mesh.state() == before) << "a trial changed the mesh";
    const std::set<Seen> triangles = triangles_of(mesh.freeze());
    const Mark mark = mesh.mark();
    const RemodelResult result = remodel(mesh, other, options);
    EXPECT_EQ(result.preserved, result.triangles_before);
    EXPECT_EQ(mesh.state().coordinates, before.coordinates);
    EXPECT_EQ(triangles_of(mesh.freeze()), triangles);
    const Changes changes = mesh.changes_since(mark);
    EXPECT_TRUE(changes.same_connectivity() && changes.moved.empty());
    EXPECT_EQ(fault_of(mesh), "");
    EXPECT_EQ(names_and_regions(mesh.domain()), names_and_regions(other));
    EXPECT_TRUE(Mesh::restore(mesh.state(), "state").state() == mesh.state());
    // The order is the new one from now on: the loops moved little, and follow by index.
    EXPECT_EQ(remodel(mesh, other, options).preserved, result.triangles_before);
  }
}

TEST(Correspondence, NewNamesRolesAndRegionsWin) {
  Domain domain = test::with_holes({test::square_hole(0.3, 0.3, 0.1), test::circle_hole(0.7, 0.7, 0.1)});
  Mesh mesh = generate(domain).mesh;
  domain.loops[1].region = "water";
  domain.loops[1].curves[0].name = "pier";
  for (const Strategy strategy : every_strategy) {
    domain.loops[2].curves[0].name = name_of(strategy);
    const RemodelResult result = remodel(mesh, domain, {.strategy = strategy});
    EXPECT_EQ(result.preserved, result.triangles_before);
    EXPECT_TRUE(mesh.domain() == domain);
    EXPECT_EQ(fault_of(mesh), "");
  }
}

// How many of the triangles that are farther than this from all points of a loop the mesh still has, in per
// cent.
double kept_beyond(const FrozenMesh& before, const Mesh& mesh, const std::vector<Point>& loop,
                   double radius) {
  const FrozenMesh after = mesh.freeze();
  const std::set<Seen> now = triangles_of(after);
  std::size_t all = 0, kept = 0;
  for (const auto& t : before.triangles) {
    const bool far = std::all_of(t.begin(), t.end(), [&](std::uint32_t v) {
      return std::all_of(loop.begin(), loop.end(),
                         [&](Point p) { return squared_distance(p, before.points[v]) > radius * radius; });
    });
    if (!far) continue;
    ++all;
    Seen seen{before.vertex_keys[t[0]], before.vertex_keys[t[1]], before.vertex_keys[t[2]]};
    std::rotate(seen.begin(), std::min_element(seen.begin(), seen.end()), seen.end());
    kept += now.contains(seen);
  }
  return all == 0 ? 100.0 : 100.0 * static_cast<double>(kept) / static_cast<double>(all);
}

double longest_segment(const Domain& domain, std::size_t loop) {
  const std::vector<Point> points = domain.points(loop);
  double longest = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
    longest = std::max(longest, squared_distance(points[i], points[(i + 1) % points.size()]));
  return std::sqrt(longest);
}

TEST(Correspondence, OneLoopGoneOrAddedKeepsWhatIsFartherThanARemovalRadius) {
  const unsigned long long seed = test::seed(43);
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  double sum[2][4] = {};
  int count[2][4] = {};
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE("domain " + std::to_string(i));
    const Domain whole = random_domain(random);
    if (whole.loops.size() < 4) continue;
    const std::size_t loop = 1 + below(random, whole.loops.size() - 1);
    Domain less = whole;
    less.loops.erase(less.loops.begin() + static_cast<long>(loop));
    const bool gone = i / 4 % 2 == 0;
    const Domain &from = gone ? whole : less, to = shuffled(gone ? less : whole, random);
    Mesh mesh = generate(from).mesh;
    const FrozenMesh before = mesh.freeze();
    const MeshState state = mesh.state();
    const RemodelOptions options{.strategy = every_strategy[i % 4]};
    { const Trial trial(mesh, to, options); }
    ASSERT_TRUE(mesh.state() == state) << "a trial changed the mesh";
    const RemodelResult result = remodel(mesh, to, options);
    EXPECT_FALSE(result.regenerated) << result.reason;
    ASSERT_EQ(fault_of(mesh), "");
    if (before.triangles.size() < 300) continue;  // of which a removal radius takes much
    const double kept = kept_beyond(before, mesh, whole.points(loop), longest_segment(whole, loop));
    // Where a loop is added its length scales reach farther: what is around it has to be finer.
    EXPECT_GT(kept, gone ? 90.0 : 70.0);
    sum[gone][i % 4] += kept;
    ++count[gone][i % 4];
  }
  for (int s = 0; s < 4; ++s) {
    EXPECT_GT(sum[1][s] / count[1][s], 98.0) << name_of(every_strategy[s]) << ", gone";
    EXPECT_GT(sum[0][s] / count[0][s], 94.0) << name_of(every_strategy[s]) << ", added";
  }
}

// ---- loops that correspond but for a few stations

CstAirfoil with_edge(CstAirfoil airfoil, double gap) {
  airfoil.te_upper = 0.5 * gap;
  airfoil.te_lower = -0.5 * gap;
  return airfoil;
}

TEST(Correspondence, AnOpenTrailingEdgeClosesAndAClosedOneOpensByEveryStrategy) {
  for (std::size_t a = 0; a < airfoil_catalogue().size(); ++a)
    for (std::size_t b = 0; b < airfoil_catalogue().size(); ++b) {
      const CstAirfoil from = airfoil_catalogue()[a].airfoil(), to = airfoil_catalogue()[b].airfoil();
      const bool opens = (a + b) % 2 == 0;
      const Domain before = airfoil_domain(with_edge(from, opens ? 0.0 : 0.004), {.points = 100});
      const Domain after = airfoil_domain(with_edge(to, opens ? 0.004 : 0.0), {.points = 100});
      const Mesh start = generate(before).mesh;
      const MeshState state = start.state();
      for (const Strategy strategy : every_strategy) {
        SCOPED_TRACE(std::to_string(a) + " to " + std::to_string(b) + " by " + name_of(strategy));
        Mesh mesh = start;
        const RemodelOptions options{.method = Method::specialised, .strategy = strategy};
        if (a == b) {
          const Trial trial(mesh, after, options);
          EXPECT_FALSE(trial.result().regenerated);
        }
        ASSERT_TRUE(mesh.state() == state);
        const Mark mark = mesh.mark();
        const RemodelResult result = remodel(mesh, after, options);
        EXPECT_FALSE(result.regenerated) << result.reason;
        EXPECT_EQ(result.method, Method::specialised);
        EXPECT_GT(result.connectivity_percent(), result.morphed ? 90.0 : 45.0);
        EXPECT_EQ(mesh.changes_since(mark).gone.size(), result.gone());
        EXPECT_EQ(mesh.quick_check(), "");
      }
    }
}

AirfoilCoordinates coordinates_of(const CstAirfoil& airfoil, std::size_t points) {
  AirfoilCoordinates coordinates;
  for (std::size_t i = 0; i <= points; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(2 * points);
    coordinates.upper.push_back(airfoil.at(0.5 - t));
    coordinates.lower.push_back(airfoil.at(0.5 + t));
  }
  return coordinates;
}

// From the upper end of the trailing edge around the nose to the lower one.
std::vector<Point> outline_points(const AirfoilCoordinates& coordinates) {
  std::vector<Point> points(coordinates.upper.rbegin(), coordinates.upper.rend());
  points.insert(points.end(), coordinates.lower.begin() + 1, coordinates.lower.end());
  return points;
}

TEST(Correspondence, OutlinesAsGivenOpenAndCloseLikewise) {
  for (const OutlineCurve curve : {OutlineCurve::spline, OutlineCurve::polyline})
    for (std::size_t a = 0; a < airfoil_catalogue().size(); ++a) {
      const std::size_t b = (a + 3) % airfoil_catalogue().size();
      const auto domain = [&](std::size_t airfoil, double gap) {
        const CstAirfoil section = with_edge(airfoil_catalogue()[airfoil].airfoil(), gap);
        PlacedAirfoil placed;
        placed.outline = outline_of(outline_points(coordinates_of(section, 40)), curve, "airfoil");
        return airfoils_domain({placed});
      };
      for (const bool opens : {false, true}) {
        SCOPED_TRACE(std::to_string(a) + (opens ? " opens" : " closes"));
        Mesh mesh = generate(domain(a, opens ? 0.0 : 0.004)).mesh;
        const RemodelResult result =
            remodel(mesh, domain(b, opens ? 0.004 : 0.0), {.strategy = Strategy::morph});
        EXPECT_FALSE(result.regenerated) << result.reason;
        EXPECT_GT(result.connectivity_percent(), 88.0);
        EXPECT_EQ(fault_of(mesh), "");
      }
    }
}

TEST(Correspondence, APolygonKeepsWhatACornerMoreOrLessLeaves) {
  constexpr std::size_t n = 24;
  std::vector<Point> corners;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / n;
    corners.push_back({0.5 + 0.2 * std::cos(angle), 0.5 + 0.15 * std::sin(angle)});
  }
  std::vector<Point> more = corners;
  more.insert(more.begin() + 3, 0.5 * (corners[2] + corners[3]) + Point{0.002, 0.004});
  const auto domain = [](const std::vector<Point>& polygon) {
    return test::with_holes({test::polygon(LoopRole::hole, "hole", polygon)});
  };
  const auto moved = [](std::vector<Point> polygon) {
    for (Point& p : polygon) p = p + Point{0.02, 0.01};
    return polygon;
  };
  for (const Strategy strategy : every_strategy)
    for (const bool adds : {true, false}) {
      SCOPED_TRACE(std::string(name_of(strategy)) + (adds ? " adds" : " takes"));
      const std::vector<Point>&from = adds ? corners : more, &to = adds ? more : corners;
      const Mesh start = generate(domain(from), {.resolution = 2.0}).mesh;
      Mesh mesh = start, plain = start;
      RemodelResult result = remodel(mesh, domain(to), {.strategy = strategy});
      EXPECT_GT(result.preserved_percent(), 88.0);
      EXPECT_EQ(fault_of(mesh), "");
      mesh = start;
      result = remodel(mesh, domain(moved(to)), {.strategy = strategy});
      EXPECT_FALSE(result.regenerated) << result.reason;
      const double alike = remodel(plain, domain(moved(from)), {.strategy = strategy}).connectivity_percent();
      EXPECT_GT(result.connectivity_percent(), alike - 12.0);
      EXPECT_EQ(fault_of(mesh), "");
    }
}

TEST(Correspondence, HolesThatMoveALittleMoveWhateverTheirOrderAndFirstCorners) {
  const unsigned long long seed = test::seed(44);
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  for (int i = 0; i < 60 && !HasFailure(); ++i) {
    SCOPED_TRACE("domain " + std::to_string(i));
    Domain domain{{test::rectangle(LoopRole::outer, "outer", {0, 0}, {1, 1}, 4)}};
    for (int k = 0; k < 9; ++k)
      domain.loops.push_back(
          test::polygon(LoopRole::hole, "hole",
                        around({0.2 + 0.3 * (k % 3), 0.2 + 0.3 * static_cast<double>(k / 3)}, 0.1,
                               5 + below(random, 3), random)));
    Mesh mesh = generate(domain, {.resolution = 2.0}).mesh;
    Domain moved = domain;
    for (std::size_t loop = 1; loop < moved.loops.size(); ++loop) {
      const Point by{between(random, -0.02, 0.02), between(random, -0.02, 0.02)};
      for (Point& p : std::get<Polyline>(moved.loops[loop].curves[0].shape).points) p = p + by;
    }
    Mesh plain = mesh;
    const RemodelOptions options{.strategy = every_strategy[i % 4]};
    const double in_order = remodel(plain, moved, options).connectivity_percent();
    const RemodelResult result = remodel(mesh, shuffled(moved, random), options);
    EXPECT_GT(result.connectivity_percent(), in_order - 5.0);
    EXPECT_EQ(fault_of(mesh), "");
  }
}

TEST(Correspondence, AHeldMeshStaysHeldWhereOnlyTheOrderOfTheDomainIsAnother) {
  const auto domain = [](double x) {
    return test::with_holes({test::circle_hole(0.3 + x, 0.5, 0.1), test::square_hole(0.7, 0.7, 0.1)});
  };
  const RemodelOptions options{.strategy = Strategy::reference};
  Mesh mesh = generate(domain(0.0), {.refine_angle_deg = 32.0}).mesh;
  remodel(mesh, domain(0.01), options);
  ASSERT_TRUE(remodel(mesh, domain(0.0101), options).held);
  Domain other = domain(0.0101);
  std::swap(other.loops[0], other.loops[2]);
  other.loops[0].curves[0].name = "pier";
  const RemodelResult result = remodel(mesh, other, options);
  EXPECT_EQ(result.preserved, result.triangles_before);
  EXPECT_TRUE(mesh.held());
  EXPECT_EQ(mesh.quick_check(), "");
  Domain back = domain(0.0102);
  std::swap(back.loops[0], back.loops[2]);
  back.loops[0].curves[0].name = "pier";
  const MeshState state = mesh.state();
  { const Trial trial(mesh, domain(0.0102), options); }
  EXPECT_TRUE(mesh.state() == state);
  EXPECT_TRUE(remodel(mesh, back, options).held);
  EXPECT_EQ(mesh.quick_check(), "");
  for (const Strategy strategy : every_strategy) {  // and where a loop goes
    Mesh other_mesh = mesh;
    Domain less = back;
    less.loops.erase(less.loops.begin());
    const MeshState before = other_mesh.state();
    { const Trial trial(other_mesh, less, {.strategy = strategy}); }
    EXPECT_TRUE(other_mesh.state() == before) << name_of(strategy);
    EXPECT_FALSE(remodel(other_mesh, less, {.strategy = strategy}).regenerated);
    EXPECT_EQ(fault_of(other_mesh), "") << name_of(strategy);
  }
}

TEST(Correspondence, AStepThatEndsEarlyLeavesNamesAndOrderAsTheyWere) {
  class Cancelling : public StepObserver {
   public:
    bool cancelled() override { return true; }
  };
  Domain domain = test::with_holes({test::square_hole(0.3, 0.3, 0.1), test::circle_hole(0.7, 0.7, 0.1)});
  Mesh mesh = generate(domain).mesh;
  const MeshState before = mesh.state();
  std::swap(domain.loops[1], domain.loops[2]);
  std::get<Arc>(domain.loops[1].curves[0].shape).centre.x = 0.6;
  Cancelling observer;
  EXPECT_EQ(remodel(mesh, domain, {.strategy = Strategy::chain, .observer = &observer}).stopped,
            Stopped::interrupted);
  EXPECT_TRUE(mesh.state() == before);
  domain.loops.pop_back();
  EXPECT_EQ(remodel(mesh, domain, {.strategy = Strategy::chain, .observer = &observer}).stopped,
            Stopped::interrupted);
  EXPECT_TRUE(mesh.state() == before);
}

}  // namespace
}  // namespace remodel
