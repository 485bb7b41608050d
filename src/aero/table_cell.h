#pragma once

// Cells of a table of values between commas (RFC 4180).

#include <string>
#include <vector>

namespace remodel {

// The shortest text that reads as the same double; nothing for what is not a number.
std::string table_cell(double value);
// Quoted where it has a comma, a quote or a line's end.
std::string table_cell(const std::string& text);
// Sentences as one, with "; " between them.
std::string joined(const std::vector<std::string>& sentences);

}  // namespace remodel
