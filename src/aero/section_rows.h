#pragma once

// Constraints of one section that are linear in its coefficients: sizes, edges, what it contains.

#include "aero/kinds.h"

namespace remodel {

// bound - row * a is at most 0, of the coefficients a of the upper, then of the lower surface.
struct SectionRow {
  std::vector<double> row;
  double bound = 0.0;
};

// t of the upper surface at this x; the lower one has it at 1 - t.
double parameter_at(double x);
// Adds factor times the height of a surface at x to what is at least the bound. Of the airfoil its degree,
// class and trailing edge are of account.
void add_height(const CstAirfoil& like, double x, bool upper, double factor, SectionRow& row);
// The stations `x` of a constraint: one or more, above 0 and below 1.
const std::vector<double>& stations_of(const DomainRequest& request);
// row * a - bound: what is at least 0.
double value_of(const SectionRow& row, const CstAirfoil& airfoil);

class SectionRows final : public DomainConstraint {
 public:
  SectionRows(std::size_t section, std::vector<SectionRow> rows)
      : section_(section), rows_(std::move(rows)) {}
  std::size_t count() const override { return rows_.size(); }
  std::vector<DesignValue> at(const DesignView& of) const override;

 private:
  std::size_t section_;
  std::vector<SectionRow> rows_;
};

}  // namespace remodel
