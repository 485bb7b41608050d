#pragma once

// Replaces the airfoil of a mesh's domain by another one.

#include "remodel/airfoil.h"
#include "remodel/domain.h"
#include "start_mesh.h"

namespace remodel::app {

// The discretisation that airfoil_domain() was given, read back from its result.
AirfoilDomainOptions discretisation_of(const Domain& domain);

// A new outline keeps the stations of the old one of its name, where that has curves of the same kinds. False
// where there is none.
bool take_stations(Loop& loop, const Domain& before);

// Returns the mesh's domain with the given airfoil. In a generated mesh without a named boundary, opening or
// closing the trailing edge builds the domain anew; otherwise all other loops are kept.
Domain with_new_airfoil(const StartMesh& start, const StartMeshOptions& options, const CstAirfoil& airfoil);

// The airfoil of the mesh: its own design, or a fit to its boundary.
CstAirfoil present_airfoil(const StartMesh& start, const StartMeshOptions& options, int degree);

}  // namespace remodel::app
