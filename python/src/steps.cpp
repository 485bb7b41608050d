// Mesh.update(), Step and Trial.

#include <algorithm>
#include <optional>
#include <utility>

#include "living.h"
#include "records.h"
#include "remodel/import.h"

namespace remodel::python {
namespace {

bool closed(const CstAirfoil& airfoil) {
  return airfoil.te_upper == airfoil.te_lower;
}

Loop with_curve(Loop loop, CstAirfoil airfoil) {
  std::optional<Curve> base;
  if (!closed(airfoil)) {
    base = {.name = loop.curves.front().name,
            .shape = Line{airfoil.at(1.0), airfoil.at(0.0)},
            .parameters = {0.0}};
    if (loop.curves.size() > 1) base->parameters = std::move(loop.curves[1].parameters);
  }
  loop.curves.resize(1);
  loop.curves.front().shape = std::move(airfoil);
  if (base) loop.curves.push_back(std::move(*base));
  return loop;
}

std::shared_ptr<StepRecord> updated(const LivingMeshPointer& mesh, const py::object& shape,
                                    const std::string& boundary, double distance, const std::string& method,
                                    const std::string& strategy, bool regenerate, bool record,
                                    double delaunay_slack) {
  auto step = std::make_shared<StepRecord>();
  RemodelOptions options = remodel_options(distance, method, strategy, regenerate, delaunay_slack);
  const ThreadLock::Held held(mesh->lock);
  const Domain domain = next_domain(*mesh, shape, boundary);
  if (record) step->before = mesh->freeze();
  step->result = interruptible([&](StepObserver& observer) {
    options.observer = &observer;
    const Mark mark = mesh->mesh.mark();
    RemodelResult result = remodel(mesh->mesh, domain, options);
    step->changes = mesh->mesh.changes_since(mark);
    mesh->changed();
    return result;
  });
  if (!step->result.abandoned) {
    mesh->stopped = step->result.stopped;
    mesh->follows = options.strategy == Strategy::reference;
  }
  step->mesh = mesh;
  step->version = mesh->version;
  if (record) step->after = mesh->freeze();
  return step;
}

std::vector<std::uint64_t> values(const std::vector<VertexKey>& keys) {
  std::vector<std::uint64_t> result;
  for (const VertexKey key : keys) result.push_back(key.value());
  return result;
}

std::vector<std::uint32_t> values(const std::vector<TriangleId>& ids) {
  std::vector<std::uint32_t> result;
  for (const TriangleId id : ids) result.push_back(id.index);
  return result;
}

// The fate of each triangle after the step: 0 kept, 1 moved, 2 new.
py::array_t<std::uint8_t> fates_of(const StepRecord& step) {
  const Snapshot mesh = after_step(step);
  const std::vector<std::uint64_t> moved = values(step.changes.moved);
  const std::vector<std::uint32_t> born = values(step.changes.born);
  py::array_t<std::uint8_t> result(static_cast<py::ssize_t>(mesh->triangles.size()));
  std::uint8_t* fate = result.mutable_data();
  for (std::size_t i = 0; i < mesh->triangles.size(); ++i) {
    bool touched = false;
    for (const std::uint32_t v : mesh->triangles[i])
      touched = touched || std::binary_search(moved.begin(), moved.end(), mesh->vertex_keys[v]);
    fate[i] = std::binary_search(born.begin(), born.end(), mesh->triangle_ids[i]) ? 2 : touched ? 1 : 0;
  }
  return result;
}

// With the meshes before and after, where they were recorded.
py::tuple state_of(const StepRecord& step) {
  return py::make_tuple(packed(step.result), packed(step.changes), packed_mesh(step.before),
                        packed_mesh(step.after));
}

std::shared_ptr<StepRecord> step_of(const py::tuple& state) {
  require_pickle(state.size() == 4, "a step");
  auto step = std::make_shared<StepRecord>();
  step->result = unpacked<RemodelResult>(state[0]);
  step->changes = unpacked<Changes>(state[1]);
  step->before = unpacked_mesh(state[2]);
  step->after = unpacked_mesh(state[3]);
  const auto within = [](auto value, auto last) { return value >= decltype(last){} && value <= last; };
  require_pickle(within(step->result.method, Method::general) &&
                     within(step->result.stopped, Stopped::interrupted) &&
                     (!step->after || (step->after->vertex_keys.size() == step->after->points.size() &&
                                       step->after->triangle_ids.size() == step->after->triangles.size())),
                 "a step");
  return step;
}

void add_changes(py::module_& module) {
  py::class_<Changes, std::shared_ptr<Changes>>(
      module, "Changes",
      "The changes of one step: vertices by key (Mesh.vertex_keys), triangles by id (Mesh.triangle_ids); all "
      "ascend.")
      .def(record_pickle<Changes>())
      .def_property_readonly("moved", [](const Changes& c) { return copied(values(c.moved)); })
      .def_property_readonly("inserted", [](const Changes& c) { return copied(values(c.inserted)); })
      .def_property_readonly("removed", [](const Changes& c) { return copied(values(c.removed)); })
      .def_property_readonly("born", [](const Changes& c) { return copied(values(c.born)); })
      .def_property_readonly("gone", [](const Changes& c) { return copied(values(c.gone)); })
      .def_property_readonly("same_connectivity", &Changes::same_connectivity,
                             "Whether the same triangles join the same vertices.");
}

void add_step(py::module_& module) {
  py::class_<StepRecord, std::shared_ptr<StepRecord>> type(module, "Step", "The record of one update.");
  const auto figure = [&](const char* name, auto member, const char* doc) {
    type.def_property_readonly(
        name, [member](const StepRecord& s) { return s.result.*member; }, doc);
  };
  figure("triangles_before", &RemodelResult::triangles_before, "Triangles before the step.");
  figure("triangles", &RemodelResult::triangles, "Triangles after it.");
  figure("preserved", &RemodelResult::preserved,
         "Old triangles that are still there, with unmoved vertices.");
  figure("connected", &RemodelResult::connected,
         "Old triangles whose three vertices are still joined, moved or not.");
  figure("moved", &RemodelResult::moved, "Vertices at another place: of the boundary, unless morphed.");
  figure("inserted", &RemodelResult::inserted, "New vertices.");
  figure("removed", &RemodelResult::removed, "Removed vertices.");
  figure("full_adjustment", &RemodelResult::full_adjustment,
         "Whether all boundary vertices moved in place: the connectivity is the same.");
  figure("flipped", &RemodelResult::flipped, "Edges flipped.");
  figure("morphed", &RemodelResult::morphed, "Whether the interior moved along with the boundary.");
  figure("refreshed", &RemodelResult::refreshed, "Whether the strategy generated the mesh afresh.");
  figure("regenerated", &RemodelResult::regenerated,
         "Whether the step could not be completed, and the mesh was generated afresh.");
  figure("abandoned", &RemodelResult::abandoned, "The same with regenerate=False: the mesh is as it was.");
  figure("held", &RemodelResult::held,
         "Whether the mesh is the morph of its reference (strategy='reference').");
  figure("reason", &RemodelResult::reason, "Why it was regenerated or abandoned.");
  type.def_property_readonly(
      "preserved_percent", [](const StepRecord& s) { return s.result.preserved_percent(); },
      "preserved over triangles_before.");
  type.def_property_readonly(
      "connectivity_percent", [](const StepRecord& s) { return s.result.connectivity_percent(); },
      "connected over triangles_before.");
  type.def_property_readonly("method", [](const StepRecord& s) { return name_of(s.result.method); });
  type.def_property_readonly(
      "stopped", [](const StepRecord& s) { return name_of(s.result.stopped); },
      "'done', or the limit that was reached.");
  type.def_property_readonly("changes", [](const std::shared_ptr<StepRecord>& s) {
    return std::shared_ptr<Changes>(s, &s->changes);
  });
  type.def_property_readonly(
      "before", [](const StepRecord& s) { return std::const_pointer_cast<FrozenMesh>(s.before); },
      "The mesh before the step, with record=True; otherwise None.");
  type.def_property_readonly(
      "after", [](const StepRecord& s) { return std::const_pointer_cast<FrozenMesh>(after_step(s)); },
      "The mesh after the step, as long as there was no other one, or with record=True.");
  type.def_property_readonly("fates", &fates_of,
                             "Per triangle of `after`: 0 kept, 1 moved with a boundary vertex, 2 new.");
  type.def(py::pickle(&state_of, &step_of));
  type.def("__repr__", [](const StepRecord& s) {
    return "Step(" + std::to_string(s.result.triangles) + " triangles, " +
           std::to_string(s.result.preserved_percent()) + " % preserved)";
  });
}

// A design that is tried. It ends when the block is left, or when it is collected.
class Attempt {
 public:
  Attempt(LivingMeshPointer mesh, py::object shape, std::string boundary, const RemodelOptions& options)
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
    auto step = std::make_shared<StepRecord>();
    const ThreadLock::Held held(mesh_->lock);
    const Domain domain = next_domain(*mesh_, shape_, boundary_);
    stopped_ = mesh_->stopped;
    follows_ = mesh_->follows;
    trial_ = interruptible([&](StepObserver& observer) {
      options_.observer = &observer;
      const Mark mark = mesh_->mesh.mark();
      auto trial = std::make_unique<Trial>(mesh_->mesh, domain, options_);
      step->changes = mesh_->mesh.changes_since(mark);
      step->result = trial->result();
      mesh_->changed();
      return trial;
    });
    if (!step->result.abandoned) {
      mesh_->stopped = step->result.stopped;
      mesh_->follows = options_.strategy == Strategy::reference;
    }
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
  const std::shared_ptr<StepRecord>& step() const {
    if (!step_)
      throw Error(ErrorCode::argument, "trial", "has not begun, expected `with mesh.trial(...) as trial`");
    return step_;
  }

 private:
  LivingMeshPointer mesh_;
  py::object shape_;
  std::string boundary_;
  RemodelOptions options_;
  Stopped stopped_ = Stopped::done;
  bool follows_ = false;
  std::unique_ptr<Trial> trial_;
  std::shared_ptr<StepRecord> step_;
};

void add_trial(py::module_& module) {
  py::class_<Attempt>(module, "Trial",
                      "A design that is tried inside a `with` block: the mesh returns to what it was, to the "
                      "last bit, unless keep() is called.")
      .def("__enter__",
           [](const py::object& self) {
             self.cast<Attempt&>().begin();
             return self;
           })
      .def("__exit__", [](Attempt& self, const py::args&) { self.end(); })
      .def_property_readonly("step", &Attempt::step, "The Step to the design that is tried.")
      .def("keep", &Attempt::keep, "The mesh stays as it is now.");
}

}  // namespace

Snapshot after_step(const StepRecord& step) {
  if (step.after) return step.after;
  if (const LivingMeshPointer mesh = step.mesh.lock()) {
    const ThreadLock::Held held(mesh->lock);
    if (mesh->version == step.version) return mesh->freeze();
  }
  throw Error(ErrorCode::argument, "step",
              "its mesh has changed since or is not here, expected update(..., record=True)");
}

Domain next_domain(const Domain& now, const py::object& shape, const std::string& boundary) {
  if (py::isinstance<Domain>(shape)) return shape.cast<Domain>();
  if (!py::isinstance<py::str>(shape) && !py::isinstance<CstAirfoil>(shape))
    throw py::type_error("shape: found " + type_of(shape) +
                         ", expected an Airfoil, a Domain or the name of an airfoil");
  CstAirfoil airfoil =
      py::isinstance<py::str>(shape) ? named_airfoil(shape.cast<std::string>(), 5) : shape.cast<CstAirfoil>();
  Domain domain = now;
  const std::vector<std::size_t> loops = airfoil_loops(domain, boundary);
  if (loops.size() > 1)
    throw Error(ErrorCode::argument, "boundary",
                "not given, expected the name of one of " + std::to_string(loops.size()) + " airfoils");
  if (loops.size() == 1) {
    Loop& loop = domain.loops[loops[0]];
    loop = with_curve(std::move(loop), std::move(airfoil));
    return domain;
  }
  return with_airfoil(domain, find_airfoil(domain, boundary.empty() ? "airfoil" : boundary, "mesh"), airfoil);
}

RemodelOptions remodel_options(double distance, const std::string& method, const std::string& strategy,
                               bool regenerate, double delaunay_slack) {
  return {.distance = distance,
          .method = method_named(method),
          .strategy = strategy_named(strategy),
          .delaunay_slack_deg = delaunay_slack,
          .regenerate = regenerate};
}

void add_steps(py::module_& module) {
  add_changes(module);
  add_step(module);
  add_trial(module);
  auto type = py::reinterpret_borrow<py::class_<LivingMesh, LivingMeshPointer>>(module.attr("Mesh"));
  type.def(
      "update", &updated, "shape"_a, py::kw_only(), "boundary"_a = "", "distance"_a = 1.0,
      "method"_a = "auto", "strategy"_a = "renew", "regenerate"_a = true, "record"_a = false,
      "delaunay_slack"_a = RemodelOptions{}.delaunay_slack_deg,
      R"(Remodels the mesh, in place, to an Airfoil in the place of its own, or to another Domain; returns a Step.

boundary: the airfoil's name, where there are several. distance: D, the removal radius over the distance of old and
new vertices. strategy: 'renew' keeps long runs in order, 'chain' is the paper's method to the
letter, 'morph' moves the interior first, so that more triangles stay joined. 'reference' makes each design's mesh
the morph of one reference mesh, whatever designs came in between, as long as connectivity can be held; the angles
opposite an inner edge may then exceed 180 degrees by delaunay_slack, 0 to 60.
regenerate=False: a step that cannot be completed leaves the mesh as it was (Step.abandoned). record=True keeps
the arrays before and after in the Step. The mesh is valid before and after: what raises (GeometryError,
ArgumentError, KeyboardInterrupt) leaves it as it was, to the last bit.)");
  type.def(
      "trial",
      [](const LivingMeshPointer& mesh, const py::object& shape, const std::string& boundary, double distance,
         const std::string& method, const std::string& strategy, bool regenerate, double delaunay_slack) {
        return std::make_unique<Attempt>(
            mesh, shape, boundary, remodel_options(distance, method, strategy, regenerate, delaunay_slack));
      },
      "shape"_a, py::kw_only(), "boundary"_a = "", "distance"_a = 1.0, "method"_a = "auto",
      "strategy"_a = "renew", "regenerate"_a = true, "delaunay_slack"_a = RemodelOptions{}.delaunay_slack_deg,
      "Tries a design: `with mesh.trial(airfoil) as trial: ...; trial.keep()`. Options as in update().");
}

}  // namespace remodel::python
