// Binary .msh files, built byte by byte as Gmsh's manual says.

#include <gtest/gtest.h>

#include <cstring>

#include "io/formats.h"
#include "io/test_meshes.h"
#include "remodel/error.h"

namespace remodel {
namespace {

class Bytes {
 public:
  Bytes& text(const std::string& value) {
    bytes_ += value;
    return *this;
  }
  template <class Value>
  Bytes& add(Value value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes_.append(raw, sizeof value);
    return *this;
  }
  Bytes& ints(std::initializer_list<std::int32_t> values) {
    for (const std::int32_t value : values) add(value);
    return *this;
  }
  Bytes& sizes(std::initializer_list<std::uint64_t> values) {
    for (const std::uint64_t value : values) add(value);
    return *this;
  }
  const std::string& get() const { return bytes_; }

 private:
  std::string bytes_;
};

void begin(Bytes& out, const std::string& version, const FrozenMesh& mesh) {
  out.text("$MeshFormat\n" + version + " 1 8\n").ints({1}).text("\n$EndMeshFormat\n");
  out.text("$PhysicalNames\n" + std::to_string(mesh.boundaries.size()) + "\n");
  for (std::size_t k = 0; k < mesh.boundaries.size(); ++k)
    out.text("1 " + std::to_string(k + 11) + " \"" + mesh.boundaries[k].name + "\"\n");
  out.text("$EndPhysicalNames\n");
}

// Curve k has the tag k + 1 and the physical group k + 11. A section in between says nothing to us.
std::string version_41(const FrozenMesh& mesh) {
  Bytes out;
  begin(out, "4.1", mesh);
  out.text("$Entities\n").sizes({1, mesh.boundaries.size(), 1, 0});
  out.ints({1}).add(0.0).add(0.0).add(0.0).sizes({0});
  for (std::int32_t k = 0; k < static_cast<std::int32_t>(mesh.boundaries.size()); ++k) {
    out.ints({k + 1});
    for (int i = 0; i < 6; ++i) out.add(0.0);
    out.sizes({1}).ints({k + 11}).sizes({2}).ints({1, 1});
  }
  out.ints({1});
  for (int i = 0; i < 6; ++i) out.add(0.0);
  out.sizes({0, 1}).ints({1}).text("\n$EndEntities\n$Comments\n\x01\x02 bytes \xff\n$EndComments\n");
  const std::uint64_t points = mesh.points.size();
  out.text("$Nodes\n").sizes({1, points, 1, points}).ints({2, 1, 0}).sizes({points});
  for (std::uint64_t i = 1; i <= points; ++i) out.sizes({i});
  for (const Point p : mesh.points) out.add(p.x).add(p.y).add(0.0);
  std::uint64_t elements = mesh.cell_count(), tag = 0;
  for (const FrozenBoundary& boundary : mesh.boundaries) elements += boundary.edges.size();
  out.text("\n$EndNodes\n$Elements\n").sizes({mesh.boundaries.size() + 2, elements, 1, elements});
  for (std::size_t k = 0; k < mesh.boundaries.size(); ++k) {
    out.ints({1, static_cast<std::int32_t>(k) + 1, 1}).sizes({mesh.boundaries[k].edges.size()});
    for (const auto& [a, b] : mesh.boundaries[k].edges)
      out.sizes({++tag, a + std::uint64_t{1}, b + std::uint64_t{1}});
  }
  out.ints({2, 1, 3}).sizes({mesh.quads.size()});  // first, as any order may come
  for (const auto& quad : mesh.quads) {
    out.sizes({++tag});
    for (const std::uint32_t v : quad) out.sizes({v + std::uint64_t{1}});
  }
  out.ints({2, 1, 2}).sizes({mesh.triangles.size()});
  for (const auto& [a, b, c] : mesh.triangles)
    out.sizes({++tag, a + std::uint64_t{1}, b + std::uint64_t{1}, c + std::uint64_t{1}});
  return out.text("\n$EndElements\n").get();
}

std::string version_22(const FrozenMesh& mesh) {
  Bytes out;
  begin(out, "2.2", mesh);
  out.text("$Nodes\n" + std::to_string(mesh.points.size()) + "\n");
  std::int32_t number = 0;
  for (const Point p : mesh.points) out.ints({++number}).add(p.x).add(p.y).add(0.0);
  std::size_t elements = mesh.cell_count();
  for (const FrozenBoundary& boundary : mesh.boundaries) elements += boundary.edges.size();
  out.text("\n$EndNodes\n$Elements\n" + std::to_string(elements) + "\n");
  const auto node = [](std::uint32_t index) { return static_cast<std::int32_t>(index) + 1; };
  number = 0;
  for (std::int32_t k = 0; k < static_cast<std::int32_t>(mesh.boundaries.size()); ++k)
    for (const auto& [a, b] : mesh.boundaries[static_cast<std::size_t>(k)].edges)
      out.ints({1, 1, 2, ++number, k + 11, k + 1, node(a), node(b)});  // a block of one
  out.ints({2, static_cast<std::int32_t>(mesh.triangles.size()), 2});
  for (const auto& [a, b, c] : mesh.triangles) out.ints({++number, 1, 1, node(a), node(b), node(c)});
  if (!mesh.quads.empty()) out.ints({3, static_cast<std::int32_t>(mesh.quads.size()), 2});
  for (const auto& [a, b, c, d] : mesh.quads)
    out.ints({++number, 1, 1, node(a), node(b), node(c), node(d)});
  return out.text("\n$EndElements\n").get();
}

TEST(BinaryMsh, BothVersionsAreReadExactly) {
  for (const FrozenMesh& mesh : {test::graded_ring(24, 6), test::mixed_ring()})
    for (const std::string& bytes : {version_41(mesh), version_22(mesh)}) {
      const FrozenMesh read = io::parse_msh(bytes, "m.msh");
      EXPECT_EQ(read.points, mesh.points);
      EXPECT_EQ(read.triangles, mesh.triangles);
      EXPECT_EQ(read.quads, mesh.quads);
      ASSERT_EQ(read.boundaries.size(), mesh.boundaries.size());
      for (std::size_t k = 0; k < mesh.boundaries.size(); ++k) {
        EXPECT_EQ(read.boundaries[k].name, mesh.boundaries[k].name);
        EXPECT_EQ(read.boundaries[k].edges.size(), mesh.boundaries[k].edges.size());
      }
    }
}

TEST(BinaryMsh, WhatIsCutOffOrDamagedIsRefusedOrReadAsSomethingElse) {
  const FrozenMesh mesh = test::graded_ring(12, 3);
  for (const std::string& bytes : {version_41(mesh), version_22(mesh)}) {
    const auto read = [](const std::string& text) {
      try {
        io::parse_msh(text, "m.msh");
        return true;
      } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return false;
      }
    };
    ASSERT_TRUE(read(bytes));
    for (std::size_t size = 0; size + 14 < bytes.size(); ++size)
      EXPECT_FALSE(read(bytes.substr(0, size))) << size;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      std::string changed = bytes;
      changed[i] = static_cast<char>(changed[i] ^ 0x81);
      read(changed);
    }
  }
}

TEST(BinaryMsh, FilesOfTheOtherByteOrderAreNamed) {
  std::string bytes = version_22(test::graded_ring(12, 3));
  const std::size_t one = bytes.find("2.2 1 8\n") + 8;
  std::swap(bytes[one], bytes[one + 3]);
  try {
    io::parse_msh(bytes, "m.msh");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "m.msh: byte 24: big-endian numbers found, little-endian ones expected");
  }
}

}  // namespace
}  // namespace remodel
