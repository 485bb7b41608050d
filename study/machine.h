#pragma once

#include <string>

namespace remodel {

// The machine that a study ran on, as JSON: processor, cores, memory_gb, system, compiler.
std::string machine_json();
// The current time in UTC, as ISO 8601 with seconds.
std::string time_now();

}  // namespace remodel
