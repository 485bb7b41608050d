#pragma once

// update(), trial() and what a step is, of meshes of both kinds.

#include <memory>
#include <string>
#include <utility>

#include "living.h"
#include "records.h"

namespace remodel::python {

// Whether the mesh may be used for what the step says of it, after a pickle.
inline bool fits(const StepRecord& step) {
  return !step.after || (step.after->vertex_keys.size() == step.after->points.size() &&
                         step.after->triangle_ids.size() == step.after->triangles.size());
}
template <class AnyLiving>
bool fits(const StepOf<AnyLiving>&) {
  return true;
}

template <class AnyLiving>
void note_step(AnyLiving& living, const RemodelResult& result, Strategy strategy) {
  if (result.abandoned) return;
  living.stopped = result.stopped;
  living.follows = strategy == Strategy::reference;
}

template <class AnyLiving>
std::shared_ptr<StepOf<AnyLiving>> updated(const std::shared_ptr<AnyLiving>& mesh, const py::object& shape,
                                           const std::string& boundary, double distance,
                                           const std::string& method, const std::string& strategy,
                                           bool regenerate, bool record, double delaunay_slack) {
  auto step = std::make_shared<StepOf<AnyLiving>>();
  RemodelOptions options = remodel_options(distance, method, strategy, regenerate, delaunay_slack);
  const ThreadLock::Held held(mesh->lock);
  const Domain domain = next_domain(mesh->mesh, shape, boundary);
  if (record) step->before = mesh->freeze();
  step->result = interruptible([&](StepObserver& observer) {
    options.observer = &observer;
    const auto mark = mesh->mesh.mark();
    auto result = remodel(mesh->mesh, domain, options);
    step->changes = mesh->mesh.changes_since(mark);
    mesh->changed();
    return result;
  });
  note_step(*mesh, step->result, options.strategy);
  step->mesh = mesh;
  step->version = mesh->version;
  if (record) step->after = mesh->freeze();
  return step;
}

// With the meshes before and after, where they were recorded.
template <class AnyLiving>
py::tuple state_of(const StepOf<AnyLiving>& step) {
  return py::make_tuple(packed(step.result), packed(step.changes), packed_mesh(step.before),
                        packed_mesh(step.after));
}

template <class AnyLiving>
std::shared_ptr<StepOf<AnyLiving>> step_of(const py::tuple& state) {
  require_pickle(state.size() == 4, "a step");
  auto step = std::make_shared<StepOf<AnyLiving>>();
  step->result = unpacked<typename AnyLiving::StepResult>(state[0]);
  step->changes = unpacked<typename AnyLiving::StepChanges>(state[1]);
  step->before = unpacked_mesh(state[2]);
  step->after = unpacked_mesh(state[3]);
  const auto within = [](auto value, auto last) { return value >= decltype(last){} && value <= last; };
  require_pickle(within(step->result.method, Method::general) &&
                     within(step->result.stopped, Stopped::interrupted) && fits(*step),
                 "a step");
  return step;
}

// What steps of both kinds have; their counts, which are of other things, are not here.
template <class AnyLiving>
void add_step_parts(py::class_<StepOf<AnyLiving>, std::shared_ptr<StepOf<AnyLiving>>>& type) {
  using Step = StepOf<AnyLiving>;
  type.def_property_readonly(
      "method", [](const Step& s) { return name_of(s.result.method); }, "'specialised' or 'general'.");
  type.def_property_readonly(
      "stopped", [](const Step& s) { return name_of(s.result.stopped); },
      "'done', or the limit that was reached.");
  type.def_property_readonly(
      "changes",
      [](const std::shared_ptr<Step>& s) {
        return std::shared_ptr<typename AnyLiving::StepChanges>(s, &s->changes);
      },
      "What the step changed, by the keys of the mesh.");
  type.def_property_readonly(
      "before", [](const Step& s) { return std::const_pointer_cast<FrozenMesh>(s.before); },
      "The mesh before the step, with record=True; otherwise None.");
  type.def_property_readonly(
      "after", [](const Step& s) { return std::const_pointer_cast<FrozenMesh>(after_step(s)); },
      "The mesh after the step, as long as there was no other one, or with record=True.");
  type.def(py::pickle(&state_of<AnyLiving>, &step_of<AnyLiving>));
}

// A design that is tried. It ends when the block is left, or when it is collected.
template <class AnyLiving>
class Attempt {
 public:
  using Step = StepOf<AnyLiving>;
  Attempt(std::shared_ptr<AnyLiving> mesh, py::object shape, std::string boundary,
          const RemodelOptions& options)
      : mesh_(std::move(mesh)), shape_(std::move(shape)), boundary_(std::move(boundary)), options_(options) {}
  ~Attempt() {
    try {
      end();
    } catch (const std::exception&) {  // the lock is not to be had: the trial ends without it
    }
  }
  Attempt(const Attempt&) = delete;
  Attempt& operator=(const Attempt&) = delete;

  void begin() {
    if (step_)
      throw Error(ErrorCode::argument, "trial", "was entered before, expected a new one for each block");
    auto step = std::make_shared<Step>();
    const ThreadLock::Held held(mesh_->lock);
    const Domain domain = next_domain(mesh_->mesh, shape_, boundary_);
    stopped_ = mesh_->stopped;
    follows_ = mesh_->follows;
    trial_ = interruptible([&](StepObserver& observer) {
      options_.observer = &observer;
      const auto mark = mesh_->mesh.mark();
      auto trial = std::make_unique<typename AnyLiving::StepTrial>(mesh_->mesh, domain, options_);
      step->changes = mesh_->mesh.changes_since(mark);
      step->result = trial->result();
      mesh_->changed();
      return trial;
    });
    note_step(*mesh_, step->result, options_.strategy);
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
    mesh_->stopped = stopped_;
    mesh_->follows = follows_;
    mesh_->changed();
  }
  const std::shared_ptr<Step>& step() const {
    if (!step_)
      throw Error(ErrorCode::argument, "trial", "has not begun, expected `with mesh.trial(...) as trial`");
    return step_;
  }

 private:
  std::shared_ptr<AnyLiving> mesh_;
  py::object shape_;
  std::string boundary_;
  RemodelOptions options_;
  Stopped stopped_ = Stopped::done;
  bool follows_ = false;
  std::unique_ptr<typename AnyLiving::StepTrial> trial_;
  std::shared_ptr<Step> step_;
};

template <class AnyLiving>
void add_trial(py::module_& module, const char* name, const char* of_step) {
  using Tried = Attempt<AnyLiving>;
  py::class_<Tried>(module, name,
                    "A design that is tried inside a `with` block: the mesh returns to what it was, to the "
                    "last bit, unless keep() is called.")
      .def("__enter__",
           [](const py::object& self) {
             self.cast<Tried&>().begin();
             return self;
           })
      .def("__exit__", [](Tried& self, const py::args&) { self.end(); })
      .def_property_readonly("step", &Tried::step, of_step)
      .def("keep", &Tried::keep, "The mesh stays as it is now.");
}

// update() and trial().
template <class AnyLiving>
void add_update(py::class_<AnyLiving, std::shared_ptr<AnyLiving>>& type, const char* of_update) {
  type.def("update", &updated<AnyLiving>, "shape"_a, py::kw_only(), "boundary"_a = "", "distance"_a = 1.0,
           "method"_a = "auto", "strategy"_a = "renew", "regenerate"_a = true, "record"_a = false,
           "delaunay_slack"_a = RemodelOptions{}.delaunay_slack_deg, of_update);
  type.def(
      "trial",
      [](const std::shared_ptr<AnyLiving>& mesh, const py::object& shape, const std::string& boundary,
         double distance, const std::string& method, const std::string& strategy, bool regenerate,
         double delaunay_slack) {
        return std::make_unique<Attempt<AnyLiving>>(
            mesh, shape, boundary, remodel_options(distance, method, strategy, regenerate, delaunay_slack));
      },
      "shape"_a, py::kw_only(), "boundary"_a = "", "distance"_a = 1.0, "method"_a = "auto",
      "strategy"_a = "renew", "regenerate"_a = true, "delaunay_slack"_a = RemodelOptions{}.delaunay_slack_deg,
      "Tries a design: `with mesh.trial(shape) as trial: ...; trial.keep()`. Options as in update().");
}

}  // namespace remodel::python
