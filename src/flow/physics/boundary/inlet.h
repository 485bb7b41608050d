#pragma once

// Gas enters with a given total pressure and total temperature, along the normal or at a given angle. Source:
// J.-R. Carlson, "Inflow/outflow boundary conditions with application to FUN3D", NASA TM-2011-217181.

#include <cmath>
#include <optional>

#include "flow/physics/boundary/inputs.h"

namespace remodel::flow {

struct Inlet {
  static constexpr const char* kind = "inlet or outlet";
  static constexpr bool solid = false, bent = false, one_sided = false, open = true;
  double total_pressure = 1.0, total_temperature = 1.0;  // parts of the stream's
  std::optional<double> angle = {};                      // to the x axis, radians; none: along the normal

  template <class T>
  Fluxes<T> flux(const BoundaryInputs<T>& in, const Stream&) const {
    const Unknowns<T> at = state(in);
    return roe_flux<T>(at, at, in.half);  // of one state: its own flux
  }

 private:
  // The wave that leaves the domain is the inner state's, by its velocity and pressure: its speed of sound is
  // that of the gas that enters, whose entropy the inner gas need not have (beside warm walls it has not).
  template <class T>
  Unknowns<T> state(const BoundaryInputs<T>& in) const {
    using std::pow, std::sqrt;
    constexpr double g = gas_gamma - 1.0;
    const Unknowns<T> inside = in.mean();
    const TotalState<T> total = total_state(in.mach);
    const T whole_pressure = total_pressure * total.pressure;
    const T sound_square = total_temperature * total.sound_square;
    const auto [nx, ny] = in.unit_normal();
    const T sound = sqrt(sound_square) * pow(pressure(inside) / whole_pressure, 0.5 * g / gas_gamma);
    const T wave = velocity_x(inside) * nx + velocity_y(inside) * ny + (2.0 / g) * sound;
    const PlaneVector<T> along =
        angle ? PlaneVector<T>{T(std::cos(*angle)), T(std::sin(*angle))} : PlaneVector<T>{-nx, -ny};
    const T inwards = angle ? -(along.x * nx + along.y * ny) : T(1.0);
    // c^2 + g/2 v^2 = sound_square where -v * inwards + 2 c / g = wave.
    const T a = inwards * inwards + 2.0 / g;
    T root = a * sound_square - 0.5 * g * (wave * wave);
    if (!(value_of(root) > 0.0)) root = 1e-12 * sound_square;
    const T c = (wave + inwards * sqrt(root)) / a;
    const T speed = ((2.0 / g) * c - wave) / inwards;
    const T p = whole_pressure * pow(c * c / sound_square, gas_gamma / g);
    return {gas_gamma * p / (c * c), along.x * speed, along.y * speed, p};
  }
};

}  // namespace remodel::flow
