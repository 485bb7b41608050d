#pragma once

// Viscosity and conduction of a perfect gas, in units of the stream's: its density and speed of sound are 1,
// so that a viscosity is Mach number times length over Reynolds number, and a temperature gamma p / rho.
//
// Source: W. Sutherland, Phil. Mag. 36 (1893); constants of air as in F. M. White, "Viscous Fluid Flow".

#include "flow/physics/euler.h"

namespace remodel::flow {

struct Viscosity {
  double stream = 0.0;       // of the stream: Mach number times length over Reynolds number
  double temperature = 300;  // of the stream, in Kelvin; 0: the viscosity is constant
  double prandtl = 0.72, turbulent_prandtl = 0.9;

  // At a temperature, a part of the stream's.
  template <class T>
  T at(const T& relative) const {
    using std::sqrt;
    constexpr double sutherland = 110.4;  // K
    if (temperature == 0.0) return T(stream);
    const double s = sutherland / temperature;
    return stream * (1.0 + s) * (relative * sqrt(relative)) / (relative + s);
  }
};

template <class T>
T temperature(const Unknowns<T>& q) {
  return gas_gamma * pressure(q) / density(q);
}

// Momentum and energy that friction and conduction carry along x and y, against the gradients: the force of
// the stress, its work, and heat.
template <class T>
struct ViscousFlux {
  PlaneVector<T> momentum_x, momentum_y, energy;
};

// u, v: of the face; du, dv, dtemperature: gradients; conduction: viscosity over Prandtl number, of all
// parts.
template <class T>
ViscousFlux<T> viscous_flux(const T& u, const T& v, const PlaneVector<T>& du, const PlaneVector<T>& dv,
                            const PlaneVector<T>& dtemperature, const T& viscosity, const T& conduction) {
  const T spread = (2.0 / 3.0) * (du.x + dv.y);
  const T xx = viscosity * (2.0 * du.x - spread), yy = viscosity * (2.0 * dv.y - spread);
  const T xy = viscosity * (du.y + dv.x);
  const T heat = conduction / (gas_gamma - 1.0);
  return {
      {xx, xy}, {xy, yy}, {u * xx + v * xy + heat * dtemperature.x, u * xy + v * yy + heat * dtemperature.y}};
}

}  // namespace remodel::flow
