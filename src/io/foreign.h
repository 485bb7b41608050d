#pragma once

// What formats of other programs hold and a plane mesh of triangles does not: said in sentences, or taken as
// it is meant.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "remodel/io.h"
#include "remodel/point.h"

namespace remodel::io {

// Sentences for people, each with the name of its file; nobody listens where there are no notes.
class Warnings {
 public:
  Warnings(ReadNotes* notes, std::string file) : notes_(notes), file_(std::move(file)) {}
  void count_repeated_triangle() const {
    if (notes_ != nullptr) ++notes_->repeated_triangles;
  }
  void add(const std::string& sentence) const {
    if (notes_ != nullptr) notes_->warnings.push_back(file_ + ": " + sentence);
  }
  // One that says how many points are left out, of which only those of `used` are kept, and how many edges
  // of boundaries with them.
  void note_unused_points(const std::vector<bool>& used, std::size_t edges) const;

 private:
  ReadNotes* notes_;
  std::string file_;
};

// "'a', 'b' and 3 more"; names in quotes, control characters escaped.
std::string listed(const std::vector<std::string>& names);

// What to do about cells of this kind, as the end of a sentence: empty, or ": cells of second order ...".
enum class CellKind { second_order, other };
std::string_view advice_on(CellKind kind);

// Points in space (3 numbers each, finite) of a mesh that lies in a plane, as points of that plane: x and y
// where z is the same everywhere but for rounding, else x and z, or y and z. Points that are not `used` may
// lie anywhere. Warns unless it is z = 0. Throws Error (format) naming a point that leaves the plane.
std::vector<Point> in_their_plane(std::span<const double> coordinates, const std::vector<bool>& used,
                                  const std::string& place, const Warnings& warnings);

}  // namespace remodel::io
