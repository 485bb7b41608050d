#pragma once

// A table as an HDF5 file: an array for each column, with names that the caller gives.

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace remodel::io {

struct FileColumn {
  std::string path;  // "/flows/cl"; groups on the way are made
  std::variant<std::vector<double>, std::vector<std::int64_t>, std::vector<std::uint8_t>,
               std::vector<std::string>>
      values;
  std::size_t width = 1;  // values of a row; of texts 1
};
struct FileAttribute {
  std::string name;  // of the root
  std::string value;
};

// Whole or not at all; the same columns give the same bytes. Throws Error (file) naming the file.
void write_columns(const std::filesystem::path& file, const std::vector<FileColumn>& columns,
                   const std::vector<FileAttribute>& attributes);

}  // namespace remodel::io
