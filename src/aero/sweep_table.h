#pragma once

#include <filesystem>
#include <vector>

#include "remodel/sweep.h"

namespace remodel {

// table.csv and table.h5, as docs/sweep.md has them. Throws Error (file).
void write_sweep_tables(const std::filesystem::path& directory, const SweepProblem& problem,
                        const std::vector<SweepFlow>& flows);

}  // namespace remodel
