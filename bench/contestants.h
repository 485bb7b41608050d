#pragma once

// The meshers that Remodel is compared with. All times are processor times in seconds.

#include <cstddef>

#include "remodel/domain.h"
#include "remodel/mesh.h"

namespace remodel::bench {

// The yardstick Y: CGAL's Delaunay_triangulation_2 (Epick kernel), 27,000 uniform random points inserted as a
// spatially sorted range; seconds per point.
double yardstick();

struct Contest {
  double seconds = 0.0;
  std::size_t triangles = 0;
  double min_angle_deg = 0.0;
};

// CGAL's Mesh_2 on the same stations, with the same bounds. Its size at a vertex is ours: the distance to the
// neighbour along the boundary, and inside the smallest of LS(u) + |uv| / G over the neighbours u.
Contest cgal_mesh(const Domain& domain, const QualityOptions& options);

// The command gmsh, on the same stations: its size field is the boundary's spacing plus distance / G. The
// time is the one that Gmsh reports for the surface mesh. The result has no triangles if the command is not
// installed.
Contest gmsh_mesh(const Domain& domain, const QualityOptions& options);

}  // namespace remodel::bench
