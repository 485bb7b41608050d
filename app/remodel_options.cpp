#include "remodel_options.h"

#include <array>

#include "arguments.h"

namespace remodel::app {

void add_remodel_options(CLI::App& app, RemodelOptions& options) {
  add_real(app,
           {"--distance", "D", "1",
            "Ratio of the removal radius to the distance between old and new vertex: at least 0, no unit"},
           {.low = 0.0}, [&](double value) { options.distance = value; });
  static constexpr std::array methods{Method::automatic, Method::specialised, Method::general};
  std::vector<std::string> words;
  for (const Method method : methods) words.emplace_back(name_of(method));
  add_choice(app,
             {"--method", "METHOD", "auto",
              "auto, specialised (domains that correspond but for a few stations) or general (any loops)"},
             words, [&](std::size_t choice) { options.method = methods[choice]; });
  add_real(app,
           {"--keep", "FACTOR", "1.1 for G up to 1, 1.2 up to 2, otherwise 1.25",
            "renew: bound of kept triangles as a multiple of --max-gradation: 1 to 10"},
           {.low = 1.0, .high = 10.0}, [&](double value) { options.keep = value; });
  add_real(app,
           {"--delaunay-slack", "DEGREES", "20",
            "reference: the angles opposite an edge may sum up to 180 degrees and this: 0 to 60"},
           {.low = 0.0, .high = 60.0}, [&](double value) { options.delaunay_slack_deg = value; });
}

void add_step_strategy(CLI::App& app, RemodelOptions& options) {
  options.strategy = Strategy::renew;
  static constexpr std::array strategies{Strategy::chain, Strategy::renew, Strategy::morph,
                                         Strategy::reference};
  std::vector<std::string> names;
  for (const Strategy strategy : strategies) names.emplace_back(name_of(strategy));
  add_choice(
      app,
      {"--strategy", "STRATEGY", "renew",
       "renew (length scales are renewed, what is too dense is coarsened), morph (renew, but the interior "
       "moves along with the boundary where it can), reference (every design's mesh is the morph of one "
       "reference, as long as connectivity can be held) or chain (the paper's method to the letter, and all "
       "that "
       "imported meshes have)"},
      names, [&](std::size_t choice) { options.strategy = strategies[choice]; });
}

}  // namespace remodel::app
