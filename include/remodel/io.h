#pragma once

// Mesh files, by extension. Every writer writes beside the target and renames: a file appears whole or not at
// all. Every reader throws Error (file, format) naming the file, the place and what was expected.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "remodel/field.h"
#include "remodel/frozen_mesh.h"
#include "remodel/mesh.h"
#include "remodel/planar.h"

namespace remodel {

class LayeredMesh;  // remodel/layers.h
enum class LayerCells : std::uint8_t;

// The file to read that is standard input.
inline constexpr std::string_view standard_input = "-";

// foam: an OpenFOAM case, by an empty file in its directory (remodel/foam.h); written alone, never read.
enum class MeshFormat { vtkhdf, su2, msh, vtu, foam };
// The extension says the format. Throws Error (argument) for another, listing those that are known.
MeshFormat mesh_format(const std::filesystem::path& file);

// The name of a boundary in a file of the format. SU2 and OpenFOAM end a name at a blank: they have '_' in
// the place of each. Two names that would be one are refused when the file is written.
std::string name_in(MeshFormat format, const std::string& boundary);

// Named edges with cells on both sides, in .su2 files: SU2 takes every edge of a marker for a boundary,
// and computes the flow around a wall that is none.
enum class InnerCurves { left_out, markers };
struct WriteOptions {
  int msh_version = 41;  // 41: Gmsh 4.1, 22: Gmsh 2.2, both ASCII
  InnerCurves inner = InnerCurves::left_out;
  // Fields are written beside the mesh to .vtkhdf, .vtu and .msh files, as ParaView, meshio and Gmsh read
  // them; a .su2 file has no place for fields. Fields of two components are written with a third one, 0:
  // without it ParaView and Gmsh have no vectors. read_fields() takes it away again.
  // Throws Error (argument) unless they fit, see require_fit().
  std::span<const Field> fields = {};
  // The boxes for free-form deformation of .su2 files, see ReadNotes: for .su2 and .vtkhdf files. Others have
  // no place for them.
  std::string su2_boxes = {};
};
// The names that have such edges, in the order of the mesh's boundaries.
std::vector<std::string> inner_curves(const FrozenMesh& mesh);

// Writes the frozen view in any format; vtkhdf written like this holds no state to go on from.
void write_mesh(const FrozenMesh& mesh, const std::filesystem::path& file, const WriteOptions& options = {});
// vtkhdf with the full state, otherwise the frozen view.
void write_mesh(const Mesh& mesh, const std::filesystem::path& file, const WriteOptions& options = {});

// Notes are what is said of a file beside its mesh, and what goes along with it.
struct ReadNotes {
  // Sentences on what the file holds and the view has no place for, and on what was taken in another way than
  // it stands there (a mesh in another plane).
  std::vector<std::string> warnings;
  // SU2's boxes for free-form deformation, its lines as they are (FFD_NBOX= and what follows); no part of a
  // mesh.
  std::string su2_boxes;
  // Triangles that Gmsh's version 2 lists once for each of their physical groups: taken once, in the first
  // one.
  std::size_t repeated_triangles = 0;
  // Points that no cell uses (Gmsh saves the centres of arcs, and more with Mesh.SaveAll). The view leaves
  // them out, with the edges of boundaries that end there and a warning, and read_fields() their values.
  // kept_points has the file's number of each point of the view, from 0 on; it is empty where none is left
  // out.
  std::size_t unused_points = 0;
  std::vector<std::uint32_t> kept_points;
};
// Reads the frozen view of any format: triangles and quadrilaterals of first order, boundary by marker or
// physical name. What comes through a pipe without an extension is known by how it begins.
FrozenMesh read_frozen_mesh(const std::filesystem::path& file, ReadNotes* notes = nullptr);
// The boxes in a .su2 or .vtkhdf file, and those of a mesh whose points are no longer the file's:
// FFD_SURFACE_POINTS= name these by their numbers, and are left out (0; SU2_DEF sets them anew).
// surface_points: their number.
std::string read_su2_boxes(const std::filesystem::path& file);
std::string without_surface_points(const std::string& su2_boxes, std::size_t& surface_points);
// The fields of reals in a file, on the vertices and cells of read_frozen_mesh(): those on vertices
// first, in alphabetical order, without what belongs to the mesh itself (length_scale, parameter, ...). Left
// out are fields of more than three components, of integers or text, and in .msh files those that say nothing
// of some vertex or cell. A .su2 file has none. Vectors of other programs' files keep the third component,
// which is 0 in the plane.
std::vector<Field> read_fields(const std::filesystem::path& file);
// Reads a native mesh. A .vtkhdf without state, or another format, is an Error that says what was expected;
// so is (format) a mesh with layers, for which there are the calls below.
Mesh read_mesh(const std::filesystem::path& file);

// A layered mesh in any format, as freeze(cells) has it; quadrilaterals where there is no choice. A .vtkhdf
// file holds the outer mesh's state, the walls and the options of the layer too, and the rest is computed
// from these to the bit. Of that file read_frozen_mesh() has the whole view.
void write_mesh(const LayeredMesh& mesh, const std::filesystem::path& file, const WriteOptions& options,
                LayerCells cells);
void write_mesh(const LayeredMesh& mesh, const std::filesystem::path& file, const WriteOptions& options = {});
// True for a .vtkhdf file of a layered mesh with its state.
bool holds_layers(const std::filesystem::path& file);
// Throws Error as read_mesh() does, and for a native mesh without layers.
LayeredMesh read_layered_mesh(const std::filesystem::path& file);
// The outer mesh of a native file with layers; of any other, read_mesh().
Mesh read_outer_mesh(const std::filesystem::path& file);

// A written place is where writing to `file` puts its bytes.
struct WrittenPlace {
  std::filesystem::path path;  // what symbolic links lead to, so that they stay
  bool in_place = false;       // a device, a FIFO or a stream of this process: is written to as it stands
};
// Only regular files are replaced. Throws Error (file) for a directory, a socket, a regular file that may not
// be written, and a symbolic link to anything but a regular file (or none yet); /dev/stdout, /dev/stderr,
// /dev/fd/N and /proc/self/fd/N are streams of this process. Opens nothing.
WrittenPlace written_place(const std::filesystem::path& file);
// Every file that this project makes appears whole or not at all: the text is written beside it, flushed to
// the disk and renamed to it, with the mode and, where possible, the owner of the file that it replaces.
// Other hard links keep the old content, as with sed -i. What is written in place is written as by any
// program: a FIFO waits for its reader. Error (file) names the file and the system's reason.
void write_text_atomically(const std::filesystem::path& file, std::string_view text);

// This is what the file system refused, as an Error (file): the path and the system's reason.
Error file_error(const std::filesystem::filesystem_error& error);

// Standard input, a FIFO, or whatever else can be read but once.
bool is_pipe(const std::filesystem::path& file);
// While one lives, read_text() keeps what it reads from pipes: who asks again for the same one gets the same.
class KeptPipes {
 public:
  KeptPipes();
  ~KeptPipes();
  KeptPipes(const KeptPipes&) = delete;
  KeptPipes& operator=(const KeptPipes&) = delete;
};

// The whole file as text; Error (file) if it is missing, a directory, a device (but a terminal as standard
// input) or unreadable, Error (format) if it is larger than limit bytes, or a pipe that brings more than
// 2^31.
std::string read_text(const std::filesystem::path& file, std::size_t limit = std::size_t{1} << 32);

// Triangle's .poly file (https://www.cs.cmu.edu/~quake/triangle.poly.html): vertices, segments, holes,
// regions, whose attributes are their names; attributes and markers may be there or not, numbering starts at
// 0 or 1, comments begin with #. A file without vertices has them in the .node file of the same name. At most
// 256 MiB. Throws Error (file, format) naming file and line.
PlanarGraph read_poly(const std::filesystem::path& file);
// True if the file is one: it is called .poly, or is a pipe without an extension that begins with the first
// line of one, three or four whole numbers of which the second, the dimension, is 2.
bool holds_graph(const std::filesystem::path& file);
PlanarGraph parse_poly(std::string_view poly, const std::string& source, std::string_view node = {},
                       const std::string& node_source = {});

}  // namespace remodel
