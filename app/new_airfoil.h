#pragma once

// Another airfoil in the place of a mesh's own.

#include "remodel/airfoil.h"
#include "remodel/domain.h"
#include "start_mesh.h"

namespace remodel::app {

// The discretisation that airfoil_domain() was given, read back from its result.
AirfoilDomainOptions discretisation_of(const Domain& domain);

// The mesh's domain with the airfoil in it. Where we made the mesh and no boundary is named, opening or
// closing its trailing edge builds the domain anew; otherwise all other loops stay as they are.
Domain with_new_airfoil(const StartMesh& start, const StartMeshOptions& options, const CstAirfoil& airfoil);

// The design that the mesh is around: its own, or fitted to its boundary.
CstAirfoil present_airfoil(const StartMesh& start, const StartMeshOptions& options, int degree);

}  // namespace remodel::app
