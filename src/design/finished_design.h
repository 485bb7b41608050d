#pragma once

// A finished design of a checkpoint as JSON: the figures of its row by their names, and its evaluation.

#include <nlohmann/json.hpp>

#include "design/checkpoint.h"

namespace remodel {

nlohmann::json to_json(const FinishedDesign& design);
// Throws nlohmann::json::exception and std::invalid_argument for what to_json() has not written.
FinishedDesign finished_design_from(const nlohmann::json& json);

}  // namespace remodel
