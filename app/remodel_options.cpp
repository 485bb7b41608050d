#include "remodel_options.h"

#include <array>

#include "arguments.h"
#include "remodel/error.h"

namespace remodel::app {

void add_remodel_options(CLI::App& app, RemodelOptions& options) {
  add_real(app,
           {"--distance", "D", "1",
            "Ratio of the removal radius to the distance between old and new vertex: at least 0, no unit"},
           {.low = 0.0}, options.distance);
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
           {.low = 1.0, .high = 10.0}, options.keep);
  add_real(app,
           {"--delaunay-slack", "DEGREES", "20",
            "reference: the angles opposite an edge may sum up to 180 degrees and this: 0 to 60"},
           {.low = 0.0, .high = 60.0}, options.delaunay_slack_deg);
}

void require_used(const std::function<bool(const std::string&)>& given, Strategy strategy, bool imported,
                  const std::string& mesh) {
  if (given("--delaunay-slack") && strategy != Strategy::reference)
    throw Error(ErrorCode::argument, "--delaunay-slack",
                std::string("given with the strategy ") + name_of(strategy) + ", expected reference");
  if (!given("--keep")) return;
  if (strategy == Strategy::chain)
    throw Error(
        ErrorCode::argument, "--keep",
        "given with the strategy chain, which keeps no triangle beyond --max-gradation, expected renew, "
        "morph or reference");
  if (imported)
    throw Error(
        ErrorCode::argument, "--keep",
        "given for '" + mesh + "', a mesh of another program's, expected one that `remodel mesh` made");
}

void add_step_strategy(CLI::App& app, RemodelOptions& options) {
  add_strategy_choice(app, name_of(default_strategy), strategies(),
                      [&options](Strategy strategy) { options.strategy = strategy; });
}

}  // namespace remodel::app
