// The driver, and the rules on indices, numbers, single cells, edges and vertices. A rule runs only where
// those that it stands on held: one mistake is one kind of violation.

#include "remodel/check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "check/exemption.h"
#include "check/rules.h"

namespace remodel {
namespace checker {
namespace {

// On ratios of lengths: twelve roundings of 2^-53 make 1.3e-15; the rest is margin, so that a mesh made to a
// bound is never refused for the checker's own rounding.
constexpr double ratio_tolerance = 1e-9;

constexpr double degrees = 180.0 / std::numbers::pi;

// ---- Indices and numbers ----

void check_size(const char* field, std::size_t found, std::size_t expected, Report& report) {
  if (found == 0 || found == expected) return;
  report.add("index", {}, sentence(field, " has ", found, " values, expected none or ", expected));
}

void check_sizes(const FrozenMesh& mesh, Report& report) {
  const std::size_t points = mesh.points.size();
  const std::size_t triangles = mesh.triangles.size();
  if (mesh.cell_count() == 0) report.add("index", {}, "the mesh has no triangles");
  if (mesh.layer_triangles > triangles)
    report.add("index", {},
               sentence("layer_triangles is ", mesh.layer_triangles, " of ", triangles, " triangles"));
  if (std::max(points, 4 * mesh.cell_count()) >= none)
    report.add("index", {}, "the mesh is too large for 32-bit indices");
  check_size("length_scale", mesh.length_scale.size(), points, report);
  check_size("vertex_ids", mesh.vertex_ids.size(), points, report);
  check_size("curve", mesh.curve.size(), points, report);
  check_size("parameter", mesh.parameter.size(), points, report);
  check_size("steiner", mesh.steiner.size(), points, report);
  check_size("triangle_ids", mesh.triangle_ids.size(), triangles, report);
  check_size("birth", mesh.birth.size(), triangles, report);
  check_size("region", mesh.region.size(), mesh.cell_count(), report);
}

// "triangle 7"; a quadrilateral by its number among all cells, as in the ids.
std::string name_of_cell(const FrozenMesh& mesh, std::uint32_t i) {
  return sentence(mesh.cell(i).size() == 3 ? "triangle " : "quadrilateral ", i);
}

bool has_a_point_twice(Corners cell) {
  for (std::size_t i = 1; i < cell.size(); ++i)
    if (std::find(cell.begin(), cell.begin() + static_cast<std::ptrdiff_t>(i), cell[i]) !=
        cell.begin() + static_cast<std::ptrdiff_t>(i))
      return true;
  return false;
}

void check_indices(const FrozenMesh& mesh, Report& report) {
  const std::size_t count = mesh.points.size();
  for (std::uint32_t i = 0; i < mesh.cell_count(); ++i) {
    const Corners corners = mesh.cell(i);
    if (*std::max_element(corners.begin(), corners.end()) >= count) {
      report.add("index", {i}, sentence(name_of_cell(mesh, i), " has a point index of ", count, " or more"));
    } else if (has_a_point_twice(corners)) {
      report.add("index", {i}, sentence(name_of_cell(mesh, i), " has the same point twice"));
    }
  }
  for (std::uint32_t t = 0; t < mesh.region.size(); ++t) {
    if (mesh.region[t] >= mesh.region_names.size())
      report.add("index", {t},
                 sentence(name_of_cell(mesh, t), " is in region ", mesh.region[t], " of ",
                          mesh.region_names.size()));
  }
  for (const FrozenBoundary& boundary : mesh.boundaries) {
    for (const auto& [a, b] : boundary.edges) {
      if (std::max(a, b) < count && a != b) continue;
      report.add("index", {a, b},
                 sentence("boundary \"", boundary.name, "\" has an edge of points ", a, " and ", b));
    }
  }
}

void check_finite(const char* field, const std::vector<double>& values, Report& report) {
  for (std::uint32_t v = 0; v < values.size(); ++v) {
    if (!std::isfinite(values[v]))
      report.add("finite", {v}, sentence(field, " of point ", v, " is ", values[v]));
  }
}

void check_numbers(const FrozenMesh& mesh, Report& report) {
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
    const auto [x, y] = mesh.points[v];
    if (std::isfinite(x) && std::isfinite(y)) continue;
    report.add("finite", {v}, sentence("point ", v, " is (", x, ", ", y, ")"));
  }
  check_finite("length_scale", mesh.length_scale, report);
  check_finite("parameter", mesh.parameter, report);
}

// ---- Points ----

std::vector<std::uint32_t> cells_per_point(const FrozenMesh& mesh) {
  std::vector<std::uint32_t> count(mesh.points.size(), 0);
  for (std::size_t i = 0; i < mesh.cell_count(); ++i) {
    for (const std::uint32_t v : mesh.cell(i)) ++count[v];
  }
  return count;
}

void check_points(const FrozenMesh& mesh, bool unused_allowed, CheckResult& result, Report& report) {
  const std::vector<std::uint32_t> count = cells_per_point(mesh);
  std::vector<std::uint32_t> order;
  for (std::uint32_t v = 0; v < count.size(); ++v) {
    if (count[v] > 0 || !unused_allowed) order.push_back(v);
    if (count[v] == 0) ++result.unused_points;
  }
  result.vertices -= result.unused_points;
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Point p = mesh.points[a], q = mesh.points[b];
    if (p.x != q.x) return p.x < q.x;
    return p.y != q.y ? p.y < q.y : a < b;
  });
  for (std::size_t i = 1; i < order.size(); ++i) {
    const std::uint32_t a = order[i - 1], b = order[i];
    if (mesh.points[a] == mesh.points[b])
      report.add("duplicate", {a, b}, sentence("points ", a, " and ", b, " coincide"));
  }
  for (std::uint32_t v = 0; v < count.size(); ++v) {
    if (count[v] == 0 && !unused_allowed)
      report.add("orphan-vertex", {v},
                 sentence("point ", v, mesh.quads.empty() ? " is in no triangle" : " is in no cell"));
  }
}

// ---- Orientation ----

void check_orientation(const FrozenMesh& mesh, const ExactPoints& exact, Report& report) {
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    const int sign = exact.orientation(a, b, c);
    if (sign > 0) continue;
    report.add("orientation", {t}, sentence("triangle ", t, sign < 0 ? " is clockwise" : " has no area"));
  }
}

// Four left turns; they go around once, because a polygon of four corners that turns left four times and goes
// around twice does not exist: its turns of less than 180 degrees would have to sum up to 720.
void check_convexity(const FrozenMesh& mesh, const ExactPoints& exact, Report& report) {
  for (auto i = static_cast<std::uint32_t>(mesh.triangles.size()); i < mesh.cell_count(); ++i) {
    const Corners corners = mesh.cell(i);
    int turns[4];
    for (std::size_t k = 0; k < 4; ++k)
      turns[k] = exact.orientation(corners[k], next_corner(corners, k), corners[(k + 2) % 4]);
    if (std::all_of(turns, turns + 4, [](int turn) { return turn > 0; })) continue;
    const bool clockwise = std::all_of(turns, turns + 4, [](int turn) { return turn < 0; });
    report.add("convex", {i},
               sentence(name_of_cell(mesh, i), clockwise ? " is clockwise" : " is not strictly convex"));
  }
}

// ---- Vertices ----

enum class Turn { clockwise, counter_clockwise };

// The cell after t when turning around its corner v: across the edge that leaves v, or the one that
// arrives.
std::uint32_t turned(const Subject& subject, std::uint32_t v, std::uint32_t t, Turn turn) {
  const Corners corners = subject.mesh.cell(t);
  const std::size_t at = corner_of(corners, v), before = at + corners.size() - 1;
  return subject.topology.neighbour(t, turn == Turn::clockwise ? at : before % corners.size());
}

// How many cells are reached from `start` by turning around v.
std::size_t fan_size(const Subject& subject, std::uint32_t v, std::uint32_t start) {
  std::size_t size = 1;
  const auto next = [&](std::uint32_t t, Turn turn) { return turned(subject, v, t, turn); };
  for (auto t = next(start, Turn::clockwise); t != none; t = next(t, Turn::clockwise), ++size) {
    if (t == start) return size;
  }
  for (auto t = next(start, Turn::counter_clockwise); t != none; t = next(t, Turn::counter_clockwise)) ++size;
  return size;
}

// An open fan at a vertex, counter-clockwise from the edge that leaves it to the one that arrives.
struct Wedge {
  std::uint32_t from = none, to = none;  // the points across
};

Wedge wedge_of(const Subject& subject, const Edge& leaving) {
  const std::uint32_t v = leaving.from;
  std::uint32_t last = leaving.left;
  for (auto t = last; t != none; t = turned(subject, v, t, Turn::counter_clockwise)) last = t;
  const Corners corners = subject.mesh.cell(last);
  return {leaving.to, corners[(corner_of(corners, v) + corners.size() - 1) % corners.size()]};
}

// Whether the direction from v to p lies inside the wedge, or along its first side.
bool holds(const Subject& subject, std::uint32_t v, const Wedge& wedge, std::uint32_t p) {
  const auto left_of = [&](std::uint32_t a, std::uint32_t b) { return subject.exact.orientation(v, a, b); };
  const auto along = [&](std::uint32_t a, std::uint32_t b) {
    return left_of(a, b) == 0 && subject.exact.dot(v, a, b) > 0;
  };
  if (along(wedge.from, p)) return true;
  if (along(wedge.to, p)) return false;
  const bool convex = left_of(wedge.from, wedge.to) > 0;
  return convex ? left_of(wedge.from, p) > 0 && left_of(p, wedge.to) > 0
                : !(left_of(wedge.to, p) >= 0 && left_of(p, wedge.from) >= 0);
}

// Where loops touch, their fans lie side by side. (Edges that share a point are not asked whether they
// cross.)
void check_fans_are_apart(const Subject& subject, Report& report) {
  std::map<std::uint32_t, std::vector<Wedge>> wedges;
  for (const Edge& edge : subject.topology.edges())
    if (edge.is_boundary() && subject.is_joint(edge.from))
      wedges[edge.from].push_back(wedge_of(subject, edge));
  for (const auto& [v, around] : wedges)
    for (std::size_t i = 0; i < around.size(); ++i)
      for (std::size_t k = 0; k < around.size(); ++k)
        if (i != k && holds(subject, v, around[i], around[k].from)) {
          report.add("overlap", {v},
                     sentence(subject.cells_name(), " of point ", v, ", where loops touch, overlap"));
          return;
        }
}

// A vertex's cells form one fan: they are all reached by turning around it. Two fans touch like a bow
// tie, where loops of the boundary do: in a mesh of a design only where its chains are joined. Without a
// design nobody says where that may be, and the file's format must not decide it. Returns the fans of all
// vertices.
std::size_t check_fans(const Subject& subject, CheckResult& result, Report& report) {
  const std::vector<std::uint32_t> expected = cells_per_point(subject.mesh);
  std::vector<std::size_t> fans(subject.mesh.points.size(), 0), reached(subject.mesh.points.size(), 0);
  for (const Edge& edge : subject.topology.edges()) {  // an open fan begins at a boundary edge
    if (!edge.is_boundary()) continue;
    ++fans[edge.from];
    reached[edge.from] += fan_size(subject, edge.from, edge.left);
  }
  for (std::uint32_t i = 0; i < subject.mesh.cell_count(); ++i)
    for (const std::uint32_t v : subject.mesh.cell(i)) {
      if (fans[v] > 0) continue;
      fans[v] = 1;
      reached[v] = fan_size(subject, v, i);
    }
  for (std::uint32_t v = 0; v < fans.size(); ++v) {
    result.touching_points += fans[v] > 1 ? 1 : 0;
    if (reached[v] != expected[v] || (fans[v] > 1 && !subject.is_joint(v)))
      report.add("manifold", {v},
                 sentence("the ", subject.cells_name(), " of point ", v, " do not form one fan"));
  }
  return std::accumulate(fans.begin(), fans.end(), std::size_t{0});
}

// Euler's formula for a planar surface: each component has V - E + F = 2 - its loops. A vertex of two fans
// counts twice.
void check_euler(const Subject& subject, std::size_t fans, Report& report) {
  const auto vertices = static_cast<long long>(fans);
  const auto edges = static_cast<long long>(subject.topology.edges().size());
  const auto faces = static_cast<long long>(subject.mesh.cell_count());
  const auto components = static_cast<long long>(subject.topology.component_count());
  const auto loops = static_cast<long long>(subject.topology.loops().size());
  if (vertices - edges + faces == 2 * components - loops) return;
  report.add("euler", {},
             sentence(vertices, " vertices - ", edges, " edges + ", faces, " ", subject.cells_name(),
                      " is not 2 x ", components, " components - ", loops, " boundary loops"));
}

// ---- Regions ----

// In a mesh of a design a named curve lies between two regions.
void check_regions(const Subject& subject, Report& report) {
  const auto& edges = subject.topology.edges();
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const Edge& edge = edges[e];
    if (edge.is_boundary() || subject.name_of_edge[e] != none) continue;
    if (subject.mesh.region[edge.left] == subject.mesh.region[edge.right]) continue;
    report.add("region", {edge.left, edge.right},
               sentence("the edge of points ", edge.from, " and ", edge.to,
                        " lies between two regions, but on no curve of the design"));
  }
}

// ---- Delaunay ----

// An edge between two regions is constrained, named or not.
bool is_interface(const FrozenMesh& mesh, const Edge& edge) {
  return !mesh.region.empty() && mesh.region[edge.left] != mesh.region[edge.right];
}

// Whether the angles opposite an edge of two counter-clockwise triangles sum up to at most 180 degrees and
// the slack. Each is the argument of a complex number (scalar product, area), their sum that of the product.
bool within_slack(const ExactPoints& exact, const Edge& edge, std::uint32_t apex, std::uint32_t across,
                  double slack_deg) {
  using Integer = ExactPoints::Integer;
  const Integer dot_1 = exact.dot(apex, edge.from, edge.to),
                area_1 = exact.twice_area(apex, edge.from, edge.to);
  const Integer dot_2 = exact.dot(across, edge.to, edge.from),
                area_2 = exact.twice_area(across, edge.to, edge.from);
  const Integer x = dot_1 * dot_2 - area_1 * area_2, y = dot_1 * area_2 + area_1 * dot_2;
  constexpr int bits = 53;  // of the tangent
  const Integer tangent =
      static_cast<std::int64_t>(std::ldexp(std::tan(slack_deg * std::numbers::pi / 180.0), bits));
  return y >= 0 || (x < 0 && (-y << bits) <= -x * tangent);
}

// Triangles of layers have no empty circles, and quadrilaterals none at all.
bool is_between_free_triangles(const FrozenMesh& mesh, const Edge& edge) {
  const auto is_free = [&](std::uint32_t cell) {
    return cell >= mesh.layer_triangles && cell < mesh.triangles.size();
  };
  return is_free(edge.left) && is_free(edge.right);
}

// Every unconstrained inner edge of two triangles: the point across is not inside the circle, or the slack
// allows it. Returns whether none is.
bool check_delaunay(const Subject& subject, double slack_deg, Report& report) {
  bool all = true;
  const auto& edges = subject.topology.edges();
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const Edge& edge = edges[e];
    if (edge.is_boundary() || subject.name_of_edge[e] != none || is_interface(subject.mesh, edge)) continue;
    if (!is_between_free_triangles(subject.mesh, edge)) continue;
    const std::uint32_t apex = subject.topology.opposite(edge, edge.left);
    const std::uint32_t across = subject.topology.opposite(edge, edge.right);
    if (subject.exact.in_circle(edge.from, edge.to, apex, across) <= 0) continue;
    all = false;
    if (slack_deg > 0.0 && within_slack(subject.exact, edge, apex, across, slack_deg)) continue;
    report.add("delaunay", {edge.left, edge.right},
               sentence("the edge of points ", edge.from, " and ", edge.to, " is not locally Delaunay"));
  }
  return all;
}

// ---- Quality ----

struct Circle {
  double radius = 0.0;
  double shortest_edge = 0.0;
};

Circle circumscribed(Point a, Point b, Point c) {
  const double ab = std::hypot(b.x - a.x, b.y - a.y);
  const double bc = std::hypot(c.x - b.x, c.y - b.y);
  const double ca = std::hypot(a.x - c.x, a.y - c.y);
  const double area = std::abs(cross(b - a, c - a)) / 2.0;
  return {ab * bc * ca / (4.0 * area), std::min({ab, bc, ca})};
}

Circle circumscribed(const FrozenMesh& mesh, std::uint32_t triangle) {
  const auto [a, b, c] = mesh.triangles[triangle];
  return circumscribed(mesh.points[a], mesh.points[b], mesh.points[c]);
}

// Not a number (a triangle that has collapsed in double arithmetic) exceeds every bound.
bool exceeds(double value, double bound) {
  return !(value <= bound * (1.0 + ratio_tolerance));
}

// The smallest angle's sine is e_min / 2r. Sets the smallest of all, and that of what is not exempt, in
// degrees.
void check_angles(const FrozenMesh& mesh, const Exemption* exemption, double bound_deg, CheckResult& result,
                  Report& report) {
  double smallest_sine = 1.0, smallest_held = std::nan("");
  const double largest_ratio = 0.5 / std::sin(bound_deg / degrees);
  for (std::uint32_t t = mesh.layer_triangles; t < mesh.triangles.size(); ++t) {
    const Circle circle = circumscribed(mesh, t);
    const double sine = circle.shortest_edge / (2.0 * circle.radius);
    smallest_sine = std::isnan(sine) ? 0.0 : std::min(smallest_sine, sine);
    const bool below = bound_deg > 0.0 && exceeds(circle.radius / circle.shortest_edge, largest_ratio);
    if (below && exemption != nullptr && exemption->exempts(t)) {
      ++result.exempt_triangles;
      continue;
    }
    smallest_held = std::isnan(sine) ? 0.0 : std::fmin(smallest_held, sine);
    if (!below) continue;
    report.add("angle", {t},
               sentence("triangle ", t, " has radius-edge ratio ", circle.radius / circle.shortest_edge,
                        ", above ", largest_ratio, " of ", bound_deg, " degrees"));
  }
  const bool any = mesh.layer_triangles < mesh.triangles.size();
  result.min_angle_deg = any ? std::asin(smallest_sine) * degrees : std::nan("");
  result.min_held_angle_deg = std::asin(smallest_held) * degrees;
}

// No bound holds for them: figures alone.
void measure_corners(const FrozenMesh& mesh, CheckResult& result) {
  for (const auto& quad : mesh.quads)
    for (std::size_t k = 0; k < 4; ++k) {
      const Point corner = mesh.points[quad[k]];
      const Point next = mesh.points[quad[(k + 1) % 4]] - corner,
                  before = mesh.points[quad[(k + 3) % 4]] - corner;
      const double angle = std::atan2(cross(next, before), next.x * before.x + next.y * before.y) * degrees;
      result.least_corner_deg = std::fmin(result.least_corner_deg, angle);
      result.largest_corner_deg = std::fmax(result.largest_corner_deg, angle);
    }
}

// Returns the largest r / (H mean LS) but for exempt triangles.
double check_gradation(const FrozenMesh& mesh, const Exemption* exemption, double bound, Report& report) {
  const double scale = bound > 0.0 ? bound : std::numbers::sqrt2 / 2.0;
  double largest = 0.0;
  for (std::uint32_t t = mesh.layer_triangles; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    const double mean = (mesh.length_scale[a] + mesh.length_scale[b] + mesh.length_scale[c]) / 3.0;
    const double ratio = mean > 0.0 ? circumscribed(mesh, t).radius / (scale * mean) : std::nan("");
    const bool above = exceeds(ratio, 1.0);
    if (above && exemption != nullptr && exemption->exempts(t)) continue;
    if (!(ratio <= largest)) largest = std::isnan(ratio) ? std::numeric_limits<double>::infinity() : ratio;
    if (bound <= 0.0 || !above) continue;
    report.add(
        "gradation", {t},
        sentence("triangle ", t, " has r / (H mean LS) = ", ratio, ", its mean length scale is ", mean));
  }
  return largest;
}

void check_quality(const FrozenMesh& mesh, const Exemption* exemption, const CheckOptions& options,
                   CheckResult& result, Report& report) {
  Report unwanted(0);
  Report& bounds = options.bounds ? report : unwanted;
  const std::size_t before = bounds.found();
  check_angles(mesh, exemption, options.min_angle_deg, result, bounds);
  measure_corners(mesh, result);
  if (!mesh.length_scale.empty()) {
    result.max_gradation = check_gradation(mesh, exemption, options.max_gradation, bounds);
  } else if (options.max_gradation > 0.0) {
    report.add("gradation", {}, "the mesh has no length scales to test the gradation with");
    return;
  }
  result.beyond_bounds = bounds.found() - before;
}

// ---- Driver ----

bool is_readable(const FrozenMesh& mesh, Report& report) {
  check_sizes(mesh, report);
  check_indices(mesh, report);
  check_numbers(mesh, report);
  return report.found() == 0;
}

double total_area(const FrozenMesh& mesh, const ExactPoints& exact) {
  ExactPoints::Integer sum = 0;
  for (std::size_t i = 0; i < mesh.cell_count(); ++i) sum += twice_area(exact, mesh.cell(i));
  return exact.half_in_mesh_units(sum);
}

// The rules that need every edge to have its one or two cells.
void check_structure(const Subject& subject, bool oriented, const CheckOptions& options, CheckResult& result,
                     Report& report) {
  if (oriented) {
    Report unwanted(0);
    result.delaunay =
        check_delaunay(subject, options.delaunay_slack_deg, options.delaunay ? report : unwanted);
  }
  const std::size_t before_fans = report.found();
  const std::size_t fans = check_fans(subject, result, report);
  if (report.found() != before_fans) return;
  check_euler(subject, fans, report);
  check_order_of_names(subject, report);
  if (oriented) check_fans_are_apart(subject, report);
  if (oriented) check_overlap(subject, report);
}

void check_readable(const FrozenMesh& mesh, const CheckOptions& options, CheckResult& result,
                    Report& report) {
  check_points(mesh, options.unused_points, result, report);

  const std::unique_ptr<ExactPoints> exact = exact_points(mesh.points);
  result.area = total_area(mesh, *exact);
  const std::size_t before_orientation = report.found();
  check_orientation(mesh, *exact, report);
  check_convexity(mesh, *exact, report);
  const bool oriented = report.found() == before_orientation;

  const std::size_t before_adjacency = report.found();
  const Topology topology(mesh, report);
  if (report.found() != before_adjacency) return check_quality(mesh, nullptr, options, result, report);
  Subject subject{mesh, topology, *exact, name_edges(mesh, topology, report), {}};
  subject.joints =
      options.design != nullptr ? joints_of(mesh, *options.design) : points_of_several_loops(topology, mesh);
  const Exemption exemption(mesh, topology, subject.name_of_edge);
  check_quality(mesh, &exemption, options, result, report);
  check_names_are_complete(subject, report);
  check_area(subject, report);
  check_structure(subject, oriented, options, result, report);
  if (options.design != nullptr && !mesh.region.empty()) check_regions(subject, report);
  if (options.design != nullptr) check_design(subject, *options.design, options.design_rounding, report);
}

}  // namespace
}  // namespace checker

CheckResult check(const FrozenMesh& mesh, const CheckOptions& options) {
  CheckResult result;
  result.triangles = mesh.triangles.size();
  result.quadrilaterals = mesh.quads.size();
  result.vertices = mesh.points.size();
  for (const FrozenBoundary& boundary : mesh.boundaries)
    result.boundary[boundary.name] += boundary.edges.size();
  for (const std::uint32_t region : mesh.region)
    if (region < mesh.region_names.size()) ++result.regions[mesh.region_names[region]];

  checker::Report report(options.max_violations);
  if (checker::is_readable(mesh, report)) checker::check_readable(mesh, options, result, report);
  result.valid = report.found() == 0;
  result.violations = report.take();
  return result;
}

}  // namespace remodel
