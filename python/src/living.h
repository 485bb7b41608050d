#pragma once

// The objects behind Mesh and Step of the module, and behind those of meshes with layers.

#include <memory>
#include <optional>

#include "bindings.h"
#include "interrupts.h"
#include "records.h"
#include "remodel/changes.h"
#include "remodel/error.h"
#include "remodel/mesh.h"
#include "remodel/remodel.h"

namespace remodel {

class LayeredMesh;

template <python::Is<RemodelResult> T>
auto members(T& r) {
  return std::tie(r.triangles_before, r.triangles, r.preserved, r.connected, r.moved, r.inserted, r.removed,
                  r.flipped, r.full_adjustment, r.morphed, r.held, r.method, r.refreshed, r.regenerated,
                  r.abandoned, r.reason, r.stopped);
}
template <python::Is<Changes> T>
auto members(T& c) {
  return std::tie(c.moved, c.inserted, c.removed, c.born, c.gone);
}

}  // namespace remodel

namespace remodel::python {

// A living mesh of either kind, which threads share.
template <class AnyMesh>
struct Living {
  AnyMesh mesh;
  Stopped stopped = Stopped::done;  // why generation ended
  // Whether the last step was by Strategy::reference: the next one of that strategy moves the interior along,
  // also where the mesh is a new reference and not held.
  bool follows = false;
  ThreadLock lock;
  // The mesh as it is now, frozen when it is first asked for. Views of it keep it alive.
  Snapshot frozen;
  // How often the mesh has been changed here: a step's own mesh is there as long as this is its number.
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

struct LivingMesh : Living<Mesh> {
  using StepResult = RemodelResult;
  using StepChanges = Changes;
  using StepTrial = Trial;
};
using LivingMeshPointer = std::shared_ptr<LivingMesh>;

template <class AnyLiving>
struct StepOf {
  typename AnyLiving::StepResult result;
  typename AnyLiving::StepChanges changes;
  std::weak_ptr<AnyLiving> mesh;
  std::uint64_t version = 0;  // of the mesh after the step
  Snapshot before, after;     // where they were asked for
};
using StepRecord = StepOf<LivingMesh>;

// The mesh after the step. Throws Error (argument) where it is gone and was not recorded.
template <class AnyLiving>
Snapshot after_step(const StepOf<AnyLiving>& step) {
  if (step.after) return step.after;
  if (const std::shared_ptr<AnyLiving> mesh = step.mesh.lock()) {
    const ThreadLock::Held held(mesh->lock);
    if (mesh->version == step.version) return mesh->freeze();
  }
  throw Error(ErrorCode::argument, "step",
              "its mesh has changed since or is not here, expected update(..., record=True)");
}

// The domain that an update to a shape leads to: a Domain itself, or the mesh's own domain with an airfoil in
// the place of the one called `boundary`. Names and files are as domain_of() takes them.
Domain next_domain(const Domain& now, const py::object& shape, const std::string& boundary);
Domain next_domain(const Mesh& mesh, const py::object& shape, const std::string& boundary);
// Throws Error (argument) for a file of several elements, whose stations are none for layers.
Domain next_domain(const LayeredMesh& mesh, const py::object& shape, const std::string& boundary);

// The loops whose movement the interior goes along with: those, and all that have moved since the reference
// of a mesh that is held.
std::vector<std::size_t> moving_loops(const Mesh& mesh, const std::vector<std::size_t>& loops);

// The strategy of whose small steps derivatives and at() are, unless they are asked for another: reference,
// which moves the interior along, of meshes that are held or follow; otherwise chain, which leaves it.
Strategy own_strategy(const Mesh& mesh, bool follows);

// Where the upper and lower coefficients of the airfoil of that name, or the only one, are in
// coefficients_of(): its loop, the first and how many. Throws Error (argument) where there is not one such
// airfoil.
struct AirfoilNumbers {
  std::size_t loop, first, count;
};
AirfoilNumbers airfoil_numbers(const Domain& domain, const std::string& boundary);

// The loops of a domain that are an airfoil by its coefficients, of that name if there is one.
std::vector<std::size_t> airfoil_loops(const Domain& domain, const std::string& name);

RemodelOptions remodel_options(double distance, const std::string& method, const std::string& strategy,
                               bool regenerate, double delaunay_slack);

}  // namespace remodel::python
