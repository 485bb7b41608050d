// Prints data that must be the same bytes with every compiler, at every optimisation level and on any number
// of threads: a generated mesh, and sequences of remodellings by both methods.
//
//   trace          prints the states: one hash per step, the first and the last mesh in full
//   trace threads  runs chains on several threads at once and one after the other: exit status 1 if they
//   differ

#include <bit>
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <functional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "remodel/airfoil.h"
#include "remodel/domain.h"
#include "remodel/error.h"
#include "remodel/generate.h"
#include "remodel/layers.h"
#include "remodel/mesh_state.h"
#include "remodel/planar.h"
#include "remodel/remodel.h"

namespace {

using namespace remodel;

// Knuth's MMIX generator: multiples of 2^-24 in [-1, 1).
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : state_(seed) {}
  double operator()() {
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    return static_cast<double>(state_ >> 39) * 0x1p-24 - 1.0;
  }

 private:
  std::uint64_t state_;
};

// Every array of the state under its name, doubles as their bits.
void visit(const MeshState& state,
           const std::function<void(const char*, const std::vector<std::uint64_t>&)>& each) {
  const auto show = [&](const char* name, const auto& values) {
    std::vector<std::uint64_t> words;
    for (const auto value : values) {
      if constexpr (sizeof value == 8) {
        words.push_back(std::bit_cast<std::uint64_t>(value));
      } else {
        words.push_back(std::bit_cast<std::uint32_t>(value));
      }
    }
    each(name, words);
  };
  show("coordinates", state.coordinates);
  show("length_scales", state.length_scales);
  show("vertex_stars", state.vertex_stars);
  show("vertex_generations", state.vertex_generations);
  show("vertex_curves", state.vertex_curves);
  show("vertex_parameters", state.vertex_parameters);
  show("vertex_scale_factors", state.vertex_scale_factors);
  show("triangle_vertices", state.triangle_vertices);
  show("triangle_links", state.triangle_links);
  show("triangle_regions", state.triangle_regions);
  show("triangle_births", state.triangle_births);
  show("free_vertices", state.free_vertices);
  show("free_triangles", state.free_triangles);
}

std::uint64_t hash_of(const MeshState& state) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  visit(state, [&](const char*, const std::vector<std::uint64_t>& words) {
    for (const std::uint64_t word : words) hash = (hash ^ word) * 0x100000001b3U;
    hash = (hash ^ words.size()) * 0x100000001b3U;
  });
  return hash;
}

void print_in_full(const MeshState& state) {
  visit(state, [](const char* name, const std::vector<std::uint64_t>& words) {
    std::printf("%s %zu\n", name, words.size());
    for (const std::uint64_t word : words) std::printf("%" PRIx64 "\n", word);
  });
}

struct Chain {
  std::uint64_t seed;
  int points;
  int steps;
  Method method;
  Strategy strategy = Strategy::chain;
  double turning_share = 0.0;
};

CstAirfoil design_about(const CstAirfoil& centre, Chance& chance, double size) {
  CstAirfoil design = centre;
  for (auto* surface : {&design.upper, &design.lower})
    for (double& coefficient : *surface) coefficient += size * chance();
  return design;
}

// A walk from one airfoil of the catalogue to the next, with small and large steps and returns. Calls each
// for the first mesh and after every step.
Mesh run(const Chain& chain, const std::function<void(const Mesh&)>& each) {
  const std::vector<CatalogueEntry>& airfoils = airfoil_catalogue();
  const AirfoilDomainOptions options{.points = chain.points, .turning_share = chain.turning_share};
  Chance chance(chain.seed);
  CstAirfoil centre = airfoils[chain.seed % airfoils.size()].airfoil();
  Mesh mesh = generate(airfoil_domain(centre, options), {.gradation = chain.points / 50.0}).mesh;
  each(mesh);
  for (int i = 1; i <= chain.steps; ++i) {
    if (i % 40 == 0) centre = airfoils[(chain.seed + static_cast<unsigned>(i)) % airfoils.size()].airfoil();
    const CstAirfoil design = design_about(centre, chance, i % 3 == 0 ? 0.05 : 0.005);
    if (surfaces_apart(design))
      remodel::remodel(mesh, airfoil_domain(design, options),
                       {.method = chain.method, .strategy = chain.strategy});
    each(mesh);
  }
  return mesh;
}

int print_chains() {
  for (const Chain& chain : {Chain{1, 100, 200, Method::automatic}, Chain{5, 60, 60, Method::general},
                             Chain{3, 80, 120, Method::automatic, Strategy::renew},
                             Chain{4, 50, 60, Method::general, Strategy::renew},
                             Chain{2, 60, 40, Method::automatic, Strategy::chain, 0.3}}) {
    bool first = true;
    const Mesh last = run(chain, [&](const Mesh& mesh) {
      const MeshState state = mesh.state();
      if (first) print_in_full(state);
      first = false;
      std::printf("step %u: %zu triangles, %016" PRIx64 "\n", mesh.step(), mesh.triangle_count(),
                  hash_of(state));
    });
    print_in_full(last.state());
  }
  return 0;
}

// Domains without an airfoil: a graph of segments that cross, and a spline that turns, each into the other.
int print_domains() {
  Chance chance(3);
  PlanarGraph graph{.points = {{-2, -2}, {2, -2}, {2, 2}, {-2, 2}},
                    .segments = {{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
  for (std::uint32_t i = 0; i < 20; ++i) {
    for (int end = 0; end < 2; ++end) graph.points.push_back({1.9 * chance(), 1.9 * chance()});
    graph.segments.push_back({4 + 2 * i, 5 + 2 * i});
  }
  const Domain crossed = planar_domain(graph, "graph");
  const Spline blob = spline_through({{0.6, 0}, {0.1, 0.5}, {-0.5, 0.3}, {-0.2, -0.4}, {0.6, 0}});
  std::vector<double> parameters;
  for (int i = 0; i < 30; ++i) parameters.push_back(i / 30.0);
  Mesh mesh = generate(crossed).mesh;
  for (int i = 0; i < 12; ++i) {
    Domain turned = crossed;
    std::erase_if(turned.loops, [](const Loop& loop) { return loop.role == LoopRole::internal; });
    turned.loops.push_back({.role = LoopRole::right,
                            .curves = {{.name = "blob", .shape = blob, .parameters = parameters}},
                            .placement = {1.0 + 0.05 * i, 7.0 * i, {0.03 * i, 0.1}}});
    for (const Domain* domain : {&std::as_const(turned), &crossed}) {
      if (i % 3 != 0 && domain == &crossed) continue;
      remodel::remodel(mesh, *domain, {.strategy = remodel::Strategy::chain});
      std::printf("domain %d: %zu triangles, %016" PRIx64 "\n", i, mesh.triangle_count(),
                  hash_of(mesh.state()));
    }
  }
  print_in_full(mesh.state());
  return 0;
}

// Layers on an airfoil with a blunt edge and on a flap below it, which move: all points and the outer mesh.
int print_layers() {
  Chance chance(11);
  CstAirfoil main = airfoil_catalogue()[5].airfoil(), flap = airfoil_catalogue()[0].airfoil();
  main.te_upper = 0.002, main.te_lower = -0.002;
  Domain domain = airfoils_domain(
      {{.name = "main", .airfoil = main},
       {.name = "flap", .airfoil = flap, .placement = {.chord = 0.3, .position = {0.97, -0.05}}}});
  space_walls(domain, {});
  LayeredMesh mesh = generate_layered(domain, {.first_height = first_height(1.0, 6.5e6)}, {.gradation = 8.0}).mesh;
  for (int i = 0; i <= 8; ++i) {
    if (i > 0) {
      Domain next = mesh.domain();
      std::get<CstAirfoil>(next.loops[0].curves[0].shape) = design_about(main, chance, 0.005);
      next.loops[1].placement.rotation_deg = -2.0 * i;
      remodel::remodel(mesh, next, {.strategy = i < 5 ? Strategy::morph : Strategy::reference});
    }
    std::uint64_t hash = hash_of(mesh.outer().state());
    for (const Point p : mesh.freeze().points)
      for (const double x : {p.x, p.y}) hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x100000001b3U;
    std::printf("layers %d: %zu cells, %016" PRIx64 "\n", i, mesh.cells(), hash);
  }
  return 0;
}

int compare_threads() {
  const std::vector<Chain> chains = {{1, 60, 60, Method::automatic},
                                     {2, 60, 60, Method::general},
                                     {1, 60, 60, Method::automatic},
                                     {7, 100, 40, Method::automatic, Strategy::renew}};
  const auto hashes_of = [](const Chain& chain) {
    std::vector<std::uint64_t> hashes;
    run(chain, [&](const Mesh& mesh) { hashes.push_back(hash_of(mesh.state())); });
    return hashes;
  };
  std::vector<std::vector<std::uint64_t>> together(chains.size()), alone;
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < chains.size(); ++i)
      threads.emplace_back([&, i] { together[i] = hashes_of(chains[i]); });
  }
  for (const Chain& chain : chains) alone.push_back(hashes_of(chain));
  const bool same = together == alone && alone[0] == alone[2];
  std::printf("%zu chains at once: %s\n", chains.size(),
              same ? "the same bytes as one after the other" : "OTHER BYTES");
  return same ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) try {
  return argc > 1 && std::strcmp(argv[1], "threads") == 0 ? compare_threads()
                                                          : print_chains() + print_domains() + print_layers();
} catch (const remodel::Error& error) {
  std::fprintf(stderr, "trace: %s\n", error.what());
  return 2;
}
