#pragma once

// Before a function: it is compiled for AVX2 too, where REMODEL_DISPATCH is set, and which of the two runs is
// decided when the program is loaded. Both give the same bits, since vectors round as single numbers do, and
// nothing is contracted or reordered. (Not under instrumentation: the choice is made before a sanitizer has
// begun.)
#if defined(REMODEL_DISPATCH) && defined(__x86_64__)
#define REMODEL_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define REMODEL_VECTOR_CLONES
#endif
