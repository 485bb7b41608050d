#pragma once

// How a dataset of a file that nobody vouches for is stored. HDF5 itself opens whatever other files a dataset
// names, loads any filter's code from a directory of plugins, and lets the deflate filter grow a piece
// without bound.

#include <hdf5.h>

#include <cstddef>
#include <string>

namespace remodel::io {

// Why the dataset is not to be read, as "found X, expected Y"; empty if its values are in the file itself,
// behind no filters but deflate and shuffle. Opens and allocates nothing.
std::string storage_problem(hid_t set);

// A dataset may be stored in pieces ("chunks", the only layout with filters). Has each piece of this one just
// the bytes that it says it has, unpacked, and at most `most`? Then HDF5 can read it without surprises. No if
// a piece is missing: HDF5 would invent its values. Yes for a dataset that is stored in one place.
bool has_sound_pieces(hid_t set, std::size_t most);

}  // namespace remodel::io
