// The rule "design": the mesh's boundary is the discretised boundary of the design, refined on its curves.

#include <algorithm>
#include <tuple>

#include "check/rules.h"

namespace remodel::checker {
namespace {

class DesignRule {
 public:
  DesignRule(const Subject& subject, const Domain& design, Report& report)
      : subject_(subject), mesh_(subject.mesh), design_(design), report_(report) {}

  void run() {
    if (mesh_.curve.empty() || mesh_.parameter.empty()) {
      report_.add("design", {}, "the mesh does not say on which curve and at which parameter its points lie");
      return;
    }
    const std::size_t before = report_.found();
    check_points();
    if (report_.found() != before) return;
    const auto members = points_of_loops();
    for (std::size_t l = 0; l < members.size(); ++l) {
      check_stations(l, members[l]);
      check_edges(l, members[l]);
    }
  }

 private:
  using Points = std::vector<std::uint32_t>;

  std::size_t curve_of(std::uint32_t v) const { return static_cast<std::size_t>(mesh_.curve[v]); }
  BoundaryStation station_of(std::uint32_t v) const { return {curve_of(v), mesh_.parameter[v]}; }
  static bool comes_before(const BoundaryStation& a, const BoundaryStation& b) {
    return std::tie(a.curve, a.t) < std::tie(b.curve, b.t);
  }

  std::vector<bool> boundary_points() const {
    std::vector<bool> is_boundary(mesh_.points.size(), false);
    for (const Edge& edge : subject_.topology.edges()) {
      if (edge.is_boundary()) is_boundary[edge.from] = is_boundary[edge.to] = true;
    }
    return is_boundary;
  }

  void check_points() {
    const std::vector<bool> is_boundary = boundary_points();
    for (std::uint32_t v = 0; v < mesh_.points.size(); ++v) {
      if (is_boundary[v]) {
        check_boundary_point(v);
      } else if (mesh_.curve[v] != -1) {
        report_.add("design", {v},
                    sentence("point ", v, " is inside, but said to be on curve ", mesh_.curve[v]));
      }
    }
  }

  void check_boundary_point(std::uint32_t v) {
    const double t = mesh_.parameter[v];
    if (mesh_.curve[v] < 0 || curve_of(v) >= design_.curve_count() || t < 0.0 || t > 1.0) {
      report_.add("design", {v},
                  sentence("boundary point ", v, " is on curve ", mesh_.curve[v], " at ", t,
                           ", which the design does not have"));
      return;
    }
    const Point expected = design_.at(station_of(v));
    const Point found = mesh_.points[v];
    if (found == expected) return;
    report_.add("design", {v},
                sentence("point ", v, " is (", found.x, ", ", found.y, "), but curve ", curve_of(v), " at ",
                         t, " is (", expected.x, ", ", expected.y, ")"));
  }

  // The boundary points on each loop, in order of curve and parameter.
  std::vector<Points> points_of_loops() const {
    std::vector<Points> members(design_.loops.size());
    for (std::uint32_t v = 0; v < mesh_.points.size(); ++v) {
      if (mesh_.curve[v] >= 0) members[design_.loop_of(curve_of(v))].push_back(v);
    }
    for (Points& points : members) {
      std::sort(points.begin(), points.end(),
                [&](std::uint32_t a, std::uint32_t b) { return comes_before(station_of(a), station_of(b)); });
    }
    return members;
  }

  void check_stations(std::size_t loop, const Points& points) {
    for (const BoundaryStation& station : design_.stations(loop)) {
      const auto at = std::lower_bound(
          points.begin(), points.end(), station,
          [&](std::uint32_t v, const BoundaryStation& s) { return comes_before(station_of(v), s); });
      if (at != points.end() && station_of(*at) == station) continue;
      report_.add(
          "design", {},
          sentence("curve ", station.curve, " of the design at ", station.t, " is no point of the mesh"));
    }
  }

  // Whether boundary edges, which have the domain on their left, follow the loop's parameters upwards.
  bool edges_go_upwards(std::size_t loop, const Points& points) const {
    ExactPoints::Integer area = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      area += subject_.exact.cross(points[i], points[(i + 1) % points.size()]);
    }
    return (area > 0) == (design_.loops[loop].role == LoopRole::outer);
  }

  void check_edges(std::size_t loop, const Points& points) {
    const bool upwards = edges_go_upwards(loop, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::uint32_t lower = points[i];
      const std::uint32_t upper = points[(i + 1) % points.size()];
      check_edge(curve_of(lower), upwards ? lower : upper, upwards ? upper : lower);
    }
  }

  void check_edge(std::size_t curve, std::uint32_t from, std::uint32_t to) {
    const std::uint32_t e = subject_.topology.find(from, to);
    const bool is_there =
        e != none && subject_.topology.edges()[e].is_boundary() && subject_.topology.edges()[e].from == from;
    if (!is_there) {
      report_.add("design", {from, to},
                  sentence("points ", from, " and ", to, " follow each other on curve ", curve,
                           ", but no boundary edge leads from the first to the second"));
      return;
    }
    const std::uint32_t n = subject_.name_of_edge[e];
    const std::string& expected = design_.curve(curve).name;
    if (n == none || mesh_.boundaries[n].name == expected) return;  // no name: rule "boundary" has told
    report_.add("design", {from, to},
                sentence("the edge of points ", from, " and ", to, " is named \"", mesh_.boundaries[n].name,
                         "\", its curve \"", expected, "\""));
  }

  const Subject& subject_;
  const FrozenMesh& mesh_;
  const Domain& design_;
  Report& report_;
};

}  // namespace

void check_design(const Subject& subject, const Domain& design, Report& report) {
  DesignRule(subject, design, report).run();
}

}  // namespace remodel::checker
