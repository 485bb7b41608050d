#pragma once

// The walls of a layer as rings of columns. Columns are set up here: which loops have them, how many stand on
// each station, and in which directions they leave the wall.
//
// Words: a *ring* is the columns of one wall, in the order of its stations; that of a chain is open. A *fan*
// is several columns on the station of a convex corner; it has *sectors* between them.

#include <cstdint>
#include <string>
#include <vector>

#include "layer/walls.h"
#include "remodel/domain.h"
#include "remodel/layers.h"

namespace remodel {

using FanSectors =
    std::vector<std::vector<std::uint32_t>>;  // per ring and station: sectors, 0 where there is no fan

struct ColumnRing {
  LayeredWall wall;
  bool left = false;                   // the domain is on the left of the loop's direction
  Openings openings;                   // of a chain
  std::size_t outside_curve = 0;       // the curve of its tops in the loop of the domain beyond the layer
  std::vector<std::uint32_t> station;  // per column: in its loop
  std::vector<Point> foot;             // per column: on the wall
  std::vector<Point> normal;           // per column: its direction at the wall, of length 1
  std::vector<Point> top;              // per column: its direction at the top, of length 1
  std::vector<double> spacing;         // per column: mean length of the two edges of the wall at its station
  std::vector<double>
      step;  // per column: length of the wall up to the next one; 0 inside a fan and at the end
  std::vector<double> thickness;  // per column
  std::vector<double> growth;     // per column
  std::vector<Point> points;      // levels 1, 2, ... of column 0, of column 1, ...

  std::size_t size() const { return foot.size(); }
  bool closed() const { return wall.closed; }
  // Columns that have a next one.
  std::size_t pairs() const { return closed() ? size() : size() - 1; }
  bool are_neighbours(std::size_t c, std::size_t next) const { return c < pairs() && after(c) == next; }
  std::size_t after(std::size_t c) const { return c + 1 == size() ? 0 : c + 1; }
  std::size_t before(std::size_t c) const { return c == 0 ? size() - 1 : c - 1; }
};

// The sectors of fans: those that are kept, per ring (null: none are), where a corner still turns by what
// they were made for, to two sectors; by the turns of the corners elsewhere.
FanSectors fans_of(const Walls& walls, const std::vector<LayeredWall>& layered, const LayerOptions& options,
                   const std::vector<const std::vector<std::uint32_t>*>& kept);

// Columns with their feet and normals; those at the ends of chains follow from their thickness. The sides of
// loops are those of a domain that validate() has accepted.
std::vector<ColumnRing> rings_of(const Walls& walls, const std::vector<LayeredWall>& layered,
                                 const FanSectors& sectors, const LayerOptions& options);

// The columns near an end of a chain lean as the opening does: by less and less, up to some thicknesses away
// from it, so that no column comes near the next one's top.
void lean_to_openings(ColumnRing& ring, const LayerOptions& options);

// Where a column stands, for messages.
std::string column_place(const Domain& domain, const ColumnRing& ring, std::size_t column);

}  // namespace remodel
