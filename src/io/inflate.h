#pragma once

// Decompression whose result cannot be larger than announced: what a file says of itself is not trusted.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace remodel::io {

// The numbers of a mesh, compressed, become 3 to 60 times as large: what a file becomes in all, of which more
// than a hundredfold is refused before it is read.
inline constexpr std::size_t largest_growth = 100;
inline constexpr std::size_t always_allowed = std::size_t{1} << 20;

// The `size` bytes that a zlib stream (RFC 1950) holds; none if the stream is damaged or holds more or fewer.
// Memory for `size` bytes is taken whatever the stream holds: the caller bounds it.
std::optional<std::string> inflated(std::string_view stream, std::size_t size);

}  // namespace remodel::io
