#pragma once

// The native state of a mesh as a dict of arrays, for pickles: a mesh that was pickled goes on to the same
// bytes.

#include "bindings.h"
#include "remodel/mesh_state.h"

namespace remodel::python {

py::dict dict_of(const MeshState& state);
// Throws Error (format) for another dict, naming the key.
MeshState state_of(const py::dict& dict);

}  // namespace remodel::python
