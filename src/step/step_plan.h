#pragma once

// What a step is going to do: what its two domains have in common, found before anything is touched, and the
// attempts that follow where boundary vertices cannot all be moved in place.

#include <optional>

#include "remodel/remodel.h"
#include "step/correspondence.h"
#include "step/methods.h"
#include "step/morph.h"
#include "step/step_journal.h"

namespace remodel {

// One way to make the step, under a journal of its own.
struct Attempt {
  Method method = Method::general;        // specialised or general
  std::optional<Interior> interior = {};  // how a morph moves it; none: what cannot move is replaced
  Places places = Places::wanted;         // where the structure of the boundary differs

  // Whether it replaces what moves by a domain whose structure the mesh has, or all of it.
  bool replaces_all_that_moves() const { return !interior && places == Places::wanted; }
};

struct StepPlan {
  // Where the domains do not correspond by the order of their loops alone.
  std::optional<Correspondence> correspondence;
  // The loops that differ, where their vertices correspond one to one. In the mesh's arena.
  std::optional<LoopIndices> moving;
  bool structure_differs = false;     // of the boundary: not all segments correspond
  bool differs_in_parts = false;      // and most of each loop does
  bool other_discretisation = false;  // boundary vertices do not correspond
  Method method = Method::general;    // of the first attempt
  bool renews = false;                // as Strategy::renew does

  // Compares the mesh's own domain with the one that is wanted. Throws Error if that is no domain and its
  // loops do not correspond in order.
  void compare(MeshData& mesh, const Domain& wanted);
  // Compares loops alone, in order: `moving` and `other_discretisation`. The step starts from the domain
  // `from`, the mesh's own or its reference's.
  void compare_loops(MeshData& mesh, const Domain& from, const Domain& wanted);
  // What the mesh will have: the wanted domain, in the mesh's own terms where the two correspond.
  const Domain& target(const Domain& wanted) const {
    return correspondence ? correspondence->domain : wanted;
  }
  // Whether the mesh has the wanted structure by other names.
  bool renames(const Domain& own) const;
  // The specialised method, if it applies and is not ruled out.
  void choose_method(Method asked);
  bool specialises() const { return moving || differs_in_parts; }

  // The attempts in turn, those first that change least. `morphs`: connectivity is to be kept.
  List<Attempt> attempts(Arena& arena, const RemodelOptions& options, bool morphs) const;
};

// Whether another chain is joined to one of the loops.
bool joined(const MeshData& mesh, const LoopIndices& loops);

}  // namespace remodel
