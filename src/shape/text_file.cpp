#include "text_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#include "remodel/error.h"

namespace remodel {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

}  // namespace

void check_text_size(std::string_view text, const std::string& source) {
  if (text.size() > text_file_limit) {
    throw Error(ErrorCode::format, source, "more than 16 MiB, expected a small text file");
  }
}

std::string read_text_file(const std::filesystem::path& file) {
  const std::string source = file.string();
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) {
    throw Error(ErrorCode::file, source, "is a directory, expected a file");
  }
  const std::unique_ptr<std::FILE, CloseFile> stream(std::fopen(source.c_str(), "rb"));
  if (!stream) throw Error(ErrorCode::file, source, std::string("cannot be opened: ") + std::strerror(errno));
  std::string text;
  std::vector<char> block(std::size_t{1} << 16);
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), stream.get())) {
    text.append(block.data(), count);
    check_text_size(text, source);  // in the loop: the file may be a device without an end
  }
  if (std::ferror(stream.get()) != 0) {
    throw Error(ErrorCode::file, source, std::string("cannot be read: ") + std::strerror(errno));
  }
  return text;
}

}  // namespace remodel
