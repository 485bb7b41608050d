#include "aero/section_rows.h"

#include <cmath>

namespace remodel {

double parameter_at(double x) {
  return std::acos(2.0 * x - 1.0) / (2.0 * M_PI);
}

void add_height(const CstAirfoil& like, double x, bool upper, double factor, SectionRow& to) {
  const std::size_t n = like.upper.size();
  std::vector<double> row(n);
  const double t = parameter_at(x);
  const CstStation at = cst_basis(upper ? t : 1.0 - t, like.degree(), like.e1, like.e2, row);
  to.row.resize(2 * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) to.row[(upper ? 0 : n) + i] += factor * row[i];
  to.bound -= factor * at.x * (upper ? like.te_upper : like.te_lower);
}

const std::vector<double>& stations_of(const DomainRequest& request) {
  const std::vector<double>& stations = station_list_of(request);
  for (const double x : stations)
    if (!(x > 0.0 && x < 1.0))
      request.place.fail("found " + shown(x) + " in 'x', expected numbers above 0 and below 1");
  return stations;
}

double value_of(const SectionRow& row, const CstAirfoil& airfoil) {
  double sum = 0.0;
  const std::size_t n = airfoil.upper.size();
  for (std::size_t i = 0; i < n; ++i)
    sum += row.row[i] * airfoil.upper[i] + row.row[n + i] * airfoil.lower[i];
  return sum - row.bound;
}

std::vector<DesignValue> SectionRows::at(const DesignView& of) const {
  const CstAirfoil section = of.space.section(of.design, section_);
  const std::size_t n = section.upper.size();
  std::vector<DesignValue> result;
  for (const SectionRow& of_row : rows_) {
    double value = of_row.bound;
    std::vector<double> row = of_row.row;
    for (std::size_t i = 0; i < row.size(); ++i) {
      value -= row[i] * (i < n ? section.upper[i] : section.lower[i - n]);
      row[i] = -row[i];
    }
    result.push_back({value, of.space.gradient_of_section(section_, row)});
  }
  return result;
}

}  // namespace remodel
