#pragma once

// A program that runs beside this one, with all processes that it starts.

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace remodel {

// A child in a process group of its own. It reads nothing. The group outlives neither this object nor the
// child; processes that leave it (setsid) do.
class ChildProcess {
 public:
  // Its standard output and error go into two files. Throws std::runtime_error where it cannot be started.
  ChildProcess(std::vector<std::string> command, const std::filesystem::path& output,
               const std::filesystem::path& errors);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  // Where it has not ended, its group is told to, and two seconds later killed.
  ~ChildProcess();

  // When it has, what it started in its group is killed.
  bool ended();
  // The way in which it ended; empty where its status is 0.
  std::string failure() const;

 private:
  void end_group();

  pid_t id_ = 0;
  int status_ = 0;
  bool ended_ = false;
};

}  // namespace remodel
