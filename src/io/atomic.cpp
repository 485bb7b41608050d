// A file appears whole or not at all: it is written beside its target, brought to the disk and renamed.
// Devices and FIFOs are written in place. And files are read in one place, pipes among them.

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
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

void require_directory_of(const fs::path& file) {
  std::error_code ignored;
  if (!file.has_filename()) throw Error(ErrorCode::argument, file.string(), "a file name expected");
  if (!fs::is_directory(directory_of(file), ignored)) fail_writing(file, ENOENT);
}

void write_all(int descriptor, const fs::path& target, std::string_view bytes) {
  while (!bytes.empty()) {
    const auto written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail_writing(target, errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

// As the file that is replaced; the owner where that is allowed.
void take_over(const Descriptor& fresh, const fs::path& replaced) {
  struct stat old {};
  if (::stat(replaced.c_str(), &old) != 0) return;
  static_cast<void>(!::fchown(fresh.get(), old.st_uid, old.st_gid));
  static_cast<void>(!::fchmod(fresh.get(), old.st_mode & 0777));
}

// The number of a stream of this process that a path names, -1 of others. A copy of the stream is written to:
// opened by its name, a file would be written from its beginning, and a socket not at all.
int stream_of(const std::string& path) {
  if (path == "/dev/stdout") return STDOUT_FILENO;
  if (path == "/dev/stderr") return STDERR_FILENO;
  for (const std::string_view directory : {"/dev/fd/", "/proc/self/fd/"}) {
    if (!path.starts_with(directory)) continue;
    int number = -1;
    const char* end = path.data() + path.size();
    const auto [stop, error] = std::from_chars(path.data() + directory.size(), end, number);
    if (error == std::errc() && stop == end) return number;
  }
  return -1;
}

const char* kind_of(fs::file_type type) {
  switch (type) {
    case fs::file_type::directory:
      return "a directory";
    case fs::file_type::fifo:
      return "a FIFO";
    case fs::file_type::socket:
      return "a socket";
    case fs::file_type::block:
    case fs::file_type::character:
      return "a device";
    default:
      return "of an unknown kind";
  }
}

void write_in_place(const fs::path& file, std::string_view text) {
  const int stream = stream_of(file.string());
  Descriptor descriptor = stream >= 0 ? Descriptor(::dup(stream)) : Descriptor(file, O_WRONLY | O_NOCTTY);
  if (!descriptor) fail_writing(file, errno);
  write_all(descriptor.get(), file, text);
  if (!descriptor.close()) fail_writing(file, errno);
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

Error file_error(const fs::filesystem_error& error) {
  return {ErrorCode::file, error.path1().string(), error.code().message()};
}

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

WrittenPlace written_place(const fs::path& file) {
  if (stream_of(file.string()) >= 0) return {file, true};
  std::error_code error;
  // stat() decides what is there: a link of /proc names what it leads to by no path.
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::none) fail_writing(file, error.value());
  const bool is_link = fs::is_symlink(file, error);
  const bool is_new = status.type() == fs::file_type::not_found;
  if (!is_new && !fs::is_regular_file(status)) {
    const bool is_stream = fs::is_fifo(status) || fs::is_character_file(status) || fs::is_block_file(status);
    if (!is_link && is_stream) return {file, true};
    throw Error(ErrorCode::file, file.string(),
                std::string(is_link ? "is a link to something that is " : "is ") + kind_of(status.type()) +
                    ", expected a file to write");
  }
  constexpr int most_links = 40;  // as the system itself has it
  fs::path place = file;
  for (int links = 0; fs::is_symlink(place, error); ++links) {
    if (links == most_links) fail_writing(file, ELOOP);
    const fs::path next = fs::read_symlink(place, error);
    if (error) fail_writing(file, error.value());
    place = next.is_absolute() ? next : place.parent_path() / next;
  }
  if (!is_new && ::access(place.c_str(), W_OK) != 0) fail_writing(file, errno);
  return {place, false};
}

void write_text_atomically(const fs::path& given, std::string_view text) {
  const WrittenPlace place = written_place(given);
  if (place.in_place) return write_in_place(given, text);
  const fs::path& file = place.path;
  require_directory_of(file);
  const Temporary temporary(file);
  ::unlink(temporary.path().c_str());  // of a process of the same number that was killed
  Descriptor written(temporary.path(), O_WRONLY | O_CREAT | O_EXCL);
  if (!written) fail_writing(file, errno);
  write_all(written.get(), file, text);
  take_over(written, file);
  // Some file systems report a full disk only when they flush or close.
  if (::fsync(written.get()) != 0 || !written.close()) fail_writing(file, errno);
  if (::rename(temporary.path().c_str(), file.c_str()) != 0) fail_writing(file, errno);
  // The rename itself must outlive a power failure too. Not every file system can flush a directory: the file
  // is complete under its name by now, so that is no error.
  const Descriptor directory(directory_of(file), O_RDONLY | O_DIRECTORY);
  if (directory) ::fsync(directory.get());
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
