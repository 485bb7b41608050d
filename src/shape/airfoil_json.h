#pragma once

#include <nlohmann/json.hpp>

#include "json_reader.h"
#include "remodel/airfoil.h"

namespace remodel {

// The airfoil's part of a JSON text, alone or as a curve of a domain. reader: an object whose keys the caller
// has checked. Throws Error.
nlohmann::ordered_json json_of(const CstAirfoil& airfoil);
CstAirfoil airfoil_of(const JsonReader& reader);

}  // namespace remodel
