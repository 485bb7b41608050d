#include "live/core.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/checksum.h"
#include "live/page_mesh.h"
#include "remodel/airfoil.h"
#include "remodel/check.h"
#include "remodel/cmaes.h"
#include "remodel/error.h"
#include "remodel/potential_flow.h"
#include "remodel/remodel.h"

namespace {

using namespace remodel;

struct Search {
  CstAirfoil target;
  Cmaes cmaes;
};

struct Session {
  std::string error, text;
  std::vector<double> scratch, design, outline;
  PageMesh mesh;
  FrozenMesh frozen;
  std::vector<std::uint32_t> births;  // per cell
  std::vector<double> angles, sizes;
  std::vector<std::uint32_t> wall, keys, edges;
  std::uint32_t meshes = 0;  // that were generated
  std::vector<std::uint8_t> going;
  std::vector<double> figures = std::vector<double>(live_figure_count, 0.0);
  std::optional<PotentialSolver> solver;  // of the present mesh, made when it is asked for
  PotentialFlow flow;
  std::vector<double> cp, mach, wall_cp;
  std::optional<Search> search;
};
Session session;

// 1, or 0 with the sentence of what was thrown.
template <class Work>
std::uint32_t attempt(Work&& work) {
  try {
    work();
    return 1;
  } catch (const std::exception& error) {
    session.error = error.what();
    return 0;
  }
}

CstAirfoil airfoil_of(const double* design, std::uint32_t count) {
  if (count < 6 || count % 2 != 0 || count > 28)
    throw Error(ErrorCode::argument, "design",
                "found " + std::to_string(count) + " numbers, expected an even number from 6 to 28");
  const std::size_t surface = count / 2 - 1;
  CstAirfoil airfoil;
  airfoil.upper.assign(design, design + surface);
  airfoil.lower.assign(design + surface, design + 2 * surface);
  airfoil.te_upper = design[count - 2];
  airfoil.te_lower = design[count - 1];
  return airfoil;
}

// The class exponents of designs are the usual ones: others are fitted anew.
std::uint32_t give(CstAirfoil airfoil) {
  if (airfoil.e1 != CstAirfoil{}.e1 || airfoil.e2 != CstAirfoil{}.e2)
    throw Error(ErrorCode::argument, "airfoil", "found other class exponents, expected 0.5 and 1");
  session.design = airfoil.upper;
  session.design.insert(session.design.end(), airfoil.lower.begin(), airfoil.lower.end());
  session.design.insert(session.design.end(), {airfoil.te_upper, airfoil.te_lower});
  return static_cast<std::uint32_t>(session.design.size());
}

double smallest_angle_deg(std::span<const std::uint32_t> cell) {
  double smallest = std::numbers::pi;
  for (std::size_t i = 0; i < cell.size(); ++i) {
    const Point at = session.frozen.points[cell[i]];
    const Point a = session.frozen.points[cell[(i + 1) % cell.size()]] - at;
    const Point b = session.frozen.points[cell[(i + cell.size() - 1) % cell.size()]] - at;
    smallest = std::min(smallest, std::atan2(cross(a, b), dot(a, b)));
  }
  return smallest * 180.0 / std::numbers::pi;
}

void measure_cells() {
  const FrozenMesh& mesh = session.frozen;
  session.angles.clear();
  session.sizes.clear();
  for (std::size_t i = 0; i < mesh.cell_count(); ++i) {
    const auto cell = mesh.cell(i);
    session.angles.push_back(smallest_angle_deg(cell));
    double sum = 0.0;
    for (const std::uint32_t v : cell) sum += mesh.length_scale[v];
    session.sizes.push_back(sum / static_cast<double>(cell.size()));
  }
}

void find_wall() {
  session.wall.clear();
  for (const FrozenBoundary& boundary : session.frozen.boundaries) {
    if (boundary.name != "airfoil") continue;
    for (const auto& edge : boundary.edges) session.wall.push_back(edge[0]);
  }
}

// Names of vertices are those of their mesh, of which there may have been many.
void name_vertices() {
  constexpr unsigned generation_bits = 16;
  session.keys.clear();
  for (const std::uint64_t key : session.frozen.vertex_keys) {
    session.keys.push_back(static_cast<std::uint32_t>(key));
    session.keys.push_back(static_cast<std::uint32_t>(key >> 32) ^ (session.meshes << generation_bits));
  }
}

void find_edges() {
  session.edges.clear();
  for (const bool is_airfoil : {true, false})
    for (const FrozenBoundary& boundary : session.frozen.boundaries)
      if ((boundary.name == "airfoil") == is_airfoil)
        for (const auto& edge : boundary.edges)
          session.edges.insert(session.edges.end(), edge.begin(), edge.end());
}

// A layered mesh's frozen view has no births.
std::vector<std::uint32_t> births_since(const FrozenMesh* before) {
  if (!session.mesh.has_layers()) return session.frozen.birth;
  const std::uint32_t step = session.mesh.outer().step();
  if (before == nullptr) return std::vector<std::uint32_t>(session.frozen.cell_count(), step);
  return births_by_corners(*before, session.births, session.frozen, step);
}

// The arrays and figures of the mesh as it is now. `before` is its state before the step, if there was one.
void show(const FrozenMesh* before) {
  session.solver.reset();
  session.frozen = session.mesh.freeze();
  session.births = births_since(before);
  FrozenMesh& mesh = session.frozen;
  mesh.fate = before != nullptr ? fates(*before, mesh) : std::vector<Fate>(mesh.cell_count(), Fate::made);
  measure_cells();
  find_wall();
  const auto count = [&](Fate fate) {
    return static_cast<double>(std::count(mesh.fate.begin(), mesh.fate.end(), fate));
  };
  auto& figures = session.figures;
  const MeshStatistics statistics = session.mesh.outer().statistics();
  figures[live_triangle_count] = static_cast<double>(mesh.triangles.size());
  figures[live_quad_count] = static_cast<double>(mesh.quads.size());
  figures[live_layer_cells] = static_cast<double>(mesh.quads.size() + mesh.layer_triangles);
  figures[live_vertex_count] = static_cast<double>(mesh.points.size());
  figures[live_kept] = count(Fate::kept);
  figures[live_moved] = count(Fate::moved);
  figures[live_made] = count(Fate::made);
  figures[live_smallest_angle] = statistics.min_angle_deg;
  figures[live_largest_gradation] = statistics.max_gradation;
  figures[live_fresh_cells] = 0.0;
  figures[live_step] = session.mesh.outer().step();
}

void take(PageMesh mesh) {
  session.mesh = std::move(mesh);
  ++session.meshes;
  auto& figures = session.figures;
  figures[live_full_adjustment] = figures[live_vertices_moved] = figures[live_vertices_inserted] =
      figures[live_vertices_removed] = 0.0;
  figures[live_regenerated] = 1.0;
  show(nullptr);
}

// The distance between two outlines: the root mean square over stations.
double distance(const CstAirfoil& a, const CstAirfoil& b) {
  constexpr int stations = 200;
  double sum = 0.0;
  for (int i = 1; i < stations; ++i) {
    const double t = static_cast<double>(i) / stations;
    const double gap = a.at(t).y - b.at(t).y;
    sum += gap * gap;
  }
  return std::sqrt(sum / (stations - 1));
}

// Of a flow without losses (gamma = 1.4) where the pressure coefficient is `cp`; at most `largest`.
double local_mach(double cp, double mach) {
  constexpr double largest = 10.0;
  const double pressure = std::max(0.0, 1.0 + 0.7 * mach * mach * cp);  // over the stream's
  const double factor = (1.0 + 0.2 * mach * mach) / std::pow(pressure, 2.0 / 7.0);
  return std::min(largest, std::sqrt(std::max(0.0, 5.0 * (factor - 1.0))));
}

// Fails where no design of a thousand can be meshed.
CstAirfoil next_feasible(Search& search) {
  for (int tries = 0; tries < 1000; ++tries) {
    std::vector<double> sample = search.cmaes.ask();
    sample.insert(sample.end(), {search.target.te_upper, search.target.te_lower});
    CstAirfoil airfoil = airfoil_of(sample.data(), static_cast<std::uint32_t>(sample.size()));
    if (surfaces_apart(airfoil)) return airfoil;
  }
  throw Error(ErrorCode::geometry, "search", "a thousand designs in a row cross themselves");
}

}  // namespace

extern "C" {

LIVE double* live_scratch(std::uint32_t bytes) {
  session.scratch.resize(bytes / sizeof(double) + 1);
  return session.scratch.data();
}
LIVE const char* live_error() {
  return session.error.c_str();
}

// ---- Designs ----

LIVE const char* live_catalogue() {
  auto list = nlohmann::ordered_json::array();
  for (const CatalogueEntry& entry : airfoil_catalogue())
    list.push_back({{"name", entry.name}, {"description", entry.description}});
  session.text = list.dump();
  return session.text.c_str();
}

LIVE std::uint32_t live_named(const char* name, std::uint32_t degree) {
  std::uint32_t count = 0;
  attempt([&] { count = give(named_airfoil(name, static_cast<int>(degree))); });
  return count;
}

LIVE std::uint32_t live_read(const char* text, const char* file, std::uint32_t degree) {
  std::uint32_t count = 0;
  attempt([&] {
    const std::string content = text, name = file;
    count = give(name.ends_with(".json")
                     ? airfoil_from_json(content, name)
                     : fit_cst_apart(parse_airfoil(content, name), static_cast<int>(degree)).airfoil);
  });
  return count;
}

LIVE double* live_design() {
  return session.design.data();
}

LIVE double* live_outline(const double* design, std::uint32_t count, std::uint32_t samples) {
  const std::uint32_t done = attempt([&] {
    if (samples < 2) throw Error(ErrorCode::argument, "samples", "expected at least 2");
    const CstAirfoil airfoil = airfoil_of(design, count);
    session.outline.clear();
    for (std::uint32_t i = 0; i < samples; ++i) {
      const Point point = airfoil.at(static_cast<double>(i) / (samples - 1));
      session.outline.insert(session.outline.end(), {point.x, point.y});
    }
  });
  return done == 1 ? session.outline.data() : nullptr;
}

// ---- The mesh ----

LIVE std::uint32_t live_generate(const double* design, std::uint32_t count, std::uint32_t points,
                                 double gradation, double reynolds) {
  return attempt([&] {
    const PageMeshOptions options{
        .points = static_cast<int>(points), .gradation = gradation, .reynolds = reynolds};
    take(PageMesh(airfoil_of(design, count), options));
  });
}

LIVE std::uint32_t live_update(const double* design, std::uint32_t count) {
  return attempt([&] {
    const FrozenMesh before = session.frozen;
    const RemodelResult result = session.mesh.step(airfoil_of(design, count));
    auto& figures = session.figures;
    figures[live_full_adjustment] = result.full_adjustment;
    figures[live_regenerated] = result.regenerated || result.refreshed;
    figures[live_vertices_moved] = static_cast<double>(result.moved);
    figures[live_vertices_inserted] = static_cast<double>(result.inserted);
    figures[live_vertices_removed] = static_cast<double>(result.removed);
    show(figures[live_regenerated] != 0.0 ? nullptr : &before);
  });
}

LIVE std::uint32_t live_regenerate() {
  return attempt([&] { take(PageMesh(session.mesh.airfoil(), session.mesh.options())); });
}

LIVE std::uint32_t live_fresh() {
  return attempt([&] {
    const PageMesh fresh(session.mesh.airfoil(), session.mesh.options());
    session.figures[live_fresh_cells] = static_cast<double>(fresh.cells());
  });
}

LIVE std::uint32_t live_outlook(const double* design, std::uint32_t count) {
  return attempt([&] {
    const FrozenMesh then = session.mesh.tried(airfoil_of(design, count));
    session.going.clear();
    for (const Fate fate : fates(then, session.frozen)) session.going.push_back(fate == Fate::made);
  });
}
LIVE const std::uint8_t* live_going() {
  return session.going.data();
}

LIVE double* live_figures() {
  return session.figures.data();
}
LIVE const double* live_points() {
  return &session.frozen.points.data()->x;
}
LIVE const std::uint32_t* live_triangles() {
  return session.frozen.triangles.data()->data();
}
LIVE const std::uint32_t* live_quads() {
  return session.frozen.quads.empty() ? nullptr : session.frozen.quads.front().data();
}
LIVE const std::uint8_t* live_fates() {
  return reinterpret_cast<const std::uint8_t*>(session.frozen.fate.data());
}
LIVE const std::uint32_t* live_births() {
  return session.births.data();
}
LIVE double* live_angles() {
  return session.angles.data();
}
LIVE double* live_sizes() {
  return session.sizes.data();
}
LIVE std::uint32_t* live_wall() {
  return session.wall.data();
}
LIVE std::uint32_t live_wall_count() {
  return static_cast<std::uint32_t>(session.wall.size());
}
LIVE const std::uint32_t* live_keys() {
  name_vertices();
  return session.keys.data();
}
LIVE const std::uint32_t* live_edges() {
  find_edges();
  return session.edges.data();
}
LIVE std::uint32_t live_airfoil_edges() {
  return live_wall_count();
}
LIVE std::uint32_t live_farfield_edges() {
  return static_cast<std::uint32_t>(session.edges.size() / 2) - live_wall_count();
}

LIVE const char* live_check() {
  session.text.clear();
  const std::uint32_t done = attempt([&] {
    const PageMesh& mesh = session.mesh;
    const Domain domain = mesh.domain_of(mesh.airfoil());
    const CheckResult result = check(session.frozen, {.min_angle_deg = mesh.least_angle_deg(),
                                                      .max_gradation = mesh.outer().promised_gradation(),
                                                      .design = &domain});
    if (!result.valid) session.text = result.violations.front().detail;
  });
  if (done == 0) session.text = session.error;
  return session.text.c_str();
}

LIVE const char* live_hash() {
  Checksum sum;
  for (const Point& point : session.frozen.points) {
    sum.add(point.x);
    sum.add(point.y);
  }
  for (const auto& triangle : session.frozen.triangles)
    for (const std::uint32_t v : triangle) sum.add(std::uint64_t{v});
  for (const auto& quad : session.frozen.quads)
    for (const std::uint32_t v : quad) sum.add(std::uint64_t{v});
  session.text = sum.text();
  return session.text.c_str();
}

// ---- The flow ----

LIVE std::uint32_t live_flow(double alpha_deg, double mach) {
  return attempt([&] {
    if (!session.solver) session.solver.emplace(session.frozen);
    session.flow = session.solver->at(alpha_deg, mach);
    session.cp.clear();
    session.wall_cp.clear();
    for (const Point& velocity : session.flow.velocity) {
      const double squared = dot(velocity, velocity);
      session.cp.push_back(compressible_cp(1.0 - squared, mach));
    }
    for (const BodyFlow& body : session.flow.bodies) {
      for (const WallValue& value : body.wall) {
        session.cp[value.vertex] = value.cp;
        session.wall_cp.insert(session.wall_cp.end(), {value.point.x, value.cp});
      }
    }
    session.mach.clear();
    for (const double value : session.cp) session.mach.push_back(local_mach(value, mach));
  });
}
LIVE double* live_cp() {
  return session.cp.data();
}
LIVE double* live_mach() {
  return session.mach.data();
}
LIVE double* live_wall_cp() {
  return session.wall_cp.data();
}
LIVE std::uint32_t live_wall_cp_count() {
  return static_cast<std::uint32_t>(session.wall_cp.size() / 2);
}
LIVE double live_lift() {
  return session.flow.lift_by_pressure;
}
LIVE double live_sonic_cp() {
  return sonic_cp(session.flow.mach);
}

// ---- The search: CMA-ES from one design to another of the same degree ----

LIVE std::uint32_t live_search_start(const double* from, std::uint32_t count, const double* target,
                                     std::uint32_t target_count, double sigma, std::uint32_t seed) {
  return attempt([&] {
    const CstAirfoil start = airfoil_of(from, count), goal = airfoil_of(target, target_count);
    if (count != target_count)
      throw Error(ErrorCode::argument, "search", "found two degrees, expected designs of one");
    CmaesOptions options;
    options.sigma = sigma;
    options.seed = seed;
    options.least_deviation = 1e-6;
    std::vector<double> mean = start.upper;
    mean.insert(mean.end(), start.lower.begin(), start.lower.end());
    session.search.emplace(Search{goal, Cmaes(std::move(mean), options)});
  });
}

LIVE std::uint32_t live_search_next() {
  std::uint32_t count = 0;
  attempt([&] {
    if (!session.search) throw Error(ErrorCode::argument, "search", "none was started");
    if (session.search->cmaes.largest_deviation() > 1e-5) count = give(next_feasible(*session.search));
  });
  return count;
}

LIVE double live_search_objective() {
  double objective = HUGE_VAL;
  attempt([&] {
    const CstAirfoil design =
        airfoil_of(session.design.data(), static_cast<std::uint32_t>(session.design.size()));
    objective = distance(design, session.search.value().target);
  });
  return objective;
}

LIVE void live_search_tell(double objective) {
  attempt([&] {
    const std::span<const double> sample(session.design.data(), session.design.size() - 2);
    session.search.value().cmaes.tell(sample, objective);
  });
}
}
