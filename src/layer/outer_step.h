#pragma once

// The step of the mesh around a layer, to the polygons of new tops.

#include <optional>

#include "layer/columns.h"
#include "mesh/change_record.h"
#include "remodel/remodel.h"

namespace remodel {

// False if the two domains have other loops or stations, or may be in another order.
bool follows_by_index(const Domain& own, const Domain& wanted);

class OuterStep {
 public:
  enum class TakeBack { never, possible };
  // Where the step follows by index it takes the tops as they are. Where it has to find out what is what, it
  // may keep an old loop whose places are those of the tops to the last rounding, although the wall below is
  // another one, or is written otherwise. Then the tops are not the columns', and a fresh mesh takes the
  // place of the one before.
  OuterStep(Mesh& outer, const Domain& outside, const LayerColumns& columns, const RemodelOptions& options,
            TakeBack take_back);
  OuterStep(const OuterStep&) = delete;
  OuterStep& operator=(const OuterStep&) = delete;
  // Takes the step back, to the last bit, unless it is kept; but for TakeBack::never.
  ~OuterStep();
  void keep();
  const RemodelResult& result() const { return result_; }
  bool as_it_was() const { return result_.abandoned || result_.stopped == Stopped::interrupted; }

 private:
  void exchange(const Domain& outside, const RemodelOptions& options, const char* reason);

  Mesh& outer_;
  const ChangeRecords::Moment marked_before_;
  std::optional<Trial> trial_;
  std::optional<Mesh> before_;  // where a fresh mesh has taken its place
  RemodelResult result_;
};

}  // namespace remodel
