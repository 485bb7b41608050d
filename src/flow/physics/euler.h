#pragma once

// The compressible Euler equations of a perfect gas at one point or face. Everything is written once, for
// doubles and for dual numbers alike, so that derivatives are exact.
//
// Sources: P. L. Roe, "Approximate Riemann solvers, parameter vectors, and difference schemes", J. Comput.
// Phys. 43 (1981); F. Rieper, "A low-Mach number fix for Roe's approximate Riemann solver", J. Comput. Phys.
// 230 (2011), with the function of X.-S. Li and C.-W. Gu, J. Comput. Phys. 227 (2008), eq. (21), for its factor.

#include <array>
#include <cmath>

#include "flow/physics/dual.h"
#include "flow/physics/state.h"
#include "remodel/point.h"

namespace remodel::flow {

inline constexpr double gas_gamma = 1.4;

// A vector of the plane, of numbers of any kind.
template <class T>
struct PlaneVector {
  T x, y;
  PlaneVector() = default;
  PlaneVector(const T& at_x, const T& at_y) : x(at_x), y(at_y) {}
  PlaneVector(Point p) : x(p.x), y(p.y) {}
};

// |x| with a parabola around zero, so that its derivative is continuous.
template <class T>
T rounded_abs(const T& x, const T& width) {
  if (value_of(x) >= value_of(width)) return x;
  if (value_of(x) <= -value_of(width)) return -x;
  return (x * x + width * width) / (2.0 * width);
}

// Density, momentum, energy.
template <class T>
Fluxes<T> conserved(const Unknowns<T>& q) {
  const T &rho = density(q), &u = velocity_x(q), &v = velocity_y(q);
  return {rho, rho * u, rho * v, pressure(q) / (gas_gamma - 1.0) + 0.5 * (rho * (u * u + v * v))};
}

template <class T>
T mach_squared(const Unknowns<T>& q) {
  const T &u = velocity_x(q), &v = velocity_y(q);
  return (u * u + v * v) * density(q) / (gas_gamma * pressure(q));
}

// What the jump of normal velocity in Roe's acoustic waves is multiplied by, given the Mach number's square: 1
// from Mach 1 on, with a continuous derivative, and as the Mach number itself in slow flow, whose
// dissipation would otherwise grow with the speed of sound.
template <class T>
T slow_flow_factor(const T& mach_squared) {
  using std::sqrt;
  constexpr double least = 1e-6;  // of the square: the root has a derivative at rest
  const T below = 1.0 - mach_squared;
  if (value_of(below) <= 0.0) return T(1.0);
  const T square = below * below;
  return sqrt((mach_squared + least * square) * (4.0 + square)) / (1.0 + mach_squared);
}

// The largest speed of a wave through a face, times its length.
inline double wave_speed(const Unknowns<double>& q, Point normal) {
  return std::fabs(velocity_x(q) * normal.x + velocity_y(q) * normal.y) +
         std::sqrt(gas_gamma * pressure(q) / density(q) * dot(normal, normal));
}

// How Roe's flux is told to dissipate: half-widths of the parabolas of acoustic and of linear waves, in speeds of
// sound; and what is added to the square of the Mach number in slow_flow_factor().
struct Dissipation {
  double acoustic = 0.1, linear = 0.02, mach_squared = 0.0;
};

// Roe's flux through a face of this normal (whose length is the face's), from left to right, for all speeds.
template <class T, class G>
Fluxes<T> roe_flux(const Unknowns<T>& l, const Unknowns<T>& r, const PlaneVector<G>& normal,
                   const Dissipation& fix = {}) {
  using std::sqrt;
  const G area = sqrt(normal.x * normal.x + normal.y * normal.y);
  if (value_of(area) == 0.0) return {};
  const G nx = normal.x / area, ny = normal.y / area;
  constexpr double g = gas_gamma / (gas_gamma - 1.0);
  const T &rho_l = density(l), &u_l = velocity_x(l), &v_l = velocity_y(l), &p_l = pressure(l);
  const T &rho_r = density(r), &u_r = velocity_x(r), &v_r = velocity_y(r), &p_r = pressure(r);
  const T hl = g * p_l / rho_l + 0.5 * (u_l * u_l + v_l * v_l);
  const T hr = g * p_r / rho_r + 0.5 * (u_r * u_r + v_r * v_r);
  const T through_l = u_l * nx + v_l * ny, through_r = u_r * nx + v_r * ny;

  const T w = sqrt(rho_r / rho_l);
  const T share = 1.0 / (1.0 + w);
  const T rho = w * rho_l;
  const T u = (u_l + w * u_r) * share, v = (v_l + w * v_r) * share, h = (hl + w * hr) * share;
  const T square = 0.5 * (u * u + v * v);
  const T c2 = (gas_gamma - 1.0) * (h - square);
  const T c = sqrt(c2);
  const T vn = u * nx + v * ny;

  const T slow = rounded_abs<T>(vn - c, fix.acoustic * c), fast = rounded_abs<T>(vn + c, fix.acoustic * c);
  const T linear = rounded_abs<T>(vn, fix.linear * c);
  const T drho = rho_r - rho_l, dp = p_r - p_l, dvn = through_r - through_l;
  const T acoustic = rho * c * slow_flow_factor<T>(2.0 * square / c2 + fix.mach_squared) * dvn;
  const T a1 = slow * (dp - acoustic) / (2.0 * c2);
  const T a2 = linear * (drho - dp / c2);
  const T a3 = fast * (dp + acoustic) / (2.0 * c2);
  const T shear = linear * rho;
  const T du = u_r - u_l - nx * dvn, dv = v_r - v_l - ny * dvn;

  const T ml = rho_l * through_l, mr = rho_r * through_r;
  const T both = p_l + p_r;
  const G half = 0.5 * area;
  return {half * (ml + mr - (a1 + a2 + a3)),
          half * (ml * u_l + mr * u_r + both * nx -
                  (a1 * (u - nx * c) + a2 * u + a3 * (u + nx * c) + shear * du)),
          half * (ml * v_l + mr * v_r + both * ny -
                  (a1 * (v - ny * c) + a2 * v + a3 * (v + ny * c) + shear * dv)),
          half * (ml * hl + mr * hr -
                  (a1 * (h - vn * c) + a2 * square + a3 * (h + vn * c) + shear * (u * du + v * dv)))};
}

// Derivatives of the flux through a face by the unknowns; row-major.
template <class T>
std::array<T, unknown_count * unknown_count> flux_derivative(const Unknowns<T>& q, Point normal) {
  constexpr double g = gas_gamma / (gas_gamma - 1.0);
  const T &rho = density(q), &u = velocity_x(q), &v = velocity_y(q);
  const T through = u * normal.x + v * normal.y, mass = rho * through;
  const T square = 0.5 * (u * u + v * v);
  const T energy = g * pressure(q) + rho * square;
  const T mx = rho * normal.x, my = rho * normal.y;
  const T nx(normal.x), ny(normal.y), none(0.0);
  const T along_x = energy * normal.x, along_y = energy * normal.y;
  return {through,
          mx,
          my,
          none,  //
          u * through,
          mass + u * mx,
          u * my,
          nx,  //
          v * through,
          v * mx,
          mass + v * my,
          ny,  //
          square * through,
          u * mass + along_x,
          v * mass + along_y,
          g * through};
}

// The extrapolation correction of one end: what the flux through a face, linearised at `vertex`, is at
// `value` and `further` above the flux at `value` itself. With linear extrapolations to the middle of an edge
// the mean of both ends' is exact for quadratic fluxes without sources, over dual cells of any triangles: A.
// Katz and V. Sankaran, J. Comput. Phys. 230 (2011).
template <class T, class Q, class G>
Fluxes<T> extrapolation_correction(const Unknowns<Q>& vertex, const Unknowns<T>& value,
                                   const Unknowns<T>& further, const PlaneVector<G>& normal) {
  constexpr double g = gas_gamma / (gas_gamma - 1.0);
  const Q &rho = density(vertex), &u = velocity_x(vertex), &v = velocity_y(vertex);
  const Q square = u * u + v * v;
  const Q energy = g * pressure(vertex) + 0.5 * rho * square;
  const T through = u * normal.x + v * normal.y, mass = rho * through;
  // Linear in `further`.
  const T further_through = velocity_x(further) * normal.x + velocity_y(further) * normal.y;
  const T further_mass = density(further) * through + rho * further_through;
  const T further_energy = g * pressure(further) + 0.5 * density(further) * square +
                           rho * (u * velocity_x(further) + v * velocity_y(further));
  // Beyond linear in the difference to `value`.
  const T drho = density(value) - rho, du = velocity_x(value) - u, dv = velocity_y(value) - v;
  const T dthrough = du * normal.x + dv * normal.y;
  const T curved_mass = drho * dthrough;
  const T dmass = drho * through + rho * dthrough + curved_mass;
  const T work = u * du + v * dv;
  const T curved_energy = drho * work + 0.5 * density(value) * (du * du + dv * dv);
  const T denergy =
      g * (pressure(value) - pressure(vertex)) + 0.5 * drho * square + rho * work + curved_energy;
  return {further_mass - curved_mass,
          further_mass * u + mass * velocity_x(further) + pressure(further) * normal.x - curved_mass * u -
              dmass * du,
          further_mass * v + mass * velocity_y(further) + pressure(further) * normal.y - curved_mass * v -
              dmass * dv,
          further_energy * through + energy * further_through - curved_energy * through - denergy * dthrough};
}

// The smoothness sensor, the part of that correction which is taken between two vertices: 1 where they are
// the same, a half where they are a tenth apart (squares of the differences of density, pressure and
// velocity, by their means and the isothermal speed of sound), little across what the mesh does not resolve.
template <class T>
T smoothness(const Unknowns<T>& a, const Unknowns<T>& b) {
  constexpr double steepness = 100.0;
  const T rho = 0.5 * (density(a) + density(b)), p = 0.5 * (pressure(a) + pressure(b));
  const T drho = (density(b) - density(a)) / rho, dp = (pressure(b) - pressure(a)) / p;
  const T du = velocity_x(b) - velocity_x(a), dv = velocity_y(b) - velocity_y(a);
  return 1.0 / (1.0 + steepness * (drho * drho + dp * dp + (du * du + dv * dv) * rho / p));
}

}  // namespace remodel::flow
