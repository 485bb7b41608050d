#pragma once

// The independent validator. It shares no predicate and no data structure with the rest: rational arithmetic
// on the frozen view. Slow and obvious on purpose.

#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "remodel/domain.h"
#include "remodel/frozen_mesh.h"

namespace remodel {

struct Violation {
  std::string rule;                // "orientation", "adjacency", "orphan-vertex", "euler", "area", "boundary",
                                   // "design", "delaunay", "angle", "gradation", "index", "finite", "duplicate"
  std::vector<std::uint32_t> ids;  // the points or triangles concerned (indices of the frozen view)
  std::string detail;              // one sentence
};

struct CheckOptions {
  double min_angle_deg = 0.0;  // 0: not tested. Compared with a relative tolerance of 1e-9 on the
                               // radius-edge ratio (rounding of the ratio itself, 1e-15, with a margin)
  double max_gradation = 0.0;  // H; 0: not tested; needs length_scale
  bool delaunay = true;        // false: report in the result only
  const Domain* design = nullptr;  // if given, boundary vertices must lie on its curves' stations
  std::size_t max_violations = 100;
};

struct CheckResult {
  bool valid = false;
  std::vector<Violation> violations;
  std::size_t triangles = 0;
  std::size_t vertices = 0;
  double min_angle_deg = 0.0;
  double max_gradation = std::numeric_limits<double>::quiet_NaN();  // r / (H mean LS), H = sqrt(1/2) unless
                                                                    // given; NaN without length scales
  bool delaunay = false;
  std::map<std::string, std::size_t> boundary;  // edges per name
  double area = 0.0;                            // square chords
};

CheckResult check(const FrozenMesh& mesh, const CheckOptions& options = {});

}  // namespace remodel
