#pragma once

// The page of a run of `remodel design`: sections, pressures, Mach numbers, convergence, what it cost.

#include <filesystem>

#include "report.h"

namespace remodel::app {

// Reads the run, finds the flows around its first and its best section once more, and writes one page with
// everything in it. Returns its figures. Throws Error (file, format) for a directory that holds no such run.
Json write_design_report(const std::filesystem::path& run, const std::filesystem::path& page);

}  // namespace remodel::app
