#pragma once

// Small input angles. Where two boundary edges meet at less than 60 degrees inside the domain, refinement by
// diametral circles would never end: each split of one edge encroaches on the other. The remedy of the
// literature (Ruppert 1995, Shewchuk 2002, "seditious edges"): edges at such a corner are split at distances
// from it that are powers of two, so that splits of both edges lie on the same circles, and a triangle is
// exempt from the bounds on quality if its shortest edge joins two such splits of one corner.

#include <vector>

#include "mesh/mesh_data.h"

namespace remodel {

class SmallAngles {
 public:
  // Looks at the boundary table alone: its edges need not be in the triangulation.
  explicit SmallAngles(const MeshData& mesh) : mesh_(mesh) {}

  std::size_t count() const;  // of small corners: O(boundary vertices)
  // Whether the boundary vertex is a corner of less than 60 degrees inside the domain.
  bool is_corner(VertexId v) const;
  // Whether the edge a-b joins two edges at one small corner at the same distance from it.
  bool seditious(VertexId a, VertexId b) const;
  // Whether the triangle is exempt: its shortest edge is seditious.
  bool exempt(const Triangle& triangle) const;
  // Where on (0, 1) of its length a segment with a small corner at its start is split: at a power of two.
  static double shell_fraction(double length);

 private:
  const MeshData& mesh_;
};

// The triangles of the domain that are bad and exempt. O(triangles) where there are small angles.
std::size_t count_exempt(const MeshData& mesh);

}  // namespace remodel
