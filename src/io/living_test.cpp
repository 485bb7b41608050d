// The living mesh in and out of its native file.

#include <gtest/gtest.h>

#include "io/mesh_bytes.h"
#include "io/test_meshes.h"
#include "io/vtkhdf.h"
#include "remodel/airfoil.h"
#include "remodel/generate.h"
#include "remodel/io.h"
#include "remodel/layers.h"
#include "remodel/mesh_state.h"
#include "remodel/remodel.h"

namespace remodel {
namespace {

using test::error_of;
using test::Scratch;

Mesh square_mesh() {
  Domain domain;
  domain.loops = {{LoopRole::outer,
                   {{"wall", Polyline{{{0, 0}, {1, 0}, {1, 1}}}, {0, 0.25, 0.5, 0.75}},
                    {"lid", Polyline{{{1, 1}, {0, 1}, {0, 0}}}, {0, 0.25, 0.5, 0.75}}}}};
  return generate(domain).mesh;
}

// The checksum is right: whoever forges a number can compute it.
TEST(LivingMesh, ASealedStateOutOfRangeIsRefusedWithItsFile) {
  const Scratch scratch;
  const auto file = scratch / "m.vtkhdf";
  const Mesh mesh = square_mesh();
  const auto refusal = [&](void (*change)(MeshState&)) {
    MeshState state = mesh.state();
    change(state);
    io::write_vtkhdf(file, mesh.freeze(), &state);
    return error_of([&] { read_mesh(file).step(); });
  };
  EXPECT_EQ(refusal([](MeshState&) {}), "");
  const std::string begin = file.string() + ": not the state of a mesh: ";
  EXPECT_EQ(refusal([](MeshState& s) { s.options.resolution = 0.0; }),
            begin + "resolution: found 0.000000, expected a number above 0 up to 1e6");
  EXPECT_EQ(refusal([](MeshState& s) { s.options.min_angle_deg = 5e20; }),
            begin + "min_angle_deg: found 500000000000000000000.000000, expected 0 to 34 degrees");
}

TEST(LivingMesh, ComesBackFromItsBytesWithTheSameState) {
  Mesh mesh = generate(airfoil_domain(named_airfoil("naca:0012", 5), {.points = 40})).mesh;
  const Domain next = airfoil_domain(named_airfoil("naca:0011", 5), {.points = 40});
  for (const Strategy strategy : {Strategy::renew, Strategy::reference}) {
    remodel(mesh, next, {.strategy = strategy});
    const std::string bytes = io::mesh_to_bytes(mesh);
    EXPECT_EQ(io::mesh_from_bytes(bytes, "here").state(), mesh.state());
    for (const std::size_t size : {bytes.size() - 1, bytes.size() / 2, std::size_t{3}, std::size_t{0}})
      EXPECT_NE(error_of([&] { io::mesh_from_bytes(bytes.substr(0, size), "here"); }), "") << size;
    EXPECT_EQ(error_of([&] { io::mesh_from_bytes(bytes + "x", "here"); }),
              "here: found other bytes than those of a mesh's state");
  }
}

TEST(LivingMesh, ComesBackFromItsFileWithTheSameStateAndTheSameBytes) {
  const Scratch scratch;
  const Mesh mesh = square_mesh();
  write_mesh(mesh, scratch / "a.vtkhdf");
  const Mesh back = read_mesh(scratch / "a.vtkhdf");
  EXPECT_EQ(back.state(), mesh.state());
  EXPECT_EQ(back.quick_check(), "");
  write_mesh(back, scratch / "b.vtkhdf");
  EXPECT_EQ(read_text(scratch / "a.vtkhdf"), read_text(scratch / "b.vtkhdf"));
}

LayeredMesh layered_mesh() {
  Domain domain = airfoil_domain(named_airfoil("naca:2412", 8));
  space_walls(domain, {.most = 0.03});
  LayeredMesh mesh =
      generate_layered(domain, {.first_height = 1e-4, .walls = {"airfoil"}}, {.gradation = 4.0}).mesh;
  Domain next = domain;
  next.loops[0].placement.rotation_deg = -1.0;
  remodel::remodel(mesh, next, {.strategy = Strategy::reference});
  return mesh;
}

TEST(LayeredMesh, ComesBackFromItsFileWithTheSameStateAndTheSameBytes) {
  const Scratch scratch;
  const LayeredMesh mesh = layered_mesh();
  for (const LayerCells cells : {LayerCells::quadrilaterals, LayerCells::triangles}) {
    write_mesh(mesh, scratch / "a.vtkhdf", {}, cells);
    ASSERT_TRUE(holds_layers(scratch / "a.vtkhdf"));
    const LayeredMesh back = read_layered_mesh(scratch / "a.vtkhdf");
    EXPECT_EQ(back.state(), mesh.state());
    EXPECT_EQ(back.quick_check(), "");
    write_mesh(back, scratch / "b.vtkhdf", {}, cells);
    EXPECT_EQ(read_text(scratch / "a.vtkhdf"), read_text(scratch / "b.vtkhdf"));
  }
}

TEST(LayeredMesh, ItsFrozenViewIsTheSameInEveryFormat) {
  const Scratch scratch;
  const LayeredMesh mesh = layered_mesh();
  const FrozenMesh frozen = mesh.freeze();
  for (const char* name : {"m.vtkhdf", "m.vtu", "m.su2", "m.msh"}) {
    write_mesh(mesh, scratch / name);
    const FrozenMesh back = read_frozen_mesh(scratch / name);
    EXPECT_EQ(back.points, frozen.points) << name;
    EXPECT_EQ(back.triangles, frozen.triangles) << name;
    EXPECT_EQ(back.quads, frozen.quads) << name;
    EXPECT_EQ(back.boundaries.size(), frozen.boundaries.size()) << name;
  }
}

TEST(LayeredMesh, IsNotTakenForOneWithoutLayersNorTheOtherWayRound) {
  const Scratch scratch;
  write_mesh(layered_mesh(), scratch / "layers.vtkhdf");
  write_mesh(square_mesh(), scratch / "square.vtkhdf");
  EXPECT_FALSE(holds_layers(scratch / "square.vtkhdf"));
  const std::string begin =
      (scratch / "layers.vtkhdf").string() + ":/remodel/layers: a mesh with layers found";
  EXPECT_TRUE(error_of([&] { read_mesh(scratch / "layers.vtkhdf").step(); }).starts_with(begin));
  EXPECT_NE(error_of([&] {
              read_layered_mesh(scratch / "square.vtkhdf").levels();
            }).find("/remodel/layers: not found"),
            std::string::npos);
  EXPECT_NE(error_of([&] { read_layered_mesh(scratch / "m.su2").levels(); }).find("another format found"),
            std::string::npos);
}

TEST(LivingMesh, ItsFrozenViewIsTheSameInEveryFormat) {
  const Scratch scratch;
  const Mesh mesh = square_mesh();
  const FrozenMesh frozen = mesh.freeze();
  for (const char* name : {"m.vtkhdf", "m.vtu", "m.su2", "m.msh"}) {
    write_mesh(mesh, scratch / name);
    const FrozenMesh back = read_frozen_mesh(scratch / name);
    EXPECT_EQ(back.points, frozen.points) << name;
    EXPECT_EQ(back.triangles, frozen.triangles) << name;
    ASSERT_EQ(back.boundaries.size(), frozen.boundaries.size()) << name;
    for (std::size_t k = 0; k < frozen.boundaries.size(); ++k) {
      EXPECT_EQ(back.boundaries[k].name, frozen.boundaries[k].name) << name;
      EXPECT_EQ(back.boundaries[k].edges, frozen.boundaries[k].edges) << name;
    }
  }
}

TEST(LivingMesh, IsNotReadFromAFileThatHoldsNoState) {
  const Scratch scratch;
  const Mesh mesh = square_mesh();
  for (const char* name : {"m.su2", "m.msh", "m.vtu", "m.vtkhdf"}) {
    write_mesh(mesh.freeze(), scratch / name);
    const std::string error = error_of([&] { read_mesh(scratch / name); });
    EXPECT_NE(error.find("expected, as `remodel mesh` makes it"), std::string::npos) << error;
  }
}

}  // namespace
}  // namespace remodel
