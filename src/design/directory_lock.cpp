#include "remodel/directory_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "remodel/error.h"

namespace remodel {

// The lock is on the directory itself, so that there is no lock file to be left behind. Some network file
// systems cannot lock a directory: there it is up to the user.
DirectoryLock::DirectoryLock(const std::filesystem::path& directory) {
  std::error_code problem;
  std::filesystem::create_directories(directory, problem);
  if (problem)
    throw Error(ErrorCode::file, directory.string(), "cannot make the directory: " + problem.message());
  descriptor_ = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor_ < 0)
    throw Error(ErrorCode::file, directory.string(),
                "cannot be opened: " + std::generic_category().message(errno));
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  ::close(std::exchange(descriptor_, -1));
  throw Error(ErrorCode::file, directory.string(),
              "is in use by another run: expected another directory, or that the run has ended");
}

DirectoryLock::DirectoryLock(DirectoryLock&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)) {}

DirectoryLock::~DirectoryLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

// Not every file system can flush a directory: that is no error.
void DirectoryLock::sync() const {
  static_cast<void>(::fsync(descriptor_));
}

}  // namespace remodel
