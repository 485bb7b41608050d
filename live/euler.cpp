// Euler's flow on the page of `remodel live`: a solver that outlives its meshes, which come as arrays.

#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>
#include <new>
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
struct Teller : StepObserver {
  int steps = 0;
  bool cancelled() override {
    ++steps;
#ifdef __EMSCRIPTEN__
    EM_ASM(
        {
          if (Module.onFlowStep) Module.onFlowStep($0);
        },
        steps);
#endif
    return false;
  }
};

struct EulerSession {
  Teller teller;
  FrozenMesh mesh;
  LivingFlow flow = LivingFlow(
      {.tolerance = tolerance, .max_steps = longest_search, .memory_mb = memory_mb, .observer = &teller});
  std::string reason;
  std::vector<double> cp, mach, wall_cp;
  std::vector<double> figures = std::vector<double>(live_euler_figure_count, 0.0);
};

EulerSession& session() {
  static EulerSession only;
  return only;
}

// The boundary's pressures, in the order of its edges.
void find_wall_cp() {
  EulerSession& now = session();
  now.wall_cp.clear();
  for (const auto& edge : now.mesh.boundaries[0].edges)
    now.wall_cp.insert(now.wall_cp.end(), {now.mesh.points[edge[0]].x, now.cp[edge[0]]});
}

void show(const FlowResult& flow) {
  EulerSession& now = session();
  auto& figures = now.figures;
  now.reason = flow.reason;
  now.cp = pressure_coefficients(flow);
  now.mach = mach_numbers(flow);
  find_wall_cp();
  figures[live_euler_converged] = flow.converged() ? 1.0 : 0.0;
  figures[live_euler_start] = static_cast<double>(flow.start);
  figures[live_euler_cl] = flow.cl;
  figures[live_euler_cd] = flow.cd;
  figures[live_euler_cm] = flow.cm;
  figures[live_euler_sonic_cp] = sonic_cp(flow.mach);
  figures[live_euler_highest_mach] = *std::max_element(now.mach.begin(), now.mach.end());
  figures[live_euler_newton_steps] = flow.newton_steps;
  figures[live_euler_factorisations] = flow.factorisations;
  figures[live_euler_krylov_iterations] = flow.krylov_iterations;
  figures[live_euler_corrected_vertices] = static_cast<double>(flow.corrected_vertices);
  figures[live_euler_vertices] = static_cast<double>(now.mesh.points.size());
  figures[live_euler_memory_mb] = flow.memory_mb;
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

LIVE std::uint32_t live_euler_mesh(const double* points, const std::uint32_t* numbers, std::uint32_t vertices,
                                   std::uint32_t triangles, std::uint32_t airfoil_edges,
                                   std::uint32_t farfield_edges) {
  return attempt([&] {
    FrozenMesh mesh;
    for (std::uint32_t v = 0; v < vertices; ++v) mesh.points.push_back({points[2 * v], points[2 * v + 1]});
    const std::uint32_t* at = numbers;
    for (std::uint32_t t = 0; t < triangles; ++t, at += 3) mesh.triangles.push_back({at[0], at[1], at[2]});
    for (std::uint32_t v = 0; v < vertices; ++v, at += 2)
      mesh.vertex_keys.push_back(at[0] | std::uint64_t{at[1]} << 32);
    mesh.boundaries = {{"airfoil", {}}, {"farfield", {}}};
    for (std::uint32_t e = 0; e < airfoil_edges + farfield_edges; ++e, at += 2)
      mesh.boundaries[e < airfoil_edges ? 0 : 1].edges.push_back({at[0], at[1]});
    session().mesh = std::move(mesh);
  });
}

LIVE std::uint32_t live_euler(double alpha_deg, double mach) {
  return attempt([&] {
    EulerSession& now = session();
    now.teller.steps = 0;
    show(now.flow.solve(now.mesh, {.mach = mach, .alpha_deg = alpha_deg}));
  });
}

LIVE double* live_euler_figures() {
  return session().figures.data();
}
LIVE const char* live_euler_reason() {
  return session().reason.c_str();
}
LIVE double* live_euler_cp() {
  return session().cp.data();
}
LIVE double* live_euler_mach() {
  return session().mach.data();
}
LIVE double* live_euler_wall_cp() {
  return session().wall_cp.data();
}
LIVE std::uint32_t live_euler_wall_cp_count() {
  return static_cast<std::uint32_t>(session().wall_cp.size() / 2);
}
}
