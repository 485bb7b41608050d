// remodel live -o FILE: a page in which an airfoil is dragged and its mesh follows.

#include <unistd.h>

#include <memory>
#include <string>

#include "arguments.h"
#include "command.h"
#include "figures.h"
#include "live_page.h"
#include "outputs.h"
#include "remodel/error.h"
#include "remodel/io.h"

namespace remodel::app {
namespace {

struct LiveCommand {
  std::string output;
  bool open = false;
  bool json = false;
};

Status run(const LiveCommand& command) {
  if (live_page().empty())
    throw Error(
        ErrorCode::argument, "live",
        "found a program that was built without its page (that of ./demo is), expected one built with "
        "emscripten: `scripts/install-dependencies program live && cmake --preset release "
        "-DREMODEL_TESTS=OFF && cmake --build --preset release` makes build/release/remodel");
  require_writable_as(command.output, {".html"});
  write_text_atomically(command.output, live_page());
  Report report;
  add_output_figures(report, {command.output});
  report.print(command.json);
  if (command.open) {
    // Takes the place of this program, which is done.
    execlp("xdg-open", "xdg-open", command.output.c_str(), nullptr);
    throw Error(ErrorCode::argument, "--open", "no xdg-open found, expected it to open " + command.output);
  }
  return Status::done;
}

}  // namespace

void add_live_command(CLI::App& program, Action& action) {
  auto command = std::make_shared<LiveCommand>();
  CLI::App& app = add_command(
      program, "live", "Writes a page in which one drags an airfoil and its mesh follows", command, action);
  add_text(app, {"-o,--output", "FILE", "", "Page to write: .html; it needs no other file and no network"},
           Presence::required, command->output);
  add_flag(app, "--open", "Open the page in the browser", command->open);
  add_json_flag(app, command->json);
}

}  // namespace remodel::app
