#pragma once

// Eigen for results that must be the same bytes with any compiler and optimisation level.
//
// Vector instructions change the order of Eigen's sums, so they are off. That alone would not do: a program
// that links this library may use Eigen with vector instructions itself, and the linker keeps one of two
// template instances of the same name. So this copy of Eigen lives in a namespace of its own. (Not to be
// included beside Eigen's own headers. The macro stays defined, because Eigen's own macros spell the
// namespace's name.)
//
// What is left to rely on: +, -, *, / and sqrt are correctly rounded, no compiler reorders them without
// -ffast-math, and -ffp-contract=off forbids fused operations: but g++ 12 makes fused vfmaddsub of
// straight-line code even so where the machine has them, unless -fno-tree-slp-vectorize.
// cmaes_determinism_test compares compilers.

#ifdef EIGEN_CORE_H
#error "include deterministic_eigen.h instead of Eigen's headers"
#endif
#ifndef EIGEN_DONT_VECTORIZE
#define EIGEN_DONT_VECTORIZE
#endif
#define Eigen remodel_deterministic_eigen
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
