// The rules "boundary", "area" and "overlap".

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "check/rules.h"

namespace remodel::checker {
namespace {

std::vector<std::uint32_t> boundary_edges(const Topology& topology) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t e = 0; e < topology.edges().size(); ++e) {
    if (topology.edges()[e].is_boundary()) found.push_back(e);
  }
  return found;
}

std::string edge_text(std::uint32_t a, std::uint32_t b) {
  return sentence("edge of points ", a, " and ", b);
}

}  // namespace

// ---- Names ----

std::vector<std::uint32_t> name_edges(const FrozenMesh& mesh, const Topology& topology, Report& report) {
  std::vector<std::uint32_t> names(topology.edges().size(), none);
  for (std::uint32_t n = 0; n < mesh.boundaries.size(); ++n) {
    const std::string& name = mesh.boundaries[n].name;
    const auto refuse = [&](std::uint32_t a, std::uint32_t b, const char* why) {
      report.add("boundary", {a, b}, sentence("\"", name, "\" names the ", edge_text(a, b), ", which ", why));
    };
    for (const auto& [a, b] : mesh.boundaries[n].edges) {
      const std::uint32_t e = topology.find(a, b);
      if (e == none) {
        refuse(a, b, "is no edge of the mesh");
        continue;
      }
      if (names[e] != none) refuse(a, b, "is named already");
      if (topology.edges()[e].is_boundary() && topology.edges()[e].from != a) {
        refuse(a, b, "has the domain on its right");
      }
      names[e] = n;
    }
  }
  return names;
}

std::vector<bool> points_of_several_loops(const Topology& topology, const FrozenMesh& mesh) {
  std::vector<bool> once(mesh.points.size()), several(mesh.points.size());
  for (const Edge& edge : topology.edges()) {
    if (!edge.is_boundary()) continue;
    several[edge.from] = several[edge.from] || once[edge.from];
    once[edge.from] = true;
  }
  return several;
}

void check_names_are_complete(const Subject& subject, Report& report) {
  const std::vector<std::uint32_t> edges = boundary_edges(subject.topology);
  if (subject.mesh.boundaries.empty() && !edges.empty()) {
    report.add("boundary", {}, sentence("none of the ", edges.size(), " boundary edges has a name"));
    return;
  }
  for (const std::uint32_t e : edges) {
    if (subject.name_of_edge[e] != none) continue;
    const Edge& edge = subject.topology.edges()[e];
    report.add("boundary", {edge.from, edge.to},
               sentence("the ", edge_text(edge.from, edge.to), " is on the boundary, but has no name"));
  }
}

namespace {

// Where a boundary edge lies on the loops of the mesh.
struct Place {
  std::uint32_t loop = none;
  std::uint32_t position = 0;
};

// Loops that pass points where several touch are cut there: which piece comes after which is a matter of
// taste.
std::vector<std::vector<std::uint32_t>> loops_cut_at_joints(const Subject& subject) {
  std::vector<std::vector<std::uint32_t>> pieces;
  const auto& edges = subject.topology.edges();
  for (std::vector<std::uint32_t>& loop : subject.topology.loops()) {
    const auto at_joint = [&](std::uint32_t e) { return subject.is_joint(edges[e].from); };
    const auto first = std::find_if(loop.begin(), loop.end(), at_joint);
    if (first != loop.end()) std::rotate(loop.begin(), first, loop.end());
    for (std::size_t i = 0; i < loop.size(); ++i) {
      if (i == 0 || at_joint(loop[i])) pieces.emplace_back();
      pieces.back().push_back(loop[i]);
    }
  }
  return pieces;
}

std::vector<Place> places_on_loops(const Topology& topology,
                                   const std::vector<std::vector<std::uint32_t>>& loops) {
  std::vector<Place> places(topology.edges().size());
  for (std::uint32_t l = 0; l < loops.size(); ++l) {
    for (std::uint32_t i = 0; i < loops[l].size(); ++i) places[loops[l][i]] = {l, i};
  }
  return places;
}

// Whether positions on a closed loop follow it, forwards or backwards, from any beginning: on the way through
// them and back to the first they fall, or rise, once at most.
bool follow_the_loop(const std::vector<std::uint32_t>& positions) {
  std::size_t falls = 0;
  std::size_t rises = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const std::uint32_t next = positions[(i + 1) % positions.size()];
    falls += next < positions[i];
    rises += next > positions[i];
  }
  return std::min(falls, rises) <= 1;
}

}  // namespace

void check_order_of_names(const Subject& subject, Report& report) {
  const auto loops = loops_cut_at_joints(subject);
  const std::vector<Place> places = places_on_loops(subject.topology, loops);
  for (const FrozenBoundary& boundary : subject.mesh.boundaries) {
    std::vector<std::vector<std::uint32_t>> positions(loops.size());
    for (const auto& [a, b] : boundary.edges) {
      const std::uint32_t e = subject.topology.find(a, b);
      if (e != none && places[e].loop != none) positions[places[e].loop].push_back(places[e].position);
    }
    for (const auto& on_loop : positions) {
      if (follow_the_loop(on_loop)) continue;
      report.add("boundary", {},
                 sentence("the edges of \"", boundary.name, "\" are not in the order of their loop"));
    }
  }
}

// ---- Area ----

ExactPoints::Integer twice_area(const ExactPoints& exact, Corners cell) {
  ExactPoints::Integer sum = exact.twice_area(cell[0], cell[1], cell[2]);
  if (cell.size() == 4) sum += exact.twice_area(cell[0], cell[2], cell[3]);
  return sum;
}

// Magnitudes are summed, so that a cell turned over does not hide another one.
void check_area(const Subject& subject, Report& report) {
  if (subject.mesh.boundaries.empty()) return;
  ExactPoints::Integer cells = 0;
  for (std::size_t i = 0; i < subject.mesh.cell_count(); ++i)
    cells += abs(twice_area(subject.exact, subject.mesh.cell(i)));
  ExactPoints::Integer polygons = 0;
  for (const FrozenBoundary& boundary : subject.mesh.boundaries) {
    for (const auto& [a, b] : boundary.edges) {
      const std::uint32_t e = subject.topology.find(a, b);
      const bool internal = e != none && !subject.topology.edges()[e].is_boundary();
      if (!internal) polygons += subject.exact.cross(a, b);
    }
  }
  if (cells == polygons) return;
  report.add("area", {},
             sentence(subject.mesh.quads.empty() ? "the triangles' area is " : "the cells' area is ",
                      subject.exact.half_in_mesh_units(cells), ", that of the named boundaries ",
                      subject.exact.half_in_mesh_units(polygons)));
}

// ---- Overlap ----

namespace {

class OverlapRule {
 public:
  OverlapRule(const Subject& subject, Report& report) : subject_(subject), report_(report) {}

  void run() {
    const std::size_t before = report_.found();
    check_crossings();
    if (report_.found() == before) check_winding();
  }

 private:
  const Edge& edge(std::uint32_t e) const { return subject_.topology.edges()[e]; }
  Point point(std::uint32_t v) const { return subject_.mesh.points[v]; }
  std::pair<double, double> x_range(std::uint32_t e) const {
    return std::minmax({point(edge(e).from).x, point(edge(e).to).x});
  }
  std::pair<double, double> y_range(std::uint32_t e) const {
    return std::minmax({point(edge(e).from).y, point(edge(e).to).y});
  }

  // A sweep over x: each edge is compared with those that still reach its smallest x.
  void check_crossings() {
    std::vector<std::uint32_t> order = boundary_edges(subject_.topology);
    std::sort(order.begin(), order.end(), [&](std::uint32_t e, std::uint32_t f) {
      return std::pair(x_range(e).first, e) < std::pair(x_range(f).first, f);
    });
    std::vector<std::uint32_t> active;
    for (const std::uint32_t e : order) {
      std::erase_if(active, [&](std::uint32_t f) { return x_range(f).second < x_range(e).first; });
      for (const std::uint32_t f : active) check_pair(e, f);
      active.push_back(e);
    }
  }

  void check_pair(std::uint32_t e, std::uint32_t f) {
    if (y_range(e).second < y_range(f).first || y_range(f).second < y_range(e).first) return;
    const auto [a, b] = std::pair(edge(e).from, edge(e).to);
    const auto [c, d] = std::pair(edge(f).from, edge(f).to);
    if (a == c || a == d || b == c || b == d || !meet(a, b, c, d)) return;
    report_.add("overlap", {a, b, c, d},
                sentence("the boundary edges of points ", a, ", ", b, " and of points ", c, ", ", d,
                         " cross or touch"));
  }

  // Whether the closed segments ab and cd, whose boxes do, have a common point.
  bool meet(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
    const ExactPoints& exact = subject_.exact;
    return exact.orientation(a, b, c) * exact.orientation(a, b, d) <= 0 &&
           exact.orientation(c, d, a) * exact.orientation(c, d, b) <= 0;
  }

  // Loops that do not meet but at joints: the winding number on the left of a loop is the same all along it.
  // It is taken at a point that is on no other loop; a loop of joints alone is left to its neighbours.
  void check_winding() {
    const auto loops = subject_.topology.loops();
    for (std::size_t l = 0; l < loops.size(); ++l) {
      int covered = is_counter_clockwise(loops[l]) ? 1 : 0;
      const auto own = std::find_if(loops[l].begin(), loops[l].end(),
                                    [&](std::uint32_t e) { return !subject_.is_joint(edge(e).from); });
      if (own == loops[l].end()) continue;
      const std::uint32_t v = edge(*own).from;
      for (std::size_t other = 0; other < loops.size(); ++other) {
        if (other != l) covered += winding_number(loops[other], v);
      }
      if (covered == 1) continue;
      report_.add("overlap", {v}, sentence("the domain at point ", v, " is covered ", covered, " times"));
    }
  }

  bool is_counter_clockwise(const std::vector<std::uint32_t>& loop) const {
    ExactPoints::Integer sum = 0;
    for (const std::uint32_t e : loop) sum += subject_.exact.cross(edge(e).from, edge(e).to);
    return sum > 0;
  }

  // Crossings of the ray from v to the right, upward ones counted positively. Each edge owns its lower end
  // only.
  int winding_number(const std::vector<std::uint32_t>& loop, std::uint32_t v) const {
    int sum = 0;
    for (const std::uint32_t e : loop) {
      const auto [a, b] = std::pair(edge(e).from, edge(e).to);
      const bool a_below = point(a).y <= point(v).y;
      const bool b_below = point(b).y <= point(v).y;
      if (a_below == b_below) continue;
      const int side = subject_.exact.orientation(a, b, v);
      if (a_below && side > 0) ++sum;
      if (b_below && side < 0) --sum;
    }
    return sum;
  }

  const Subject& subject_;
  Report& report_;
};

}  // namespace

void check_overlap(const Subject& subject, Report& report) {
  OverlapRule(subject, report).run();
}

}  // namespace remodel::checker
