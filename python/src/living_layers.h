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

// As LivingMesh.
struct LivingLayers {
  LayeredMesh mesh;
  bool follows = false;  // whether its last step held it by its reference
  ThreadLock lock;
  Snapshot frozen;
  std::uint64_t version = 0;

  // Needs the lock.
  Snapshot freeze() {
    if (!frozen) frozen = std::make_shared<const FrozenMesh>(mesh.freeze());
    return frozen;
  }
  Snapshot snapshot() {
    const ThreadLock::Held held(lock);
    return freeze();
  }
  void changed() {
    frozen.reset();
    ++version;
  }
};
using LayersPointer = std::shared_ptr<LivingLayers>;

LayersPointer layers_alive(LayeredMesh mesh, bool follows = false);

// As StepRecord.
struct LayeredStepRecord {
  LayeredRemodelResult result;
  LayeredChanges changes;
  std::weak_ptr<LivingLayers> mesh;
  std::uint64_t version = 0;
  Snapshot before, after;
};

// How layers are asked for. By the Reynolds number, unless heights are given.
LayerOptions layer_of(const std::optional<double>& reynolds, const std::string& model,
                      const std::optional<double>& first_height, const std::optional<double>& thickness,
                      double growth, const std::vector<std::string>& walls);
// The usual distances between stations, times `factor`. Throws Error (argument) unless that is positive.
WallSpacing wall_spacing(double factor);

// update(), trial(), LayeredStep and LayeredTrial.
void add_layered_changes(py::module_& module);
void add_layered_steps(py::class_<LivingLayers, LayersPointer>& type);

}  // namespace remodel::python
