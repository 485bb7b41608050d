#pragma once

// The physics of the flow solver at one point or face: fluxes, the limiter, the stream far away. All of it
// is written for doubles and for dual numbers alike, so that derivatives are exact.
//
// Sources: P. L. Roe, "Approximate Riemann solvers, parameter vectors, and difference schemes", J. Comput.
// Phys. 43 (1981); G. D. van Albada, B. van Leer and W. W. Roberts, "A comparative study of computational
// methods in cosmic gas dynamics", Astron. Astrophys. 108 (1982); J. L. Thomas and M. D. Salas, "Far-field
// boundary conditions for transonic lifting solutions to the FlowSystem equations", AIAA J. 24 (1986),
// equations 3 to 6 (the compressible point vortex).

#include <array>
#include <cmath>

#include "flow/physics/dual.h"
#include "remodel/point.h"

namespace remodel::flow {

inline constexpr double gas_gamma = 1.4;

// Density, velocity, pressure: the unknowns of a vertex.
template <class T>
using Unknowns = std::array<T, 4>;

// |x| with a parabola around zero, so that its derivative is continuous.
template <class T>
T rounded_abs(const T& x, const T& width) {
  if (value_of(x) >= value_of(width)) return x;
  if (value_of(x) <= -value_of(width)) return -x;
  return (x * x + width * width) / (2.0 * width);
}

// Roe's flux through a face of this normal (whose length is the face's), from left to right. Entropy fix: 0.1
// c for the acoustic waves, 0.02 c for the linear ones.
template <class T, class N>
std::array<T, 4> roe_flux_through(const Unknowns<T>& l, const Unknowns<T>& r, const N& normal_x,
                                  const N& normal_y) {
  using std::sqrt;
  const N area = sqrt(normal_x * normal_x + normal_y * normal_y);
  if (value_of(area) == 0.0) return {};
  const N nx = normal_x / area, ny = normal_y / area;
  constexpr double g = gas_gamma / (gas_gamma - 1.0);
  const T hl = g * l[3] / l[0] + 0.5 * (l[1] * l[1] + l[2] * l[2]);
  const T hr = g * r[3] / r[0] + 0.5 * (r[1] * r[1] + r[2] * r[2]);
  const T vl = l[1] * nx + l[2] * ny, vr = r[1] * nx + r[2] * ny;

  const T w = sqrt(r[0] / l[0]);
  const T share = 1.0 / (1.0 + w);
  const T rho = w * l[0];
  const T u = (l[1] + w * r[1]) * share, v = (l[2] + w * r[2]) * share, h = (hl + w * hr) * share;
  const T square = 0.5 * (u * u + v * v);
  const T c2 = (gas_gamma - 1.0) * (h - square);
  const T c = sqrt(c2);
  const T vn = u * nx + v * ny;

  const T slow = rounded_abs<T>(vn - c, 0.1 * c), fast = rounded_abs<T>(vn + c, 0.1 * c);
  const T linear = rounded_abs<T>(vn, 0.02 * c);
  const T drho = r[0] - l[0], dp = r[3] - l[3], dvn = vr - vl;
  const T a1 = slow * (dp - rho * c * dvn) / (2.0 * c2);
  const T a2 = linear * (drho - dp / c2);
  const T a3 = fast * (dp + rho * c * dvn) / (2.0 * c2);
  const T shear = linear * rho;
  const T du = r[1] - l[1] - nx * dvn, dv = r[2] - l[2] - ny * dvn;

  const T ml = l[0] * vl, mr = r[0] * vr;
  const T pressure = l[3] + r[3];
  const N half = 0.5 * area;
  return {half * (ml + mr - (a1 + a2 + a3)),
          half * (ml * l[1] + mr * r[1] + pressure * nx -
                  (a1 * (u - nx * c) + a2 * u + a3 * (u + nx * c) + shear * du)),
          half * (ml * l[2] + mr * r[2] + pressure * ny -
                  (a1 * (v - ny * c) + a2 * v + a3 * (v + ny * c) + shear * dv)),
          half * (ml * hl + mr * hr -
                  (a1 * (h - vn * c) + a2 * square + a3 * (h + vn * c) + shear * (u * du + v * dv)))};
}

template <class T>
std::array<T, 4> roe_flux(const Unknowns<T>& l, const Unknowns<T>& r, Point normal) {
  return roe_flux_through<T, double>(l, r, normal.x, normal.y);
}

// Derivatives of the flux through a face by density, velocity and pressure; row-major.
template <class T>
std::array<T, 16> flux_slopes(const Unknowns<T>& q, Point normal) {
  constexpr double g = gas_gamma / (gas_gamma - 1.0);
  const T through = q[1] * normal.x + q[2] * normal.y, mass = q[0] * through;
  const T square = 0.5 * (q[1] * q[1] + q[2] * q[2]);
  const T energy = g * q[3] + q[0] * square;
  const T mx = q[0] * normal.x, my = q[0] * normal.y;
  const T nx(normal.x), ny(normal.y), none(0.0);
  const T along_x = energy * normal.x, along_y = energy * normal.y;
  return {through,
          mx,
          my,
          none,  //
          q[1] * through,
          mass + q[1] * mx,
          q[1] * my,
          nx,  //
          q[2] * through,
          q[2] * mx,
          mass + q[2] * my,
          ny,  //
          square * through,
          q[1] * mass + along_x,
          q[2] * mass + along_y,
          g * through};
}

// Fluxes that are linear in the differences to a vertex: what the flux through a face, linearised at
// `vertex`, is at `value` and `more` above the flux at `value` itself. With linear extrapolations to the
// middle of an edge the mean of both ends' is exact for quadratic fluxes without sources, over dual cells of
// any triangles: A. Katz and V. Sankaran, J. Comput. Phys. 230 (2011).
template <class T, class V, class N>
std::array<T, 4> linearised_above(const Unknowns<V>& vertex, const Unknowns<T>& value,
                                  const std::array<T, 4>& more, const N& normal_x, const N& normal_y) {
  constexpr double g = gas_gamma / (gas_gamma - 1.0);
  const auto square = vertex[1] * vertex[1] + vertex[2] * vertex[2];
  const auto energy = g * vertex[3] + 0.5 * vertex[0] * square;
  const auto through = vertex[1] * normal_x + vertex[2] * normal_y, mass = vertex[0] * through;
  // Linear in `more`.
  const T more_through = more[1] * normal_x + more[2] * normal_y;
  const T more_mass = more[0] * through + vertex[0] * more_through;
  const T more_energy =
      g * more[3] + 0.5 * more[0] * square + vertex[0] * (vertex[1] * more[1] + vertex[2] * more[2]);
  // Beyond linear in the difference to `value`.
  const T drho = value[0] - vertex[0], du = value[1] - vertex[1], dv = value[2] - vertex[2];
  const T dthrough = du * normal_x + dv * normal_y;
  const T bent_mass = drho * dthrough;
  const T dmass = drho * through + vertex[0] * dthrough + bent_mass;
  const T work = vertex[1] * du + vertex[2] * dv;
  const T bent_energy = drho * work + 0.5 * value[0] * (du * du + dv * dv);
  const T denergy = g * (value[3] - vertex[3]) + 0.5 * drho * square + vertex[0] * work + bent_energy;
  return {more_mass - bent_mass,
          more_mass * vertex[1] + mass * more[1] + more[3] * normal_x - bent_mass * vertex[1] - dmass * du,
          more_mass * vertex[2] + mass * more[2] + more[3] * normal_y - bent_mass * vertex[2] - dmass * dv,
          more_energy * through + energy * more_through - bent_energy * through - denergy * dthrough};
}

// The part of that which is taken between two vertices: 1 where they are alike, a half where they are a tenth
// apart (squares of the differences of density, pressure and velocity, by their means and the isothermal
// speed of sound), little across what the mesh does not resolve.
template <class T>
T alike(const Unknowns<T>& a, const Unknowns<T>& b) {
  constexpr double steepness = 100.0;
  const T rho = 0.5 * (a[0] + b[0]), p = 0.5 * (a[3] + b[3]);
  const T drho = (b[0] - a[0]) / rho, dp = (b[3] - a[3]) / p, du = b[1] - a[1], dv = b[2] - a[2];
  return 1.0 / (1.0 + steepness * (drho * drho + dp * dp + (du * du + dv * dv) * rho / p));
}

// Van Albada's function of two slopes, both as differences over an edge's length: 1 where they are equal. It
// has no minimum over neighbours and is continuously differentiable, so that Newton's method converges
// quadratically; it is cut off at zero by a parabola of this half-width.
template <class T, class E>
T slope_limiter(const T& upwind, const T& central, const E& epsilon) {
  constexpr double blend = 0.1;
  const T s = (2.0 * upwind * central + epsilon) / (upwind * upwind + central * central + epsilon);
  if (value_of(s) <= -blend) return T(0.0);
  if (value_of(s) < blend) return (s + blend) * (s + blend) * (0.25 / blend);
  return s;
}
inline constexpr double kappa = 1.0 / 3.0;
// What is added to the value at an edge's one end to have it at the edge's middle: third order on even
// spacing (kappa = 1/3) where nothing limits it (s = 1).
template <class T>
T half_step(const T& s, const T& upwind, const T& central) {
  return 0.25 * s * ((1.0 - kappa * s) * upwind + (1.0 + kappa * s) * central);
}
// What has to be added to that for kappa = 0, linear extrapolation.
template <class T>
T more_of_step(const T& s, const T& upwind, const T& central) {
  return 0.25 * kappa * (s * s) * (upwind - central);
}

// The stream far away at `from` the vortex: uniform flow of this Mach number and angle (radians), and a point
// vortex of the circulation that belongs to lift coefficient times reference length; total enthalpy and
// entropy are the stream's. The density and the speed of sound of the undisturbed stream are 1.
template <class T, class M, class P>
Unknowns<T> stream_around(const P& from_x, const P& from_y, const M& mach, const T& alpha, const T& lift) {
  using std::cos, std::pow, std::sin, std::sqrt;
  const T ca = cos(alpha), sa = sin(alpha);
  T u = mach * ca, v = mach * sa;
  const P r2 = from_x * from_x + from_y * from_y;
  if (value_of(mach) < 1.0 && value_of(r2) > 0.0) {
    const P r = sqrt(r2);
    const P st = from_y / r, ct = from_x / r;
    const T across = st * ca - ct * sa;  // the sine of the angle to the stream
    const T speed =
        (mach * sqrt(1.0 - mach * mach) / (4.0 * M_PI * r)) * lift / (1.0 - mach * mach * across * across);
    u = u + speed * st;
    v = v - speed * ct;
  }
  const T c2 = 1.0 + 0.5 * (gas_gamma - 1.0) * (mach * mach - u * u - v * v);
  const T rho = pow(c2, 1.0 / (gas_gamma - 1.0));
  return {rho, u, v, rho * c2 / gas_gamma};
}
template <class T>
Unknowns<T> stream_at(Point from, double mach, const T& alpha, const T& lift) {
  return stream_around<T, double, double>(from.x, from.y, mach, alpha, lift);
}

// The state at an inlet: gas of this total pressure and this square of the total speed of sound enters along
// the normal (outwards, of any length), and the wave that leaves the domain is the inner state's. Source for
// both ends: J.-R. Carlson, "Inflow/outflow boundary conditions with application to FUN3D", NASA
// TM-2011-217181.
template <class T>
Unknowns<T> inlet_state(const Unknowns<T>& inside, Point normal, double total_pressure,
                        double total_sound_square) {
  using std::pow, std::sqrt;
  constexpr double g = gas_gamma - 1.0, a = 1.0 + 2.0 / g;
  const double length = std::sqrt(dot(normal, normal));
  const double nx = normal.x / length, ny = normal.y / length;
  const T wave = inside[1] * nx + inside[2] * ny + (2.0 / g) * sqrt(gas_gamma * inside[3] / inside[0]);
  // c^2 + g/2 v^2 = total_sound_square where -v + 2 c / g = wave.
  T root = a * total_sound_square - 0.5 * g * (wave * wave);
  if (!(value_of(root) > 0.0)) root = T(1e-12 * total_sound_square);
  const T c = (wave + sqrt(root)) / a;
  const T speed = (2.0 / g) * c - wave;
  const T pressure = total_pressure * pow(c * c / total_sound_square, gas_gamma / g);
  return {gas_gamma * pressure / (c * c), -nx * speed, -ny * speed, pressure};
}

// The state at an outlet of this pressure: entropy, the speed along the boundary and the wave that leaves are
// the inner state's. Gas that leaves faster than sound is the inner state; a pressure that would make gas do
// so at the outlet itself counts as the one at the speed of sound.
template <class T>
Unknowns<T> outlet_state(const Unknowns<T>& inside, Point normal, double pressure) {
  using std::pow, std::sqrt;
  constexpr double g = gas_gamma - 1.0;
  const double length = std::sqrt(dot(normal, normal));
  const double nx = normal.x / length, ny = normal.y / length;
  const T c = sqrt(gas_gamma * inside[3] / inside[0]), speed = inside[1] * nx + inside[2] * ny;
  if (value_of(speed) >= value_of(c)) return inside;
  const T sonic_c = (g * speed + 2.0 * c) / (g + 2.0);
  T p = T(pressure);
  if (value_of(sonic_c) > 0.0) {
    const T sonic = inside[3] * pow(sonic_c / c, 2.0 * gas_gamma / g);
    if (value_of(sonic) > pressure) p = sonic;
  }
  const T density = inside[0] * pow(p / inside[3], 1.0 / gas_gamma);
  const T gain = (2.0 / g) * (c - sqrt(gas_gamma * p / density));
  return {density, inside[1] + nx * gain, inside[2] + ny * gain, p};
}

}  // namespace remodel::flow
