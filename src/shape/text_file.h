#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace remodel {

// Larger files are no airfoils and no designs.
inline constexpr std::size_t text_file_limit = std::size_t{16} << 20;

// The whole file. Throws Error (file) where it cannot be read, Error (format) where it is over the limit.
std::string read_text_file(const std::filesystem::path& file);

// Throws Error (format) where the text is over the limit.
void check_text_size(std::string_view text, const std::string& source);

}  // namespace remodel
