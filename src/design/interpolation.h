#pragma once

// How far a design is from the airfoil that it is to become: the objective of the paper's section 5.1.

#include <span>
#include <vector>

#include "design/airfoil_space.h"
#include "remodel/airfoil.h"

namespace remodel {

// Distance in y to the target at its representative points: 50 stations of each surface.
class InterpolationObjective {
 public:
  static constexpr int stations_per_surface = 50;

  explicit InterpolationObjective(const CstAirfoil& target);
  double mean_square(const CstAirfoil& design) const;  // square chords
  double max_error(const CstAirfoil& design) const;    // chords
  // The derivatives of mean_square by the coefficients of both surfaces, upper first.
  std::vector<double> gradient(const CstAirfoil& design) const;

 private:
  std::vector<CachedStation> stations_;
  std::vector<double> heights_;  // of the target
};

}  // namespace remodel
