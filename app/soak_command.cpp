// remodel soak: random remodellings by the thousand, each mesh validated.

#include <memory>

#include "arguments.h"
#include "command.h"
#include "figures.h"
#include "interrupt.h"
#include "remodel/soak.h"
#include "report.h"

namespace remodel::app {
namespace {

struct SoakCommand {
  SoakOptions soak;
  bool json = false;
};

Status run(const SoakCommand& command) {
  const InterruptFlag interrupt;
  SoakOptions options = command.soak;
  options.keep_going = [&interrupt](std::size_t) { return !interrupt.raised(); };
  const SoakResult result = soak(options);
  Report report;
  report.figure("steps", "steps", result.steps);
  report.figure("invalid_meshes", "invalid meshes", result.invalid_meshes);
  report.figure("recoveries", "recoveries by generation", result.recoveries);
  report.figure("refused", "refused designs", result.refused);
  report.figure("limited", "steps ended by a limit", result.limited);
  report.figure("full_adjustments", "full adjustments", result.full_adjustments);
  report.figure("full_checks", "full checks", result.full_checks);
  report.figure("min_angle_deg", "smallest angle",
                result.full_checks > 0 ? Json(result.min_angle_deg) : Json(), "degrees");
  report.figure("slowest_step_ms", "slowest step, processor time", result.slowest_step_ms, "ms");
  report.figure("slowest_step", "its number", result.slowest_step);
  report.figure("slowest_episode", "its episode", result.slowest_episode);
  report.figure("peak_memory_mib", "peak memory", result.peak_memory_mib, "MiB");
  report.figure("seconds", "wall time", result.seconds, "seconds");
  report.figure("seed", "seed", options.seed);
  if (!result.first_failure.empty()) report.figure("first_failure", "first failure", result.first_failure);
  report.print(command.json);
  if (result.invalid_meshes > 0) return Status::answer_is_no;
  return result.steps == options.steps ? Status::done : Status::limit;
}

}  // namespace

void add_soak_command(CLI::App& program, Action& action) {
  auto command = std::make_shared<SoakCommand>();
  CLI::App& app = add_command(program, "soak",
                              "Random remodellings, each mesh validated; exit status 1 if one is invalid",
                              command, action);
  add_integer(app, {"--steps", "N", "1000", "Remodellings, refused designs included: at least 1"}, {.low = 1},
              command->soak.steps);
  add_integer(app, {"--seed", "N", "1", "Seed of the episodes: 0 or more"}, {.low = 0}, command->soak.seed);
  add_integer(app, {"--episode", "N", "1", "The first episode, of 200 steps each: 1 to 1000000"},
              {.low = 1, .high = 1000000}, command->soak.first_episode);
  add_integer(app,
              {"--full-check-every", "K", "200",
               "Every K-th mesh also goes through the independent validator; 0: never"},
              {.low = 0}, command->soak.full_check_every);
  add_flag(app, "--layers", "Airfoils and sets of them with layers on their walls", command->soak.layers);
  add_json_flag(app, command->json);
}

}  // namespace remodel::app
