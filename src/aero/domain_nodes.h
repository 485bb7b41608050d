#pragma once

// The given points of a domain: what its splines and polylines go through, and where its lines end.

#include <optional>
#include <string>
#include <vector>

#include "remodel/domain.h"

namespace remodel {

// One place of a loop. Where two curves meet they share it.
struct DomainNode {
  Point at;
  std::vector<std::size_t> numbers;  // of x, among coefficients_of(Domain); y is the next one
  bool is_periodic = false;          // of a periodic curve
  bool is_stiff = false;  // the end of an arc or a section as well, which has no numbers of its own
};

// The nodes of one curve, in its order, with both ends.
struct CurveNodes {
  std::size_t loop = 0;
  const Curve* curve = nullptr;
  std::vector<std::size_t> nodes;  // none of arcs and sections but their ends
  bool has_points = false;         // a spline or polyline
};

struct DomainNodes {
  std::vector<DomainNode> nodes;
  std::vector<CurveNodes> curves;  // all curves of all loops
};

// The domain has to outlive it.
DomainNodes nodes_of(const Domain& domain);

}  // namespace remodel
