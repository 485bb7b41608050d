#pragma once

// What a user should know although the command went on: a line each on standard error, and `warnings` of the
// JSON report.

#include <string>
#include <vector>

namespace remodel::app {

// Prints the sentence at once, and keeps it for the report; the same sentence once.
void warn(const std::string& sentence);
void warn(const std::vector<std::string>& sentences);

// All so far.
const std::vector<std::string>& warnings();

}  // namespace remodel::app
