#include "design/child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <thread>

#include "base/stopwatch.h"

extern char** environ;

namespace remodel {

ChildProcess::ChildProcess(std::vector<std::string> command, const std::filesystem::path& output,
                           const std::filesystem::path& errors) {
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
  if (problem != 0)
    throw std::runtime_error(command.front() + ": cannot be started: " + std::strerror(problem));
}

ChildProcess::~ChildProcess() {
  if (ended_) return;
  constexpr double patience = 2.0;  // seconds
  kill(-id_, SIGTERM);
  for (const Stopwatch watch; !ended() && watch.seconds() < patience;)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  kill(-id_, SIGKILL);
  if (!ended_) waitpid(id_, &status_, 0);
}

bool ChildProcess::ended() {
  const pid_t waited = ended_ ? 0 : waitpid(id_, &status_, WNOHANG);
  ended_ = ended_ || waited == id_ || (waited < 0 && errno != EINTR);
  return ended_;
}

std::string ChildProcess::failure() const {
  if (WIFSIGNALED(status_)) return "ended by signal " + std::to_string(WTERMSIG(status_));
  const int status = WEXITSTATUS(status_);
  return status == 0 ? "" : "ended with status " + std::to_string(status);
}

}  // namespace remodel
