#pragma once

// The text of a design problem as JSON, with the places of what is wrong in it.

#include <string>

#include <nlohmann/json.hpp>

namespace remodel {

using Json = nlohmann::ordered_json;

// Throws Error (format) naming the file, the line and the column where the text is no JSON, has a key twice
// in one object, a number that is too large, or more than 64 brackets inside each other. `expected`: what
// the file should hold, where it is no JSON.
Json parse_design_json(const std::string& text, const std::string& source,
                       const char* expected = "a design problem");

}  // namespace remodel
