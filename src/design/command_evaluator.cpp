// An evaluator that is a program of the user's: one process a design.

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

#include "base/stopwatch.h"
#include "remodel/error.h"
#include "remodel/evaluator.h"
#include "remodel/io.h"

extern char** environ;

namespace remodel {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// Goes with all that is in it.
class TemporaryDirectory {
 public:
  TemporaryDirectory() {
    std::string name = (fs::temp_directory_path() / "remodel-evaluation-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
      throw Error(ErrorCode::file, name, std::string("cannot make the directory: ") + std::strerror(errno));
    path_ = name;
  }
  ~TemporaryDirectory() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  fs::path operator/(const char* name) const { return path_ / name; }

 private:
  fs::path path_;
};

void require_started(int problem, const std::string& program) {
  if (problem != 0) throw std::runtime_error(program + ": cannot be started: " + std::strerror(problem));
}

// A child in a process group of its own, which does not outlive this object.
class Child {
 public:
  Child(std::vector<std::string> command, const fs::path& output, const fs::path& errors) {
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
    constexpr int writing = O_WRONLY | O_CREAT | O_TRUNC;
    posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, 1, output.c_str(), writing, 0600);
    posix_spawn_file_actions_addopen(&files, 2, errors.c_str(), writing, 0600);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    std::vector<char*> arguments;
    for (std::string& word : command) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const int problem = posix_spawnp(&id_, arguments[0], &files, &attributes, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
    require_started(problem, command.front());
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (ended_) return;
    constexpr double patience = 2.0;  // seconds
    kill(-id_, SIGTERM);
    for (const Stopwatch watch; !ended() && watch.seconds() < patience;)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    kill(-id_, SIGKILL);
    if (!ended_) waitpid(id_, &status_, 0);
  }

  bool ended() {
    const pid_t waited = ended_ ? 0 : waitpid(id_, &status_, WNOHANG);
    ended_ = ended_ || waited == id_ || (waited < 0 && errno != EINTR);
    return ended_;
  }
  // The way in which a child ended; empty where its status is 0.
  std::string failure() const {
    if (WIFSIGNALED(status_)) return "ended by signal " + std::to_string(WTERMSIG(status_));
    const int status = WEXITSTATUS(status_);
    return status == 0 ? "" : "ended with status " + std::to_string(status);
  }

 private:
  pid_t id_ = 0;
  int status_ = 0;
  bool ended_ = false;
};

// The end of what a program said, on one line.
std::string end_of(const fs::path& file) {
  constexpr std::size_t most = 300;
  std::string text = read_text(file);
  text.erase(text.find_last_not_of(" \n\r\t") + 1);
  if (text.size() > most) text.erase(0, text.size() - most);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

Evaluation evaluation_from(const std::string& text) {
  const Json json = Json::parse(text);
  Evaluation evaluation;
  json.at("objective").get_to(evaluation.objective);
  const auto read = [&](const char* key, auto& value) {
    if (json.contains(key)) json.at(key).get_to(value);
  };
  read("constraints", evaluation.constraints);
  read("gradient", evaluation.gradient);
  read("constraint_gradients", evaluation.constraint_gradients);
  read("outputs", evaluation.outputs);
  return evaluation;
}

class CommandEvaluator final : public Evaluator {
 public:
  explicit CommandEvaluator(std::vector<std::string> command) : command_(std::move(command)) {}

  Evaluation evaluate(const EvaluationTask& task, std::unique_ptr<EvaluatorState>&) override {
    const TemporaryDirectory directory;
    const fs::path mesh = directory / "mesh.su2", design = directory / "design.json";
    write_mesh(task.mesh, mesh);
    write_text_atomically(design, Json(std::vector<double>(task.design.begin(), task.design.end())).dump());
    std::vector<std::string> command = command_;
    command.insert(command.end(), {mesh.string(), design.string()});
    const fs::path output = directory / "output", errors = directory / "errors";
    run(std::move(command), output, errors, task.observer);
    try {
      return evaluation_from(read_text(output));
    } catch (const Json::exception& problem) {
      throw std::runtime_error(command_.front() +
                               ": expected one JSON object with an objective: " + problem.what());
    }
  }
  std::string description() const override { return Json{{"command", command_}}.dump(); }

 private:
  void run(std::vector<std::string> command, const fs::path& output, const fs::path& errors,
           StepObserver& observer) const {
    Child child(std::move(command), output, errors);
    for (auto pause = std::chrono::milliseconds(1); !child.ended();) {
      if (observer.cancelled()) throw std::runtime_error(command_.front() + ": cancelled");
      std::this_thread::sleep_for(pause);
      pause = std::min(2 * pause, std::chrono::milliseconds(50));
    }
    if (const std::string failure = child.failure(); !failure.empty())
      throw std::runtime_error(command_.front() + ": " + failure + ": " + end_of(errors));
  }

  std::vector<std::string> command_;
};

}  // namespace

std::unique_ptr<Evaluator> command_evaluator(std::vector<std::string> command) {
  if (command.empty()) throw Error(ErrorCode::argument, "command", "found no word, expected a program");
  return std::make_unique<CommandEvaluator>(std::move(command));
}

}  // namespace remodel
