#pragma once

// Replaces the airfoil of a mesh's domain by another one.

#include "remodel/airfoil.h"
#include "remodel/domain.h"
#include "remodel/shape_domain.h"
#include "start_mesh.h"

namespace remodel::app {

// Returns the mesh's domain with the given airfoil. In a generated mesh without a named boundary, opening or
// closing the trailing edge builds the domain anew; otherwise all other loops are kept.
Domain with_new_airfoil(const StartMesh& start, const StartMeshOptions& options, const CstAirfoil& airfoil);

// The airfoil of the mesh: its own design, or a fit to its boundary.
CstAirfoil present_airfoil(const StartMesh& start, const StartMeshOptions& options, int degree);

}  // namespace remodel::app
