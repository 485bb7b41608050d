#pragma once

// States along a search: how large their residuals are, and how far a step may lead.

#include "flow/scheme/block_system.h"

namespace remodel::flow {

// state + length * increment, where no density or pressure falls to less than a fifth by it.
template <std::size_t N>
BlockState<N> moved(const BlockState<N>& state, const BlockIncrement<N>& increment, double length);

// The largest part of density or pressure that an increment changes anywhere; of what is nearly a vacuum, as
// a part of 0.05.
template <std::size_t N>
double largest_change(const BlockState<N>& state, const BlockIncrement<N>& increment);

// A state's residuals and their size.
template <std::size_t N>
struct BlockResiduals {
  BlockVector<N> of_vertices = {};
  Augmented augmented = {};
  double size = 0.0;
  BlockIncrement<N> negated() const;
};
using Residuals = BlockResiduals<unknown_count>;

// The size of residuals: of the flow's relative to undisturbed flow through the same mesh, and of the
// augmented equations'.
template <std::size_t N>
class BlockMeasure {
 public:
  explicit BlockMeasure(const BlockSystem<N>& system);
  const BlockSystem<N>& system() const { return system_; }
  // Their size is infinite where it is no state of a gas.
  BlockResiduals<N> operator()(const BlockState<N>& state) const;
  // Of residuals that someone else has computed; infinite where it is no number.
  double size_of(const BlockVector<N>& of_vertices, const Augmented& augmented) const;
  double scale() const { return scale_; }  // the size of undisturbed flow's residuals

 private:
  const BlockSystem<N>& system_;
  double scale_;
};

}  // namespace remodel::flow
