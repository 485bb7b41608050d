#include "remodel/boundary_layer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "aero/boundary_pieces.h"
#include "aero/table_cell.h"
#include "remodel/error.h"

namespace remodel {

namespace {

// The speed of the boundary layer along one column, from the wall on.
struct Profile {
  std::vector<double> height, speed, density;
};

class Columns {
 public:
  Columns(const FrozenMesh& mesh, const FlowResult& flow) : mesh_(mesh), flow_(flow) {
    for (std::uint32_t q = 0; q < mesh.quads.size(); ++q)
      for (std::uint32_t i = 0; i < 4; ++i) beside_[{mesh.quads[q][i], mesh.quads[q][(i + 1) % 4]}] = q;
  }

  // The column above `a` or, with at_end, `b`, of the wall's edge from a to b; no more than its first point
  // where no quadrilateral stands on that edge.
  Profile profile(std::uint32_t a, std::uint32_t b, bool at_end) const {
    Profile profile;
    std::uint32_t below = at_end ? b : a;
    profile.height = {0.0}, profile.speed = {0.0}, profile.density = {flow_.density[below]};
    for (auto found = beside_.find({a, b}); found != beside_.end(); found = beside_.find({a, b})) {
      const auto& quad = mesh_.quads[found->second];
      const auto i = static_cast<std::size_t>(std::find(quad.begin(), quad.end(), a) - quad.begin());
      a = quad[(i + 3) % 4], b = quad[(i + 2) % 4];
      const std::uint32_t above = at_end ? b : a;
      const double step = std::sqrt(squared_distance(mesh_.points[below], mesh_.points[above]));
      profile.height.push_back(profile.height.back() + step);
      // A wall lies below a layer whose gas goes from a to b: its vorticity is negative.
      profile.speed.push_back(profile.speed.back() - step * vorticity(below, above));
      profile.density.push_back(flow_.density[above]);
      below = above;
      if (profile.height.size() > mesh_.quads.size()) break;  // quadrilaterals in a ring
    }
    if (profile.speed.back() < 0.0)
      for (double& speed : profile.speed) speed = -speed;
    return profile;
  }

 private:
  // The mean of the quadrilaterals on both sides of an edge.
  double vorticity(std::uint32_t a, std::uint32_t b) const {
    double circulation = 0.0, area = 0.0;
    for (const auto& side : {std::pair(a, b), std::pair(b, a)})
      if (const auto found = beside_.find(side); found != beside_.end())
        add_cell(mesh_.quads[found->second], circulation, area);
    return circulation / area;
  }
  void add_cell(const std::array<std::uint32_t, 4>& quad, double& circulation, double& area) const {
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t v = quad[i], w = quad[(i + 1) % 4];
      const Point p = mesh_.points[v], q = mesh_.points[w];
      circulation += 0.5 * ((flow_.velocity_x[v] + flow_.velocity_x[w]) * (q.x - p.x) +
                            (flow_.velocity_y[v] + flow_.velocity_y[w]) * (q.y - p.y));
      area += 0.5 * (p.x * q.y - p.y * q.x);
    }
  }

  const FrozenMesh& mesh_;
  const FlowResult& flow_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> beside_;  // the cell to the left of a side
};

double between(double a, double b, double part) {
  return a + part * (b - a);
}

// Nothing where the column ends within the layer: where the speed still changes over its last tenth.
void measure(const Profile& profile, double stream, BoundaryLayerStation& station) {
  constexpr double edge_part = 0.99, last_tenth = 0.005;
  const std::vector<double>&y = profile.height, &u = profile.speed;
  const double edge = u.back();
  if (y.size() < 4 || !(edge > 0.0)) return;
  const auto above =
      static_cast<std::size_t>(std::upper_bound(y.begin(), y.end(), 0.9 * y.back()) - y.begin());
  const double near_top =
      between(u[above - 1], u[above], (0.9 * y.back() - y[above - 1]) / (y[above] - y[above - 1]));
  if (std::fabs(near_top - edge) > last_tenth * edge) return;
  std::size_t last = u.size() - 1;  // within the layer
  while (last > 0 && u[last] >= edge_part * edge) --last;
  if (last + 1 == u.size()) return;
  const double part = (edge_part * edge - u[last]) / (u[last + 1] - u[last]);
  const double thickness = between(y[last], y[last + 1], part);
  const double edge_flux = edge * between(profile.density[last], profile.density[last + 1], part);
  double displacement = 0.0, momentum = 0.0;
  for (std::size_t k = 0; k <= last; ++k) {
    const bool is_last = k == last;
    const double step = (is_last ? thickness : y[k + 1]) - y[k];
    for (const std::size_t i : {k, k + 1}) {
      const bool is_edge = is_last && i == k + 1;
      const double speed = is_edge ? edge_part : u[i] / edge;
      const double flux = is_edge ? edge_part : profile.density[i] * u[i] / edge_flux;
      displacement += 0.5 * step * (1.0 - flux);
      momentum += 0.5 * step * flux * (1.0 - speed);
    }
  }
  station.edge_speed = edge / stream;
  station.thickness = thickness;
  station.displacement_thickness = displacement, station.momentum_thickness = momentum;
  station.shape_factor = displacement / momentum;
}

}  // namespace

std::vector<BoundaryLayerStation> boundary_layer(const FrozenMesh& mesh, const FlowResult& flow) {
  if (!flow.friction) throw Error(ErrorCode::argument, "flow", "found no friction, expected a model with it");
  if (flow.density.size() != mesh.points.size() || flow.friction->cf.size() != mesh.points.size())
    throw Error(ErrorCode::argument, "flow",
                "found " + std::to_string(flow.density.size()) + " values, expected one for each of " +
                    std::to_string(mesh.points.size()) + " points");
  const Columns columns(mesh, flow);
  std::vector<BoundaryLayerStation> stations;
  for (const FrozenBoundary& boundary : mesh.boundaries) {
    double arc = 0.0;
    for (const std::vector<std::uint32_t>& piece : boundary_pieces(boundary)) {
      // A line of symmetry may begin or end on a wall.
      const auto stick = [&](std::uint32_t a, std::uint32_t b) {
        return flow.friction->y_plus[a] > 0.0 && flow.friction->y_plus[b] > 0.0;
      };
      if (std::adjacent_find(piece.begin(), piece.end(), stick) == piece.end()) continue;
      const bool is_closed = piece.front() == piece.back();
      for (std::size_t i = 0; i + (is_closed ? 1 : 0) < piece.size(); ++i) {
        const bool at_end = i + 1 == piece.size();
        const std::uint32_t v = piece[i], a = at_end ? piece[i - 1] : v, b = at_end ? v : piece[i + 1];
        if (i != 0) arc += std::sqrt(squared_distance(mesh.points[piece[i - 1]], mesh.points[v]));
        BoundaryLayerStation& station = stations.emplace_back();
        station.wall = boundary.name, station.vertex = v, station.arc = arc;
        station.cf = flow.friction->cf[v], station.y_plus = flow.friction->y_plus[v];
        if (flow.friction->wall_temperature) station.ch = flow.friction->ch[v];
        measure(columns.profile(a, b, at_end), flow.mach, station);
      }
    }
  }
  return stations;
}

std::string boundary_layer_table(const FrozenMesh& mesh, const FlowResult& flow) {
  const std::vector<double> cp = pressure_coefficients(flow);
  std::string table =
      "wall,x,y,arc,cp,cf,y_plus,edge_speed,thickness,displacement_thickness,momentum_thickness,"
      "shape_factor,ch\n";
  for (const BoundaryLayerStation& station : boundary_layer(mesh, flow)) {
    table += table_cell(station.wall);
    const Point p = mesh.points[station.vertex];
    for (const double value : {p.x, p.y, station.arc, cp[station.vertex], station.cf, station.y_plus,
                               station.edge_speed, station.thickness, station.displacement_thickness,
                               station.momentum_thickness, station.shape_factor, station.ch})
      table += ',' + table_cell(value);
    table += '\n';
  }
  return table;
}

}  // namespace remodel
