#pragma once

// How many triangles a mesh should have, without generating another one.
//
// Words: the *size* of a mesh is S = sum over the domain triangles of area / (H LS)^2, with the mean of
// 1 / LS^2 over the three vertices. It depends on the design and hardly on the triangles, and fresh meshes of
// one discretisation and gradation have nearly the same number of triangles per size, whatever the design:
// the *count factor* K. A mesh of N triangles has a surplus of about N / (K S) - 1.

#include "mesh/mesh_data.h"
#include "remodel/generate.h"

namespace remodel {

// S: O(triangles).
double size_of(const MeshData& mesh);
// N / S.
double triangles_per_size(const MeshData& mesh);

// A fresh mesh of the same domain, made to H times a factor of at most 1. A triangle count is chaotic: meshes
// whose factors differ by a tenth of a percent are independent samples. Their count is in proportion to
// 1 / h_factor^2.
GenerateResult fresh_sample(const MeshData& like, double h_factor, StepObserver* observer);
// K from that many samples; those that cannot be finished are left out. 0 if none can be.
double measured_count_factor(const MeshData& mesh, int samples, StepObserver* observer);

}  // namespace remodel
