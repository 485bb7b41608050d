// The program `remodel`: a thin layer over the library's public headers. This file turns the command line
// into one Action and every failure into one line and an exit status.

#include <CLI/CLI.hpp>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <thread>

#include "command.h"
#include "remodel/error.h"
#include "study_ranks.h"

namespace remodel::app {
namespace {

// All ranks of an MPI program refuse the same input: rank 0 says so. Another that ended before could be the
// end of rank 0, unheard, so it waits. Where input differs it does from host to host: the first rank of each
// other host says so then, if the end of rank 0 was not its own.
bool is_heard(Status status) {
  constexpr std::chrono::seconds patience{5};
  if (status != Status::bad_input || launched_rank() == 0) return true;
  std::this_thread::sleep_for(patience);
  return launched_local_rank() == 0;
}

int fail(Status status, std::string message) {
  if (!is_heard(status)) return static_cast<int>(status);
  if (launched_rank() > 0) message = "rank " + std::to_string(launched_rank()) + ": " + message;
  // File names and foreign content may hold anything; the message stays one line.
  for (char& c : message) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) c = ' ';
  }
  std::fprintf(stderr, "remodel: %s\n", message.c_str());
  return static_cast<int>(status);
}

std::string list_of_subcommands(const CLI::App& program) {
  std::string list;
  for (const CLI::App* subcommand : program.get_subcommands([](const CLI::App*) { return true; })) {
    list += (list.empty() ? "" : ", ") + subcommand->get_name();
  }
  return list;
}

std::string explain(const CLI::ParseError& error, const CLI::App& program, int argc, char** argv) {
  const auto chosen = program.get_subcommands();
  if (chosen.empty()) {
    const std::string found = argc > 1 ? "'" + std::string(argv[1]) + "'" : "nothing";
    return "command line: found " + found + ", expected one of " + list_of_subcommands(program);
  }
  // A subcommand of a subcommand is the one that was asked for.
  const CLI::App* asked = chosen.front();
  std::string name = asked->get_name();
  while (!asked->get_subcommands().empty()) {
    asked = asked->get_subcommands().front();
    name += " " + asked->get_name();
  }
  std::string problem = error.what();
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
    problem = "found unexpected";
    for (const std::string& argument : asked->remaining()) problem += " '" + argument + "'";
    problem += ", expected only known options and arguments";
  }
  return problem + " (see `remodel " + name + " --help`)";
}

int run(int argc, char** argv) {
  CLI::App program{"Remodels quality Delaunay meshes while the airfoil inside changes", "remodel"};
  program.set_version_flag("--version", REMODEL_VERSION);
  program.require_subcommand(1);
  program.footer(
      "Exit status: 0 done, 1 done and the answer is no, 2 bad usage or input, 3 stopped at a limit, 4 our "
      "own "
      "bug.\nLengths are in chords, angles in degrees; `remodel SUBCOMMAND --help` names units and "
      "defaults.");
  Action action;
  for (const auto add : {add_mesh_command, add_update_command, add_batch_command, add_check_command,
                         add_fit_command, add_optimise_command, add_draw_command, add_convert_command,
                         add_shapes_command, add_soak_command, add_study_command}) {
    add(program, action);
  }
  try {
    program.parse(argc, argv);
    return static_cast<int>(action());
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return program.exit(error);
    return fail(Status::bad_input, "error: " + explain(error, program, argc, argv));
  } catch (const Error& error) {
    return fail(Status::bad_input, std::string("error: ") + error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(Status::bad_input, std::string("error: ") + error.what());
  } catch (const std::bad_alloc&) {
    return fail(Status::limit, "error: out of memory, expected enough for the mesh");
  } catch (const std::exception& error) {
    return fail(Status::internal_error, std::string("internal error: ") + error.what());
  } catch (...) {
    return fail(Status::internal_error, "internal error: unknown exception");
  }
}

}  // namespace
}  // namespace remodel::app

int main(int argc, char** argv) {
  // Beyond a limit on file sizes a write then fails like one to a full disk, instead of ending the process.
  std::signal(SIGXFSZ, SIG_IGN);
  return remodel::app::run(argc, argv);
}
