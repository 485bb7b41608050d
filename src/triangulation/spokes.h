#pragma once

#include <cstddef>

#include "geometry/vector_clones.h"
#include "triangulation/cavity.h"
#include "triangulation/circle.h"

namespace remodel {

// The edges from a new vertex to the vertices of its ring, and the triangles between an edge and the next.
// These are computed several at once: loops over rows of numbers compile to vector instructions. Good until
// the next vertex; a copy is to be begun anew.
class Spokes {
 public:
  // Begins with a vertex at p of n neighbours: set() each, then compute().
  void begin(Point p, std::size_t n) {
    const std::size_t stride = whole_vectors(n) * vector_lanes;
    edges_.resize(stride + 1);
    rows_.resize(row_count * stride);
    centre_ = p;
    size_ = n;
    stride_ = stride;
  }
  void set(std::size_t k, Point neighbour) { edges_[k] = neighbour - centre_; }
  void compute();

  std::size_t size() const { return size_; }
  double length(std::size_t k) const { return row(length_row)[k]; }
  // The circle of the triangle between edges k and k + 1.
  Circle circle(std::size_t k) const {
    return {{row(x_row)[k], row(y_row)[k]}, row(inside_row)[k], row(outside_row)[k]};
  }
  double squared_shortest(std::size_t k) const { return row(shortest_row)[k]; }

 private:
  enum Row : std::size_t { x_row, y_row, inside_row, outside_row, shortest_row, length_row, row_count };

  const double* row(Row r) const { return rows_.begin() + r * stride_; }

  Point centre_;
  std::size_t size_ = 0, stride_ = 0;  // of edges; of a row, whole vectors
  Buffer<Point> edges_;                // continued around the ring to whole vectors, and one more
  Buffer<double> rows_;
};

}  // namespace remodel
