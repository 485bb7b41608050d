#pragma once

#include <cstddef>

// Before a function: it is compiled for AVX2 too, where REMODEL_DISPATCH is set, and which of the two runs is
// decided when the program is loaded. Both give the same bits, since vectors round as single numbers do, and
// nothing is contracted or reordered. Not under sanitizers, which begin after that decision.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define REMODEL_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define REMODEL_SANITIZED
#endif
#endif
#if defined(REMODEL_DISPATCH) && defined(__x86_64__) && !defined(REMODEL_SANITIZED)
#define REMODEL_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define REMODEL_VECTOR_CLONES
#endif

namespace remodel {

// Numbers in the longest vector: rows are filled up to a multiple, and loops over them counted in vectors, so
// that the compiler need not add one for what is left.
inline constexpr std::size_t vector_lanes = 4;
inline constexpr std::size_t whole_vectors(std::size_t numbers) {
  return (numbers + vector_lanes - 1) / vector_lanes;
}

}  // namespace remodel
