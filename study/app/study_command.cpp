// remodel study -o DIR: the paper's whole study, or a part of it.

#include <algorithm>
#include <memory>

#include "arguments.h"
#include "command.h"
#include "figures.h"
#include "outputs.h"
#include "ranks.h"
#include "remodel/error.h"
#include "remodel/shape_files.h"
#include "study/study.h"
#include "study_progress.h"
#include "study_report_command.h"

namespace remodel::app {
namespace {

struct StudyCommand {
  std::filesystem::path directory;
  // The options that were given, in the order of the command line. Each changes the defaults, the paper's
  // study
  // (--full) or the study that is resumed.
  std::vector<std::function<void(StudyOptions&)>> given;
  std::size_t threads = 0;  // 0: not given
  double time_limit = 0.0;
  RanksOptions ranks;
  bool full = false;
  bool resume = false;
  bool quiet = false;
  bool json = false;
};

StudyOptions options_of(const StudyCommand& command) {
  StudyOptions options;
  if (command.full) options = full_study();
  if (command.resume) options = read_study_options(command.directory);
  if (options.airfoils.empty()) options.airfoils.push_back({"rae2822", load_airfoil("rae2822", 5)});
  for (const auto& change : command.given) change(options);
  return options;
}

void add_result(Report& report, const StudyResult& result) {
  report.figure("jobs", "jobs", result.jobs);
  report.figure("done", "done", result.done);
  report.figure("before", "done before", result.before);
  report.figure("cells", "cells", result.cells, "(airfoil, sigma, I, G, D, strategy)");
  report.figure("scenarios", "scenarios", result.scenarios);
  report.figure("replays", "replays", result.replays);
  report.figure("evaluations", "remodellings", result.evaluations);
  report.figure("invalid_meshes", "invalid meshes", result.invalid_meshes);
  report.figure("recoveries", "recoveries by generation", result.recoveries);
  report.figure("stopped_replays", "replays that a limit ended", result.stopped_replays);
  report.figure("core_seconds", "work of all finished jobs", result.core_seconds, "core seconds");
  report.figure("seconds", "wall time", result.seconds, "seconds");
  report.figure("stopped", "stopped", name_of(result.stopped));
}

Status status_of(const StudyResult& result) {
  if (result.stopped != StudyStopped::done || result.stopped_replays > 0) return Status::limit;
  return result.invalid_meshes == 0 ? Status::done : Status::answer_is_no;
}

// Rank 0 of an MPI program, or the only process.
Status run_study(const StudyCommand& command, Crew& crew) {
  const StudyOptions options = options_of(command);
  StudyProgressLine progress(progress_style(command.quiet), "options: " + study_options_to_json(options),
                             command.time_limit);
  const StudyResult result = study(command.directory, options,
                                   command.resume ? StudyMode::resume : StudyMode::begin, crew, &progress);
  progress.finish();

  Report report;
  report.data("options", Json::parse(study_options_to_json(read_study_options(command.directory))));
  add_result(report, result);
  report.figure("directory", "study", command.directory.string());
  report.print(command.json);
  return status_of(result);
}

Status run(const StudyCommand& command) {
  if (command.directory.empty())
    throw Error(ErrorCode::argument, "-o", "not found, expected the study's directory");
  if (command.resume && command.full)
    throw Error(ErrorCode::argument, "--full",
                "found with --resume, expected one of them: a study knows its options");
  if (!command.resume) require_place_of_run(command.directory);
  return with_crew(command.threads, command.ranks, run_study_job,
                   [&](Crew& crew) { return run_study(command, crew); });
}

StudyPair parse_pair(const std::string& option, const std::string& text) {
  const std::size_t slash = text.find('/');
  const std::string points = text.substr(0, slash);
  const std::int64_t number = parse_integer(option, points, {.low = 8, .high = 100000, .even = true});
  if (slash == std::string::npos) return {static_cast<int>(number), static_cast<double>(number) / 50.0};
  return {static_cast<int>(number),
          parse_real(option, text.substr(slash + 1), {.low = 0.0, .high = 1e6, .above_low = true})};
}

// Adds an option for a list. Its values are parsed one by one and replace those of the default; on --resume
// they are added to the study's.
template <typename Value>
void add_list(CLI::App& app, StudyCommand& command, const OptionText& text,
              std::vector<Value> StudyOptions::*list, std::function<Value(const std::string&)> parse) {
  add_text(app, text, Presence::optional,
           [&command, name = text.name, list, parse = std::move(parse)](const std::string& found) {
             std::vector<Value> values;
             for (const std::string& word : parse_list(name, found)) {
               values.push_back(parse(word));
               if (std::find(values.begin(), values.end() - 1, values.back()) != values.end() - 1)
                 throw Error(ErrorCode::argument, name, "found '" + found + "', expected each value once");
             }
             command.given.emplace_back([list, values](StudyOptions& options) { options.*list = values; });
           });
}

void add_lists(CLI::App& app, StudyCommand& command) {
  add_list<StudyAirfoil>(app, command, {"--airfoils", "SHAPE,...", "rae2822", "Targets of the optimisations"},
                         &StudyOptions::airfoils, [](const std::string& shape) {
                           return StudyAirfoil{shape, load_airfoil(shape, 5, TrailingEdge::closed)};
                         });
  add_list<double>(app, command,
                   {"--sigmas", "S,...", "0.01,0.05,0.25",
                    "Initial standard deviations of the coefficients: above 0, no unit"},
                   &StudyOptions::sigmas, [](const std::string& text) {
                     return parse_real("--sigmas", text, {.low = 0.0, .high = 1e6, .above_low = true});
                   });
  add_list<StudyPair>(app, command,
                      {"--pairs", "I/G,...", "50/1,100/2,200/4,300/6,400/8,700/14",
                       "Vertices on the airfoil (even, 8 to 100000) and gradation (above 0; I alone: I/50)"},
                      &StudyOptions::pairs,
                      [](const std::string& text) { return parse_pair("--pairs", text); });
  add_list<double>(
      app, command,
      {"--distances", "D,...", "0.5,1,2,4",
       "Ratios of the removal radius to the distance between old and new vertex: at least 0, no unit"},
      &StudyOptions::distances,
      [](const std::string& text) { return parse_real("--distances", text, {.low = 0.0}); });
  add_list<std::string>(app, command, {"--strategy", "NAME,...", "chain,renew", "Strategies to compare"},
                        &StudyOptions::strategies, [](const std::string& text) {
                          const std::vector<std::string> known = study_strategies();
                          if (std::find(known.begin(), known.end(), text) != known.end()) return text;
                          std::string names;
                          for (const std::string& name : known) names += (names.empty() ? "" : ", ") + name;
                          throw Error(ErrorCode::argument, "--strategy",
                                      "found '" + text + "', expected some of " + names);
                        });
}

void add_counts(CLI::App& app, StudyCommand& command) {
  const auto add = [&](const OptionText& text, IntegerRange range, auto StudyOptions::*member) {
    add_integer(app, text, range, [&command, member](std::int64_t value) {
      command.given.emplace_back([member, value](StudyOptions& options) {
        options.*member = static_cast<std::remove_reference_t<decltype(options.*member)>>(value);
      });
    });
  };
  add({"--scenarios", "N", "1",
       "Optimisations of each airfoil and sigma, seeds SEED to SEED + N - 1: 1 to 9999"},
      {.low = 1, .high = 9999}, &StudyOptions::scenarios);
  add({"--evaluations", "N", std::to_string(StudyOptions().evaluations),
       "Feasible designs of each optimisation, remodelled once per replay: at least 1"},
      {.low = 1, .high = 1'000'000'000}, &StudyOptions::evaluations);
  add({"--compare-every", "K", std::to_string(StudyOptions().compare_every),
       "Every K-th evaluation is compared with a fresh mesh; 0: never"},
      {.low = 0, .high = 1'000'000'000}, &StudyOptions::compare_every);
  add({"--check-every", "K", std::to_string(StudyOptions().check_every),
       "Every K-th mesh goes through the whole quick check, the others where they changed: at least 1"},
      {.low = 1, .high = 1'000'000'000}, &StudyOptions::check_every);
  add({"--validate-every", "K", std::to_string(StudyOptions().validate_every),
       "Every K-th mesh goes through the validator: at least 1"},
      {.low = 1, .high = 1'000'000'000}, &StudyOptions::validate_every);
  add({"--seed", "N", "1", "Seed of the first scenario: at least 0"}, {.low = 0, .high = 1'000'000'000'000},
      &StudyOptions::seed);
}

void add_work_options(CLI::App& app, StudyCommand& command) {
  add_integer(
      app, {"--threads", "N", "one per core; one per rank of an MPI program", "Threads that work: 1 to 1024"},
      {.low = 1, .high = 1024}, command.threads);
  add_real(app, {"--time-limit", "SECONDS", "none", "Ends the study in order after this time: above 0"},
           {.low = 0.0, .high = 1e9, .above_low = true}, command.time_limit);
  add_rank_option(app, command.ranks);
}

}  // namespace

void add_study_command(CLI::App& program, Action& action) {
  auto command = std::make_shared<StudyCommand>();
  CLI::App& app =
      add_subcommand(program, "study",
                     "Runs the paper's study, or a part of it: optimisations replayed for every I, G, D "
                     "and strategy",
                     [command, &action] {
                       if (!action)
                         action = [command] { return run(*command); };  // else its subcommand was given
                     });
  add_study_report_command(app, action);
  add_text(app, {"-o,--output", "DIR", "", "Directory of the study: new, empty, or with --resume a study's"},
           Presence::optional, command->directory);
  add_lists(app, *command);
  add_counts(app, *command);
  add_flag(app, "--full", "The paper's study: nine airfoils, thirty scenarios of 9000 evaluations",
           command->full);
  add_flag(app, "--resume",
           "Continue the study in the directory; lists and scenarios that are given extend it",
           command->resume);
  add_work_options(app, *command);
  add_flag(app, "--quiet", "No progress and no options on standard error", command->quiet);
  add_json_flag(app, command->json);
}

}  // namespace remodel::app
