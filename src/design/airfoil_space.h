#pragma once

// Airfoils of one family as a design space: shape coefficients and what they are made from. Knows no mesh, so
// that a run's designs cannot depend on one.

#include <span>
#include <string>
#include <vector>

#include "remodel/airfoil.h"
#include "remodel/design_space.h"
#include "remodel/domain.h"
#include "remodel/import.h"

namespace remodel {

// Throws Error (argument, geometry) unless the search can lead from one to the other: it changes shape
// coefficients alone, and both must have their surfaces apart.
void require_same_family(const CstAirfoil& from, const CstAirfoil& to);

// Coefficients of both surfaces in one vector, upper first, and back.
std::vector<double> coefficients_of(const CstAirfoil& airfoil);
CstAirfoil with_coefficients(const CstAirfoil& like, std::span<const double> coefficients);

// An airfoil's place in another mesh, for a run's history. from_json throws nlohmann's exceptions.
std::string place_to_json(const AirfoilPlace& place);
AirfoilPlace place_from_json(const std::string& text);

// A station with its row of cst_basis, kept for thousands of designs of one degree.
class CachedStation {
 public:
  CachedStation(double t, const CstAirfoil& like);
  double x() const { return station_.x; }
  double height(const CstAirfoil& airfoil) const { return cst_height(airfoil, station_, row_); }
  bool upper() const { return station_.upper; }
  const std::vector<double>& row() const {
    return row_;
  }  // the height's derivatives by its surface's coefficients

 private:
  CstStation station_;
  std::vector<double> row_;
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

}  // namespace remodel
