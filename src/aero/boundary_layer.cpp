#include "remodel/boundary_layer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "aero/boundary_pieces.h"
#include "aero/table_cell.h"
#include "flow/physics/euler.h"
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

  // The vertices of the column above `a` or, with at_end, `b`, of the wall's edge from a to b, from the wall
  // on; no more than the first where no quadrilateral stands on that edge.
  std::vector<std::uint32_t> column(std::uint32_t a, std::uint32_t b, bool at_end) const {
    std::vector<std::uint32_t> column = {at_end ? b : a};
    for (auto found = beside_.find({a, b}); found != beside_.end(); found = beside_.find({a, b})) {
      const auto& quad = mesh_.quads[found->second];
      const auto i = static_cast<std::size_t>(std::find(quad.begin(), quad.end(), a) - quad.begin());
      a = quad[(i + 3) % 4], b = quad[(i + 2) % 4];
      column.push_back(at_end ? b : a);
      if (column.size() > mesh_.quads.size()) break;  // quadrilaterals in a ring
    }
    return column;
  }

  Profile profile(const std::vector<std::uint32_t>& column) const {
    Profile profile;
    profile.height = heights(column), profile.speed = {0.0};
    for (const std::uint32_t vertex : column) profile.density.push_back(flow_.density[vertex]);
    for (std::size_t k = 1; k < column.size(); ++k)   // a wall lies below a layer whose gas goes from a to b:
      profile.speed.push_back(profile.speed.back() -  // its vorticity is negative
                              (profile.height[k] - profile.height[k - 1]) *
                                  vorticity(column[k - 1], column[k]));
    if (profile.speed.back() < 0.0)
      for (double& speed : profile.speed) speed = -speed;
    return profile;
  }

  // Along the column from the wall on.
  std::vector<double> heights(const std::vector<std::uint32_t>& column) const {
    std::vector<double> result = {0.0};
    for (std::size_t k = 1; k < column.size(); ++k)
      result.push_back(result.back() +
                       std::sqrt(squared_distance(mesh_.points[column[k - 1]], mesh_.points[column[k]])));
    return result;
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

void require_friction(const FrozenMesh& mesh, const FlowResult& flow) {
  if (!flow.friction) throw Error(ErrorCode::argument, "flow", "found no friction, expected a model with it");
  if (flow.density.size() != mesh.points.size() || flow.friction->cf.size() != mesh.points.size())
    throw Error(ErrorCode::argument, "flow",
                "found " + std::to_string(flow.density.size()) + " values, expected one for each of " +
                    std::to_string(mesh.points.size()) + " points");
}

// Calls visit(name, vertices along one connected wall, length of the walls of that name so far).
template <class Visit>
void for_each_wall(const FrozenMesh& mesh, const FlowResult& flow, const Visit& visit) {
  // A line of symmetry may begin or end on a wall.
  const auto stick = [&](std::uint32_t a, std::uint32_t b) {
    return flow.friction->y_plus[a] > 0.0 && flow.friction->y_plus[b] > 0.0;
  };
  for (const FrozenBoundary& boundary : mesh.boundaries) {
    double arc = 0.0;
    for (const std::vector<std::uint32_t>& piece : boundary_pieces(boundary))
      if (std::adjacent_find(piece.begin(), piece.end(), stick) != piece.end())
        visit(boundary.name, piece, arc);
  }
}

std::vector<std::uint32_t> column_at(const Columns& columns, const std::vector<std::uint32_t>& piece,
                                     std::size_t i) {
  const bool is_closed = piece.front() == piece.back(), at_end = i + 1 == piece.size();
  if (at_end && is_closed) return columns.column(piece[0], piece[1], false);
  return at_end ? columns.column(piece[i - 1], piece[i], true)
                : columns.column(piece[i], piece[i + 1], false);
}

// In units of the wall: of its friction, density and viscosity.
std::vector<BoundaryLayerPoint> points_of(const FrozenMesh& mesh, const FlowResult& flow,
                                          const Columns& columns, const std::vector<std::uint32_t>& column) {
  const FlowFriction& friction = *flow.friction;
  const std::uint32_t wall = column.front();
  const std::vector<double> heights = columns.heights(column);
  if (heights.size() < 2) return {};
  const double friction_speed = std::sqrt(0.5 * std::fabs(friction.cf[wall]) / flow.density[wall]);
  const Point up = mesh.points[column[1]] - mesh.points[wall];
  const Point along = (1.0 / std::sqrt(dot(up, up))) * Point{up.y, -up.x};
  const auto speed_at = [&](std::uint32_t v) {
    return (flow.velocity_x[v] * along.x + flow.velocity_y[v] * along.y) / flow.mach;
  };
  const double sign = speed_at(column.back()) < 0.0 ? -1.0 : 1.0;  // positive where the edge's is
  std::vector<BoundaryLayerPoint> points;
  for (std::size_t k = 0; k < column.size(); ++k) {
    const std::uint32_t v = column[k];
    BoundaryLayerPoint& point = points.emplace_back();
    point.height = heights[k];
    point.speed = sign * speed_at(v);
    point.density = flow.density[v];
    point.temperature = flow::gas_gamma * flow.pressure[v] / flow.density[v];
    point.viscosity_ratio = friction.viscosity_ratio.empty() ? 0.0 : friction.viscosity_ratio[v];
    point.y_plus = friction.y_plus[wall] * heights[k] / heights[1];
    if (friction_speed > 0.0) point.u_plus = point.speed / friction_speed;
  }
  return points;
}

}  // namespace

std::vector<BoundaryLayerStation> boundary_layer(const FrozenMesh& mesh, const FlowResult& flow) {
  require_friction(mesh, flow);
  const Columns columns(mesh, flow);
  std::vector<BoundaryLayerStation> stations;
  for_each_wall(mesh, flow,
                [&](const std::string& name, const std::vector<std::uint32_t>& piece, double& arc) {
                  const bool is_closed = piece.front() == piece.back();
                  for (std::size_t i = 0; i + (is_closed ? 1 : 0) < piece.size(); ++i) {
                    const std::uint32_t v = piece[i];
                    if (i != 0) arc += std::sqrt(squared_distance(mesh.points[piece[i - 1]], mesh.points[v]));
                    BoundaryLayerStation& station = stations.emplace_back();
                    station.wall = name, station.vertex = v, station.arc = arc;
                    station.cf = flow.friction->cf[v], station.y_plus = flow.friction->y_plus[v];
                    if (flow.friction->wall_temperature) station.ch = flow.friction->ch[v];
                    measure(columns.profile(column_at(columns, piece, i)), flow.mach, station);
                  }
                });
  return stations;
}

std::vector<BoundaryLayerProfile> boundary_layer_profiles(const FrozenMesh& mesh, const FlowResult& flow,
                                                          const std::vector<double>& places) {
  require_friction(mesh, flow);
  for (const double place : places)
    if (!(place >= 0.0 && place <= 1.0))
      throw Error(ErrorCode::argument, "places",
                  "found a number that is not 0 to 1, expected parts of the chord");
  const Columns columns(mesh, flow);
  std::vector<BoundaryLayerProfile> profiles;
  for_each_wall(mesh, flow, [&](const std::string& name, const std::vector<std::uint32_t>& piece, double&) {
    const auto x_of = [&](std::uint32_t v) { return mesh.points[v].x; };
    const auto before = [&](std::uint32_t v, std::uint32_t w) { return x_of(v) < x_of(w); };
    const auto [least, most] = std::minmax_element(piece.begin(), piece.end(), before);
    for (const double place : places) {
      constexpr double inside = 1e-9;  // both ends of a wall are on both its sides, and on none of them alone
      const double x = between(x_of(*least), x_of(*most), std::clamp(place, inside, 1.0 - inside));
      for (std::size_t i = 0; i + 1 < piece.size(); ++i) {
        const double here = x_of(piece[i]) - x, there = x_of(piece[i + 1]) - x;
        if ((here < 0.0) == (there < 0.0)) continue;
        std::size_t nearest = std::fabs(here) <= std::fabs(there) ? i : i + 1;
        if (piece[nearest] == *least || piece[nearest] == *most) nearest = 2 * i + 1 - nearest;
        profiles.push_back({.wall = name,
                            .place = place,
                            .vertex = piece[nearest],
                            .points = points_of(mesh, flow, columns, column_at(columns, piece, nearest))});
      }
    }
  });
  return profiles;
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

std::string boundary_layer_profile_table(const FrozenMesh& mesh,
                                         const std::vector<BoundaryLayerProfile>& profiles) {
  std::string table = "wall,place,x,y,height,speed,density,temperature,viscosity_ratio,y_plus,u_plus\n";
  for (const BoundaryLayerProfile& profile : profiles) {
    const Point p = mesh.points[profile.vertex];
    for (const BoundaryLayerPoint& point : profile.points) {
      table += table_cell(profile.wall);
      for (const double value : {profile.place, p.x, p.y, point.height, point.speed, point.density,
                                 point.temperature, point.viscosity_ratio, point.y_plus, point.u_plus})
        table += ',' + table_cell(value);
      table += '\n';
    }
  }
  return table;
}

}  // namespace remodel
