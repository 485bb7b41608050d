#include "layer/outer_step.h"

#include <algorithm>
#include <utility>

#include "mesh/mesh_data.h"
#include "remodel/generate.h"
#include "step/correspondence.h"
#include "step/outcome.h"

namespace remodel {

namespace {

bool same_tops(const Domain& outside, const Domain& expected, const LayerColumns& columns) {
  if (outside.loops.size() != expected.loops.size()) return false;
  return std::all_of(columns.rings.begin(), columns.rings.end(), [&](const ColumnRing& ring) {
    const Loop &found = outside.loops[ring.wall.loop], &wanted = expected.loops[ring.wall.loop];
    const auto same = [](const Curve& a, const Curve& b) {
      return a.shape == b.shape && a.parameters == b.parameters;
    };
    return found.placement == wanted.placement &&
           std::equal(found.curves.begin(), found.curves.end(), wanted.curves.begin(), wanted.curves.end(),
                      same);
  });
}

}  // namespace

bool follows_by_index(const Domain& own, const Domain& wanted) {
  if (!one_to_one(own, wanted)) return false;
  std::vector<std::size_t> moving;
  for (std::size_t l = 0; l < own.loops.size(); ++l) {
    const Loop &from = own.loops[l], &to = wanted.loops[l];
    if (from.region != to.region || from.right_region != to.right_region) return false;
    if (!(from == to)) moving.push_back(l);
  }
  return corresponds_by_index(own, wanted, moving);
}

OuterStep::OuterStep(Mesh& outer, const Domain& outside, const LayerColumns& columns,
                     const RemodelOptions& options, TakeBack take_back)
    : outer_(outer), marked_before_(outer.data().marked.now()) {
  const bool by_index = follows_by_index(outer.domain(), outside);
  if (by_index && take_back == TakeBack::never) {
    result_ = remodel(outer, outside, options);
    return;
  }
  trial_.emplace(outer, outside, options);
  result_ = trial_->result();
  if (by_index || as_it_was() || same_tops(outer.domain(), outside, columns)) return;
  trial_.reset();
  exchange(outside, options, "the wall is the same place, described in another way");
}

OuterStep::~OuterStep() {
  if (!before_) return;
  exchange_back(outer_, *std::move(before_));
  outer_.data().marked.return_to(marked_before_);
}

void OuterStep::keep() {
  if (trial_) trial_->keep();
  trial_.reset();
  before_.reset();
}

void OuterStep::exchange(const Domain& outside, const RemodelOptions& options, const char* reason) {
  result_ = unchanged(outer_.data());
  result_.reason = reason;
  result_.abandoned = !options.regenerate;
  if (result_.abandoned) return;
  GenerateResult fresh = generate(outside, outer_.options(), options.observer);
  if (fresh.stopped == Stopped::interrupted) {
    result_ = interrupted(outer_.data());
    return;
  }
  fresh.mesh.data().keep = outer_.keep();
  result_ = remodel::exchange(outer_, std::move(fresh), before_);
  result_.regenerated = true;
  result_.reason = reason;
}

}  // namespace remodel
