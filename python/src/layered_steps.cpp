// LayeredMesh.update(), LayeredStep and LayeredTrial.

#include "living_layers.h"
#include "remodel/error.h"

namespace remodel::python {
namespace {

using LayeredStepPointer = std::shared_ptr<LayeredStepRecord>;

LayeredStepPointer layers_updated(const LayersPointer& mesh, const py::object& shape,
                                  const std::string& boundary, double distance, const std::string& method,
                                  const std::string& strategy, bool regenerate, bool record,
                                  double delaunay_slack) {
  auto step = std::make_shared<LayeredStepRecord>();
  RemodelOptions options = remodel_options(distance, method, strategy, regenerate, delaunay_slack);
  const ThreadLock::Held held(mesh->lock);
  const Domain domain = next_domain(mesh->mesh.domain(), shape, boundary);
  if (record) step->before = mesh->freeze();
  step->result = interruptible([&](StepObserver& observer) {
    options.observer = &observer;
    const LayerMark mark = mesh->mesh.mark();
    LayeredRemodelResult result = remodel(mesh->mesh, domain, options);
    step->changes = mesh->mesh.changes_since(mark);
    mesh->changed();
    if (!result.abandoned) mesh->follows = options.strategy == Strategy::reference;
    return result;
  });
  step->mesh = mesh;
  step->version = mesh->version;
  if (record) step->after = mesh->freeze();
  return step;
}

Snapshot after_of(const LayeredStepRecord& step) {
  if (step.after) return step.after;
  if (const LayersPointer mesh = step.mesh.lock()) {
    const ThreadLock::Held held(mesh->lock);
    if (mesh->version == step.version) return mesh->freeze();
  }
  throw Error(ErrorCode::argument, "step",
              "its mesh has changed since or is not here, expected update(..., record=True)");
}

py::array_t<std::uint8_t> layered_fates(const LayeredStepRecord& step) {
  if (!step.before)
    throw Error(ErrorCode::argument, "step", "its arrays were not kept, expected update(..., record=True)");
  const std::vector<Fate> all = fates(*step.before, *after_of(step));
  py::array_t<std::uint8_t> result(static_cast<py::ssize_t>(all.size()));
  for (std::size_t i = 0; i < all.size(); ++i) result.mutable_data()[i] = static_cast<std::uint8_t>(all[i]);
  return result;
}

// A design that is tried, as Attempt.
class LayeredAttempt {
 public:
  LayeredAttempt(LayersPointer mesh, py::object shape, std::string boundary, const RemodelOptions& options)
      : mesh_(std::move(mesh)), shape_(std::move(shape)), boundary_(std::move(boundary)), options_(options) {}
  ~LayeredAttempt() {
    try {
      end();
    } catch (const std::exception&) {  // the lock is not to be had: the trial ends without it
    }
  }
  LayeredAttempt(const LayeredAttempt&) = delete;
  LayeredAttempt& operator=(const LayeredAttempt&) = delete;

  void begin() {
    if (step_)
      throw Error(ErrorCode::argument, "trial", "was entered before, expected a new one for each block");
    auto step = std::make_shared<LayeredStepRecord>();
    const ThreadLock::Held held(mesh_->lock);
    const Domain domain = next_domain(mesh_->mesh.domain(), shape_, boundary_);
    trial_ = interruptible([&](StepObserver& observer) {
      options_.observer = &observer;
      const LayerMark mark = mesh_->mesh.mark();
      auto trial = std::make_unique<LayeredTrial>(mesh_->mesh, domain, options_);
      step->changes = mesh_->mesh.changes_since(mark);
      step->result = trial->result();
      mesh_->changed();
      followed_ = mesh_->follows;
      if (!step->result.abandoned) mesh_->follows = options_.strategy == Strategy::reference;
      return trial;
    });
    step->mesh = mesh_;
    step->version = mesh_->version;
    step_ = std::move(step);
  }
  void keep() {
    if (!trial_)
      throw Error(ErrorCode::argument, "trial",
                  "is over or has not begun, expected to be kept inside its block");
    const ThreadLock::Held held(mesh_->lock);
    trial_->keep();
    trial_.reset();
  }
  void end() {
    if (!trial_) return;
    const ThreadLock::Held held(mesh_->lock);
    trial_.reset();
    mesh_->follows = followed_;
    mesh_->changed();
  }
  const LayeredStepPointer& step() const {
    if (!step_)
      throw Error(ErrorCode::argument, "trial", "has not begun, expected `with mesh.trial(...) as trial`");
    return step_;
  }

 private:
  LayersPointer mesh_;
  py::object shape_;
  std::string boundary_;
  RemodelOptions options_;
  bool followed_ = false;  // before
  std::unique_ptr<LayeredTrial> trial_;
  LayeredStepPointer step_;
};

py::tuple layered_step_state(const LayeredStepRecord& step) {
  return py::make_tuple(packed(step.result), packed(step.changes), packed_mesh(step.before),
                        packed_mesh(step.after));
}

LayeredStepPointer layered_step_of(const py::tuple& state) {
  require_pickle(state.size() == 4, "a step");
  auto step = std::make_shared<LayeredStepRecord>();
  step->result = unpacked<LayeredRemodelResult>(state[0]);
  step->changes = unpacked<LayeredChanges>(state[1]);
  step->before = unpacked_mesh(state[2]);
  step->after = unpacked_mesh(state[3]);
  const auto within = [](auto value, auto last) { return value >= decltype(last){} && value <= last; };
  require_pickle(
      within(step->result.method, Method::general) && within(step->result.stopped, Stopped::interrupted),
      "a step");
  return step;
}

void add_layered_step(py::module_& module) {
  py::class_<LayeredStepRecord, LayeredStepPointer> type(
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
      "method", [](const LayeredStepRecord& s) { return name_of(s.result.method); },
      "'specialised' or 'general'.");
  type.def_property_readonly(
      "stopped", [](const LayeredStepRecord& s) { return name_of(s.result.stopped); },
      "'done', or the limit that a mesh that was generated afresh met.");
  type.def_property_readonly(
      "preserved_percent", [](const LayeredStepRecord& s) { return s.result.preserved_percent(); },
      "Cells that are there still, with all corners where they were, of those before.");
  type.def_property_readonly(
      "connectivity_percent", [](const LayeredStepRecord& s) { return s.result.connectivity_percent(); },
      "Cells whose corners are joined still, moved or not, of those before.");
  type.def_property_readonly(
      "changes", [](const LayeredStepRecord& s) { return std::make_shared<LayeredChanges>(s.changes); },
      "What the step changed, by the keys of the whole mesh.");
  type.def_property_readonly(
      "before", [](const LayeredStepRecord& s) { return std::const_pointer_cast<FrozenMesh>(s.before); },
      "The mesh before the step, with record=True; otherwise None.");
  type.def_property_readonly(
      "after", [](const LayeredStepRecord& s) { return std::const_pointer_cast<FrozenMesh>(after_of(s)); },
      "The mesh after the step, as long as there was no other one, or with record=True.");
  type.def_property_readonly("fates", &layered_fates,
                             "Per cell of `after`, with record=True: 0 kept, 1 moved, 2 new.");
  type.def(py::pickle(&layered_step_state, &layered_step_of));
  type.def("__repr__", [](const LayeredStepRecord& step) {
    return "LayeredStep(" + std::to_string(step.result.triangles) +
           " cells, preserved_percent=" + std::to_string(step.result.preserved_percent()) + ")";
  });
}

void add_layered_trial(py::module_& module) {
  py::class_<LayeredAttempt>(
      module, "LayeredTrial",
      "A design that is tried inside a `with` block: the mesh returns to what it was, to "
      "the last bit, unless keep() is called.")
      .def("__enter__",
           [](const py::object& self) {
             self.cast<LayeredAttempt&>().begin();
             return self;
           })
      .def("__exit__", [](LayeredAttempt& self, const py::args&) { self.end(); })
      .def_property_readonly("step", &LayeredAttempt::step, "The LayeredStep to the design that is tried.")
      .def("keep", &LayeredAttempt::keep, "The mesh stays as it is now.");
}

LayersPointer layers_at(LivingLayers& mesh, const py::object& shape, const std::string& boundary) {
  const ThreadLock::Held held(mesh.lock);
  const Domain domain = next_domain(mesh.mesh.domain(), shape, boundary);
  py::gil_scoped_release released;
  return layers_alive(mesh_at(mesh.mesh, domain), mesh.follows);
}

}  // namespace

Snapshot after_layered_step(const py::object& step) {
  if (!py::isinstance<LayeredStepRecord>(step)) return nullptr;
  return after_of(step.cast<const LayeredStepRecord&>());
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
  add_layered_trial(module);
}

void add_layered_steps(py::class_<LivingLayers, LayersPointer>& type) {
  type.def(
      "update", &layers_updated, "shape"_a, py::kw_only(), "boundary"_a = "", "distance"_a = 1.0,
      "method"_a = "auto", "strategy"_a = "renew", "regenerate"_a = true, "record"_a = false,
      "delaunay_slack"_a = RemodelOptions{}.delaunay_slack_deg,
      R"(Remodels to a Domain, or to an Airfoil (or the name of one) in the place of the one called `boundary`, on
the same stations; returns a LayeredStep. strategy: 'renew', 'morph', 'reference' or another of Mesh.update(), which
has the other arguments too. Where anything is refused the mesh is as it was. Raises ArgumentError and GeometryError;
Ctrl-C ends it.)");
  type.def(
      "trial",
      [](const LayersPointer& mesh, const py::object& shape, const std::string& boundary, double distance,
         const std::string& method, const std::string& strategy, bool regenerate, double delaunay_slack) {
        return std::make_unique<LayeredAttempt>(
            mesh, shape, boundary, remodel_options(distance, method, strategy, regenerate, delaunay_slack));
      },
      "shape"_a, py::kw_only(), "boundary"_a = "", "distance"_a = 1.0, "method"_a = "auto",
      "strategy"_a = "renew", "regenerate"_a = true, "delaunay_slack"_a = RemodelOptions{}.delaunay_slack_deg,
      "Tries a design: `with mesh.trial(shape) as trial: ...; trial.keep()`. Options as in update().");
  type.def("at", &layers_at, "shape"_a, py::kw_only(), "boundary"_a = "",
           "A copy at another design with the same connectivity. Raises TopologyChanged where there is no "
           "valid one.");
}

}  // namespace remodel::python
