#pragma once

// Meshes and files that several tests of this layer use.

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include "remodel/error.h"
#include "remodel/frozen_mesh.h"

namespace remodel::test {

// A square of side 3 with a square hole of side 1: eight points, eight triangles, two boundaries.
inline FrozenMesh square_ring() {
  FrozenMesh mesh;
  mesh.points = {{0, 0}, {3, 0}, {3, 3}, {0, 3}, {1, 1}, {2, 1}, {2, 2}, {1, 2.1 - 0.1 / 3}};
  mesh.triangles = {{0, 1, 4}, {1, 5, 4}, {1, 2, 5}, {2, 6, 5}, {2, 3, 6}, {3, 7, 6}, {3, 0, 7}, {0, 4, 7}};
  mesh.boundaries = {{"outer", {{0, 1}, {1, 2}, {2, 3}, {3, 0}}}, {"hole", {{4, 7}, {7, 6}, {6, 5}, {5, 4}}}};
  return mesh;
}

// The square ring with quadrilaterals in the place of four of its triangles, and a region of their own.
inline FrozenMesh mixed_ring() {
  FrozenMesh mesh = square_ring();
  mesh.triangles.erase(mesh.triangles.begin(), mesh.triangles.begin() + 4);
  mesh.quads = {{0, 1, 5, 4}, {1, 2, 6, 5}};
  mesh.region_names = {"outside", "layer"};
  mesh.region = {0, 0, 0, 0, 1, 1};
  return mesh;
}

// The same with everything that only our own meshes carry.
inline FrozenMesh full_square_ring() {
  FrozenMesh mesh = square_ring();
  mesh.length_scale = {3, 3, 3, 3, 1, 1.0 / 3, 1e-300, 0.1};
  mesh.vertex_ids = {7, 6, 5, 4, 3, 2, 1, 4000000000U};
  mesh.triangle_ids = {10, 11, 12, 13, 14, 15, 16, 17};
  mesh.birth = {0, 1, 0, 2, 0, 0, 0, 9};
  mesh.curve = {0, 0, 0, 0, 1, 1, 1, -1};
  mesh.parameter = {0, 0.25, 0.5, 0.75, 0, 0.25, 0.5, 0};
  return mesh;
}

// A graded ring of triangles, about 2 * around * outward of them.
inline FrozenMesh graded_ring(std::uint32_t around, std::uint32_t outward) {
  FrozenMesh mesh;
  for (std::uint32_t j = 0; j <= outward; ++j) {
    const double radius = 0.5 * std::pow(50.0, static_cast<double>(j) / outward);
    for (std::uint32_t i = 0; i < around; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i + 0.5 * j) / around;
      mesh.points.push_back({0.5 + radius * std::cos(angle), radius * std::sin(angle)});
    }
  }
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return j * around + i % around; };
  mesh.boundaries = {{"inner", {}}, {"outer", {}}};
  for (std::uint32_t j = 0; j < outward; ++j) {
    for (std::uint32_t i = 0; i < around; ++i) {
      mesh.triangles.push_back({at(i + 1, j), at(i, j), at(i, j + 1)});
      mesh.triangles.push_back({at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
    }
  }
  for (std::uint32_t i = 0; i < around; ++i) {
    mesh.boundaries[0].edges.push_back({at(around - i, 0), at(around - i - 1, 0)});
    mesh.boundaries[1].edges.push_back({at(i, outward), at(i + 1, outward)});
  }
  return mesh;
}

// A directory of its own for each test, removed afterwards.
class Scratch {
 public:
  Scratch() {
    std::string pattern = (std::filesystem::temp_directory_path() / "remodel-test-XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  ~Scratch() { std::filesystem::remove_all(path_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// The message of the Error that call throws; empty if it throws none.
template <class Call>
std::string error_of(Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace remodel::test
