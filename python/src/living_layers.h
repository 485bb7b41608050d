#pragma once

// The objects behind LayeredMesh and LayeredStep of the module.

#include <memory>

#include "living.h"
#include "remodel/layers.h"

namespace remodel {

template <python::Is<LayeredRemodelResult> T>
auto members(T& r) {
  using Outer = std::conditional_t<std::is_const_v<T>, const RemodelResult, RemodelResult>;
  return std::tuple_cat(members(static_cast<Outer&>(r)), std::tie(r.layer_cells, r.shrunk, r.same_columns));
}
template <python::Is<LayeredChanges> T>
auto members(T& c) {
  using Outer = std::conditional_t<std::is_const_v<T>, const Changes, Changes>;
  return std::tuple_cat(members(static_cast<Outer&>(c)), std::tie(c.layer_born, c.layer_gone));
}

}  // namespace remodel

namespace remodel::python {

struct LivingLayers : Living<LayeredMesh> {
  using StepResult = LayeredRemodelResult;
  using StepChanges = LayeredChanges;
  using StepTrial = LayeredTrial;
};
using LayersPointer = std::shared_ptr<LivingLayers>;

LayersPointer layers_alive(LayeredMesh mesh, bool follows = false);

using LayeredStepRecord = StepOf<LivingLayers>;

// How layers are asked for. By the Reynolds number, unless heights are given.
LayerOptions layer_of(const std::optional<double>& reynolds, const std::string& model,
                      const std::optional<double>& first_height, const std::optional<double>& thickness,
                      double growth, const std::vector<std::string>& walls);
// The usual distances between stations, times `factor`. Throws Error (argument) unless that is positive.
WallSpacing wall_spacing(double factor);
// None without a length. Throws Error (argument) for an angle without one, and beyond 90 degrees.
std::optional<WakeLine> wake_line(const std::optional<double>& length, double angle_deg);

// update(), trial(), LayeredStep and LayeredTrial.
void add_layered_changes(py::module_& module);
void add_layered_steps(py::class_<LivingLayers, LayersPointer>& type);

}  // namespace remodel::python
