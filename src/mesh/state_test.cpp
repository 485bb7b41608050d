// What a state says of its mesh is judged by the ranges that options have.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "remodel/error.h"
#include "remodel/generate.h"
#include "remodel/mesh_state.h"

namespace remodel {
namespace {

MeshState good_state() {
  const Domain square{
      {{.role = LoopRole::outer,
        .curves = {{"wall", Polyline{{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}}, {0.0, 0.25, 0.5, 0.75}}}}}};
  return generate(square, {}).mesh.state();
}

std::string refusal(const std::function<void(MeshState&)>& change) {
  MeshState state = good_state();
  change(state);
  try {
    Mesh::restore(state, "a.vtkhdf");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::format);
    return error.what();
  }
  return "accepted";
}

TEST(MeshState, ComesBackAsItWas) {
  EXPECT_EQ(Mesh::restore(good_state(), "a.vtkhdf").state(), good_state());
}

TEST(MeshState, NumbersOutsideOfTheRangesOfOptionsAreRefusedByName) {
  struct Case {
    const char* named;
    std::function<void(MeshState&)> change;
  };
  const Case cases[] = {
      {"resolution: found 0.0", [](MeshState& s) { s.options.resolution = 0.0; }},
      {"resolution: ", [](MeshState& s) { s.options.resolution = NAN; }},
      {"min_angle_deg: found 500000000000000000000", [](MeshState& s) { s.options.min_angle_deg = 5e20; }},
      {"min_angle_deg: ", [](MeshState& s) { s.options.min_angle_deg = -1.0; }},
      {"refine_angle_deg: ", [](MeshState& s) { s.options.refine_angle_deg = 35.0; }},
      {"gradation: ", [](MeshState& s) { s.options.gradation = -4.0; }},
      {"gradation: ", [](MeshState& s) { s.options.gradation = 1e300; }},
      {"max_gradation: ", [](MeshState& s) { s.options.max_gradation = 0.0; }},
      {"min_edge: ", [](MeshState& s) { s.options.min_edge = -1.0; }},
      {"keep: ", [](MeshState& s) { s.keep = 0.5; }},
      {"step 4294967295", [](MeshState& s) { s.step = 4294967295; }},
      {"of step 7 in a mesh of step 0", [](MeshState& s) { s.triangle_births.back() = 7; }},
      {"generation 4294967295", [](MeshState& s) { s.vertex_generations.back() = 4294967295; }},
      {"triangle count", [](MeshState& s) { s.renewal.count_factor = 1e300; }},
      {"triangle count", [](MeshState& s) { s.renewal.until_shed = 1000; }},
      {"beyond 1e60", [](MeshState& s) { s.coordinates[2] = 1e200; }},
      {"parameter",
       [](MeshState& s) {
         s.domain.loops[0].curves[0].parameters = {0.0, 0.5, 0.25, 0.75};
       }},
      {"placement", [](MeshState& s) { s.domain.loops[0].placement.chord = -1.0; }},
      {"", [](MeshState& s) { s.triangle_births.pop_back(); }},
  };
  for (const Case& one : cases) {
    const std::string found = refusal(one.change);
    EXPECT_NE(found.find(one.named), std::string::npos) << one.named << ": " << found;
    EXPECT_TRUE(found.starts_with("a.vtkhdf: not the state of a mesh: ")) << found;
  }
}

}  // namespace
}  // namespace remodel
