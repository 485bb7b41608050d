#include "remodel/potential_flow.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "flow/flow_warnings.h"
#include "flow/potential/trailing_edge.h"
#include "flow/potential/wall_loops.h"
#include "remodel/error.h"

namespace remodel {

namespace {

using flow::WallLoop;
using flow::WallLoops;

constexpr std::uint32_t no_unknown = 0xffffffff;

struct Body {
  std::string name;
  std::vector<std::uint32_t> vertices;  // clockwise; those of the trailing edge first
  std::vector<double> lengths;          // of walls that belong to each vertex: half of its two edges
  std::size_t base = 0;                 // vertices of the trailing edge: 1 if it is sharp, 0 if there is none
  Point centre;                         // where its vortex is for those far away
  flow::KuttaCondition kutta;
};

// What is the same at every angle, and two flows: at 0 and at 90 degrees.
struct Flow {
  std::vector<double> stream_function;      // per vertex
  std::vector<double> circulation;          // per body
  std::vector<double> circulation_beside;   // by Kutta's condition beside the edges
  std::vector<double> on_body;              // the stream function, per body
  std::vector<std::vector<double>> speeds;  // per body and wall vertex, along the wall
};

// a u + b v, value by value.
void combine(std::vector<double>& result, double a, const std::vector<double>& u, double b,
             const std::vector<double>& v) {
  result.resize(u.size());
  for (std::size_t i = 0; i < u.size(); ++i) result[i] = a * u[i] + b * v[i];
}

// Solves a small dense system by Gauss' elimination with pivots; matrix is row-major. The result takes the
// place of rhs. False if the matrix is singular.
bool solve_dense(std::vector<double> matrix, std::vector<double>& rhs) {
  const std::size_t n = rhs.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::abs(matrix[i * n + k]) > std::abs(matrix[pivot * n + k])) pivot = i;
    if (matrix[pivot * n + k] == 0.0) return false;
    std::swap_ranges(&matrix[k * n], &matrix[k * n] + n, &matrix[pivot * n]);
    std::swap(rhs[k], rhs[pivot]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = matrix[i * n + k] / matrix[k * n + k];
      for (std::size_t j = k; j < n; ++j) matrix[i * n + j] -= factor * matrix[k * n + j];
      rhs[i] -= factor * rhs[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) rhs[k] -= matrix[k * n + j] * rhs[j];
    rhs[k] /= matrix[k * n + k];
  }
  return true;
}

Body body_of(const WallLoop& loop, const FrozenMesh& mesh) {
  Body body;
  body.name = loop.name;
  body.vertices = loop.vertices;
  std::vector<Point> points;
  for (const std::uint32_t v : body.vertices) points.push_back(mesh.points[v]);
  const auto edge = flow::trailing_edge(points);
  body.base = edge ? edge->count : 0;
  const auto first = static_cast<std::ptrdiff_t>(edge ? edge->first : 0);
  std::rotate(body.vertices.begin(), body.vertices.begin() + first, body.vertices.end());
  std::rotate(points.begin(), points.begin() + first, points.end());
  const std::size_t n = points.size();
  const auto length = [&](std::size_t i) {
    const Point d = points[(i + 1) % n] - points[i % n];
    return std::hypot(d.x, d.y);
  };
  for (std::size_t i = 0; i < n; ++i) body.lengths.push_back(0.5 * (length(i) + length(i + n - 1)));
  if (body.base > 0) body.kutta = flow::kutta_condition(points, body.base);
  // A quarter chord behind the point farthest from the first one.
  const auto farther = [&](Point a, Point b) {
    return dot(a - points[0], a - points[0]) < dot(b - points[0], b - points[0]);
  };
  const Point front = *std::max_element(points.begin(), points.end(), farther);
  body.centre = body.base > 0 ? 0.75 * front + 0.25 * points[0] : 0.5 * (front + points[0]);
  return body;
}

}  // namespace

// Where Kutta's condition is asked for: at the vertices of the edges, or beside them, to compare.
enum class Kutta { edge, beside };

// Assembles, factors and solves once; keeps what flows at any angle are made of.
struct PotentialSolver::Solution {
  Solution(const FrozenMesh& frozen, const PotentialOptions& given, const std::string& name)
      : mesh(with_split_quads(frozen)), options(given), source(name) {
    loops = flow::find_wall_loops(mesh, options.farfield, source);
    if (loops.bodies.empty())
      throw Error(ErrorCode::argument, source, "found no boundary but the far field, expected a body");
    number_unknowns();
    areas = areas_at(mesh.points);
    solve();
  }

  void move(const std::vector<Point>& points) {
    if (points.size() != mesh.points.size())
      throw Error(ErrorCode::argument, source,
                  std::to_string(points.size()) + " points found, " + std::to_string(mesh.points.size()) +
                      " expected: as many as the mesh has");
    areas = areas_at(points);
    mesh.points = points;
    solve();
  }

  void solve() {
    flow = {};
    bodies.clear();
    for (const WallLoop& loop : loops.bodies) bodies.push_back(body_of(loop, mesh));
    factor();
    solve_flows();
  }

  // The entries of a triangle's stiffness: products of its hat functions' gradients.
  std::array<Point, 3> gradients(std::size_t triangle) const {
    const auto& [a, b, c] = mesh.triangles[triangle];
    const Point p = mesh.points[a], q = mesh.points[b], r = mesh.points[c];
    const double twice = cross(q - p, r - p);
    const auto across = [&](Point from, Point to) {
      return (1.0 / twice) * Point{from.y - to.y, to.x - from.x};
    };
    return {across(q, r), across(r, p), across(p, q)};
  }

  void number_unknowns() {
    unknown.assign(mesh.points.size(), 0);
    for (const std::uint32_t v : loops.farfield.vertices) unknown[v] = no_unknown;
    for (const WallLoop& loop : loops.bodies)
      for (const std::uint32_t v : loop.vertices) unknown[v] = no_unknown;
    std::vector<bool> used(mesh.points.size(), false);
    for (const auto& corners : mesh.triangles)
      for (const std::uint32_t v : corners) used[v] = true;
    for (std::uint32_t v = 0; v < unknown.size(); ++v) {
      if (!used[v])
        throw Error(ErrorCode::argument, source,
                    "point " + std::to_string(v) + " is of no triangle, every point in one expected");
      if (unknown[v] != no_unknown) unknown[v] = unknowns++;
    }
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      if (unknown[a] == no_unknown || unknown[b] == no_unknown || unknown[c] == no_unknown)
        at_boundary.push_back(t);
    }
  }

  std::vector<double> areas_at(const std::vector<Point>& points) const {
    std::vector<double> result;
    result.reserve(mesh.triangles.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      const double area = 0.5 * cross(points[b] - points[a], points[c] - points[a]);
      if (!(area > 0.0))
        throw Error(ErrorCode::argument, source,
                    "triangle " + std::to_string(t) + " without area or inverted found, others expected");
      result.push_back(area);
    }
    return result;
  }

  void factor() {
    using Triplet = Eigen::Triplet<double, int>;
    std::vector<Triplet> entries;
    entries.reserve(6 * mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto gradient = gradients(t);
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
          const std::uint32_t row = unknown[mesh.triangles[t][i]], column = unknown[mesh.triangles[t][k]];
          if (row == no_unknown || column == no_unknown || row < column) continue;
          entries.emplace_back(static_cast<int>(row), static_cast<int>(column),
                               areas[t] * dot(gradient[i], gradient[k]));
        }
      }
    }
    const int n = static_cast<int>(unknowns);
    if (n == 0) return;
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    entries = {};
    // The order of elimination depends on the triangles alone.
    if (!ordered) cholesky.analyzePattern(matrix);
    ordered = true;
    cholesky.factorize(matrix);
    if (cholesky.info() != Eigen::Success)
      throw Error(ErrorCode::argument, source, "triangles too flat to solve on found, better ones expected");
  }

  // The harmonic function with those values on the boundary, per vertex; the others are overwritten.
  void extend(std::vector<double>& values) const {
    Eigen::VectorXd rhs = Eigen::VectorXd::Zero(static_cast<int>(unknowns));
    for (const std::uint32_t t : at_boundary) {
      const auto gradient = gradients(t);
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t row = unknown[mesh.triangles[t][i]];
        for (std::size_t k = 0; row != no_unknown && k < 3; ++k) {
          const std::uint32_t v = mesh.triangles[t][k];
          if (unknown[v] == no_unknown)
            rhs[static_cast<int>(row)] -= areas[t] * dot(gradient[i], gradient[k]) * values[v];
        }
      }
    }
    if (unknowns == 0) return;
    const Eigen::VectorXd inside = cholesky.solve(rhs);
    for (std::size_t v = 0; v < unknown.size(); ++v)
      if (unknown[v] != no_unknown) values[v] = inside[static_cast<int>(unknown[v])];
  }

  // Minus the consistent normal flux at each vertex of the walls: the integral of the speed along the wall,
  // weighted by the vertex's hat function.
  std::vector<std::vector<double>> wall_flows(const std::vector<double>& values) const {
    std::vector<double> flux(mesh.points.size(), 0.0);
    for (const std::uint32_t t : at_boundary) {
      const auto gradient = gradients(t);
      const auto& corners = mesh.triangles[t];
      Point slope{};
      for (std::size_t k = 0; k < 3; ++k) slope = slope + values[corners[k]] * gradient[k];
      for (std::size_t i = 0; i < 3; ++i) flux[corners[i]] -= areas[t] * dot(gradient[i], slope);
    }
    std::vector<std::vector<double>> result;
    for (const Body& body : bodies) {
      auto& flows = result.emplace_back();
      for (const std::uint32_t v : body.vertices) flows.push_back(flux[v]);
    }
    return result;
  }

  // One harmonic function for each thing that is given or wanted: the stream at 0 and 90 degrees, each body's
  // value, each body's vortex.
  void solve_flows() {
    const std::size_t count = bodies.size();
    std::vector<std::vector<double>> functions;
    std::vector<std::vector<std::vector<double>>> flows;
    const auto add = [&](auto&& boundary_value) {
      auto& values = functions.emplace_back(mesh.points.size(), 0.0);
      boundary_value(values);
      extend(values);
      flows.push_back(wall_flows(values));
    };
    add([&](auto& values) {
      for (const std::uint32_t v : loops.farfield.vertices) values[v] = mesh.points[v].y;
    });
    add([&](auto& values) {
      for (const std::uint32_t v : loops.farfield.vertices) values[v] = -mesh.points[v].x;
    });
    for (const Body& body : bodies) {
      add([&](auto& values) {
        for (const std::uint32_t v : body.vertices) values[v] = 1.0;
      });
    }
    for (const Body& body : bodies) {
      add([&](auto& values) {
        for (const std::uint32_t v : loops.farfield.vertices) {
          const Point d = mesh.points[v] - body.centre;
          values[v] = std::log(std::hypot(d.x, d.y)) / (2.0 * std::numbers::pi);
        }
      });
    }
    for (const std::size_t given : {std::size_t{0}, std::size_t{1}}) {
      const std::vector<double> factors = strengths(flows, given, Kutta::edge);
      const std::vector<double> beside = strengths(flows, given, Kutta::beside);
      combination(functions, flows, factors, given, flow[given]);
      flow[given].on_body.assign(factors.begin(), factors.begin() + static_cast<std::ptrdiff_t>(count));
      flow[given].circulation.assign(factors.begin() + static_cast<std::ptrdiff_t>(count), factors.end());
      flow[given].circulation_beside.assign(beside.begin() + static_cast<std::ptrdiff_t>(count),
                                            beside.end());
    }
  }

  // Values of the bodies, then circulations: those with which each body's circulation is that of its vortex
  // far away, and the flow leaves sharp edges smoothly or has no circulation.
  std::vector<double> strengths(const std::vector<std::vector<std::vector<double>>>& flows, std::size_t given,
                                Kutta where) const {
    const std::size_t count = bodies.size(), n = 2 * count;
    const auto circulation = [&](std::size_t function, std::size_t body) {
      double sum = 0.0;
      for (const double value : flows[function][body]) sum += value;
      return sum;
    };
    const auto around_edge = [&](std::size_t function, std::size_t body) {
      const flow::KuttaCondition& kutta = bodies[body].kutta;
      double sum = 0.0;
      if (where == Kutta::beside) {
        for (std::size_t i = 0; i < 2; ++i)
          sum += kutta.weights_beside[i] * flows[function][body][kutta.beside[i]];
        return sum;
      }
      for (const auto& [i, weight] : kutta.terms) sum += weight * flows[function][body][i];
      return sum;
    };
    std::vector<double> matrix(n * n, 0.0), rhs(n, 0.0);
    for (std::size_t body = 0; body < count; ++body) {
      double* const balance = &matrix[body * n];
      double* const kutta = &matrix[(count + body) * n];
      for (std::size_t k = 0; k < n; ++k) {
        balance[k] = circulation(2 + k, body);
        if (bodies[body].base > 0) kutta[k] = around_edge(2 + k, body);
      }
      balance[count + body] -= 1.0;
      if (bodies[body].base == 0) kutta[count + body] = 1.0;
      rhs[body] = -circulation(given, body);
      if (bodies[body].base > 0) rhs[count + body] = -around_edge(given, body);
    }
    if (!solve_dense(std::move(matrix), rhs))
      throw Error(ErrorCode::argument, source, "bodies without any circulation found, others expected");
    return rhs;
  }

  void combination(const std::vector<std::vector<double>>& functions,
                   const std::vector<std::vector<std::vector<double>>>& flows,
                   const std::vector<double>& factors, std::size_t given, Flow& result) const {
    result.stream_function = functions[given];
    auto sums = flows[given];
    for (std::size_t k = 0; k < factors.size(); ++k) {
      for (std::size_t v = 0; v < result.stream_function.size(); ++v)
        result.stream_function[v] += factors[k] * functions[2 + k][v];
      for (std::size_t body = 0; body < bodies.size(); ++body)
        for (std::size_t i = 0; i < sums[body].size(); ++i)
          sums[body][i] += factors[k] * flows[2 + k][body][i];
    }
    for (std::size_t body = 0; body < bodies.size(); ++body) {
      auto& speeds = result.speeds.emplace_back(sums[body]);
      for (std::size_t i = 0; i < speeds.size(); ++i) speeds[i] /= bodies[body].lengths[i];
    }
  }

  FrozenMesh mesh;
  PotentialOptions options;
  std::string source;
  WallLoops loops;
  std::vector<Body> bodies;
  std::vector<std::uint32_t> unknown;  // per vertex: its row
  std::uint32_t unknowns = 0;
  std::vector<double> areas;               // per triangle
  std::vector<std::uint32_t> at_boundary;  // triangles with a vertex there
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> cholesky;
  bool ordered = false;
  std::array<Flow, 2> flow;  // at 0 and at 90 degrees
};

PotentialSolver::PotentialSolver(const FrozenMesh& mesh, const PotentialOptions& options,
                                 const std::string& source)
    : solution_(std::make_unique<Solution>(mesh, options, source)) {}
PotentialSolver::~PotentialSolver() = default;
PotentialSolver::PotentialSolver(PotentialSolver&&) noexcept = default;
PotentialSolver& PotentialSolver::operator=(PotentialSolver&&) noexcept = default;

void PotentialSolver::move(const std::vector<Point>& points) {
  solution_->move(points);
}

namespace {

constexpr double gamma = 1.4;  // ratio of specific heats

void require_subsonic(double mach) {
  if (!(mach >= 0.0 && mach < 1.0))
    throw Error(ErrorCode::argument, "mach",
                std::to_string(mach) + " found, at least 0 and less than 1 expected of potential flow");
}

double lift_of(const std::vector<double>& circulations, double reference_length) {
  double sum = 0.0;
  for (const double circulation : circulations) sum += circulation;
  return 2.0 * sum / reference_length;
}

// The area-weighted mean of the triangles around each vertex.
std::vector<Point> mean_velocities(const FrozenMesh& mesh, const std::vector<double>& areas,
                                   const std::vector<double>& stream_function) {
  std::vector<Point> sums(mesh.points.size());
  std::vector<double> weights(mesh.points.size(), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Point p = mesh.points[b] - mesh.points[a], q = mesh.points[c] - mesh.points[a];
    const double dp = stream_function[b] - stream_function[a], dq = stream_function[c] - stream_function[a];
    // (d psi / d y, -d psi / d x), times twice the area.
    const Point twice = {p.x * dq - q.x * dp, p.y * dq - q.y * dp};
    for (const std::uint32_t v : {a, b, c}) {
      sums[v] = sums[v] + 0.5 * twice;
      weights[v] += areas[t];
    }
  }
  for (std::size_t v = 0; v < sums.size(); ++v) sums[v] = (1.0 / weights[v]) * sums[v];
  return sums;
}

double cp_of_speed(double speed, double mach) {
  return compressible_cp(1.0 - speed * speed, mach);
}

// Forces by pressure, of speeds that are linear on each edge.
void add_forces(BodyFlow& body, std::size_t base, double alpha, double mach,
                const PotentialOptions& options) {
  const std::size_t n = body.wall.size();
  Point force{};
  double moment = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const WallValue &a = body.wall[i], &b = body.wall[(i + 1) % n];
    // The trailing edge has one speed: the flow comes towards it on both sides.
    const double from = i + 1 == base ? -a.speed : a.speed;
    const double to = b.speed;
    const double cp =
        (cp_of_speed(from, mach) + 4.0 * cp_of_speed(0.5 * (from + to), mach) + cp_of_speed(to, mach)) / 6.0;
    const Point d = b.point - a.point;
    const Point part = cp * Point{d.y, -d.x};
    const Point arm = 0.5 * (a.point + b.point) - options.reference;
    force = force + part;
    moment -= cross(arm, part);
  }
  const double length = options.reference_length;
  body.lift = (force.y * std::cos(alpha) - force.x * std::sin(alpha)) / length;
  body.drag = (force.x * std::cos(alpha) + force.y * std::sin(alpha)) / length;
  body.moment = moment / (length * length);
}

}  // namespace

double compressible_cp(double cp, double mach) {
  if (mach == 0.0) return cp;
  const double beta = std::sqrt(1.0 - mach * mach);
  const double vacuum = -2.0 / (gamma * mach * mach);
  const double denominator = beta + mach * mach / (1.0 + beta) * 0.5 * cp;
  return denominator > 0.0 ? std::max(cp / denominator, vacuum) : vacuum;
}

double sonic_cp(double mach) {
  const double square = mach * mach;
  const double pressure =
      std::pow((2.0 + (gamma - 1.0) * square) / (gamma + 1.0), gamma / (gamma - 1.0));  // over the stream's
  return 2.0 / (gamma * square) * (pressure - 1.0);
}

PotentialFlow PotentialSolver::at(double alpha_deg, double mach) const {
  if (!(std::abs(alpha_deg) <= 90.0))
    throw Error(ErrorCode::argument, "alpha",
                std::to_string(alpha_deg) + " found, -90 to 90 degrees expected");
  require_subsonic(mach);
  const Solution& s = *solution_;
  const double alpha = alpha_deg * std::numbers::pi / 180.0;
  const double a = std::cos(alpha), b = std::sin(alpha);
  PotentialFlow result;
  result.alpha_deg = alpha_deg;
  result.mach = mach;
  result.lift = (a * lift_of(s.flow[0].circulation, s.options.reference_length) +
                 b * lift_of(s.flow[1].circulation, s.options.reference_length)) /
                std::sqrt(1.0 - mach * mach);
  std::vector<flow::PotentialOutline> outlines;
  flow::LiftAgain incompressible{.reference_length = s.options.reference_length};
  incompressible.lift_beside = a * lift_of(s.flow[0].circulation_beside, s.options.reference_length) +
                               b * lift_of(s.flow[1].circulation_beside, s.options.reference_length);
  combine(result.stream_function, a, s.flow[0].stream_function, b, s.flow[1].stream_function);
  result.velocity = mean_velocities(s.mesh, s.areas, result.stream_function);
  for (std::size_t k = 0; k < s.bodies.size(); ++k) {
    const Body& body = s.bodies[k];
    BodyFlow& part = result.bodies.emplace_back();
    part.name = body.name;
    part.trailing_edge = body.base > 0;
    part.circulation = a * s.flow[0].circulation[k] + b * s.flow[1].circulation[k];
    part.stream_function = a * s.flow[0].on_body[k] + b * s.flow[1].on_body[k];
    std::vector<double> speeds;
    combine(speeds, a, s.flow[0].speeds[k], b, s.flow[1].speeds[k]);
    const std::size_t n = speeds.size();
    const auto& [lower, upper] = body.kutta.beside;
    const double leaving = 0.5 * (std::abs(speeds[lower]) + std::abs(speeds[upper]));
    std::fill_n(speeds.begin(), body.base, leaving);
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint32_t v = body.vertices[i];
      const Point along =
          s.mesh.points[body.vertices[(i + 1) % n]] - s.mesh.points[body.vertices[(i + n - 1) % n]];
      const double cp = cp_of_speed(speeds[i], mach);
      part.wall.push_back({v, s.mesh.points[v], speeds[i], cp});
      result.supersonic |= cp < sonic_cp(mach);
      if (i >= body.base) result.velocity[v] = (speeds[i] / std::hypot(along.x, along.y)) * along;
    }
    for (std::size_t i = 0; i < body.base; ++i)
      result.velocity[body.vertices[i]] =
          0.5 * (result.velocity[body.vertices[lower]] + result.velocity[body.vertices[upper]]);
    add_forces(part, body.base, alpha, 0.0, s.options);
    incompressible.lift += part.lift, incompressible.drag += part.drag;
    if (mach > 0.0) add_forces(part, body.base, alpha, mach, s.options);
    result.lift_by_pressure += part.lift;
    result.drag_by_pressure += part.drag;
    result.moment += part.moment;
    auto& outline = outlines.emplace_back(flow::PotentialOutline{body.name, {}, body.base});
    for (const WallValue& value : part.wall) outline.points.push_back(value.point);
  }
  flow::Warnings warnings = flow::warnings_of(outlines, result, incompressible);
  result.warnings = std::move(warnings.sentences);
  result.lift_determined = warnings.lift_determined;
  return result;
}

double PotentialSolver::alpha_deg_for(double lift, double mach) const {
  require_subsonic(mach);
  const double scale = 1.0 / std::sqrt(1.0 - mach * mach);
  const double at_0 = scale * lift_of(solution_->flow[0].circulation, solution_->options.reference_length);
  const double at_90 = scale * lift_of(solution_->flow[1].circulation, solution_->options.reference_length);
  const double most = std::hypot(at_0, at_90);
  // lift = most * sin(alpha - alpha without lift)
  if (!(std::abs(lift) <= most) || most == 0.0) {
    throw Error(
        ErrorCode::argument, "lift",
        std::to_string(lift) + " found, " + std::to_string(most) + " at most expected of these bodies");
  }
  const double without = std::atan2(-at_0, at_90);
  return (std::asin(lift / most) + without) * 180.0 / std::numbers::pi;
}

std::vector<Field> PotentialFlow::fields() const {
  Field cp{"cp", FieldPlace::vertices, 1, {}}, speed{"speed", FieldPlace::vertices, 1, {}};
  Field velocities{"velocity", FieldPlace::vertices, 2, {}};
  for (const Point v : velocity) {
    const double square = dot(v, v);
    cp.values.push_back(compressible_cp(1.0 - square, mach));
    speed.values.push_back(std::sqrt(square));
    velocities.values.insert(velocities.values.end(), {v.x, v.y});
  }
  return {cp, speed, {"stream_function", FieldPlace::vertices, 1, stream_function}, velocities};
}

}  // namespace remodel
