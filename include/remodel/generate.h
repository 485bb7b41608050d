#pragma once

// A fresh quality mesh of a domain by Delaunay refinement. Source: the paper's section 2; J. Ruppert, 1995;
// J. R. Shewchuk, "Delaunay Refinement Algorithms for Triangular Mesh Generation", 2002.

#include "remodel/mesh.h"

namespace remodel {

struct GenerateResult {
  Mesh mesh;
  Stopped stopped = Stopped::done;
  std::size_t small_angles = 0;  // vertices where boundary edges meet at less than 60 degrees in the domain
  std::size_t exempt_triangles =
      0;  // beyond a bound because of one of these: their shortest edge joins its sides
};

// Throws Error (argument) for options out of range, Error (geometry) for a domain that validate() refuses.
GenerateResult generate(const Domain& domain, const QualityOptions& options = {},
                        StepObserver* observer = nullptr);

}  // namespace remodel
