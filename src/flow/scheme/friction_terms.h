#pragma once

// The terms of flows with friction, each once, for numbers and dual numbers alike: the convective flux of a
// face, what friction, conduction and turbulence do in a triangle, boundaries. N unknowns a vertex: those of
// physics/state.h, and for 5 the working variable of Spalart and Allmaras, in units of working_unit times the
// stream's kinematic viscosity.

#include "flow/physics/boundary/patch.h"
#include "flow/physics/spalart_allmaras.h"
#include "flow/physics/viscosity.h"
#include "flow/scheme/friction_mesh.h"
#include "flow/scheme/reconstruction.h"

namespace remodel::flow {

template <class T, std::size_t N>
using Local = std::array<T, N>;

struct FrictionTerms {
  Viscosity viscosity;
  double mach = 0.0;  // of the stream
  double slopes = 1.0, working_slopes = 1.0;
  double limiter = 30.0, extent = 1.0;  // Stream::limiter and its length
  // Boundary layers are thin where Roe's linear waves hardly move: what the usual half-width of their
  // parabola adds is far above molecular diffusion.
  Dissipation fix = {.acoustic = 0.1, .linear = 1e-3};
  // Large enough for the fifth unknown and its equation to be as large as the others.
  static constexpr double working_unit = 100.0;
  static constexpr double stream_working = SpalartAllmaras::stream_ratio / working_unit;
  static constexpr double kinks = 1e-3;  // roundings of |vorticity| and |mass flux|, as parts of the stream's

  template <class T, std::size_t N>
  static Unknowns<T> gas(const Local<T, N>& q) {
    return {q[0], q[1], q[2], q[3]};
  }

  // What the limiter compares the squares of differences along an edge with.
  double limiter_width(Point edge) const {
    const double h = limiter * std::sqrt(dot(edge, edge)) / extent;
    return h * h * h;
  }
  // From the value at an end of an edge to that in its middle. `limited` is limited_part() of the edge's
  // ends.
  template <class T>
  T step(const T& upwind, const T& central, const T& width, const T& limited) const {
    return slopes * reconstruction_step<T, T>(EdgeEnd::inner, upwind, central, width, limited).step;
  }

  // The same of the working variable, limited everywhere: without that it swings below zero where boundary
  // layers end, and NACA 0012 at 0 degrees took 27 steps instead of 24 (docs/viscous.md).
  template <class T>
  T working_step(const T& upwind, const T& central) const {
    constexpr double unlimited = 0.1;  // the square of a difference, of 30 times the stream's viscosity
    return working_slopes *
           reconstruction_step<T, T>(EdgeEnd::inner, upwind, central, T(unlimited), T(1.0)).step;
  }

  // The working variable is upwinded by the mass that passes.
  template <class T, class G>
  T upwinded(const T& mass, const T& left, const T& right, const G& area) const {
    const T size = rounded_abs<T>(mass, T(kinks * area));
    return 0.5 * (mass * (left + right) - size * (right - left));
  }

  // Of reconstructed values.
  template <class T, std::size_t N, class G>
  Local<T, N> face_flux(const Local<T, N>& left, const Local<T, N>& right,
                        const PlaneVector<G>& normal) const {
    using std::sqrt;
    const Fluxes<T> flux = roe_flux<T>(gas(left), gas(right), normal, fix);
    Local<T, N> result;
    for (std::size_t k = 0; k < unknown_count; ++k) result[k] = flux[k];
    if constexpr (N == 5)
      result[4] = upwinded(flux[0], left[4], right[4], G(sqrt(normal.x * normal.x + normal.y * normal.y)));
    return result;
  }

  // Out of the domain through the half of a boundary edge; `here` is at its vertex.
  template <class T, std::size_t N>
  Local<T, N> boundary_flux(const Patch& patch, const BoundaryInputs<T>& in, const Local<T, N>& here,
                            const Stream& stream) const {
    const Fluxes<T> flux = patch.flux(in, stream);
    Local<T, N> result;
    for (std::size_t k = 0; k < unknown_count; ++k) result[k] = flux[k];
    if constexpr (N == 5) {
      using std::sqrt;
      result[4] = T(0.0);
      if (patch.is_farfield() || patch.open())
        result[4] = upwinded(flux[0], here[4], T(stream_working),
                             T(sqrt(in.half.x * in.half.x + in.half.y * in.half.y)));
    }
    return result;
  }

  // What leaves the dual cells of the corners by friction and conduction, less what turbulence makes there as
  // it diffuses. has_turbulence: of the corners, false on walls.
  template <class T, std::size_t N, class G>
  std::array<Local<T, N>, 3> triangle(const std::array<Local<T, N>, 3>& q, const TriangleShape<G>& of,
                                      const std::array<bool, 3>& has_turbulence) const;

  template <class T, std::size_t N, class G>
  static T vorticity(const std::array<Local<T, N>, 3>& q, const TriangleShape<G>& of) {
    T sum(0.0);
    for (std::size_t i = 0; i < 3; ++i) sum = sum + q[i][2] * of.slope[i].x - q[i][1] * of.slope[i].y;
    return sum;
  }
  // What turbulence makes in a dual cell of this area, less what it destroys, by the cell's mean vorticity.
  // The source is far from linear in vorticity: the mean of sources by the vorticity of each triangle lacks
  // 3 % of the friction where cells grow by 1.2 (docs/viscous.md).
  template <class T, std::size_t N, class G>
  T made(const Local<T, N>& q, const T& vorticity, const G& area, const WallPlace<G>& wall) const {
    using std::sqrt;
    const double unit = working_unit * viscosity.stream;
    const T kinematic = viscosity.at(T(gas_gamma * q[3] / q[0])) / q[0];
    const T size = sqrt(vorticity * vorticity + (kinks * mach) * (kinks * mach));
    return (1.0 / unit) * area * q[0] *
           SpalartAllmaras::source<T>(unit * q[N - 1], kinematic, size, T(wall.distance), wall.is_laminar);
  }
};

template <class T, std::size_t N, class G>
std::array<Local<T, N>, 3> FrictionTerms::triangle(const std::array<Local<T, N>, 3>& q,
                                                   const TriangleShape<G>& of,
                                                   const std::array<bool, 3>& has_turbulence) const {
  const auto gradient = [&](const T& a, const T& b, const T& c) {
    return PlaneVector<T>(a * of.slope[0].x + b * of.slope[1].x + c * of.slope[2].x,
                          a * of.slope[0].y + b * of.slope[1].y + c * of.slope[2].y);
  };
  const auto mean = [](const auto& x) { return (1.0 / 3.0) * (x[0] + x[1] + x[2]); };
  [[maybe_unused]] const double unit = working_unit * viscosity.stream;
  std::array<T, 3> warmth, molecular, turbulent, diffusion;
  for (std::size_t i = 0; i < 3; ++i) {
    warmth[i] = gas_gamma * q[i][3] / q[i][0];
    molecular[i] = viscosity.at(warmth[i]);
    if constexpr (N == 5) {
      const T chi = unit * q[i][0] * q[i][4] / molecular[i];
      turbulent[i] = molecular[i] * SpalartAllmaras::turbulent_ratio(chi);
      diffusion[i] = molecular[i] * SpalartAllmaras::diffusion_ratio(chi);
    }
  }
  const PlaneVector<T> du = gradient(q[0][1], q[1][1], q[2][1]), dv = gradient(q[0][2], q[1][2], q[2][2]);
  T whole = mean(molecular), conduction = (1.0 / viscosity.prandtl) * whole;
  if constexpr (N == 5) {
    const T by_turbulence = mean(turbulent);
    whole = whole + by_turbulence;
    conduction = conduction + (1.0 / viscosity.turbulent_prandtl) * by_turbulence;
  }
  const T u = (1.0 / 3.0) * (q[0][1] + q[1][1] + q[2][1]), v = (1.0 / 3.0) * (q[0][2] + q[1][2] + q[2][2]);
  const ViscousFlux<T> flux =
      viscous_flux<T>(u, v, du, dv, gradient(warmth[0], warmth[1], warmth[2]), whole, conduction);
  std::array<Local<T, N>, 3> result;
  for (std::size_t i = 0; i < 3; ++i) {
    const G &x = of.face[i].x, &y = of.face[i].y;
    result[i][0] = T(0.0);
    result[i][1] = x * flux.momentum_x.x + y * flux.momentum_x.y;
    result[i][2] = x * flux.momentum_y.x + y * flux.momentum_y.y;
    result[i][3] = x * flux.energy.x + y * flux.energy.y;
  }
  if constexpr (N == 5) {
    const PlaneVector<T> dw = gradient(q[0][4], q[1][4], q[2][4]);
    const PlaneVector<T> drho = gradient(q[0][0], q[1][0], q[2][0]);
    const T spread = mean(diffusion);
    const T square = dw.x * dw.x + dw.y * dw.y, across = drho.x * dw.x + drho.y * dw.y;
    for (std::size_t i = 0; i < 3; ++i) {
      result[i][4] = spread * (of.face[i].x * dw.x + of.face[i].y * dw.y);
      if (value_of(of.share[i]) == 0.0 || !has_turbulence[i]) continue;
      result[i][4] = result[i][4] - of.share[i] * ((SpalartAllmaras::cb2 / SpalartAllmaras::sigma * unit) *
                                                       (q[i][0] * square) -
                                                   (diffusion[i] / q[i][0]) * across);
    }
  }
  return result;
}

}  // namespace remodel::flow
