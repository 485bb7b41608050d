#include "remodel/flow.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <nanoflann.hpp>

#include "base/stopwatch.h"
#include "flow/flow_warnings.h"
#include "flow/friction_flow.h"
#include "flow/scheme/entropy_drag.h"
#include "flow/scheme/forces.h"
#include "flow/search/chord.h"
#include "flow/search/coarse_start.h"
#include "flow/solution.h"
#include "remodel/error.h"

namespace remodel {

const char* name_of(FlowStatus status) {
  constexpr const char* names[] = {"converged", "step-limit", "stalled", "memory", "interrupted"};
  return names[static_cast<std::size_t>(status)];
}

const char* name_of(FlowStart start) {
  constexpr const char* names[] = {"cold", "carried", "refactored"};
  return names[static_cast<std::size_t>(start)];
}

const char* name_of(FlowOrigin origin) {
  constexpr const char* names[] = {"last-flow", "potential", "coarser-mesh", "undisturbed"};
  return names[static_cast<std::size_t>(origin)];
}

const char* name_of(FlowModel model) {
  constexpr const char* names[] = {"euler", "laminar", "sa"};
  return names[static_cast<std::size_t>(model)];
}

const char* name_of(FlowSolver solver) {
  constexpr const char* names[] = {"lu", "gmres"};
  return names[static_cast<std::size_t>(solver)];
}

namespace flow {

namespace {

// Reads as the same number; the library of the page's compiler has no std::to_chars() of it.
std::string shortest_text(double value) {
  constexpr int least = 6, enough = 17;
  char text[32];
  for (int digits = least; digits <= enough; ++digits) {
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    if (std::strtod(text, nullptr) == value) break;
  }
  return text;
}

void require(bool holds, const char* what, double found, const char* expected) {
  if (holds) return;
  throw Error(ErrorCode::argument, what, "found " + shortest_text(found) + ", expected " + expected);
}

class Points {
 public:
  explicit Points(const std::vector<Point>& points) : points_(points), tree_(2, *this) {}
  std::size_t kdtree_get_point_count() const { return points_.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return axis == 0 ? points_[i].x : points_[i].y;
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
  std::size_t nearest(Point p) const {
    const double query[2] = {p.x, p.y};
    std::size_t index = 0;
    double distance = 0.0;
    tree_.knnSearch(query, 1, &index, &distance);
    return index;
  }

 private:
  const std::vector<Point>& points_;
  nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Points>, Points, 2, std::size_t>
      tree_;
};

// The weights of a triangle's corners at a point.
std::array<double, 3> weights_at(const FlowMesh& mesh, const std::array<std::uint32_t, 3>& corners, Point p) {
  const Point a = mesh.points()[corners[0]], b = mesh.points()[corners[1]], c = mesh.points()[corners[2]];
  const double area = cross(b - a, c - a);
  const double second = cross(p - a, c - a) / area, third = cross(b - a, p - a) / area;
  return {1.0 - second - third, second, third};
}

// All boundaries that the options say something of, ascending.
std::vector<std::string> named_boundaries(const FlowOptions& options) {
  std::vector<std::string> names = options.farfield;
  for (const FlowInlet& inlet : options.inlets) names.push_back(inlet.name);
  for (const FlowOutlet& outlet : options.outlets) names.push_back(outlet.name);
  names.insert(names.end(), options.symmetry.begin(), options.symmetry.end());
  for (const FlowPeriod& pair : options.periodic) names.push_back(pair.name), names.push_back(pair.moved);
  std::sort(names.begin(), names.end());
  return names;
}

void require_openings(const FlowConditions& conditions, const FlowOptions& options) {
  const std::vector<std::string> names = named_boundaries(options);
  const auto twice = std::adjacent_find(names.begin(), names.end());
  if (twice != names.end())
    throw Error(ErrorCode::argument, "boundary '" + *twice + "'",
                "named twice, expected it to be far field, inlet or outlet" +
                    std::string(options.symmetry.empty() ? "" : ", or symmetry plane") +
                    (options.periodic.empty() ? "" : ", or one of two periodic boundaries"));
  for (const FlowInlet& inlet : options.inlets) {
    require(inlet.total_pressure > 0.0 && std::isfinite(inlet.total_pressure), "total pressure",
            inlet.total_pressure, "more than 0");
    require(inlet.total_temperature > 0.0 && std::isfinite(inlet.total_temperature), "total temperature",
            inlet.total_temperature, "more than 0");
    require(!inlet.angle_deg || std::fabs(*inlet.angle_deg) <= 180.0, "inlet angle",
            inlet.angle_deg.value_or(0.0), "-180 to 180 degrees");
    require(conditions.mach < 1.0, "mach", conditions.mach,
            "less than 1 where there is an inlet (gas enters faster than sound through a far field)");
  }
  for (const FlowOutlet& outlet : options.outlets)
    require(outlet.pressure > 0.0 && std::isfinite(outlet.pressure), "pressure", outlet.pressure,
            "more than 0");
}

}  // namespace

void require_possible(const FlowConditions& conditions, const FlowOptions& options) {
  require(conditions.mach >= 0.01 && conditions.mach <= 3.0, "mach", conditions.mach, "0.01 to 3");
  require(std::fabs(conditions.alpha_deg) <= 90.0, "alpha", conditions.alpha_deg, "-90 to 90 degrees");
  require(conditions.reference_length > 0.0 && std::isfinite(conditions.reference_length), "reference length",
          conditions.reference_length, "more than 0");
  require(std::isfinite(conditions.reference.x) && std::isfinite(conditions.reference.y), "reference point",
          conditions.reference.x, "finite coordinates");
  if (conditions.cl) {
    require(std::fabs(*conditions.cl) <= 10.0, "cl", *conditions.cl, "-10 to 10");
    require(conditions.mach < 1.0, "mach", conditions.mach, "less than 1 where a lift coefficient is given");
  }
  require(options.tolerance >= 1e-13 && options.tolerance <= 1e-2, "tolerance", options.tolerance,
          "1e-13 to 1e-2");
  require(options.max_steps >= 1, "max steps", options.max_steps, "1 or more");
  require(options.limiter > 0.0 && std::isfinite(options.limiter), "limiter", options.limiter, "more than 0");
  require(options.memory_mb >= 1.0, "memory", options.memory_mb, "1 MB or more");
  require_openings(conditions, options);
  if (conditions.transition) {
    if (options.model != FlowModel::sa)
      throw Error(ErrorCode::argument, "transition",
                  std::string("given with the model ") + name_of(options.model) + ", expected sa");
    for (const double x : *conditions.transition)
      require(x >= 0.0 && x <= 1.0, "transition", x, "0 to 1 chords");
  }
  if (conditions.wall_temperature) {
    if (options.model == FlowModel::euler)
      throw Error(ErrorCode::argument, "wall temperature",
                  "given with the model euler, expected one with friction");
    require(*conditions.wall_temperature > 0.0 && std::isfinite(*conditions.wall_temperature),
            "wall temperature", *conditions.wall_temperature, "more than 0, as a part of the stream's");
  }
  if (options.model == FlowModel::euler) return;
  require(conditions.reynolds >= 1.0 && conditions.reynolds <= 1e10, "reynolds", conditions.reynolds,
          "1 to 1e10 for a model with friction");
  require(options.temperature_k >= 0.0 && std::isfinite(options.temperature_k), "temperature",
          options.temperature_k, "Kelvin, or 0");
}

void require_known(const FlowResult& known, const FlowMesh& mesh, FlowModel model,
                   const std::string& source) {
  if (known.density.size() != mesh.size())
    throw Error(ErrorCode::argument, source,
                "found a flow at " + std::to_string(known.density.size()) + " points, expected one at the " +
                    std::to_string(mesh.size()) + " of its mesh");
  if (model == FlowModel::sa && (!known.friction || known.friction->working.size() != mesh.size()))
    throw Error(ErrorCode::argument, source,
                std::string("found a flow of the model ") + name_of(known.model) + ", expected one of sa");
}

namespace {

// Those that were named, and those of the mesh that no option gives another part. Throws Error (argument)
// where one gives it to half a pair.
std::vector<FlowPeriod> periodic_pairs(const FrozenMesh& mesh, const FlowOptions& options,
                                       const std::string& source) {
  const std::vector<std::string> names = named_boundaries(options);
  const auto is_named = [&](const std::string& name) {
    return std::binary_search(names.begin(), names.end(), name);
  };
  std::vector<FlowPeriod> pairs = options.periodic;
  for (const auto& [name, moved] : mesh.periodic) {
    if (is_named(name) != is_named(moved))
      throw Error(ErrorCode::argument, source,
                  "found '" + (is_named(name) ? name : moved) + "' named alone, expected '" + name +
                      "' and '" + moved + "', which are periodic, to be named both or not at all");
    if (!is_named(name)) pairs.push_back({name, moved});
  }
  return pairs;
}

}  // namespace

FlowMesh dual_of(const FrozenMesh& mesh, const FlowConditions& conditions, const FlowOptions& options,
                 const std::string& source) {
  std::vector<Patch> patches;
  for (const std::string& name : options.farfield) patches.push_back({name, FarField{}});
  for (const FlowInlet& inlet : options.inlets)
    patches.push_back(
        {inlet.name, Inlet{inlet.total_pressure, inlet.total_temperature,
                           inlet.angle_deg ? std::optional(*inlet.angle_deg * one_degree) : std::nullopt}});
  for (const FlowOutlet& outlet : options.outlets) patches.push_back({outlet.name, Outlet{outlet.pressure}});
  for (const std::string& name : options.symmetry) patches.push_back({name, Symmetry{}});
  for (const FlowPeriod& pair : periodic_pairs(mesh, options, source)) {
    patches.push_back({pair.name, Periodic{pair.moved}});
    patches.push_back({pair.moved, Periodic{}});
  }
  FlowMesh dual(mesh, std::move(patches), source);
  dual.require_walls(source);
  dual.require_farfield_around(source);
  if (options.model != FlowModel::euler) dual.stick_to_walls();
  require_ways(dual, conditions, options, source);
  return dual;
}

namespace {

// Gas leaves by no outlet whose pressure is that of the gas at rest, or more.
void require_lower_pressures(bool has_farfield, const FlowConditions& conditions,
                             const FlowOptions& options) {
  double total = has_farfield ? 1.0 : 0.0;
  for (const FlowInlet& inlet : options.inlets) total = std::max(total, inlet.total_pressure);
  total *= gas_gamma * total_state(conditions.mach).pressure;
  char least[32];
  std::snprintf(least, sizeof least, "%.6g", total);
  for (const FlowOutlet& outlet : options.outlets)
    require(outlet.pressure < total, "pressure", outlet.pressure,
            (std::string("less than the ") + least +
             " of the total pressure that the gas enters with, for it to leave by '" + outlet.name + "'")
                .c_str());
}

// The mirror image of the stream is the stream.
void require_symmetry(const FlowMesh& dual, const FlowConditions& conditions, const FlowOptions& options,
                      const std::string& source) {
  constexpr double least_turn = 1e-4;  // radians: less is a straight line, as files write it
  if (!options.symmetry.empty() && conditions.cl)
    throw Error(ErrorCode::argument, "cl",
                "given for a mesh with a symmetry plane, expected an angle of attack");
  const Point stream = stream_direction(conditions.alpha_deg);
  std::vector<Point> first(dual.patches().size());
  for (const BoundaryEdge& edge : dual.boundary()) {
    const Patch& patch = dual.patch(edge);
    if (!std::holds_alternative<Symmetry>(patch.condition)) continue;
    const double length = std::sqrt(dot(edge.normal, edge.normal));
    if (first[edge.patch] == Point{}) first[edge.patch] = edge.normal;
    const double turn = std::fabs(cross(first[edge.patch], edge.normal)) /
                        (length * std::sqrt(dot(first[edge.patch], first[edge.patch])));
    const bool is_straight = turn <= least_turn;
    if (is_straight && std::fabs(dot(edge.normal, stream)) <= least_turn * length) continue;
    throw Error(
        ErrorCode::argument, source,
        "the symmetry plane '" + patch.name + "' is not " + (is_straight ? "along the stream" : "straight") +
            " between points " + std::to_string(edge.a) + " and " + std::to_string(edge.b) +
            ", expected a straight line along the stream of angle " + shortest_text(conditions.alpha_deg));
  }
}

// Gas enters at less than this angle to the normal: at 90 degrees none does.
void require_inlet_angles(const FlowMesh& dual, const std::string& source) {
  constexpr double steepest = 89.0;
  for (const BoundaryEdge& edge : dual.boundary()) {
    const Inlet* inlet = std::get_if<Inlet>(&dual.patch(edge).condition);
    if (inlet == nullptr || !inlet->angle) continue;
    const Point along = {std::cos(*inlet->angle), std::sin(*inlet->angle)};
    const double inwards = -dot(along, edge.normal) / std::sqrt(dot(edge.normal, edge.normal));
    if (inwards > std::cos(steepest * one_degree)) continue;
    throw Error(ErrorCode::argument, source,
                "found gas to enter by '" + dual.patch(edge).name + "' at " +
                    shortest_text(*inlet->angle / one_degree) +
                    " degrees, which does not lead into the domain between points " +
                    std::to_string(edge.place[0]) + " and " + std::to_string(edge.place[1]) +
                    ", expected less than 89 degrees to the normal");
  }
}

}  // namespace

void require_ways(const FlowMesh& dual, const FlowConditions& conditions, const FlowOptions& options,
                  const std::string& source) {
  require_symmetry(dual, conditions, options, source);
  require_inlet_angles(dual, source);
  if (dual.has_images() && dual.has_farfield())
    throw Error(ErrorCode::argument, source,
                "found periodic boundaries and a far field, expected an inlet and an outlet in its place");
  require_lower_pressures(dual.has_farfield(), conditions, options);
  if (dual.has_farfield()) return;
  if (options.inlets.empty() || options.outlets.empty())
    throw Error(ErrorCode::argument, source,
                std::string("found no far field and no ") + (options.inlets.empty() ? "inlet" : "outlet") +
                    ", expected one for the gas to " + (options.inlets.empty() ? "enter" : "leave") + " by");
  if (conditions.cl)
    throw Error(ErrorCode::argument, "cl",
                "given for a mesh without a far field, expected an angle of attack");
}

Stream stream_of(const FlowConditions& conditions, const FlowOptions& options, const FlowMesh& dual) {
  const double extent = dual.extent().length;
  return {.mach = conditions.mach,
          .alpha = conditions.alpha_deg * one_degree,
          .lift = conditions.cl ? std::optional(*conditions.cl * conditions.reference_length / extent)
                                : std::nullopt,
          .reference = conditions.reference,
          .length = extent,
          .reference_length = conditions.reference_length,
          .transition = conditions.transition,
          .wall_temperature = conditions.wall_temperature,
          .vortex = options.vortex && options.symmetry.empty(),
          .limiter = options.limiter};
}

void note_search(const SearchRecord& record, FlowResult& result) {
  result.status = record.status;
  result.reason = record.reason;
  result.residual = record.residual;
  result.history = record.history;
  result.origin = record.origin;
  result.newton_steps = record.newton_steps + record.in_vain;
  result.coarse_steps = record.in_vain;
  result.factorisations = record.factorisations;
  result.krylov_iterations = record.iterations;
  result.solver = record.whole_factors ? FlowSolver::lu : FlowSolver::gmres;
  result.gmres_iterations = record.gmres_iterations;
  result.memory_mb = record.memory_mb;
}

FlowOpening opening_of(const FlowMesh& dual, std::uint32_t patch, double mass_flow,
                       const FlowResult& result) {
  double mass = 0.0, total = 0.0, statical = 0.0, mach = 0.0;
  Point momentum = {};
  for (const BoundaryEdge& edge : dual.boundary()) {
    if (edge.patch != patch) continue;
    for (const std::uint32_t v : edge.place) {
      const Point velocity = {result.velocity_x[v], result.velocity_y[v]};
      const double through = 0.5 * result.density[v] * dot(velocity, edge.normal);
      const double square = result.density[v] * dot(velocity, velocity) / (gas_gamma * result.pressure[v]);
      mass += through, momentum = momentum + through * velocity;
      total += through * result.pressure[v] * std::pow(1.0 + 0.2 * square, 3.5);
      statical += through * result.pressure[v], mach += through * std::sqrt(square);
    }
  }
  FlowOpening opening{.name = dual.patches()[patch].name, .mass_flow = mass_flow};
  if (mass == 0.0) return opening;
  if (mass < 0.0) momentum = -1.0 * momentum;
  opening.flow_angle_deg = std::atan2(momentum.y, momentum.x) / one_degree;
  opening.total_pressure = total / mass / total_state(result.mach).pressure;
  opening.pressure = gas_gamma * statical / mass;
  opening.mach = mach / mass;
  return opening;
}

Point stream_direction(double alpha_deg) {
  const double alpha = alpha_deg * one_degree;
  return {std::cos(alpha), std::sin(alpha)};
}

double largest_mach(const FlowResult& flow) {
  const std::vector<double> mach = mach_numbers(flow);
  return *std::max_element(mach.begin(), mach.end());
}

FlowResult result_of(const FlowSystem& system, const State& state, const SearchRecord& record,
                     FlowStart start) {
  FlowResult result;
  note_search(record, result);
  result.start = start;
  result.mach = system.stream().mach;
  result.alpha_deg = state.augmented[1] / one_degree;
  const double scale = reported_length(system.stream());
  const Coefficients sum = coefficients(system, state);
  result.cl = scale * sum.lift, result.cd = scale * sum.drag, result.cm = scale * scale * sum.moment;
  if (system.mesh().has_farfield()) result.entropy_drag = scale * value(system, state, EntropyDrag{});
  const std::vector<double> mass_flows = system.mass_flows(state);
  for (std::uint32_t i = 0; i < mass_flows.size(); ++i) {
    const Patch& patch = system.mesh().patches()[i];
    if (!patch.solid()) continue;
    const Coefficients part = coefficients(system, state, i);
    result.bodies.push_back({patch.name, scale * part.lift, scale * part.drag, scale * scale * part.moment});
  }
  Warnings warnings = warnings_of(system.mesh(), result.mach, result.alpha_deg);
  result.warnings = std::move(warnings.sentences);
  result.lift_determined = warnings.lift_determined;
  for (const Unknowns<double>& q : state.q) {
    result.density.push_back(density(q));
    result.velocity_x.push_back(velocity_x(q));
    result.velocity_y.push_back(velocity_y(q));
    result.pressure.push_back(pressure(q));
  }
  for (std::uint32_t i = 0; i < mass_flows.size(); ++i)
    if (system.mesh().patches()[i].open())
      result.openings.push_back(opening_of(system.mesh(), i, mass_flows[i], result));
  if (system.mesh().has_farfield() && result.converged()) {
    const std::string spurious = spurious_drag_warning(result.cd, scale, largest_mach(result));
    if (!spurious.empty()) result.warnings.push_back(spurious);
  }
  if (result.converged()) add_stream_warnings(system.mesh(), system.stream(), result);
  return result;
}

template <std::size_t N>
BlockVector<N> interpolated(const FlowMesh& mesh, const BlockVector<N>& state, std::span<const Point> at) {
  const std::vector<std::array<std::uint32_t, 3>> triangles = mesh.triangles();
  std::vector<std::uint32_t> start(mesh.size() + 1, 0);
  for (const auto& corners : triangles)
    for (const std::uint32_t v : corners) ++start[v + 1];
  for (std::size_t v = 0; v < mesh.size(); ++v) start[v + 1] += start[v];
  std::vector<std::uint32_t> around(start.back()), fill(start.begin(), start.end() - 1);
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (const std::uint32_t v : triangles[t]) around[fill[v]++] = t;

  const Points points(mesh.points());
  BlockVector<N> result;
  for (const Point p : at) {
    const std::size_t near = points.nearest(p);
    // The triangle that p lies in is mostly one around the nearest vertex, or next to one of these.
    double best = -std::numeric_limits<double>::infinity();
    std::array<double, 3> weights = {1.0, 0.0, 0.0};
    std::uint32_t best_triangle = around[start[near]];
    for (std::uint32_t i = start[near]; i < start[near + 1]; ++i) {
      const std::array<double, 3> w = weights_at(mesh, triangles[around[i]], p);
      const double least = std::min({w[0], w[1], w[2]});
      if (least > best) best = least, weights = w, best_triangle = around[i];
    }
    double total = 0.0;
    for (double& w : weights) w = std::clamp(w, 0.0, 1.0), total += w;
    std::array<double, N> value = {};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < N; ++k)
        value[k] += weights[i] / total * state[triangles[best_triangle][i]][k];
    result.push_back(value);
  }
  return result;
}
template BlockVector<4> interpolated<4>(const FlowMesh&, const BlockVector<4>&, std::span<const Point>);
template BlockVector<5> interpolated<5>(const FlowMesh&, const BlockVector<5>&, std::span<const Point>);

}  // namespace flow

std::optional<double> loss_coefficient(const FlowResult& result) {
  if (result.openings.size() != 2) return std::nullopt;
  const bool first_is_inlet = result.openings[0].mass_flow > result.openings[1].mass_flow;
  const FlowOpening& in = result.openings[first_is_inlet ? 0 : 1];
  const FlowOpening& out = result.openings[first_is_inlet ? 1 : 0];
  // Gas may enter and leave by a far field too.
  constexpr double least_balance = 1e-3;
  if (!(in.mass_flow > 0.0 && std::abs(in.mass_flow + out.mass_flow) < least_balance * in.mass_flow))
    return std::nullopt;
  const double total =
      flow::gas_gamma * flow::total_state(result.mach).pressure;  // over static, of the stream
  return (in.total_pressure - out.total_pressure) * total / (in.total_pressure * total - in.pressure);
}

namespace {

// A flow from undisturbed flow, or, if the mesh's domain is known, as search_by_meshes() starts.
FlowResult cold_flow(const FrozenMesh& mesh, const Mesh* living, const FlowConditions& conditions,
                     const FlowOptions& options, const std::string& source) {
  if (options.model != FlowModel::euler) return flow::friction_flow(mesh, conditions, options, source);
  const Stopwatch watch;
  flow::require_possible(conditions, options);
  const flow::FlowMesh dual = flow::dual_of(mesh, conditions, options, source);
  const flow::FlowSystem system(dual, flow::stream_of(conditions, options, dual));
  const flow::Measure measure(system);
  flow::State state;
  flow::WholeMatrix matrix;
  flow::Factors factors;
  flow::SearchRecord record, spent;
  flow::NewtonSearch search(options, matrix, factors, record);
  if (living != nullptr)
    flow::search_by_meshes(living->domain(), living->options(), measure, conditions, search, state, spent);
  else
    search.cold(measure, state);
  FlowResult result = flow::result_of(system, state, record, FlowStart::cold);
  flow::add_coarse(spent, result);
  result.seconds = watch.seconds();
  return result;
}

}  // namespace

FlowResult solve_flow(const FrozenMesh& mesh, const FlowConditions& conditions, const FlowOptions& options,
                      const std::string& source) {
  return cold_flow(mesh, nullptr, conditions, options, source);
}

FlowResult solve_flow(const Mesh& mesh, const FlowConditions& conditions, const FlowOptions& options,
                      const std::string& source) {
  return cold_flow(mesh.freeze(), &mesh, conditions, options, source);
}

FlowResult solve_flow_from(const FrozenMesh& before, const FlowResult& known, const FrozenMesh& mesh,
                           const FlowConditions& conditions, const FlowOptions& options,
                           const std::string& source) {
  flow::require_possible(conditions, options);
  if (options.model != FlowModel::euler)
    return flow::friction_flow_from(before, known, mesh, conditions, options, source);
  const Stopwatch watch;
  const flow::FlowMesh old = flow::dual_of(before, conditions, options, source);
  const flow::FlowMesh dual = flow::dual_of(mesh, conditions, options, source);
  flow::require_known(known, old, options.model, source);
  const flow::FlowSystem system(dual, flow::stream_of(conditions, options, dual));
  const flow::Measure measure(system);
  flow::Vector q(old.size());
  for (std::size_t v = 0; v < q.size(); ++v)
    q[v] = {known.density[v], known.velocity_x[v], known.velocity_y[v], known.pressure[v]};
  flow::State state;
  state.q = flow::interpolated<flow::unknown_count>(old, q, dual.points());
  state.augmented = {known.cl / flow::reported_length(system.stream()),
                     conditions.cl ? known.alpha_deg * flow::one_degree : system.stream().alpha};

  flow::WholeMatrix matrix;
  flow::Factors factors;
  flow::SearchRecord record;
  flow::NewtonSearch search(options, matrix, factors, record);
  FlowStart start = FlowStart::refactored;
  if (options.solver != FlowSolver::lu ||
      flow::steps_with_own_factors(measure, search, state) == flow::ChordEnd::slow)
    search.near(measure, state);
  if (flow::begins_again(record, options)) {
    start = FlowStart::cold;
    search.cold(measure, state);
  }
  FlowResult result = flow::result_of(system, state, record, start);
  result.seconds = watch.seconds();
  return result;
}

namespace {

template <class Value>
std::vector<double> at_each_point(const FlowResult& flow, Value value) {
  std::vector<double> values(flow.density.size());
  for (std::size_t v = 0; v < values.size(); ++v) values[v] = value(v);
  return values;
}

}  // namespace

std::vector<double> mach_numbers(const FlowResult& flow) {
  return at_each_point(flow, [&](std::size_t v) {
    return std::sqrt((flow.velocity_x[v] * flow.velocity_x[v] + flow.velocity_y[v] * flow.velocity_y[v]) *
                     flow.density[v] / (flow::gas_gamma * flow.pressure[v]));
  });
}

std::vector<double> pressure_coefficients(const FlowResult& flow) {
  return at_each_point(flow, [&](std::size_t v) {
    return (flow.pressure[v] - 1.0 / flow::gas_gamma) / (0.5 * flow.mach * flow.mach);
  });
}

std::vector<double> entropy_errors(const FlowResult& flow) {
  return at_each_point(flow, [&](std::size_t v) {
    return flow::gas_gamma * flow.pressure[v] / std::pow(flow.density[v], flow::gas_gamma) - 1.0;
  });
}

std::vector<Field> fields_of(const FlowResult& flow) {
  std::vector<double> velocity;
  for (std::size_t v = 0; v < flow.density.size(); ++v) {
    velocity.push_back(flow.velocity_x[v]);
    velocity.push_back(flow.velocity_y[v]);
  }
  std::vector<Field> fields = {{.name = "density", .values = flow.density},
                               {.name = "velocity", .components = 2, .values = std::move(velocity)},
                               {.name = "pressure", .values = flow.pressure},
                               {.name = "mach", .values = mach_numbers(flow)},
                               {.name = "cp", .values = pressure_coefficients(flow)},
                               {.name = "entropy", .values = entropy_errors(flow)}};
  if (!flow.friction) return fields;
  fields.push_back({.name = "cf", .values = flow.friction->cf});
  fields.push_back({.name = "y_plus", .values = flow.friction->y_plus});
  if (flow.model == FlowModel::sa)
    fields.push_back({.name = "viscosity_ratio", .values = flow.friction->viscosity_ratio});
  if (flow.friction->wall_temperature) fields.push_back({.name = "ch", .values = flow.friction->ch});
  return fields;
}

}  // namespace remodel
