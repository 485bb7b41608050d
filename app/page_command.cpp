#include "page_command.h"

#include <memory>

#include "figures.h"
#include "outputs.h"

namespace remodel::app {
namespace {

struct ReportCommand {
  PageCommand of;
  std::filesystem::path directory;
  std::string output;
  bool json = false;
};

Status run(const ReportCommand& command) {
  const std::string page =
      command.output.empty() ? (command.directory / "report.html").string() : command.output;
  require_writable_as(page, {".html"});
  const Json figures = Json::parse(command.of.write(command.directory, page));
  Report report;
  report.figure(command.of.key, command.of.key, command.directory.string());
  for (const auto& [key, value] : figures.items()) report.figure(key, key, value);
  add_output_figures(report, {page});
  report.print(command.json);
  return Status::done;
}

}  // namespace

void add_page_command(CLI::App& parent, Action& action, const PageCommand& of) {
  auto command = std::make_shared<ReportCommand>();
  command->of = of;
  CLI::App& app = add_command(parent, "report", of.description, command, action);
  add_text(app, {"DIR", "", "", of.directory_help}, Presence::required, command->directory);
  add_text(app, {"-o,--output", "FILE", "DIR/report.html", "Page to write: .html"}, Presence::optional,
           command->output);
  add_json_flag(app, command->json);
}

}  // namespace remodel::app
