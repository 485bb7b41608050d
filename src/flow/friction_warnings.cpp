#include "flow/friction_warnings.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "flow/physics/euler.h"
#include "flow/physics/stream.h"
#include "flow/scheme/wall_chains.h"
#include "flow/solution.h"

namespace remodel::flow {

namespace {

// The least distance of a vertex from the wall.
double height_at_walls(const FrictionMesh& mesh) {
  double height = std::numeric_limits<double>::infinity();
  for (const double d : mesh.distances())
    if (d > 0.0) height = std::min(height, d);
  return height;
}

// Whether the cells at the wall are low enough: for the turbulence, and for telling friction from pressure.
void add_height_warnings(const FrictionWarningInputs& of, std::vector<std::string>& warnings) {
  // Up to 4 drag is .6 % too much (docs/viscous.md); a sublayer ends at 5.
  constexpr double wanted = 1.0, tolerated = 5.0;
  // The part falls with the height to the power of 3/2 (NACA 0012, laminar, Re 500 and 5,000, Mach 0.01 to
  // 0.3).
  constexpr double wanted_across = 0.01, tolerated_across = 0.02;
  char text[200];
  const double y_plus = of.flow.friction->y_plus_max;
  if (of.flow.model == FlowModel::sa && y_plus > tolerated) {
    std::snprintf(
        text, sizeof text,
        "y+ of the cells at the wall is up to %.3g, expected about %.0f: cells that are %.2g high would do",
        y_plus, wanted, height_at_walls(of.mesh) * wanted / y_plus);
    warnings.push_back(text);
  }
  if (of.part_across > tolerated_across) {
    std::snprintf(
        text, sizeof text,
        "%.2g %% of the friction acts across the wall, as pressure does, expected none: the two are told "
        "apart by cells at the wall that are %.2g high",
        100.0 * of.part_across,
        height_at_walls(of.mesh) * std::pow(wanted_across / of.part_across, 2.0 / 3.0));
    warnings.push_back(text);
  }
}

bool is_quadrilateral(const Cell& cell) {
  return cell.corners() == 4;
}

// Boundary layers, wakes and what has separated: there the speed is less than nine tenths of what the total
// pressure of the gas that enters has at the pressure of that place.
class SlowGas {
 public:
  explicit SlowGas(const FlowResult& flow) : flow_(flow) {
    double entering = 0.0;  // as a part of the stream's
    for (const FlowOpening& opening : flow.openings)
      if (opening.mass_flow > 0.0) entering = std::max(entering, opening.total_pressure);
    total_ = total_state(flow.mach).pressure * (entering > 0.0 ? entering : 1.0);
  }
  bool is_at(std::uint32_t v) const {
    constexpr double outer = 0.9;
    const double pressure = flow_.pressure[v], density = flow_.density[v];
    const Point velocity = {flow_.velocity_x[v], flow_.velocity_y[v]};
    const double here = density * dot(velocity, velocity) / (gas_gamma * pressure);  // Mach number squared
    const double of_stream = 5.0 * (std::pow(std::max(total_ / pressure, 1.0), 2.0 / 7.0) - 1.0);
    return here < outer * outer * of_stream;
  }

 private:
  const FlowResult& flow_;
  double total_ = 0.0;
};

// The part of the layers' tops where gas is slow.
double part_of_tops_within(const FrictionWarningInputs& of, const SlowGas& slow) {
  const FlowMesh& dual = of.mesh.dual();
  std::vector<bool> at_layer(dual.size()), outside(dual.size());
  for (const Cell& cell : dual.cells())
    for (std::uint32_t k = 0; k < cell.corners(); ++k)
      (is_quadrilateral(cell) ? at_layer : outside)[cell[k]] = true;
  std::size_t tops = 0, within = 0;
  for (std::uint32_t v = 0; v < dual.size(); ++v) {
    if (!at_layer[v] || !outside[v] || of.mesh.sticks(v) || dual.is_image(v)) continue;
    ++tops;
    if (slow.is_at(v)) ++within;
  }
  return tops == 0 ? 0.0 : static_cast<double>(within) / static_cast<double>(tops);
}

// Boundary layers of long ducts meet: then hardly any gas is as fast as where it enters.
bool has_core(const FlowMesh& dual, const SlowGas& slow) {
  constexpr double least = 0.5;
  if (dual.has_farfield() || dual.has_images()) return true;
  double whole = 0.0, fast = 0.0;
  for (std::uint32_t v = 0; v < dual.size(); ++v) {
    whole += dual.areas()[v];
    if (!slow.is_at(v)) fast += dual.areas()[v];
  }
  return fast > least * whole;
}

// Behind strong shocks all gas has less total pressure, and at low Reynolds numbers no layer of cells is
// thick enough.
bool may_have_thin_layers(const FrictionWarningInputs& of) {
  constexpr double weak_shocks = 1.4, least_reynolds = 300.0;
  return of.flow.mach < 1.0 && of.flow.friction->reynolds >= least_reynolds &&
         largest_mach(of.flow) < weak_shocks;
}

void add_layer_warnings(const FrictionWarningInputs& of, std::vector<std::string>& warnings) {
  // NACA 0012, 4412 and RAE 2822 have 11 to 34 %, up to the largest lift; layers three times too thin 47 %
  // and more.
  constexpr double most_within = 0.4;
  const std::vector<Cell>& cells = of.mesh.dual().cells();
  if (std::none_of(cells.begin(), cells.end(), is_quadrilateral)) {
    warnings.push_back(
        "the mesh has no layer of quadrilaterals on its walls, which friction is not accurate without");
    return;
  }
  const SlowGas slow(of.flow);
  if (!may_have_thin_layers(of) || !has_core(of.mesh.dual(), slow)) return;
  const double within = part_of_tops_within(of, slow);
  if (within <= most_within) return;
  char text[240];
  std::snprintf(
      text, sizeof text,
      "%.0f %% of the layer's top lies within the boundary layer, expected at most %.0f: unless the "
      "flow has separated, a thicker layer has other coefficients",
      100.0 * within, 100.0 * most_within);
  warnings.push_back(text);
}

// The two sides of a closed chain: from the stagnation point to the rearmost one, the former first. A chain
// that is open, as of a duct or a plate, has one, from its end upstream.
std::vector<std::vector<std::uint32_t>> sides_of(const WallChain& chain, const FlowMesh& dual,
                                                 const FlowResult& flow) {
  std::vector<std::uint32_t> all;
  for (const std::uint32_t e : chain.edges) all.push_back(dual.boundary()[e].a);
  if (!chain.closed) all.push_back(dual.boundary()[chain.edges.back()].b);
  const Point stream = stream_direction(flow.alpha_deg);
  if (!chain.closed) {
    if (dot(dual.points()[all.front()], stream) > dot(dual.points()[all.back()], stream))
      std::reverse(all.begin(), all.end());
    return {all};
  }
  const auto by_pressure = [&](std::uint32_t a, std::uint32_t b) {
    return flow.pressure[a] < flow.pressure[b];
  };
  const auto by_place = [&](std::uint32_t a, std::uint32_t b) {
    return dot(dual.points()[a], stream) < dot(dual.points()[b], stream);
  };
  const auto rear =
      static_cast<std::size_t>(std::max_element(all.begin(), all.end(), by_place) - all.begin());
  const auto front =
      static_cast<std::size_t>(std::max_element(all.begin(), all.end(), by_pressure) - all.begin());
  const std::size_t count = all.size();
  std::vector<std::vector<std::uint32_t>> sides(2);
  for (const bool ahead : {true, false})
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t at = (front + (ahead ? k : count - k)) % count;
      sides[ahead ? 0 : 1].push_back(all[at]);
      if (at == rear) break;
    }
  return sides;
}

// A corner behind the middle of a side: beyond it lies a base, along which gas flows back.
bool is_rear_corner(const FlowMesh& dual, const std::vector<std::uint32_t>& side, std::size_t i,
                    Point stream) {
  constexpr double cosine = 0.5;
  const Point a = dual.points()[side[i]] - dual.points()[side[i - 1]];
  const Point b = dual.points()[side[i + 1]] - dual.points()[side[i]];
  const Point middle = 0.5 * (dual.points()[side.front()] + dual.points()[side.back()]);
  return dot(dual.points()[side[i]] - middle, stream) > 0.0 &&
         dot(a, b) < cosine * std::sqrt(dot(a, a) * dot(b, b));
}

}  // namespace

std::vector<Separation> separations(const FrictionMesh& mesh, const FlowResult& flow) {
  std::vector<Separation> all;
  const FlowMesh& dual = mesh.dual();
  const Point stream = stream_direction(flow.alpha_deg);
  for (const WallChain& chain : wall_chains(dual))
    for (const std::vector<std::uint32_t>& side : sides_of(chain, dual, flow)) {
      bool attached = false, apart = false;
      for (std::size_t i = 1; i + 1 < side.size(); ++i) {
        if (is_rear_corner(dual, side, i, stream)) break;
        // cf is positive along the stream.
        const Point along = dual.points()[side[i + 1]] - dual.points()[side[i - 1]];
        const double cf = flow.friction->cf[side[i]];
        const double forward = dot(along, stream) < 0.0 ? -cf : cf;
        if (apart) all.back().length += 0.5 * std::sqrt(dot(along, along));
        if (apart && forward > 0.0) all.back().to = side[i], apart = false;
        if (!apart && attached && forward < 0.0) {
          all.push_back({.from = side[i], .laminar = mesh.is_laminar(side[i])});
          apart = true;
        }
        attached = attached || forward > 0.0;
      }
    }
  return all;
}

namespace {

std::string place_text(Point p) {
  char text[60];
  std::snprintf(text, sizeof text, "(%.3g, %.3g)", p.x, p.y);
  return text;
}

void add_separation_warnings(const FrictionWarningInputs& of, std::vector<std::string>& warnings) {
  // Of the walls' extent. Up to the largest lift a turbulent layer leaves less of a section.
  constexpr double longest_bubble = 0.3, longest_turbulent = 0.25;
  const FlowMesh& dual = of.mesh.dual();
  const double extent = dual.extent().length;
  for (const Separation& separation : separations(of.mesh, of.flow)) {
    const Point from = dual.points()[separation.from];
    const bool is_closed = separation.to != no_index;
    const Point to = is_closed ? dual.points()[separation.to] : Point{};
    const std::string end = is_closed ? "comes back at " + place_text(to) : "does not come back to the wall";
    if (separation.laminar)
      warnings.push_back("the laminar boundary layer separates at " + place_text(from) +
                         ", ahead of the given transition, where a free one would come before long; it " +
                         end +
                         (!is_closed || separation.length > longest_bubble * extent
                              ? ": lift and drag are those of this stall"
                              : ""));
    else if (of.flow.model == FlowModel::sa && separation.length > longest_turbulent * extent)
      warnings.push_back("the turbulent boundary layer separates at " + place_text(from) + " and " + end +
                         ": nature's flow may not be steady there, and the model is least sure of it");
  }
}

}  // namespace

std::vector<std::string> friction_warnings(const FrictionWarningInputs& of) {
  std::vector<std::string> warnings;
  add_height_warnings(of, warnings);
  add_layer_warnings(of, warnings);
  add_separation_warnings(of, warnings);
  return warnings;
}

}  // namespace remodel::flow
