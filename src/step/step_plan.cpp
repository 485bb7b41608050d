#include "step/step_plan.h"

#include <algorithm>

#include "step/rename.h"

namespace remodel {

namespace {

// The loops that are not the same in two domains, a mesh's own and another one; none where the boundary
// vertices of the two do not correspond one to one.
std::optional<LoopIndices> moving_loops(Arena& arena, const Domain& its_own, const Domain& domain) {
  const std::vector<Loop>&from = its_own.loops, &to = domain.loops;
  if (from.size() != to.size()) return std::nullopt;
  LoopIndices moving(&arena);
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (from[i] == to[i]) continue;
    const bool same_regions = from[i].region == to[i].region && from[i].right_region == to[i].right_region;
    if (!same_regions || !one_to_one(from[i], to[i])) return std::nullopt;
    moving.push_back(i);
  }
  return moving;
}

}  // namespace

bool joined(const MeshData& mesh, const LoopIndices& loops) {
  if (std::ranges::none_of(mesh.domain.loops, &Loop::open)) return false;
  bool found = false;
  for (const std::size_t loop : loops)
    mesh.walk(mesh.loop_heads[loop], [&](std::uint32_t k) { found |= mesh.at(k).twin != k; });
  return found;
}

void StepPlan::compare(MeshData& mesh, const Domain& wanted) {
  const Domain& own = mesh.domain;
  compare_loops(mesh, own, wanted);
  if (moving && (moving->empty() || corresponds_by_index(own, wanted, *moving))) return;
  validate(wanted);
  correspondence = correspond(own, wanted);
  structure_differs = !only_renames(own, *correspondence);
  differs_in_parts = structure_differs && corresponds_in_parts(own, *correspondence);
  compare_loops(mesh, own, wanted);
}

void StepPlan::compare_loops(MeshData& mesh, const Domain& from, const Domain& wanted) {
  moving = moving_loops(mesh.arena, from, target(wanted));
  other_discretisation = !moving && (!correspondence || differs_much(mesh.domain, *correspondence));
  if (moving && joined(mesh, *moving)) moving.reset();
}

bool StepPlan::renames(const Domain& own) const {
  return correspondence && !structure_differs && !same_names(own, *correspondence);
}

void StepPlan::choose_method(Method asked) {
  if (asked == Method::general) moving.reset();
  method = moving ? Method::specialised : Method::general;
}

List<Attempt> StepPlan::attempts(Arena& arena, const RemodelOptions& options, bool morphs) const {
  List<Attempt> list(&arena);
  const bool still = morphs && options.strategy == Strategy::morph;
  const auto add_morphs = [&](Method by, Places places) {
    if (still) list.push_back({by, Interior::still, places});
    if (morphs) list.push_back({by, Interior::along, places});
  };
  if (structure_differs && options.method != Method::general) {
    const Method by = differs_in_parts ? Method::specialised : Method::general;
    for (const Places places : {Places::joined, Places::present}) add_morphs(by, places);
    for (const Places places : {Places::joined, Places::present}) list.push_back({by, std::nullopt, places});
  } else if (method == Method::specialised) {
    add_morphs(method, Places::wanted);
    list.push_back({.method = method});
  }
  if (options.method != Method::specialised) list.push_back({.method = Method::general});
  return list;
}

}  // namespace remodel
