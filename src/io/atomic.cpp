// A file appears whole or not at all: it is written beside its target, brought to the disk and renamed. And
// files are read in one place, pipes among them.

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <map>
#include <mutex>
#include <string>
#include <system_error>
#include <utility>

#include "remodel/error.h"
#include "remodel/io.h"

namespace remodel {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& file, const char* what, int reason) {
  throw Error(ErrorCode::file, file.string(), what + std::generic_category().message(reason));
}
[[noreturn]] void fail_writing(const fs::path& file, int reason) {
  fail(file, "cannot be written: ", reason);
}
[[noreturn]] void fail_reading(const fs::path& file, int reason) {
  fail(file, "cannot be read: ", reason);
}

class Descriptor {
 public:
  explicit Descriptor(int value) : value_(value) {}
  Descriptor(const fs::path& file, int flags) : value_(::open(file.c_str(), flags | O_CLOEXEC, 0666)) {}
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  explicit operator bool() const { return value_ >= 0; }
  int get() const { return value_; }
  // Some file systems report a full disk only here.
  bool close() { return ::close(std::exchange(value_, -1)) == 0; }

 private:
  int value_;
};

fs::path directory_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

class Temporary {
 public:
  explicit Temporary(const fs::path& target) {
    static std::atomic<unsigned> counter = 0;
    // The file's own name may be as long as the file system allows: of long ones the beginning.
    constexpr std::size_t longest = 100;
    std::string name = ".";
    name += target.filename().string().substr(0, longest);
    name += '.' + std::to_string(::getpid()) + '.' + std::to_string(counter++) + ".tmp";
    path_ = directory_of(target) / name;
  }
  ~Temporary() { ::unlink(path_.c_str()); }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

void check_target(const fs::path& file) {
  std::error_code ignored;
  if (!file.has_filename()) throw Error(ErrorCode::argument, file.string(), "a file name expected");
  if (fs::is_directory(file, ignored)) fail_writing(file, EISDIR);
  if (!fs::is_directory(directory_of(file), ignored)) fail_writing(file, ENOENT);
}

void write_bytes(const fs::path& path, const fs::path& target, std::string_view bytes) {
  Descriptor descriptor(path, O_WRONLY | O_CREAT | O_TRUNC);
  if (!descriptor) fail_writing(target, errno);
  while (!bytes.empty()) {
    const auto written = ::write(descriptor.get(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail_writing(target, errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  if (!descriptor.close()) fail_writing(target, errno);
}

void check_size(const fs::path& file, std::size_t size, std::size_t limit) {
  if (size <= limit) return;
  throw Error(ErrorCode::format, file.string(),
              "larger than the " + std::to_string(limit) + " bytes allowed");
}

// A pipe has no size that could bound what is read; documented at read_text().
constexpr std::size_t largest_piped = std::size_t{1} << 31;

// What was read from pipes while somebody wants it kept.
struct KeptTexts {
  std::mutex lock;
  int users = 0;
  std::map<fs::path, std::string> texts;
};
KeptTexts& kept_texts() {
  static KeptTexts kept;
  return kept;
}

std::string read_once(const fs::path& file, std::size_t limit) {
  const bool standard = file == standard_input;
  const Descriptor descriptor = standard ? Descriptor(::dup(STDIN_FILENO)) : Descriptor(file, O_RDONLY);
  if (!descriptor) fail_reading(file, errno);
  struct stat status {};
  if (::fstat(descriptor.get(), &status) != 0) fail_reading(file, errno);
  if (S_ISDIR(status.st_mode)) fail_reading(file, EISDIR);
  const bool device = S_ISBLK(status.st_mode) || S_ISCHR(status.st_mode);
  if (device && !(standard && ::isatty(descriptor.get()) != 0))
    throw Error(ErrorCode::file, file.string(), "is a device, expected a file or a pipe");

  // Read to the end rather than to the size: a pipe has none.
  constexpr std::size_t piece = std::size_t{1} << 20;
  std::string text;
  if (S_ISREG(status.st_mode))
    text.reserve(std::min(static_cast<std::size_t>(status.st_size), limit) + piece);
  for (std::size_t used = 0;;) {
    text.resize(used + piece);
    const auto got = ::read(descriptor.get(), text.data() + used, piece);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail_reading(file, errno);
    used += static_cast<std::size_t>(got);
    text.resize(used);
    check_size(file, used, limit);
    if (got == 0) return text;
  }
}

}  // namespace

bool is_pipe(const fs::path& file) {
  std::error_code ignored;
  const fs::file_status status = fs::status(file, ignored);
  return file == standard_input ||
         (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status));
}

KeptPipes::KeptPipes() {
  const std::lock_guard guard(kept_texts().lock);
  ++kept_texts().users;
}

KeptPipes::~KeptPipes() {
  const std::lock_guard guard(kept_texts().lock);
  if (--kept_texts().users == 0) kept_texts().texts.clear();
}

fs::path written_place(const fs::path& file) {
  constexpr int most_links = 40;  // as the system itself has it
  fs::path place = file;
  std::error_code error;
  for (int links = 0; fs::is_symlink(place, error); ++links) {
    if (links == most_links) fail_writing(file, ELOOP);
    const fs::path next = fs::read_symlink(place, error);
    if (error) fail_writing(file, error.value());
    place = next.is_absolute() ? next : place.parent_path() / next;
  }
  return place;
}

void write_atomically(const fs::path& given, const std::function<void(const fs::path&)>& write) {
  const fs::path file = written_place(given);
  check_target(file);
  const Temporary temporary(file);
  write(temporary.path());

  Descriptor written(temporary.path(), O_RDONLY);
  if (!written || ::fsync(written.get()) != 0 || !written.close()) fail_writing(file, errno);
  if (::rename(temporary.path().c_str(), file.c_str()) != 0) fail_writing(file, errno);
  // The rename itself must outlive a power failure too. Not every file system can flush a directory: the file
  // is complete under its name by now, so that is no error.
  const Descriptor directory(directory_of(file), O_RDONLY | O_DIRECTORY);
  if (directory) ::fsync(directory.get());
}

void write_text_atomically(const fs::path& file, std::string_view text) {
  write_atomically(file, [&](const fs::path& temporary) { write_bytes(temporary, file, text); });
}

std::string read_text(const fs::path& file, std::size_t limit) {
  if (!is_pipe(file)) return read_once(file, limit);
  auto& [lock, users, texts] = kept_texts();
  const std::lock_guard guard(lock);
  const auto known = texts.find(file);
  if (known != texts.end()) {
    check_size(file, known->second.size(), limit);
    return known->second;
  }
  std::string text = read_once(file, std::min(limit, largest_piped));
  if (users > 0) texts.emplace(file, text);
  return text;
}

}  // namespace remodel
