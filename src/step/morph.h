#pragma once

// Strategy::morph: a step that keeps connectivity. Boundary vertices come to their places on the new design,
// the interior makes room, and what that spoils is mended by moves of single vertices. Nearly all triangles
// go on joining the vertices that they joined before. docs/morph.md has figures.
//
// The two ways, the cheaper first (Step makes them as two attempts):
//
//   Interior::still   Boundary vertices alone move, then single vertices beside them are relaxed. That has to
//                     be enough: nothing may miss a bound afterwards.
//   Interior::along   The whole interior moves along with the walls, then is relaxed. Edges that are not
//                     Delaunay after that are flipped. What misses a bound after that is left to refinement.
//
// The displacement u of the interior (wall_field.h) is the inverse-distance mean of E. Luke, E. Collins and
// E. Blades, "A fast mesh deformation method using explicit interpolation", J. Comput. Phys. 231, 2012. Each
// boundary edge asks for a local similarity, the mean weighs it by length / distance^4. Near a wall u is the
// wall's own displacement, rotation and stretching included; beyond a reach about what moves it is zero.
//
// A large change is made in parts (Morph::all()):
//
//   1. part = all that is left of the way.
//   2. u is computed for all that is left of the way, at the places that the vertices have now.
//   3. Boundary vertices go the part of their straight way, interior vertices the same share of u.
//   4. If a triangle turns over (orient2d() <= 0, exact), all go back and the part is halved; on from 3.
//   5. Otherwise relaxation and flips make the mesh good and Delaunay. While some of the way is left, on
//      from 2 with a part of the same size.
//
// The smallest part is a 64th. After twelve tries, failed ones included, the morph fails: a replacement is
// cheaper then and keeps as much. So the loop ends, and every state between two parts is a valid mesh.
//
// Relaxation (relax.h) treats what is off its bound by little. A vertex v of the interior owns the sum
//
//   E(v) = sum over its terms of max(0, m - s)^2,   m = 0.01,
//
// over the triangles of its star (s: one minus the squared radius over the largest allowed one) and the edges
// of its star and rim (s: the sum of the cotangents of the two opposite angles, positive where the edge is
// Delaunay). These are all terms that its place decides, so that a move that lowers E(v) lowers the sum over
// the whole mesh. v goes downhill by compass search: eight places around it, at a reach that starts at a
// tenth of its shortest edge and is halved where no place is a tenth better. The move is taken if v still
// sees its whole rim, by exact predicates. Vertices are queued by the triangles and edges that miss a bound;
// a sweep queues the next one. Sweeps end after eight, or where one leaves more than seven tenths of its
// queue. Sources: L. A. Freitag and C. Ollivier-Gooch, "Tetrahedral mesh improvement using swapping and
// smoothing", Int. J. Numer. Meth. Engng 40, 1997; here only what misses a bound is moved.

#include <optional>

#include "step/adjust.h"

namespace remodel {

enum class Interior { still, along };

// Precondition: a journal, and adjust_all() returned false. Returns the vertices that are at other places, in
// the mesh's arena. Returns nothing where triangles turn over in the smallest part too, where the tries are
// used up, or where a still interior is not enough: then the caller takes the step back. Refinement has to
// look at what misses `bounds` on angles and gradation after all. Throws RecoveryError where the hull crosses
// itself.
std::optional<List<VertexId>> morph_mesh(MeshData& mesh, AdjustCache& cache, const Domain& domain,
                                         Interior interior, const QualityBounds& bounds);

}  // namespace remodel
