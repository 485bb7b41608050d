#pragma once

// The checker's own exact geometry. Every finite double is an integer times a power of two: all coordinates
// of a mesh are scaled to integers once, and everything is decided in integer arithmetic. No filters, no
// tolerance.

#include <boost/multiprecision/cpp_int.hpp>
#include <cstdint>
#include <memory>
#include <vector>

#include "remodel/point.h"

namespace remodel::checker {

class ExactPoints {
 public:
  using Integer = boost::multiprecision::cpp_int;

  virtual ~ExactPoints() = default;

  // Twice the signed area of a triangle, in square units of the scaled coordinates.
  virtual Integer twice_area(std::uint32_t a, std::uint32_t b, std::uint32_t c) const = 0;
  // The scalar product of the vectors from a to b and to c, in the same units.
  virtual Integer dot(std::uint32_t a, std::uint32_t b, std::uint32_t c) const = 0;
  // The sign of that area: +1 counter-clockwise, 0 without area.
  virtual int orientation(std::uint32_t a, std::uint32_t b, std::uint32_t c) const = 0;
  // The cross product of the position vectors of a and b: summed over the edges of a polygon, twice its area.
  virtual Integer cross(std::uint32_t a, std::uint32_t b) const = 0;
  // +1 if d is inside the circle through a, b, c in counter-clockwise order, 0 on it, -1 outside.
  virtual int in_circle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const = 0;
  // Half of it in square units of the mesh, rounded.
  virtual double half_in_mesh_units(const Integer& twice_area) const = 0;
};

// The points must be finite.
std::unique_ptr<ExactPoints> exact_points(const std::vector<Point>& points);

}  // namespace remodel::checker
