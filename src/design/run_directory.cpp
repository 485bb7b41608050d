#include "design/run_directory.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "design/checkpoint.h"
#include "remodel/error.h"

namespace remodel {
namespace {

namespace fs = std::filesystem;

constexpr const char* start_name = ".remodel-start";
constexpr const char* evaluations_name = "evaluations";  // that a command leaves
// Everything that a run leaves, and what programs say of it (the last three), in the order in which it is
// removed; then the files of checkpoints.
constexpr std::array<std::string_view, 11> run_files = {
    "checkpoint.json", "result.json",  "best.json",      "middle.vtkhdf",
    "last.vtkhdf",     "first.vtkhdf", "history.sqlite", "history.sqlite-journal",
    "stages.json",     "fresh.json",   "report.html"};
// What a run starts with, in the order in which it appears: with the checkpoint the run is there.
constexpr std::array<std::string_view, 4> start_files = {"first.vtkhdf", "history.sqlite",
                                                         first_checkpoint_mesh, "checkpoint.json"};

// Whether write_atomically() would make a file of that name for one of the run's:
// ".FILE.PROCESS.COUNTER.tmp".
bool is_temporary(std::string_view name) {
  if (!name.starts_with('.') || !name.ends_with(".tmp")) return false;
  name.remove_prefix(1);
  for (int part = 0; part < 3; ++part) name = name.substr(0, name.rfind('.'));
  return is_checkpoint_file(name) || std::find(run_files.begin(), run_files.end(), name) != run_files.end();
}

std::vector<fs::path> files_with(const fs::path& directory, bool (*wanted)(std::string_view)) {
  std::error_code ignored;
  std::vector<fs::path> found;
  for (fs::directory_iterator file(directory, ignored), end; file != end && !ignored;
       file.increment(ignored)) {
    if (wanted(file->path().filename().string())) found.push_back(file->path());
  }
  return found;
}

}  // namespace

RunDirectory::RunDirectory(fs::path directory) : directory_(std::move(directory)), lock_(directory_) {
  remove_temporaries();
  drop_start();
}

void RunDirectory::remove_temporaries() const noexcept {
  std::error_code ignored;
  for (const fs::path& file : files_with(directory_, is_temporary)) fs::remove(file, ignored);
}

fs::path RunDirectory::make_start() const {
  drop_start();
  const fs::path start = directory_ / start_name;
  std::error_code problem;
  fs::create_directory(start, problem);
  if (problem)
    throw Error(ErrorCode::file, start.string(), "cannot make the directory: " + problem.message());
  return start;
}

void RunDirectory::drop_start() const noexcept {
  std::error_code ignored;
  fs::remove_all(directory_ / start_name, ignored);
}

void RunDirectory::publish_start() const {
  const auto require = [&](const std::error_code& problem, std::string_view name) {
    if (problem)
      throw Error(ErrorCode::file, (directory_ / name).string(), "cannot be replaced: " + problem.message());
  };
  std::error_code problem;
  for (const std::string_view name : run_files) {
    fs::remove(directory_ / name, problem);
    require(problem, name);
  }
  fs::remove_all(directory_ / evaluations_name, problem);
  require(problem, evaluations_name);
  for (const fs::path& file : files_with(directory_, is_checkpoint_file)) {
    fs::remove(file, problem);
    require(problem, file.filename().string());
  }
  for (const std::string_view name : start_files) {
    if (name == start_files.back()) lock_.sync();
    fs::rename(directory_ / start_name / name, directory_ / name, problem);
    require(problem, name);
  }
  lock_.sync();
  drop_start();
}

}  // namespace remodel
