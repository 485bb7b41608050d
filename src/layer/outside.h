#pragma once

// The domain beyond a layer: the walls' own, where polylines of tops have taken the places of walls, and
// openings begin and end at the tops of the columns that stand on them.

#include <cstdint>
#include <vector>

#include "layer/columns.h"
#include "remodel/domain.h"

namespace remodel {

// A curve of a loop beyond the layer.
struct OutsideCurve {
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  // The tops of a ring, or the walls' own curve, in the loop, from the tops of one ring to those of another.
  std::size_t ring = none, curve = none;
  std::size_t begins = none, ends = none;  // the rings that the own curve begins and ends at
  double from = 0.0, to = 1.0;             // its parameters there

  // The own curve's parameter that the curve beyond the layer has this one for.
  double own_parameter(const Shape& own, double t) const;
};

// The curves of a loop in their order; none where it has no layer.
std::vector<OutsideCurve> outside_curves(const Domain& walls, const std::vector<ColumnRing>& rings,
                                         std::size_t loop);
// Sets ColumnRing::outside_curve.
void number_outside_curves(const Domain& walls, std::vector<ColumnRing>& rings);
// The shape of an own curve beyond the layer. All its parameters are valid there too.
Shape outside_shape(const Shape& own, const OutsideCurve& curve, const std::vector<ColumnRing>& rings,
                    std::uint32_t levels);
// The walls with the stations of openings where they are in the mesh; the tops of columns there are some,
// too.
Domain with_moved_stations(Domain walls, const std::vector<ColumnRing>& rings);
Domain outside_of(const Domain& walls, const LayerColumns& columns, std::uint32_t levels);

}  // namespace remodel
