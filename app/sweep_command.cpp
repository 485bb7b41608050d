// remodel sweep SWEEP.json -o DIR: the flows around many sections at many conditions, as a table.

#include <array>
#include <cstdio>
#include <memory>

#include "arguments.h"
#include "command.h"
#include "figures.h"
#include "interrupt.h"
#include "outputs.h"
#include "page_command.h"
#include "progress.h"
#include "ranks.h"
#include "remodel/error.h"
#include "remodel/sweep.h"
#include "warnings.h"

namespace remodel::app {
namespace {

struct SweepCommand {
  std::string problem;
  std::filesystem::path directory;
  std::size_t threads = 0;  // 0: not given
  double time_limit = 0.0;
  RanksOptions ranks;
  bool resume = false, quiet = false, json = false;
};

class SweepProgressLine final : public SweepObserver {
 public:
  // time_limit: seconds; 0: none
  SweepProgressLine(ProgressStyle style, double time_limit) : line_(style), time_limit_(time_limit) {}
  bool cancelled() override {
    return interrupt_.raised() || (time_limit_ > 0.0 && line_.seconds() > time_limit_);
  }

  void finished(const SweepProgress& progress) override {
    if (line_.style() == ProgressStyle::none || !line_.is_due(progress.chains_done == progress.chains))
      return;
    const double seconds = line_.seconds();
    const auto here = static_cast<double>(progress.flows_done - progress.flows_before);
    const auto left = static_cast<double>(progress.flows - progress.flows_done);
    std::array<char, 200> text{};
    std::snprintf(text.data(), text.size(),
                  "%zu/%zu flows, %zu found  %.3g flows a minute  about %.0f s left", progress.flows_done,
                  progress.flows, progress.found, 60.0 * here / seconds, left * seconds / here);
    begun_ |= line_.show(static_cast<double>(progress.flows_done) / static_cast<double>(progress.flows),
                         text.data());
  }
  void end_line() const {
    if (begun_) line_.end();
  }

 private:
  StatusLine line_;
  double time_limit_;
  InterruptFlag interrupt_;
  bool begun_ = false;  // a bar is drawn
};

void require_possible(const SweepCommand& command) {
  if (command.problem.empty() || command.directory.empty())
    throw Error(ErrorCode::argument, command.problem.empty() ? "SWEEP" : "--output",
                "is missing, expected a sweep's file and -o, its directory");
  std::error_code ignored;
  if (!command.resume || std::filesystem::is_directory(command.directory, ignored))
    require_place_of_run(command.directory);
}

void add_refused(Report& report, const SweepProblem& problem) {
  Json refused = Json::array();
  for (const SweepSection& section : problem.sections)
    if (!section.problem.empty()) refused.push_back({{"section", section.name}, {"reason", section.problem}});
  if (!refused.empty()) report.line("sections that are none", std::to_string(refused.size()));
  report.data("refused", std::move(refused));
}

void add_result(Report& report, const SweepResult& result) {
  report.figure("sections", "sections", result.sections);
  report.figure("chains", "chains", result.chains);
  report.figure("planned", "flows planned", result.planned);
  report.figure("flows", "flows done", result.flows);
  report.figure("found", "flows that were found", result.found);
  report.figure("not_found", "flows that were not found", result.not_found);
  report.figure("flow_seconds", "searching for flows", result.flow_seconds, "seconds");
  report.figure("mesh_seconds", "meshing", result.mesh_seconds, "seconds");
  report.figure("cold_seconds_estimate", "the same flows each by itself, about", result.cold_seconds_estimate,
                "seconds");
  report.figure("seconds", "wall time", result.seconds, "seconds");
  report.figure("stopped", "stopped", name_of(result.stopped));
}

// Rank 0 of an MPI program, or the only process.
Status run_sweep(const SweepCommand& command, Crew& crew) {
  const SweepProblem problem = read_sweep(command.problem);
  warn(problem.warnings);
  SweepProgressLine progress(progress_style(command.quiet), command.time_limit);
  const SweepResult result = sweep(command.directory, problem,
                                   command.resume ? SweepMode::resume : SweepMode::begin, crew, &progress);
  progress.end_line();

  Report report;
  report.figure("sweep", "sweep", command.problem);
  add_refused(report, problem);
  add_result(report, result);
  report.figure("directory", "directory", command.directory.string());
  add_output_figures(report,
                     {(command.directory / "table.csv").string(), (command.directory / "table.h5").string()});
  report.print(command.json);
  if (result.stopped != SweepStopped::done) return Status::limit;
  return result.not_found == 0 ? Status::done : Status::answer_is_no;
}

Status run(const SweepCommand& command) {
  require_possible(command);
  return with_crew(command.threads, command.ranks, run_sweep_chain,
                   [&](Crew& crew) { return run_sweep(command, crew); });
}

}  // namespace

void add_sweep_command(CLI::App& program, Action& action) {
  auto command = std::make_shared<SweepCommand>();
  CLI::App& app = add_subcommand(
      program, "sweep", "Flows around many sections at many conditions, as a table", [command, &action] {
        if (!action) action = [command] { return run(*command); };  // else its subcommand was given
      });
  add_text(app, {"sweep", "SWEEP", "", "Sections and conditions, a JSON file: docs/sweep.md"},
           Presence::optional, command->problem);
  add_text(app, {"-o,--output", "DIR", "", "Directory of the sweep: new, empty, or with --resume a sweep's"},
           Presence::optional, command->directory);
  add_flag(app, "--resume",
           "Continue the sweep in the directory; sections and conditions that SWEEP has more of extend it",
           command->resume);
  add_integer(app,
              {"--threads", "N", "one per core; one per rank of an MPI program",
               "Chains of sections at the same time. The table does not depend on it; 1 to 1024"},
              {.low = 1, .high = 1024}, command->threads);
  add_real(app, {"--time-limit", "SECONDS", "none", "Ends the sweep in order after this time: above 0"},
           {.low = 0.0, .high = 1e9, .above_low = true}, command->time_limit);
  add_rank_option(app, command->ranks);
  add_flag(app, "--quiet", "No progress on standard error", command->quiet);
  add_json_flag(app, command->json);
  add_page_command(app, action,
                   {.description = "Reports a sweep on one page, with everything in it",
                    .directory_help = "Directory of `remodel sweep`, finished or not",
                    .key = "sweep",
                    .write = write_sweep_page});
}

}  // namespace remodel::app
