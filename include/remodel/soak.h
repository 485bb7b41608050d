#pragma once

// The endurance test of a living mesh: thousands of random remodellings, each mesh validated. What it proves
// is the promise of remodel(): a step commits a valid mesh, or leaves the old one untouched and says why.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace remodel {

struct SoakOptions {
  std::size_t steps = 1000;            // remodellings asked for, refused designs included; at least 1
  std::uint64_t seed = 1;              // the same seed, the same episodes
  std::size_t first_episode = 1;       // to see one again; from 1
  std::size_t full_check_every = 200;  // every K-th mesh also goes through check()
  bool layers = false;                 // episodes of meshes with layers on their walls (remodel/layers.h)
  std::function<bool(std::size_t)> keep_going =
      {};  // asked before every step, with the steps done; empty: always
};

struct SoakResult {
  std::size_t steps = 0;  // done
  std::size_t invalid_meshes =
      0;                       // that a validation refused, or that changed although the design was refused
  std::size_t recoveries = 0;  // steps that ended in a fresh mesh
  std::size_t refused = 0;     // designs that are no domains, as surfaces cross: with the mesh untouched
  std::size_t limited = 0;     // steps that a limit of the options ended
  std::size_t full_adjustments = 0;
  std::size_t full_checks = 0;
  double min_angle_deg = 90.0;   // smallest of all meshes that went through check()
  double slowest_step_ms = 0.0;  // processor time
  std::size_t slowest_step = 0;  // its number, from 1; steps before the first episode count
  std::size_t slowest_episode = 0;
  double peak_memory_mib = 0.0;  // of the process
  double seconds = 0.0;
  std::string first_failure;  // the first broken rule, with the seed and the episode that reproduce it
};

// Episodes of up to 200 steps on one mesh. An episode draws a kind of domain (an airfoil of the catalogue,
// slat, main airfoil and flap, a duct, a lake with an island, a wall and lone points, a mesh of another
// program; some at the coordinates of a map), I from 8 to 400, G, D of the paper's four, method and strategy.
// Its steps are random walks, jumps to other shapes, and designs that cross themselves. Episodes know nothing
// of each other: `first_episode` begins with a later one. Episodes with layers are of airfoils and of sets of
// slat, main airfoil and flap, with first heights from 3e-7 to 3e-4 chords. Throws Error (argument) for
// episode 0.
SoakResult soak(const SoakOptions& options);

}  // namespace remodel
