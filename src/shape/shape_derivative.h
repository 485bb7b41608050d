#pragma once

// Derivatives of the points of one curve, at fixed parameters, by the numbers that describe the curve
// (remodel/mesh_derivative.h has their order).

#include <span>
#include <vector>

#include "remodel/domain.h"

namespace remodel {

std::vector<double> numbers_of(const Shape& shape);
// The same kind of shape; as many numbers as numbers_of() gives.
Shape with_numbers(const Shape& shape, std::span<const double> numbers);

// How the points at each t move with the numbers in this direction.
std::vector<Point> shape_jvp(const Shape& shape, std::span<const double> t,
                             std::span<const double> direction);
// Transposed: adds to `by_numbers`.
void shape_vjp(const Shape& shape, std::span<const double> t, std::span<const Point> by_points,
               std::span<double> by_numbers);

// How a spline's knots and second derivatives follow when its points move in this direction (closed: the
// last with the first).
struct SplineTangent {
  std::vector<double> knots;
  std::vector<Point> second;
};
SplineTangent spline_tangent(const Spline& spline, std::span<const Point> direction);

}  // namespace remodel
