#pragma once

// Lift, drag and moment of the pressure on walls, as coefficients with the stream's length.

#include "flow/scheme/functional.h"

namespace remodel::flow {

struct Coefficients {
  double lift = 0.0, drag = 0.0, moment = 0.0;
};

// The weighted sum of the coefficients.
struct WallForce {
  Coefficients weight = {};
  std::uint32_t patch = no_index;  // of this wall; no_index: of all walls

  static constexpr std::size_t sums = 3;  // force along x and y, turning (counter-clockwise)
  bool includes(const FlowMesh& mesh, std::uint32_t of) const {
    return mesh.patches()[of].solid() && (patch == no_index || patch == of);
  }
  template <class T>
  std::array<T, sums> local(const BoundaryInputs<T>& in, const Stream& stream) const {
    constexpr double outside = 1.0 / gas_gamma;
    const PlaneVector<T> force = wall_force<T>(in, pressure(in.here) - outside, pressure(in.there) - outside);
    const T arm_x = near_place * in.place_here.x + far_place * in.place_there.x - stream.reference.x;
    const T arm_y = near_place * in.place_here.y + far_place * in.place_there.y - stream.reference.y;
    return {force.x, force.y, arm_x * force.y - arm_y * force.x};
  }
  // Lift, drag and moment.
  template <class T>
  static std::array<T, 3> coefficients(const std::array<T, sums>& of, const T& mach, const T& alpha,
                                       const Stream& stream) {
    using std::cos, std::sin;
    const T scale = 1.0 / (0.5 * mach * mach * stream.length), ca = cos(alpha), sa = sin(alpha);
    return {scale * (of[1] * ca - of[0] * sa), scale * (of[0] * ca + of[1] * sa),
            -scale * of[2] / stream.length};
  }
  template <class T>
  T total(const std::array<T, sums>& of, const T& mach, const T& alpha, const Stream& stream) const {
    const std::array<T, 3> each = coefficients(of, mach, alpha, stream);
    return weight.lift * each[0] + weight.drag * each[1] + weight.moment * each[2];
  }
};

inline Coefficients coefficients(const FlowSystem& system, const State& state,
                                 std::uint32_t patch = no_index) {
  const WallForce force = {.patch = patch};
  const auto [lift, drag, moment] = WallForce::coefficients<double>(
      sums_of(system, state, force), system.stream().mach, state.augmented[1], system.stream());
  return {lift, drag, moment};
}

}  // namespace remodel::flow
