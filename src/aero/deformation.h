#pragma once

// The variables of a deformation as columns of its matrix.

#include <vector>

#include "aero/problem_place.h"
#include "remodel/deformation.h"

namespace remodel {

// A number of the domain (coefficients_of(Domain)) that a variable moves, and by how much of it.
struct MovedNumber {
  std::size_t number = 0;
  double by = 0.0;
};

struct DeformationVariable {
  std::string name;
  DeformationRange range = {};
  std::vector<MovedNumber> moves = {};
};

// Throws for parts that move nothing, are out of range, name no curve, or would tear the domain.
std::vector<DeformationVariable> variables_of(const Deformation& deformation, const ProblemPlace& place);

}  // namespace remodel
