#pragma once

#include <cstddef>

#include "triangulation/cavity.h"
#include "triangulation/circle.h"

namespace remodel {

// The edges from a new vertex to the vertices of its ring, and the triangles between an edge and the next.
// These are computed several at once: loops over rows of numbers compile to vector instructions.
class Spokes {
 public:
  // Of a vertex at p with n neighbours: set() each, then compute().
  void begin(Point p, std::size_t n) {
    centre_ = p;
    size_ = n;
    stride_ = (n + lanes - 1) / lanes * lanes;
    edges_.resize(stride_ + 1);
    rows_.resize(row_count * stride_);
  }
  void set(std::size_t k, Point neighbour) { edges_[k] = neighbour - centre_; }
  void compute();

  std::size_t size() const { return size_; }
  double length(std::size_t k) const { return row(length_row)[k]; }
  // Of the triangle between edges k and k + 1.
  Circle circle(std::size_t k) const {
    return {{row(x_row)[k], row(y_row)[k]}, row(inside_row)[k], row(outside_row)[k]};
  }
  double squared_shortest(std::size_t k) const { return row(shortest_row)[k]; }

  static constexpr std::size_t lanes = 4;

 private:
  enum Row : std::size_t { x_row, y_row, inside_row, outside_row, shortest_row, length_row, row_count };

  const double* row(Row r) const { return rows_.begin() + r * stride_; }

  Point centre_;
  std::size_t size_ = 0, stride_ = 0;  // of edges; of a row, whole vectors
  Buffer<Point> edges_;                // filled up with the first, and once more
  Buffer<double> rows_;
};

}  // namespace remodel
