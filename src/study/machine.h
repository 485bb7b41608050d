#pragma once

#include <string>

namespace remodel {

// The machine that a study ran on, as JSON: processor, cores, memory_gb, system, compiler.
std::string machine_json();
// ISO 8601, UTC, to the second.
std::string time_now();

}  // namespace remodel
