#pragma once

// Shared parts of the fuzz targets. A target asserts that no input crashes, hangs or breaks a stated
// invariant: readers refuse input with an Error, and whatever they accept can be used.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "remodel/check.h"
#include "remodel/error.h"
#include "remodel/frozen_mesh.h"

namespace remodel::fuzz {

// The number of inputs, or of steps of one, that ended with an Error; fuzz/driver.cpp prints it.
inline long refusals = 0;

[[noreturn]] inline void fail(const std::string& broken) {
  std::fprintf(stderr, "broken: %s\n", broken.c_str());
  std::abort();
}
inline void require(bool holds, const char* what) {
  if (!holds) fail(what);
}
inline void require_empty(const std::string& broken) {
  if (!broken.empty()) fail(broken);
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

// Reads values from the front of the input; zeros at its end.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  bool empty() const { return size_ == 0; }
  unsigned next() {
    if (size_ == 0) return 0;
    --size_;
    return *data_++;
  }
  unsigned below(unsigned n) { return n <= 256 ? next() % n : (next() << 8 | next()) % n; }
  std::uint64_t word() {
    std::uint64_t value = 0;
    for (int i = 0; i < 8; ++i) value = value << 8 | next();
    return value;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
};

// Checks a mesh that a reader has accepted: by the validator and, if it is small, by each writer in turn.
template <class Write>
void use(const FrozenMesh& mesh, Write write_and_read) {
  if (mesh.cell_count() > 64) return;
  check(mesh, {.min_angle_deg = 1.0, .max_gradation = 1.0});
  try {
    const FrozenMesh again = write_and_read(mesh);
    require(again.points == mesh.points && again.triangles == mesh.triangles && again.quads == mesh.quads,
            "what is written is read differently");
  } catch (const Error&) {
    // A name or number that the format cannot hold.
  }
}

}  // namespace remodel::fuzz
