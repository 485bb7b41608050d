#pragma once

// The turbulence model of P. R. Spalart and S. R. Allmaras (AIAA paper 92-0439, 1992) in its negative
// variant: S. R. Allmaras, F. T. Johnson and P. R. Spalart, "Modifications and clarifications for the
// implementation of the Spalart-Allmaras turbulence model", ICCFD7-1902, 2012. Equation numbers are theirs.
// No trip term: a laminar zone has no production, as is usual (FUN3D, CFL3D, SU2). No laminar suppression
// (ft2), which would keep a laminar boundary layer so ahead of a trip: "SA-neg-noft2" of NASA's Turbulence
// Modeling Resource, also what SU2 means by SA. With it turbulence may set in at one column of cells or at
// the next, and Newton's method went to and fro between the two (docs/viscous.md).

#include <algorithm>
#include <cmath>

#include "flow/physics/euler.h"

namespace remodel::flow {

struct SpalartAllmaras {
  static constexpr double cb1 = 0.1355, cb2 = 0.622, sigma = 2.0 / 3.0, karman = 0.41;
  static constexpr double cw1 = cb1 / (karman * karman) + (1.0 + cb2) / sigma, cw2 = 0.3, cw3 = 2.0;
  static constexpr double cv1 = 7.1, cv2 = 0.7, cv3 = 0.9, ct3 = 1.2, cn1 = 16.0;
  static constexpr double stream_ratio = 3.0;  // working variable over viscosity in the stream

  // Turbulent viscosity over molecular viscosity, by chi, the working variable over kinematic viscosity (9).
  template <class T>
  static T turbulent_ratio(const T& chi) {
    if (value_of(chi) <= 0.0) return T(0.0);
    return chi * damping(chi);
  }

  // The diffusivity of the working variable times density, over molecular viscosity (18, 21).
  template <class T>
  static T diffusion_ratio(const T& chi) {
    if (value_of(chi) >= 0.0) return (1.0 / sigma) * (1.0 + chi);
    const T cube = chi * chi * chi;
    return (1.0 / sigma) * (1.0 + chi * (cn1 + cube) / (cn1 - cube));
  }

  // Production less destruction of the working variable w, by kinematic viscosity, vorticity and the distance
  // from walls (13 to 17, 22). There is no production in laminar zones.
  template <class T>
  static T source(const T& w, const T& viscosity, const T& vorticity, const T& distance, bool is_laminar) {
    const T by_distance = w / (distance * distance);
    const double production = is_laminar ? 0.0 : cb1;
    if (value_of(w) < 0.0) return production * (1.0 - ct3) * vorticity * w + cw1 * (w * by_distance);
    const T chi = w / viscosity;
    const T shear = modified_vorticity(chi, vorticity, by_distance);
    const T wall = wall_function(by_distance, shear);
    return production * (shear * w) - cw1 * wall * (w * by_distance);
  }

 private:
  template <class T>
  static T damping(const T& chi) {
    const T cube = chi * chi * chi;
    return cube / (cube + cv1 * cv1 * cv1);
  }
  // (11, 12): it stays positive.
  template <class T>
  static T modified_vorticity(const T& chi, const T& vorticity, const T& by_distance) {
    const T added = (1.0 / (karman * karman)) * (by_distance * (1.0 - chi / (1.0 + chi * damping(chi))));
    if (value_of(added) >= -cv2 * value_of(vorticity)) return vorticity + added;
    return vorticity +
           vorticity * (cv2 * cv2 * vorticity + cv3 * added) / ((cv3 - 2.0 * cv2) * vorticity - added);
  }
  // fw of r, which is 10 at most (15 to 17).
  template <class T>
  static T wall_function(const T& by_distance, const T& shear) {
    using std::pow;
    constexpr double largest = 10.0, c6 = cw3 * cw3 * cw3 * cw3 * cw3 * cw3;
    T r(largest);
    if (value_of(by_distance) < largest * karman * karman * value_of(shear))
      r = by_distance / (karman * karman * shear);
    const T r2 = r * r;
    const T g = r + cw2 * (r2 * r2 * r2 - r);
    const T g2 = g * g;
    return g * pow((1.0 + c6) / (g2 * g2 * g2 + c6), 1.0 / 6.0);
  }
};

}  // namespace remodel::flow
