#pragma once

// Values of flows at points that are the same for all of them.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "remodel/flow.h"
#include "remodel/frozen_mesh.h"

namespace remodel {

// Where points lie in a mesh. Quadrilaterals are the two triangles of with_split_quads().
class TemplatePlaces {
 public:
  TemplatePlaces() = default;
  TemplatePlaces(const FrozenMesh& mesh, std::span<const Point> points);
  // Of values of the mesh's points, by linear interpolation in the triangle that holds a point, in the first
  // of several; not a number where none does: in the body, or beyond the far field.
  std::vector<double> at(const std::vector<double>& values) const;

 private:
  struct Place {
    std::array<std::uint32_t, 3> corners{};
    std::array<double, 3> weights{};
    bool is_in_mesh = false;
  };
  std::vector<Place> places_;
};

// The names of what template_values() has, one after the other.
std::vector<std::string> template_fields(FlowModel model);
// For each of these names the values at all places.
std::vector<double> template_values(const FlowResult& flow, const TemplatePlaces& places);

}  // namespace remodel
