// remodel study report DIR -o FILE: reports a study's results as a page, tables and figures.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "arguments.h"
#include "command.h"
#include "figures.h"
#include "outputs.h"
#include "remodel/error.h"
#include "remodel/io.h"
#include "report.h"
#include "study/study_report.h"
#include "study_report_command.h"

namespace remodel::app {
namespace {

struct StudyReportCommand {
  std::string study;
  std::vector<std::string> outputs;
  std::string verdict;
  std::string csv;
  std::string svg;
  bool json = false;
};

std::string extension_of(const std::string& file) {
  return std::filesystem::path(file).extension().string();
}

// Throws Error unless nothing is there and a directory can be made.
void require_missing(const std::string& directory) {
  if (std::filesystem::exists(directory))
    throw Error(ErrorCode::file, directory, "found a file, expected a directory, or none yet");
  require_writable(directory);
}

void require_outputs(const StudyReportCommand& command) {
  if (command.outputs.empty() && command.verdict.empty() && command.csv.empty() && command.svg.empty())
    throw Error(ErrorCode::argument, "study report",
                "found no output, expected -o FILE, --verdict FILE, --csv DIR or --svg DIR");
  for (const std::string& file : command.outputs) require_writable_as(file, {".html", ".md"});
  if (!command.verdict.empty()) require_writable(command.verdict);
  for (const std::string& directory : {command.csv, command.svg})
    if (!directory.empty() && !std::filesystem::is_directory(directory)) require_missing(directory);
}

// Makes the directory if it is missing; its parent has to be there.
std::filesystem::path made_directory(const std::string& name) {
  const std::filesystem::path directory(name);
  std::error_code error;
  std::filesystem::create_directory(directory, error);
  if (!std::filesystem::is_directory(directory))
    throw Error(ErrorCode::file, name, "found no directory and made none, expected one that can be written");
  return directory;
}

std::vector<std::filesystem::path> write_csv(const std::string& name, const StudyContents& study) {
  const std::filesystem::path directory = made_directory(name);
  const std::vector<std::filesystem::path> files = {directory / "tables.csv", directory / "blocks.csv",
                                                    directory / "verdict.csv"};
  write_text_atomically(files[0], study_csv(study));
  write_text_atomically(files[1], study_blocks_csv(study));
  write_text_atomically(files[2], verdict_csv(judge_study(study)));
  return files;
}

std::vector<std::filesystem::path> write_svg(const std::string& name, const std::vector<StudySvg>& figures) {
  const std::filesystem::path directory = made_directory(name);
  std::vector<std::filesystem::path> files;
  for (const StudySvg& figure : figures) {
    files.push_back(directory / (figure.name + ".svg"));
    write_text_atomically(files.back(), figure.text);
  }
  return files;
}

bool wants_page(const StudyReportCommand& command) {
  for (const std::string& file : command.outputs)
    if (extension_of(file) == ".html") return true;
  return false;
}

Status run(const StudyReportCommand& command) {
  require_outputs(command);
  const StudyContents study = read_study(command.study);
  std::vector<StudySvg> meshes;
  if (wants_page(command) || !command.svg.empty()) meshes = study_mesh_figures(study);
  const std::string page = wants_page(command) ? study_page(study, meshes) : std::string();
  std::vector<std::string> written;
  for (const std::string& file : command.outputs) {
    write_text_atomically(file, extension_of(file) == ".html" ? page : study_markdown(study));
    written.push_back(file);
  }
  if (!command.verdict.empty()) {
    write_text_atomically(command.verdict, verdict_markdown(study));
    written.push_back(command.verdict);
  }
  const auto add = [&](const std::vector<std::filesystem::path>& files) {
    for (const std::filesystem::path& file : files) written.push_back(file.string());
  };
  if (!command.csv.empty()) add(write_csv(command.csv, study));
  if (!command.svg.empty()) {
    std::vector<StudySvg> figures = study_charts(study);
    for (const auto& more : {meshes, study_airfoil_figures(study)})
      figures.insert(figures.end(), more.begin(), more.end());
    add(write_svg(command.svg, figures));
  }

  const VerdictShare share = verdict_share(judge_study(study));
  Report report;
  report.figure("study", "study", command.study);
  report.figure("finished", "finished", study.finished());
  report.figure("replays", "replays", study.replays, "of " + std::to_string(study.expected_replays));
  report.figure("rows", "rows", study.rows.size());
  report.figure("judged", "rows with I >= 200 by chain", share.rows);
  report.figure("inside", "of these as the paper's", share.inside);
  report.data("outputs", written);
  report.line("written", std::to_string(written.size()) + (written.size() == 1 ? " file" : " files"));
  report.print(command.json);
  return Status::done;
}

}  // namespace

void add_study_report_command(CLI::App& study, Action& action) {
  auto command = std::make_shared<StudyReportCommand>();
  CLI::App& app =
      add_command(study, "report", "Reports the results of a study: a page, tables, figures, the verdict",
                  command, action);
  add_text(app, {"study", "DIR", "", "The study's directory, finished or not"}, Presence::required,
           command->study);
  add_texts(
      app,
      {"-o,--output", "FILE", "",
       "File to write, by extension: .html (one page with everything in it, to be opened from disk) or .md "
       "(what was run, the verdict, all tables); may be repeated"},
      Presence::optional, command->outputs);
  add_text(app, {"--verdict", "FILE", "", "Markdown of what was run and the verdict alone"},
           Presence::optional, command->verdict);
  add_text(app,
           {"--csv", "DIR", "",
            "Directory for tables.csv, blocks.csv (over the run) and verdict.csv; made if missing"},
           Presence::optional, command->csv);
  add_text(app, {"--svg", "DIR", "", "Directory for all figures as SVG; made if missing"}, Presence::optional,
           command->svg);
  add_json_flag(app, command->json);
}

}  // namespace remodel::app
