#pragma once

// The native file: HDF5 with two groups at its top.
//   /VTKHDF   the frozen view as VTKHDF 1.0 lays out an unstructured grid: ParaView opens it
//   /remodel  the living mesh: every array of MeshState, the domain as JSON, the options, a checksum
//   /remodel/layers  of a layered mesh, whose outer mesh the living one is: the walls as JSON, the options, the fans
// A file without /remodel is a picture of a mesh; nothing can go on from it.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "remodel/field.h"
#include "remodel/frozen_mesh.h"
#include "remodel/io.h"
#include "remodel/layers.h"
#include "remodel/mesh.h"
#include "remodel/mesh_state.h"

namespace remodel::io {

// state may be null. Written atomically.
void write_vtkhdf(const std::filesystem::path& file, const FrozenMesh& mesh, const MeshState* state,
                  const WriteOptions& options = {});
// With its state.
void write_vtkhdf(const std::filesystem::path& file, const Mesh& mesh, const WriteOptions& options = {});
void write_vtkhdf(const std::filesystem::path& file, const LayeredMesh& mesh, const WriteOptions& options,
                  LayerCells cells);

FrozenMesh read_vtkhdf_frozen(const std::filesystem::path& file, ReadNotes* notes = nullptr);
std::string read_vtkhdf_boxes(const std::filesystem::path& file);  // ReadNotes::su2_boxes
std::vector<Field> read_vtkhdf_fields(const std::filesystem::path& file);
// Throws Error (format) where the file has no state, or one that its checksum does not confirm.
MeshState read_vtkhdf_state(const std::filesystem::path& file);
bool holds_vtkhdf_layers(const std::filesystem::path& file);
LayeredState read_vtkhdf_layers(const std::filesystem::path& file);

// Over every value of the state and the domain's text, in the order of writing, independent of the machine.
// Any change of a single value changes it.
std::uint64_t checksum_of(const MeshState& state, const std::string& domain_text);

}  // namespace remodel::io
