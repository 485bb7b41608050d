#pragma once

// The directory of a run: held by one process at a time, and given a new run's files at once.
//
// A new run starts in a subdirectory. Only when all that it needs is on the disk are the files of the run
// before removed and the new ones moved to their places, checkpoint.json first and last: a disk that is full
// leaves the old run, and a process killed in between leaves a directory without a checkpoint, in which a run
// can start.

#include <filesystem>

#include "remodel/directory_lock.h"

namespace remodel {

class RunDirectory {
 public:
  // Makes the directory if it is missing, locks it and removes what a killed run left half written in it.
  // Throws Error (file), also where another process holds the lock. The lock ends with the process, however
  // it ends.
  explicit RunDirectory(std::filesystem::path directory);

  std::filesystem::path make_start() const;  // the empty subdirectory
  void publish_start() const;                // its files replace those of the run before
  void drop_start() const noexcept;

 private:
  void remove_temporaries() const noexcept;

  std::filesystem::path directory_;
  DirectoryLock lock_;
};

}  // namespace remodel
