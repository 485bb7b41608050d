// The rule "design": the mesh's boundary is the discretised boundary of the design, refined on its curves.

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "check/rules.h"

namespace remodel::checker {
namespace {

using Coordinates = std::pair<double, double>;

Coordinates coordinates_of(Point p) {
  return {p.x, p.y};
}

class DesignRule {
 public:
  DesignRule(const Subject& subject, const Domain& design, double rounding, Report& report)
      : subject_(subject), mesh_(subject.mesh), design_(design), report_(report) {
    double largest = 0.0;
    for (const Point p : subject.mesh.points) largest = std::max({largest, std::fabs(p.x), std::fabs(p.y)});
    allowed_ = rounding * largest;
    for (std::size_t loop = 0; loop < design.loops.size(); ++loop)
      for (std::size_t c = 0; c < design.loops[loop].curves.size(); ++c) curves_.push_back({loop, c});
  }

  void run() {
    if (mesh_.curve.empty() || mesh_.parameter.empty()) {
      report_.add("design", {}, "the mesh does not say on which curve and at which parameter its points lie");
      return;
    }
    const std::size_t before = report_.found();
    check_points();
    if (report_.found() != before) return;
    auto members = points_of_loops();
    const auto point_at = boundary_points_by_place();
    for (std::size_t l = 0; l < members.size(); ++l) {
      add_stations(l, members[l], point_at);
      check_edges(l, members[l]);
    }
  }

 private:
  struct Member {
    BoundaryStation station;
    std::uint32_t point;
    friend bool operator<(const Member& a, const Member& b) {
      return std::tie(a.station.curve, a.station.t) < std::tie(b.station.curve, b.station.t);
    }
  };
  using Members = std::vector<Member>;

  const Loop& loop_of(std::size_t curve) const { return design_.loops[curves_[curve].first]; }
  const Curve& curve(std::size_t index) const { return loop_of(index).curves[curves_[index].second]; }
  BoundaryStation station_of(std::uint32_t v) const {
    return {static_cast<std::size_t>(mesh_.curve[v]), mesh_.parameter[v]};
  }

  // Ends of boundary edges and of named edges inside.
  std::vector<bool> edge_points() const {
    std::vector<bool> result(mesh_.points.size(), false);
    for (std::size_t e = 0; e < subject_.topology.edges().size(); ++e) {
      const Edge& edge = subject_.topology.edges()[e];
      if (edge.is_boundary() || subject_.name_of_edge[e] != none) result[edge.from] = result[edge.to] = true;
    }
    return result;
  }

  bool is_single_point(std::uint32_t v) const {
    return mesh_.curve[v] >= 0 && station_of(v).curve < curves_.size() && loop_of(station_of(v).curve).open &&
           design_.points(curves_[station_of(v).curve].first).size() == 1;
  }

  void check_points() {
    const std::vector<bool> on_edge = edge_points();
    for (std::uint32_t v = 0; v < mesh_.points.size(); ++v) {
      if (on_edge[v] || is_single_point(v)) {
        check_boundary_point(v);
      } else if (mesh_.curve[v] != -1) {
        report_.add("design", {v},
                    sentence("point ", v, " is inside, but said to be on curve ", mesh_.curve[v]));
      }
    }
  }

  void check_boundary_point(std::uint32_t v) {
    const auto [c, t] = station_of(v);
    if (mesh_.curve[v] < 0 || c >= curves_.size() || !(t >= 0.0 && t <= 1.0)) {
      report_.add("design", {v},
                  sentence("boundary point ", v, " is on curve ", mesh_.curve[v], " at ", t,
                           ", which the design does not have"));
      return;
    }
    const Point expected = Frame(loop_of(c).placement)(point_at(curve(c).shape, t));
    const Point found = mesh_.points[v];
    if (found == expected || squared_distance(found, expected) < allowed_ * allowed_) return;
    report_.add("design", {v},
                sentence("point ", v, " is (", found.x, ", ", found.y, "), but curve ", c, " at ", t, " is (",
                         expected.x, ", ", expected.y, ")"));
  }

  // The boundary points on each loop, in order of curve and parameter.
  std::vector<Members> points_of_loops() const {
    std::vector<Members> members(design_.loops.size());
    for (std::uint32_t v = 0; v < mesh_.points.size(); ++v) {
      if (mesh_.curve[v] >= 0) members[curves_[station_of(v).curve].first].push_back({station_of(v), v});
    }
    for (Members& points : members) std::sort(points.begin(), points.end());
    return members;
  }

  std::map<Coordinates, std::uint32_t> boundary_points_by_place() const {
    std::map<Coordinates, std::uint32_t> result;
    for (std::uint32_t v = 0; v < mesh_.points.size(); ++v)
      if (mesh_.curve[v] >= 0) result[coordinates_of(mesh_.points[v])] = v;
    return result;
  }

  // Every station is a point of the mesh. Where chains are joined the point names another loop's curve: it is
  // known by its place, and becomes a member of this loop too.
  void add_stations(std::size_t loop, Members& members,
                    const std::map<Coordinates, std::uint32_t>& point_at) {
    const std::vector<BoundaryStation> stations = design_.stations(loop);
    const std::vector<Point> points = design_.points(loop);
    for (std::size_t i = 0; i < stations.size(); ++i) {
      const Member wanted{stations[i], 0};
      const auto at = std::lower_bound(members.begin(), members.end(), wanted);
      if (at != members.end() && at->station == stations[i]) continue;
      const auto other = point_at.find(coordinates_of(points[i]));
      if (other != point_at.end()) {
        members.insert(at, {stations[i], other->second});
        continue;
      }
      report_.add("design", {},
                  sentence("curve ", stations[i].curve, " of the design at ", stations[i].t,
                           " is no point of the mesh"));
    }
  }

  // Whether boundary edges, which have the domain on their left, follow the loop's parameters upwards.
  bool edges_go_upwards(LoopRole role, const Members& points) const {
    if (role == LoopRole::left || role == LoopRole::right) return role == LoopRole::left;
    ExactPoints::Integer area = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      area += subject_.exact.cross(points[i].point, points[(i + 1) % points.size()].point);
    }
    return (area > 0) == (role == LoopRole::outer);
  }

  void check_edges(std::size_t loop, const Members& points) {
    const bool upwards = edges_go_upwards(design_.loops[loop].role, points);
    for (std::size_t i = 0; i + (design_.loops[loop].open ? 1 : 0) < points.size(); ++i) {
      const Member& lower = points[i];
      const std::uint32_t upper = points[(i + 1) % points.size()].point;
      check_edge(lower.station.curve, upwards ? lower.point : upper, upwards ? upper : lower.point);
    }
  }

  void check_edge(std::size_t on_curve, std::uint32_t from, std::uint32_t to) {
    const std::uint32_t e = subject_.topology.find(from, to);
    const bool inner = loop_of(on_curve).role == LoopRole::internal;
    const bool is_there = e != none && subject_.topology.edges()[e].is_boundary() != inner &&
                          (inner || subject_.topology.edges()[e].from == from);
    if (!is_there) {
      report_.add(
          "design", {from, to},
          sentence("points ", from, " and ", to, " follow each other on curve ", on_curve, ", but no ",
                   inner ? "inner edge joins them" : "boundary edge leads from the first to the second"));
      return;
    }
    const std::uint32_t n = subject_.name_of_edge[e];
    const std::string& expected = curve(on_curve).name;
    if (n != none && mesh_.boundaries[n].name == expected) return;
    if (n == none && !inner) return;  // rule "boundary" has told
    report_.add(
        "design", {from, to},
        sentence("the edge of points ", from, " and ", to, " is named \"",
                 n == none ? std::string() : mesh_.boundaries[n].name, "\", its curve \"", expected, "\""));
  }

  const Subject& subject_;
  const FrozenMesh& mesh_;
  const Domain& design_;
  Report& report_;
  double allowed_ = 0.0;                                     // between a point and its place
  std::vector<std::pair<std::size_t, std::size_t>> curves_;  // by index over all loops: loop, curve in it
};

}  // namespace

std::vector<bool> joints_of(const FrozenMesh& mesh, const Domain& design) {
  std::vector<bool> joints(mesh.points.size(), false);
  std::set<Coordinates> once, joined;
  for (std::size_t loop = 0; loop < design.loops.size(); ++loop)
    for (const Point p : design.points(loop))
      if (!once.insert(coordinates_of(p)).second) joined.insert(coordinates_of(p));
  if (joined.empty()) return {};
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    joints[v] = joined.contains(coordinates_of(mesh.points[v]));
  return joints;
}

void check_design(const Subject& subject, const Domain& design, double rounding, Report& report) {
  DesignRule(subject, design, rounding, report).run();
}

}  // namespace remodel::checker
