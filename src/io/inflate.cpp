#include "io/inflate.h"

#include <zlib.h>

namespace remodel::io {

std::optional<std::string> inflated(std::string_view stream, std::size_t size) {
  std::string bytes(size, '\0');
  uLongf found = bytes.size();
  const auto* source = reinterpret_cast<const Bytef*>(stream.data());
  const int outcome = uncompress(reinterpret_cast<Bytef*>(bytes.data()), &found, source, stream.size());
  if (outcome != Z_OK || found != size) return std::nullopt;
  return bytes;
}

}  // namespace remodel::io
