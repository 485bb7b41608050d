#pragma once

// The optimiser's side of a run: samples of shape coefficients, which of them are designs, and how far a
// design is from the target. Knows no mesh, so that a run's designs cannot depend on one.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "remodel/airfoil.h"
#include "remodel/cmaes.h"
#include "remodel/domain.h"

namespace remodel {

// Throws Error (argument, geometry) unless the search can lead from one to the other: it changes shape
// coefficients alone, and both must have their surfaces apart.
void require_same_family(const CstAirfoil& from, const CstAirfoil& to);

// The same airfoil with shape functions of a higher degree: exact but for rounding.
CstAirfoil raise_degree(const CstAirfoil& airfoil, int degree);

// Coefficients of both surfaces in one vector, upper first, and back.
std::vector<double> coefficients_of(const CstAirfoil& airfoil);
CstAirfoil with_coefficients(const CstAirfoil& like, const std::vector<double>& coefficients);

// A station with its row of cst_basis, kept for thousands of designs of one degree.
class CachedStation {
 public:
  CachedStation(double t, const CstAirfoil& like);
  double x() const { return station_.x; }
  double height(const CstAirfoil& airfoil) const { return cst_height(airfoil, station_, row_); }

 private:
  CstStation station_;
  std::vector<double> row_;
};

// Distance in y to the target at its representative points: 50 stations of each surface.
class InterpolationObjective {
 public:
  static constexpr int stations_per_surface = 50;

  explicit InterpolationObjective(const CstAirfoil& target);
  double mean_square(const CstAirfoil& design) const;  // square chords
  double max_error(const CstAirfoil& design) const;    // chords

 private:
  std::vector<CachedStation> stations_;
  std::vector<double> heights_;  // of the target
};

// Whether a design can be meshed: its surfaces are apart, the upper vertices of its polygon lie above the
// lower ones, and it is inside the farfield's polygon. Upper and lower vertices share their x, so that the
// polygon is then simple.
class Feasibility {
 public:
  Feasibility(const CstAirfoil& like, const AirfoilDomainOptions& options);
  bool operator()(const CstAirfoil& design) const;

 private:
  struct Pair {
    CachedStation upper, lower;
  };
  std::vector<Pair> pairs_;
  double farfield_ = 0.0;  // radius of the circle inside the farfield's polygon
};

// Where a run starts. The least deviation is far below what a mesh or a solver could tell, and far above
// rounding (remodel/optimise.h says why).
Cmaes initial_distribution(const CstAirfoil& from, double sigma, std::uint64_t seed);

struct Sample {
  std::vector<double> coefficients;
  CstAirfoil design;
  std::uint64_t refused = 0;  // infeasible samples before it
};

class ShapeSearch {
 public:
  using Feasible = std::function<bool(const CstAirfoil&)>;

  // Designs are like `like` in everything but the coefficients, which cmaes samples.
  ShapeSearch(const CstAirfoil& like, const AirfoilDomainOptions& domain, Cmaes cmaes);
  ShapeSearch(const CstAirfoil& like, Cmaes cmaes, Feasible feasible);

  // The next feasible sample; nothing after `limit` infeasible ones in a row.
  std::optional<Sample> next(std::size_t limit);
  void tell(const Sample& sample, double value) { cmaes_.tell(sample.coefficients, value); }

  // The design at the distribution's mean, if it is feasible.
  std::optional<CstAirfoil> mean_design() const;

  const Cmaes& cmaes() const { return cmaes_; }

 private:
  CstAirfoil like_;
  Feasible feasible_;
  Cmaes cmaes_;
};

}  // namespace remodel
