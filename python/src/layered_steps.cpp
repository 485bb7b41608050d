// LayeredMesh.update(), LayeredStep and LayeredTrial.

#include "living_layers.h"
#include "living_steps.h"
#include "remodel/error.h"

namespace remodel::python {
namespace {

py::array_t<std::uint8_t> layered_fates(const LayeredStepRecord& step) {
  if (!step.before)
    throw Error(ErrorCode::argument, "step", "its arrays were not kept, expected update(..., record=True)");
  const std::vector<Fate> all = fates(*step.before, *after_step(step));
  py::array_t<std::uint8_t> result(static_cast<py::ssize_t>(all.size()));
  for (std::size_t i = 0; i < all.size(); ++i) result.mutable_data()[i] = static_cast<std::uint8_t>(all[i]);
  return result;
}

void add_layered_step(py::module_& module) {
  py::class_<LayeredStepRecord, std::shared_ptr<LayeredStepRecord>> type(
      module, "LayeredStep",
      "What LayeredMesh.update() did. Cells are those of the whole: layer and outside.");
  const auto figure = [&](const char* name, auto member, const char* doc) {
    type.def_property_readonly(
        name, [member](const LayeredStepRecord& s) { return s.result.*member; }, doc);
  };
  figure("cells_before", &LayeredRemodelResult::triangles_before, "Cells before the step.");
  figure("cells", &LayeredRemodelResult::triangles, "Cells after it.");
  figure("preserved", &LayeredRemodelResult::preserved,
         "Old cells that are still there, with unmoved corners.");
  figure("connected", &LayeredRemodelResult::connected,
         "Old cells whose corners are still joined, moved or not.");
  figure("moved", &LayeredRemodelResult::moved, "Vertices at another place.");
  figure("inserted", &LayeredRemodelResult::inserted, "New vertices.");
  figure("removed", &LayeredRemodelResult::removed, "Removed vertices.");
  figure("same_columns", &LayeredRemodelResult::same_columns,
         "Whether the layer's connectivity is what it was: no station or fan has changed.");
  figure("full_adjustment", &LayeredRemodelResult::full_adjustment,
         "Whether the outer mesh's connectivity is what it was.");
  figure("flipped", &LayeredRemodelResult::flipped, "Edges flipped, outside the layer.");
  figure("morphed", &LayeredRemodelResult::morphed, "Whether the interior moved along with the boundary.");
  figure("refreshed", &LayeredRemodelResult::refreshed,
         "Whether the strategy generated the outer mesh afresh.");
  figure("regenerated", &LayeredRemodelResult::regenerated,
         "Whether the step could not be completed, and the outer mesh was generated afresh.");
  figure("abandoned", &LayeredRemodelResult::abandoned,
         "With regenerate=False: the step could not be completed, and the mesh is as it was.");
  figure("held", &LayeredRemodelResult::held, "Whether the outer mesh is a morph of its reference.");
  figure("reason", &LayeredRemodelResult::reason, "Why it was generated afresh or abandoned.");
  type.def_property_readonly(
      "preserved_percent", [](const LayeredStepRecord& s) { return s.result.preserved_percent(); },
      "Cells that are there still, with all corners where they were, of those before.");
  type.def_property_readonly(
      "connectivity_percent", [](const LayeredStepRecord& s) { return s.result.connectivity_percent(); },
      "Cells whose corners are joined still, moved or not, of those before.");
  type.def_property_readonly("fates", &layered_fates,
                             "Per cell of `after`, with record=True: 0 kept, 1 moved, 2 new.");
  add_step_parts(type);
  type.def("__repr__", [](const LayeredStepRecord& step) {
    return "LayeredStep(" + std::to_string(step.result.triangles) +
           " cells, preserved_percent=" + std::to_string(step.result.preserved_percent()) + ")";
  });
}

LayersPointer layers_at(LivingLayers& mesh, const py::object& shape, const std::string& boundary) {
  const ThreadLock::Held held(mesh.lock);
  const Domain domain = next_domain(mesh.mesh, shape, boundary);
  py::gil_scoped_release released;
  return layers_alive(mesh_at(mesh.mesh, domain, own_strategy(mesh.mesh.outer(), mesh.follows)),
                      mesh.follows);
}

}  // namespace

Snapshot after_layered_step(const py::object& step) {
  if (!py::isinstance<LayeredStepRecord>(step)) return nullptr;
  return after_step(step.cast<const LayeredStepRecord&>());
}

void add_layered_changes(py::module_& module) {
  py::class_<LayeredChanges, Changes, std::shared_ptr<LayeredChanges>>(
      module, "LayeredChanges",
      "The changes of one step of a LayeredMesh: vertices of the whole by key, triangles outside the layer "
      "by "
      "the ids of the outer mesh.")
      .def(record_pickle<LayeredChanges>())
      .def_readonly("layer_born", &LayeredChanges::layer_born, "Cells of the layer that join other vertices.")
      .def_readonly("layer_gone", &LayeredChanges::layer_gone, "Cells of the layer that are gone for them.");
  add_layered_step(module);
  add_trial<LivingLayers>(module, "LayeredTrial", "The LayeredStep to the design that is tried.");
}

void add_layered_steps(py::class_<LivingLayers, LayersPointer>& type) {
  add_update(
      type,
      R"(Remodels to a Domain, or to an Airfoil (or the name or file of one) in the place of the one called `boundary`,
on the same stations; returns a LayeredStep. strategy: 'renew', 'morph', 'reference' or another of Mesh.update(), which
has the other arguments too. Where anything is refused the mesh is as it was. Raises ArgumentError and GeometryError;
Ctrl-C ends it.)");
  type.def(
      "at", &layers_at, "shape"_a, py::kw_only(), "boundary"_a = "",
      "A copy at another design with the same connectivity; shape and boundary as update()'s. Its interior "
      "goes as jvp(interior='own') says: along after update(strategy='reference'), otherwise it stays. "
      "Raises TopologyChanged where there is no valid one.");
}

}  // namespace remodel::python
