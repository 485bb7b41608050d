#pragma once

// A directory that one process at a time writes to.

#include <filesystem>

namespace remodel {

class DirectoryLock {
 public:
  // Makes the directory if it is missing and locks it. Throws Error (file), also where another process holds
  // the lock. The lock ends with the process, however it ends.
  explicit DirectoryLock(const std::filesystem::path& directory);
  ~DirectoryLock();
  DirectoryLock(DirectoryLock&& other) noexcept;
  DirectoryLock& operator=(DirectoryLock&&) = delete;

  // Puts what was renamed and removed in the directory on the disk, where the file system can.
  void sync() const;

 private:
  int descriptor_ = -1;
};

}  // namespace remodel
