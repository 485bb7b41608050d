// Length scales, and whole steps of remodelling: around RAE 2822, with I points and G = I / 50 as in compare.

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include <benchmark/benchmark.h>

#include "mesh/mesh_data.h"
#include "remodel/airfoil.h"
#include "remodel/generate.h"
#include "remodel/remodel.h"
#include "seeded.h"
#include "step/renew.h"

namespace remodel::bench {

namespace {

CstAirfoil rae2822() {
  const auto& catalogue = airfoil_catalogue();
  return std::find_if(catalogue.begin(), catalogue.end(),
                      [](const CatalogueEntry& entry) { return entry.name == "rae2822"; })
      ->airfoil();
}

// Made once for each I.
const Mesh& fresh_mesh(int points) {
  static std::map<int, Mesh> made;
  const auto [place, is_new] = made.try_emplace(points);
  if (is_new)
    place->second =
        generate(airfoil_domain(rae2822(), {.points = points}), {.gradation = 0.02 * points}).mesh;
  return place->second;
}

// Designs whose coefficients are within the relative `spread` of those of RAE 2822, alternately thicker and
// thinner by the same amount.
std::vector<Domain> designs(int points, double thicker, double spread) {
  Seeded random(5);
  std::vector<Domain> result;
  while (result.size() < 16) {
    const double thickness = result.size() % 2 == 0 ? 1.0 + thicker : 1.0 - thicker;
    CstAirfoil airfoil = rae2822();
    for (std::vector<double>* surface : {&airfoil.upper, &airfoil.lower})
      for (double& c : *surface) c *= thickness + random.number(-spread, spread);
    if (surfaces_apart(airfoil)) result.push_back(airfoil_domain(airfoil, {.points = points}));
  }
  return result;
}

// Designs close enough to adjust everything in place.
std::vector<Domain> near_designs(int points) {
  return designs(points, 0.0, 1e-6);
}

// Designs so far apart that every step has to replace vertices.
std::vector<Domain> far_designs(int points) {
  return designs(points, 0.07, 0.02);
}

std::size_t boundary_vertices(const MeshData& mesh) {
  std::size_t count = 0;
  for (const std::uint32_t head : mesh.loop_heads) mesh.walk(head, [&](std::uint32_t) { ++count; });
  return count;
}

// ---- length scales

// One iteration propagates length scales from the boundary through a whole mesh. An item is a vertex.
void propagate_fresh(benchmark::State& state) {
  const Mesh& mesh = fresh_mesh(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(propagated_length_scales(mesh.data()));
  state.SetItemsProcessed(state.iterations() *
                          static_cast<std::int64_t>(mesh.data().triangulation.vertex_count()));
}
BENCHMARK(propagate_fresh)->Arg(200)->Arg(700)->Unit(benchmark::kMicrosecond);

// The airfoil: the loop with the hole's role.
std::size_t airfoil_loop(const MeshData& mesh) {
  const auto& loops = mesh.domain.loops;
  return static_cast<std::size_t>(
      std::find_if(loops.begin(), loops.end(), [](const Loop& loop) { return loop.role == LoopRole::hole; }) -
      loops.begin());
}

// Reduces the length scales of a tenth of the loop's vertices by a fifth.
void lower_some(MeshData& mesh, std::size_t loop) {
  std::vector<std::uint32_t> entries;
  mesh.walk(mesh.loop_heads[loop], [&](std::uint32_t k) { entries.push_back(k); });
  for (std::size_t i = entries.size() / 5; i < entries.size() * 3 / 10; ++i)
    mesh.set_boundary_length_scale(entries[i], 0.8 * mesh.length_scale(entries[i]));
}

// One iteration renews length scales after those of a tenth of the airfoil's vertices have changed. An item
// is a vertex of the airfoil: renewal looks for changes around all of them.
void renew_local(benchmark::State& state) {
  Mesh mesh = fresh_mesh(static_cast<int>(state.range(0)));
  MeshData& data = mesh.data();
  const std::uint32_t loops[] = {static_cast<std::uint32_t>(airfoil_loop(data))};
  std::size_t around = 0, changes = 0;
  data.walk(data.loop_heads[loops[0]], [&](std::uint32_t) { ++around; });
  for (auto _ : state) {
    state.PauseTiming();
    data.triangulation.begin();
    data.boundary.begin();
    lower_some(data, loops[0]);
    const std::size_t before = data.triangulation.earlier_vertices().size();
    const Arena::Scope scope(data.arena);
    state.ResumeTiming();
    benchmark::DoNotOptimize(renew_length_scales(data, loops, {}));
    state.PauseTiming();
    changes = data.triangulation.earlier_vertices().size() - before;
    data.triangulation.rollback();
    data.boundary.rollback();
    state.ResumeTiming();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(around));
  state.counters["changes"] = static_cast<double>(changes);
}
BENCHMARK(renew_local)->Arg(200)->Arg(700)->Unit(benchmark::kMicrosecond);

// ---- steps

// One iteration is a step that moves all boundary vertices in place. An item is a boundary vertex.
void full_adjustment(benchmark::State& state) {
  const int points = static_cast<int>(state.range(0));
  Mesh mesh = fresh_mesh(points);
  const std::vector<Domain> around = near_designs(points);
  remodel(mesh, around.back(),
          {.strategy = Strategy::chain});  // adjustment lists are built in the first step
  std::size_t i = 0;
  for (auto _ : state) {
    if (!remodel(mesh, around[i], {.strategy = Strategy::chain}).full_adjustment)
      return state.SkipWithError("not a full adjustment");
    i = (i + 1) % around.size();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(boundary_vertices(mesh.data())));
}
BENCHMARK(full_adjustment)->Arg(200)->Arg(700)->Unit(benchmark::kMicrosecond);

// One iteration is the same 16 steps from the same fresh mesh, each from design to design, none of them a
// full adjustment: a mesh that went on would grow with the number of iterations. An item is a step. The
// counter is the mean number of vertices inserted and removed per step.
void partial_steps(benchmark::State& state, Strategy strategy) {
  const int points = static_cast<int>(state.range(0));
  const std::vector<Domain> path = far_designs(points);
  std::size_t steps = 0, changed = 0;
  for (auto _ : state) {
    state.PauseTiming();
    {
      Mesh mesh = fresh_mesh(points);
      state.ResumeTiming();
      for (const Domain& design : path) {
        const RemodelResult result = remodel(mesh, design, {.strategy = strategy});
        if (result.full_adjustment || result.regenerated) return state.SkipWithError("not a partial step");
        changed += result.inserted + result.removed;
        ++steps;
      }
      state.PauseTiming();
    }
    state.ResumeTiming();
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(steps));
  state.counters["vertices"] = static_cast<double>(changed) / static_cast<double>(steps);
}

void partial_chain(benchmark::State& state) {
  partial_steps(state, Strategy::chain);
}
BENCHMARK(partial_chain)->Arg(200)->Arg(700)->Unit(benchmark::kMillisecond);

void partial_renew(benchmark::State& state) {
  partial_steps(state, Strategy::renew);
}
BENCHMARK(partial_renew)->Arg(200)->Arg(700)->Unit(benchmark::kMillisecond);

// One iteration tries a design that takes a partial step and returns to the mesh from before. An item is a
// trial.
void trial(benchmark::State& state) {
  const int points = static_cast<int>(state.range(0));
  Mesh mesh = fresh_mesh(points);
  const std::vector<Domain> tried = far_designs(points);
  std::size_t i = 0;
  for (auto _ : state) {
    const Trial attempt(mesh, tried[i], {.strategy = Strategy::chain});
    benchmark::DoNotOptimize(attempt.result().triangles);
    i = (i + 1) % tried.size();
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(trial)->Arg(200)->Arg(700)->Unit(benchmark::kMicrosecond);

// One iteration is the return from such a trial alone. An item is a trial.
void trial_return(benchmark::State& state) {
  const int points = static_cast<int>(state.range(0));
  Mesh mesh = fresh_mesh(points);
  const std::vector<Domain> tried = far_designs(points);
  std::size_t i = 0;
  for (auto _ : state) {
    state.PauseTiming();
    std::optional<Trial> attempt;
    attempt.emplace(mesh, tried[i]);
    if (attempt->result().full_adjustment) return state.SkipWithError("not a partial step");
    state.ResumeTiming();
    attempt.reset();
    i = (i + 1) % tried.size();
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(trial_return)->Arg(200)->Arg(700)->Unit(benchmark::kMicrosecond);

}  // namespace

}  // namespace remodel::bench
