#include "flow/flow_warnings.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "flow/potential/trailing_edge.h"
#include "flow/solution.h"

namespace remodel::flow {

namespace {

std::string short_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

struct Outline {
  std::string name;  // of its boundaries, joined by '+'
  std::vector<Point> points;
};

double doubled_area(const std::vector<Point>& points) {
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) sum += cross(points[i], points[(i + 1) % points.size()]);
  return sum;
}

// Closed loops of walls that are holes of the domain. Those that touch themselves or others are left out.
std::vector<Outline> bodies_of(const FlowMesh& mesh) {
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> from(mesh.size(), none);  // the boundary edge that begins at a vertex
  std::vector<bool> seen(mesh.boundary().size(), false);
  for (std::size_t i = 0; i < mesh.boundary().size(); ++i) {
    std::size_t& at = from[mesh.boundary()[i].a];
    if (at != none) seen[i] = seen[at] = true;
    at = i;
  }
  std::vector<Outline> bodies;
  for (std::size_t first = 0; first < seen.size(); ++first) {
    Outline body;
    std::vector<std::uint32_t> patches;
    bool is_wall = !seen[first];
    std::size_t i = first;
    for (; i != none && !seen[i]; i = from[mesh.boundary()[i].b]) {
      const BoundaryEdge& edge = mesh.boundary()[i];
      seen[i] = true;
      is_wall = is_wall && mesh.patch(edge).solid();
      body.points.push_back(mesh.points()[edge.a]);
      if (std::find(patches.begin(), patches.end(), edge.patch) == patches.end())
        patches.push_back(edge.patch);
    }
    if (!is_wall || i != first || doubled_area(body.points) >= 0.0) continue;
    for (const std::uint32_t k : patches)
      body.name += (body.name.empty() ? "" : "+") + mesh.patches()[k].name;
    bodies.push_back(std::move(body));
  }
  return bodies;
}

// Of the largest body: its chord.
double largest_extent(const std::vector<PotentialOutline>& bodies) {
  double largest = 0.0;
  for (const PotentialOutline& body : bodies) {
    const auto by_x = [](Point a, Point b) { return a.x < b.x; };
    const auto by_y = [](Point a, Point b) { return a.y < b.y; };
    const auto [left, right] = std::minmax_element(body.points.begin(), body.points.end(), by_x);
    const auto [low, high] = std::minmax_element(body.points.begin(), body.points.end(), by_y);
    largest = std::max({largest, right->x - left->x, high->y - low->y});
  }
  return largest;
}

std::string undetermined(const std::string& name) {
  return "the lift of '" + name +
         "' is not determined: it has no edge that the flow has to leave from, so that flows without "
         "friction exist with any circulation; ";
}

}  // namespace

Warnings warnings_of(const FlowMesh& mesh, double mach, double alpha_deg) {
  Warnings warnings;
  if (mach >= 1.0) return warnings;
  for (const Outline& body : bodies_of(mesh))
    if (!edge_faces_downstream(body.points, stream_direction(alpha_deg))) {
      warnings.lift_determined = false;
      warnings.sentences.push_back(undetermined(body.name) +
                                   "this one is chosen by the errors of mesh and scheme");
    }
  return warnings;
}

std::string spurious_drag_warning(double drag, double scale, double largest_mach) {
  constexpr double count = 1e-4, least = 10.0 * count;
  if (largest_mach >= 1.0 || std::abs(drag) <= least * scale) return {};
  return "the drag of " + short_text(drag / count) +
         " counts is made by mesh and scheme: without friction and shocks there is none, and lift is off "
         "too; a finer mesh has less (--points, --error)";
}

namespace {

void add_size_warnings(const FlowMesh& mesh, const Stream& stream, FlowResult& result) {
  constexpr double most = 3.0, least_turbulent = 1e4;
  const double extent = mesh.extent().length, ratio = extent / stream.reference_length;
  const bool has_bodies = mesh.has_farfield() || mesh.has_images();
  if (has_bodies && (ratio > most || ratio < 1.0 / most))
    result.warnings.push_back("the reference length is " + short_text(stream.reference_length) +
                              " and the largest wall is " + short_text(extent) + " long: coefficients" +
                              (result.friction ? " and the Reynolds number" : "") + " are by the former");
  if (result.model != FlowModel::sa) return;
  const double reynolds = result.friction->reynolds * (has_bodies ? ratio : 1.0);
  if (reynolds < least_turbulent)
    result.warnings.push_back(
        "the model is of turbulent flow, and the Reynolds number by the walls' length is " +
        short_text(reynolds) + ", where boundary layers are laminar");
}

// In a duct the stream is no more than a unit.
void add_row_warnings(FlowResult& result) {
  constexpr double most_mach = 0.05, most_degrees = 2.0;
  for (const FlowOpening& opening : result.openings) {
    if (opening.mass_flow <= 0.0) continue;
    if (std::abs(opening.mach - result.mach) > most_mach * result.mach)
      result.warnings.push_back("gas enters by '" + opening.name + "' at Mach " + short_text(opening.mach) +
                                ", and coefficients are by a stream of Mach " + short_text(result.mach) +
                                ": the outlets' pressure decides how much enters");
    if (std::abs(std::remainder(opening.flow_angle_deg - result.alpha_deg, 360.0)) > most_degrees)
      result.warnings.push_back("gas enters by '" + opening.name + "' at " +
                                short_text(opening.flow_angle_deg) +
                                " degrees, and lift and drag are across and along " +
                                short_text(result.alpha_deg) + " degrees, as the angle of attack has it");
  }
}

// Where a boundary condition cannot have what it is given, the mean of what enters says so.
void add_inlet_warnings(const FlowMesh& mesh, FlowResult& result) {
  constexpr double most = 0.1;                                         // of the dynamic pressure
  const double whole = total_state(result.mach).pressure * gas_gamma;  // over the stream's pressure
  for (const Patch& patch : mesh.patches()) {
    const auto* const inlet = std::get_if<Inlet>(&patch.condition);
    if (inlet == nullptr) continue;
    for (const FlowOpening& opening : result.openings) {
      if (opening.name != patch.name || opening.mass_flow <= 0.0) continue;
      const double dynamic = 0.5 * gas_gamma * opening.mach * opening.mach * opening.pressure;
      const double off = whole * std::abs(opening.total_pressure - inlet->total_pressure);
      if (off > most * dynamic)
        result.warnings.push_back(
            "the mean total pressure of the gas that enters by '" + opening.name +
            "' is off the given one by " + short_text(100.0 * off / dynamic) +
            " % of its dynamic pressure: the flow at that inlet is not what was asked for");
    }
  }
}

void add_loss_warning(FlowResult& result) {
  constexpr double least = 0.02;
  if (result.friction) return;
  if (const auto loss = loss_coefficient(result);
      loss && std::abs(*loss) > least && largest_mach(result) < 1.0)
    result.warnings.push_back(
        "the loss coefficient of " + short_text(*loss) +
        " is made by mesh and scheme: without friction and shocks no total pressure is lost; "
        "a finer mesh has less, and so may an inlet angle that suits the blades");
}

}  // namespace

void add_stream_warnings(const FlowMesh& mesh, const Stream& stream, FlowResult& result) {
  add_size_warnings(mesh, stream, result);
  if (mesh.has_images()) add_row_warnings(result);
  add_inlet_warnings(mesh, result);
  add_loss_warning(result);
}

Warnings warnings_of(const std::vector<PotentialOutline>& bodies, const PotentialFlow& flow,
                     const LiftAgain& again) {
  constexpr double part = 0.035, least = 0.01;
  Warnings warnings;
  for (const PotentialOutline& body : bodies) {
    const bool no_edge = body.base == 0;
    const bool faces_stream = !no_edge && dot(edge_direction(body.points, body.base),
                                              stream_direction(flow.alpha_deg)) < least_cosine;
    warnings.lift_determined = warnings.lift_determined && !no_edge && !faces_stream;
    if (no_edge) warnings.sentences.push_back(undetermined(body.name) + "this one has none");
    if (faces_stream)
      warnings.sentences.push_back(
          "the lift of '" + body.name +
          "' is not determined: its only edge faces the stream, and is taken for a trailing one");
  }
  const double lift = flow.lift * std::sqrt(1.0 - flow.mach * flow.mach);
  // Behind a blunt base there is drag on any mesh.
  const bool blunt =
      std::any_of(bodies.begin(), bodies.end(), [](const auto& body) { return body.base > 1; });
  const double error =
      std::abs(lift - again.lift) + std::abs(lift - again.lift_beside) + (blunt ? 0.0 : std::abs(again.drag));
  if (error > part * std::abs(lift) + least * largest_extent(bodies) / again.reference_length)
    warnings.sentences.push_back("the mesh is too coarse for this flow: without compressibility CL is " +
                                 short_text(lift) + " by circulation, " + short_text(again.lift) +
                                 " by pressure and " + short_text(again.lift_beside) +
                                 " by what leaves the body a little beside its edge, expected the same, and "
                                 "CD by pressure is " +
                                 short_text(again.drag) + ", expected none");
  if (flow.supersonic)
    warnings.sentences.push_back(
        "some pressures are below that of sonic speed, where the rule of Karman and Tsien does not hold");
  return warnings;
}

}  // namespace remodel::flow
