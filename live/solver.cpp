// Compressible flow on the page of `remodel live`, with friction or without: a solver that outlives its
// meshes, which come as arrays.

#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "live/core.h"
#include "remodel/flow.h"
#include "remodel/frozen_mesh.h"
#include "remodel/potential_flow.h"

namespace {

using namespace remodel;

// The residual is this part of what it is for undisturbed flow: more is not seen in a picture.
constexpr double tolerance = 1e-6;
constexpr int longest_search = 150;  // Newton steps of one flow
constexpr double memory_mb = 1200;   // of the factors, of the 2 GB that there can be

// Tells the page each step, which is in a worker of its own and cannot be asked.
void tell_step(int step) {
#ifdef __EMSCRIPTEN__
  EM_ASM(
      {
        if (Module.onFlowStep) Module.onFlowStep($0);
      },
      step);
#else
  static_cast<void>(step);
#endif
}

struct SolverSession {
  int steps = 0;  // of the search under way, those on coarser meshes included
  FrozenMesh mesh;
  FlowModel model = FlowModel::euler;  // of the living flow
  std::optional<LivingFlow> flow;
  std::string reason;
  std::vector<double> cp, mach, wall_cp;
  std::vector<double> figures = std::vector<double>(live_solver_figure_count, 0.0);
};

SolverSession& session() {
  static SolverSession only;
  return only;
}

// The boundary's pressures, in the order of its edges.
void find_wall_cp() {
  SolverSession& now = session();
  now.wall_cp.clear();
  for (const auto& edge : now.mesh.boundaries[0].edges)
    now.wall_cp.insert(now.wall_cp.end(), {now.mesh.points[edge[0]].x, now.cp[edge[0]]});
}

void show(const FlowResult& flow) {
  SolverSession& now = session();
  auto& figures = now.figures;
  now.reason = flow.reason;
  now.cp = pressure_coefficients(flow);
  now.mach = mach_numbers(flow);
  find_wall_cp();
  figures[live_solver_converged] = flow.converged() ? 1.0 : 0.0;
  figures[live_solver_start] = static_cast<double>(flow.start);
  figures[live_solver_cl] = flow.cl;
  figures[live_solver_cd] = flow.cd;
  figures[live_solver_cm] = flow.cm;
  figures[live_solver_sonic_cp] = sonic_cp(flow.mach);
  figures[live_solver_highest_mach] = *std::max_element(now.mach.begin(), now.mach.end());
  figures[live_solver_newton_steps] = flow.newton_steps;
  figures[live_solver_factorisations] = flow.factorisations;
  figures[live_solver_krylov_iterations] = flow.krylov_iterations;
  figures[live_solver_corrected_vertices] = static_cast<double>(flow.corrected_vertices);
  figures[live_solver_vertices] = static_cast<double>(now.mesh.points.size());
  figures[live_solver_memory_mb] = flow.memory_mb;
  figures[live_solver_cd_pressure] = flow.friction ? flow.friction->cd_pressure : flow.cd;
  figures[live_solver_cd_friction] = flow.friction ? flow.friction->cd_friction : 0.0;
}

// The factors of one model are of no use to another, and there is room for one.
// With friction GMRES solves all systems: a sparse LU by Eigen takes as long here as several flows do
// without.
void living_flow(FlowModel model) {
  SolverSession& now = session();
  if (now.flow && now.model == model) return;
  now.flow.reset();
  now.model = model;
  now.flow.emplace(
      FlowOptions{.tolerance = tolerance,
                  .max_steps = longest_search,
                  .memory_mb = memory_mb,
                  .solver = model == FlowModel::euler ? std::optional<FlowSolver>() : FlowSolver::gmres,
                  .on_step = [](const FlowProgress&) { tell_step(++session().steps); },
                  .model = model});
}

// 1, or 0 with the sentence of what was thrown.
template <class Work>
std::uint32_t attempt(Work&& work) {
  try {
    work();
    return 1;
  } catch (const std::bad_alloc&) {
    session().reason = "the flow needs more memory than there is";
  } catch (const std::exception& error) {
    session().reason = error.what();
  }
  return 0;
}

}  // namespace

extern "C" {

LIVE std::uint32_t live_solver_mesh(const double* points, const std::uint32_t* numbers) {
  return attempt([&] {
    const std::uint32_t vertices = numbers[0], triangles = numbers[1], quads = numbers[2];
    const std::uint32_t airfoil_edges = numbers[3], edges = airfoil_edges + numbers[4];
    FrozenMesh mesh;
    for (std::uint32_t v = 0; v < vertices; ++v) mesh.points.push_back({points[2 * v], points[2 * v + 1]});
    const std::uint32_t* at = numbers + 5;
    for (std::uint32_t t = 0; t < triangles; ++t, at += 3) mesh.triangles.push_back({at[0], at[1], at[2]});
    for (std::uint32_t q = 0; q < quads; ++q, at += 4) mesh.quads.push_back({at[0], at[1], at[2], at[3]});
    mesh.boundaries = {{"airfoil", {}}, {"farfield", {}}};
    for (std::uint32_t e = 0; e < edges; ++e, at += 2)
      mesh.boundaries[e < airfoil_edges ? 0 : 1].edges.push_back({at[0], at[1]});
    for (std::uint32_t v = 0; v < vertices; ++v, at += 2)
      mesh.vertex_keys.push_back(at[0] | std::uint64_t{at[1]} << 32);
    session().mesh = std::move(mesh);
  });
}

LIVE std::uint32_t live_solve(std::uint32_t model, double alpha_deg, double mach, double reynolds) {
  return attempt([&] {
    SolverSession& now = session();
    now.steps = 0;
    const FlowModel wanted = model == live_laminar ? FlowModel::laminar : FlowModel::euler;
    living_flow(wanted);
    const double of_friction = wanted == FlowModel::euler ? 0.0 : reynolds;
    show(now.flow->solve(now.mesh, {.mach = mach, .alpha_deg = alpha_deg, .reynolds = of_friction}));
  });
}

LIVE double* live_solver_figures() {
  return session().figures.data();
}
LIVE const char* live_solver_reason() {
  return session().reason.c_str();
}
LIVE double* live_solver_cp() {
  return session().cp.data();
}
LIVE double* live_solver_mach() {
  return session().mach.data();
}
LIVE double* live_solver_wall_cp() {
  return session().wall_cp.data();
}
LIVE std::uint32_t live_solver_wall_cp_count() {
  return static_cast<std::uint32_t>(session().wall_cp.size() / 2);
}
}
