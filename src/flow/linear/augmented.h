#pragma once

// Vectors and matrices of a flow's unknowns: blocks of vertices, and two unknowns beside them. The augmented
// system [A B; D E] [x; z] = [r; g] has B dense and D sparse, and is solved by what solves for A alone.

#include <array>
#include <span>
#include <vector>

#include "flow/linear/block_matrix.h"
#include "flow/physics/state.h"

namespace remodel::flow {

using Vector = BlockVector<unknown_count>;
using Block = SquareBlock<unknown_count>;
using BlockRows = BlockMatrix<unknown_count>;

inline constexpr std::size_t augmented_count = 2;
using Augmented = std::array<double, augmented_count>;

struct Increment {
  Vector q;
  Augmented augmented = {};
};

Increment zero(std::size_t vertices);
double inner(const Vector& a, const Vector& b);
double inner(const Increment& a, const Increment& b);
double norm(const Increment& a);
void add_times(Increment& to, double factor, const Increment& what);

// D and E. The second equation has augmented unknowns alone.
struct AugmentedRows {
  struct Entry {
    std::uint32_t vertex;
    Unknowns<double> by;
  };
  std::vector<Entry> first;  // a vertex may have several
  std::array<Augmented, augmented_count> corner;

  double times(const Vector& x) const;                   // the first row of D
  void add_transposed(double factor, Vector& to) const;  // of it
};

// The whole matrix.
class AugmentedMatrix {
 public:
  AugmentedMatrix(const BlockRows& matrix, std::array<Vector, augmented_count> columns, AugmentedRows rows)
      : matrix_(matrix), columns_(std::move(columns)), rows_(std::move(rows)) {}
  const BlockRows& blocks() const { return matrix_; }
  const AugmentedRows& rows() const { return rows_; }
  Increment times(const Increment& x) const;
  Increment transposed_times(const Increment& x) const;

 private:
  const BlockRows& matrix_;
  std::array<Vector, augmented_count> columns_;
  AugmentedRows rows_;
};

// x and the solutions y of A y = B for both columns. Not finite where the small system is singular.
Increment close_augmented(Vector x, const std::array<Vector, augmented_count>& y, const AugmentedRows& rows,
                          const Augmented& right);

}  // namespace remodel::flow
