#pragma once

// The native state of a mesh as a dict of arrays, for pickles: a mesh that was pickled goes on to the same
// bytes.

#include "bindings.h"
#include "remodel/mesh_state.h"

namespace remodel::python {

py::dict dict_of(const MeshState& state);
// Throws Error (format) for another dict, naming the key.
MeshState state_of(const py::dict& dict);

// convert(dict[key]), or Error (format) naming the key.
template <class Convert>
void read_member(const py::dict& dict, const char* key, Convert convert) {
  try {
    convert(dict[key]);
  } catch (const std::exception&) {
    throw Error(ErrorCode::format, "pickle",
                std::string("'") + key + "' is missing or of another kind, expected the state of a mesh");
  }
}

}  // namespace remodel::python
