// The program `remodel`: a thin layer over the library's public headers. This file turns the command line
// into one Action and every failure into one line and an exit status.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "command.h"
#include "help.h"
#include "interrupt.h"
#include "launched.h"
#include "ranks.h"
#include "remodel/error.h"
#include "remodel/io.h"
#include "remodel/version.h"
#include "warnings.h"

namespace remodel::app {
namespace {

// Usually all ranks of an MPI program refuse the same input, and rank 0 alone reports it. The others wait
// before they exit, because mpirun would kill rank 0 before it has printed. If only a host's files differ,
// rank 0 goes on and the first rank of that host reports the refusal.
bool is_heard(Status status) {
  constexpr std::chrono::seconds patience{5};
  if (status != Status::bad_input || launched_rank() == 0) return true;
  std::this_thread::sleep_for(patience);
  return launched_local_rank() == 0;
}

int fail(Status status, std::string message) {
  if (!is_heard(status)) return static_cast<int>(status);
  if (launched_rank() > 0) message = "rank " + std::to_string(launched_rank()) + ": " + message;
  std::fprintf(stderr, "remodel: %s\n", message.c_str());
  return static_cast<int>(status);
}

using Words = std::vector<std::string>;

Words subcommands_of(const CLI::App& program) {
  Words names;
  for (const CLI::App* subcommand : program.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(subcommand->get_name());
  return names;
}

Words options_of(const CLI::App& app) {
  Words names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::string explain_word(const Words& words, const CLI::App& program) {
  Words names = subcommands_of(program);
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  std::string problem = "command line: found " + (words.empty() ? "nothing" : "'" + words[0] + "'") +
                        ", expected one of " + list;
  for (const std::string& option : options_of(program)) names.push_back(option);
  const std::string nearest = words.empty() ? "" : nearest_word(words[0], names);
  return nearest.empty() ? problem : problem + " (did you mean '" + nearest + "'?)";
}

std::string explain(const CLI::ParseError& error, const CLI::App& program, const Words& words) {
  const auto chosen = program.get_subcommands();
  if (chosen.empty()) return explain_word(words, program);
  // The innermost subcommand is the requested one.
  const CLI::App* asked = chosen.front();
  std::string name = asked->get_name();
  while (!asked->get_subcommands().empty()) {
    asked = asked->get_subcommands().front();
    name += " " + asked->get_name();
  }
  std::string problem = error.what();
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
    problem = "found unexpected";
    std::string nearest;
    for (const std::string& argument : asked->remaining()) {
      problem += " '" + argument + "'";
      if (nearest.empty() && argument.starts_with("--"))
        nearest = nearest_word(argument.substr(0, argument.find('=')), options_of(*asked));
    }
    problem += ", expected only known options and arguments";
    if (!nearest.empty()) problem += "; did you mean '" + nearest + "'?";
  }
  return problem + " (see `remodel " + name + " --help`)";
}

// `help SUBCOMMAND` is `SUBCOMMAND --help`.
Words words_of(int argc, char** argv) {
  Words words(argv + 1, argv + argc);
  if (!words.empty() && words[0] == "help") {
    words.erase(words.begin());
    words.push_back("--help");
  }
  return words;
}

int run(const Words& words) {
  CLI::App program{"Remodels quality Delaunay meshes while the airfoil inside changes", "remodel"};
  program.formatter(help_formatter());
  program.set_version_flag("--version", REMODEL_VERSION);
  program.require_subcommand(1);
  const KeptPipes input_is_read_once;
  Action action;
  for (const auto add :
       {add_mesh_command, add_update_command, add_batch_command, add_check_command, add_fit_command,
        add_flow_command, add_polar_command, add_sweep_command, add_optimise_command, add_design_command,
        add_draw_command, add_film_command, add_live_command, add_noise_command, add_transfer_command,
        add_convert_command, add_shapes_command, add_soak_command}) {
    add(program, action);
  }
#ifdef REMODEL_STUDY
  add_study_command(program, action);
#endif
  // Subcommands inherit what was set before them; this is for the program's own help alone.
  program.footer(
      "Exit status: 0 done, 1 done and the answer is no, 2 bad usage or input, 3 stopped at a limit, 4 our "
      "own bug.\nLengths are in chords, angles in degrees; `remodel help SUBCOMMAND` names units and "
      "defaults.");
  if (!words.empty() && !words[0].starts_with('-')) {
    const Words names = subcommands_of(program);
    if (std::find(names.begin(), names.end(), words[0]) == names.end())
      return fail(Status::bad_input, "error: " + one_line(explain_word(words, program)));
  }
  try {
    program.parse(Words(words.rbegin(), words.rend()));
    const Status status = action();
    print_warnings();
    return static_cast<int>(status);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return program.exit(error);
    return fail(Status::bad_input, "error: " + one_line(explain(error, program, words)));
  } catch (const Interrupted&) {
    return fail(Status::limit, "interrupted");
  } catch (const Error& error) {
    return fail(Status::bad_input, std::string("error: ") + error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(Status::bad_input, std::string("error: ") + file_error(error).what());
  } catch (const std::bad_alloc&) {
    return fail(Status::limit, "error: out of memory, expected enough for what was asked");
  } catch (const std::exception& error) {
    return fail(Status::internal_error, "internal error: " + one_line(error.what()));
  } catch (...) {
    return fail(Status::internal_error, "internal error: unknown exception");
  }
}

// Whether MPI's ranks do its work together.
bool shares_ranks(std::string_view subcommand) {
  return subcommand == "study" || subcommand == "sweep" || subcommand == "optimise" || subcommand == "design";
}

}  // namespace
}  // namespace remodel::app

int main(int argc, char** argv) {
  // A write beyond the limit on file sizes then fails as on a full disk, instead of ending the process.
  std::signal(SIGXFSZ, SIG_IGN);
  const std::string_view subcommand = argc > 1 ? argv[1] : "";
  if (remodel::app::launched_ranks() > 1 && remodel::app::shares_ranks(subcommand))
    remodel::app::go_on_with_mpi(argv);
  remodel::app::end_at_interrupt();
  return remodel::app::run(remodel::app::words_of(argc, argv));
}
