#pragma once

// The settings that the designs, rows and meshes of a run depend on. A run is resumed with the same ones
// only.

#include <cstddef>
#include <filesystem>
#include <string>

#include "remodel/optimise.h"

namespace remodel {

// Throws Error (argument) for options out of range.
void require_good(const OptimiseOptions& options);

// All of it but the number of evaluations, as JSON text: compared as text.
std::string settings_of(const DesignSpace& space, const Designer& designer, const Evaluator& evaluator,
                        const OptimiseOptions& options);

// Throws Error (argument) naming the settings that differ.
void require_settings(const std::string& found, const std::string& expected,
                      const std::filesystem::path& directory);

}  // namespace remodel
