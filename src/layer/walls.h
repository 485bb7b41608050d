#pragma once

// The walls of a domain that get a layer, and the openings where they end.
//
// A wall is a whole closed loop, or a *chain*: a row of curves that ends, on both sides, where a curve that
// is no wall begins, its *opening*. The columns at the ends of a chain stand on the openings' lines. Where an
// opening goes on from the wall without a corner, as a line of symmetry ahead of a plate does, it is
// *carried*: it has columns too.

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "remodel/domain.h"
#include "remodel/layers.h"

namespace remodel {

// A domain and the points of its loops, which are evaluated once.
struct Walls {
  explicit Walls(const Domain& of);
  // The points of the stations of a wall.
  std::vector<Point> points_of(const LayeredWall& wall) const;
  // Whether the domain is on the left of a loop's direction.
  bool on_left(std::size_t loop) const;

  const Domain& domain;
  std::vector<std::vector<Point>> points;  // per loop
};

// The walls that get a layer, ascending. Throws Error (argument, geometry) as generate_layered() says.
std::vector<LayeredWall> layered_walls(const Walls& walls, const LayerOptions& options);
std::vector<LayeredWall> layered_walls(const Domain& domain, const LayerOptions& options);

// Whether a curve is a wall by its name, and not one that is carried.
bool is_wall(const Domain& domain, std::size_t loop, std::size_t curve,
             const std::vector<std::string>& names);

// Whether a polygon turns by more than 30 degrees at a point, where lengths are not 0.
bool bends_by_30_degrees(Point before, Point at, Point after);

// The curve at the end of a chain, seen from there.
class Opening {
 public:
  Opening() = default;
  // `begins`: the chain ends where the curve begins, and not where it ends.
  Opening(const Loop& loop, std::size_t curve, bool begins, Point corner);
  std::size_t curve() const { return curve_; }  // in its loop
  // What a layer may take of it.
  double longest() const { return part_of_length * length_; }
  // The point that lies so far along it, and its parameter.
  Point at(double distance) const;
  double parameter(double distance) const { return begins_ ? part(distance) : 1.0 - part(distance); }

 private:
  static constexpr double part_of_length = 0.3;
  double part(double distance) const { return distance / length_ / pieces_; }

  Shape shape_;
  std::size_t curve_ = 0;
  bool begins_ = true;
  Point beside_;  // from its end to the corner: nothing but rounding, unless one of the two is differenced
  double length_ = 0.0, pieces_ = 1.0;  // of its first piece, and how many there are
};
using Openings = std::array<Opening, 2>;  // at a chain's beginning and its end

// Precondition: a chain that layered_walls() has found.
Openings openings_of(const Walls& walls, const LayeredWall& wall);

}  // namespace remodel
