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
  if (!ended_) end_group();
}

bool ChildProcess::ended() {
  if (ended_) return true;
  siginfo_t found{};
  const int failed = waitid(P_PID, static_cast<id_t>(id_), &found, WEXITED | WNOHANG | WNOWAIT);
  if (failed != 0 ? errno != EINTR : found.si_pid == id_) end_group();
  return ended_;
}

// As long as the child has not been waited for, no other group can have its number.
void ChildProcess::end_group() {
  kill(-id_, SIGKILL);
  while (waitpid(id_, &status_, 0) < 0 && errno == EINTR) {
  }
  ended_ = true;
}

std::string ChildProcess::failure() const {
  if (WIFSIGNALED(status_)) return "ended by signal " + std::to_string(WTERMSIG(status_));
  const int status = WEXITSTATUS(status_);
  return status == 0 ? "" : "ended with status " + std::to_string(status);
}

}  // namespace remodel
