#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace remodel::io {

// Decodes at most `most` bytes. Blanks are passed over; padding may also stand in the middle, where two
// encoded pieces follow each other; another character ends the data. Nothing if the data is cut off.
std::optional<std::string> decode_base64(std::string_view text, std::size_t most);

}  // namespace remodel::io
