// Least-squares fit of CST coefficients to a coordinate file's points.

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "cst_row.h"
#include "fit_degree.h"
#include "remodel/airfoil.h"
#include "remodel/error.h"

namespace remodel {
namespace {

// Files have five or six digits.
constexpr double least_gap = 1e-5;
// In chords: what a user should know of a fit. Of 2,172 files of the UIUC, 23 fits are farther off.
constexpr double poor_fit = 5e-3;

std::string name_of(const AirfoilCoordinates& coordinates) {
  return coordinates.name.empty() ? "airfoil" : coordinates.name;
}

// One surface's points as equations: row i of basis times the coefficients is height i.
struct Equations {
  Eigen::MatrixXd basis;
  Eigen::VectorXd heights;
  Eigen::VectorXd removed;       // of each height, of a gap that stays closed
  Eigen::Index informative = 0;  // equations that are not 0 = 0: points strictly between the edges
};

// y over x is only defined on the chord: points a little outside count at its ends.
Equations equations_of(const std::vector<Point>& surface, int degree, double trailing_edge) {
  const CstAirfoil paper_class;
  const Eigen::Index columns = degree + 1;
  const Eigen::Index count = static_cast<Eigen::Index>(surface.size());
  Equations result{.basis = Eigen::MatrixXd(count, columns),
                   .heights = Eigen::VectorXd(count),
                   .removed = Eigen::VectorXd(count)};
  std::vector<double> row(static_cast<std::size_t>(columns));
  for (Eigen::Index i = 0; i < count; ++i) {
    const Point p = surface[static_cast<std::size_t>(i)];
    const double x = std::clamp(p.x, 0.0, 1.0);
    cst_row(x, 1.0 - x, paper_class.e1, paper_class.e2, row);
    for (Eigen::Index j = 0; j < columns; ++j) result.basis(i, j) = row[static_cast<std::size_t>(j)];
    result.heights(i) = p.y - x * surface.back().y;  // the trailing-edge gap, removed linearly
    result.removed(i) = x * (surface.back().y - trailing_edge);
    if (x > 0.0 && x < 1.0) ++result.informative;
  }
  return result;
}

struct Residuals {
  double largest = 0.0;
  double sum_of_squares = 0.0;
};

std::vector<double> solve(const Equations& equations, const std::string& where, Residuals& residuals) {
  const Eigen::Index unknowns = equations.basis.cols();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(equations.basis);
  if (equations.informative < unknowns || qr.rank() < unknowns) {
    std::ostringstream problem;
    problem << "found " << equations.informative
            << " points between the edges of a surface, expected at least " << unknowns
            << " at different x for a fit of degree " << unknowns - 1;
    throw Error(ErrorCode::argument, where, problem.str());
  }
  const Eigen::VectorXd coefficients = qr.solve(equations.heights);
  const Eigen::VectorXd errors = equations.basis * coefficients - equations.heights - equations.removed;
  residuals.largest = std::max(residuals.largest, errors.cwiseAbs().maxCoeff());
  residuals.sum_of_squares += errors.squaredNorm();
  return {coefficients.begin(), coefficients.end()};
}

void check_points(const std::vector<Point>& surface, const std::string& where) {
  const bool finite = std::all_of(surface.begin(), surface.end(),
                                  [](Point p) { return std::isfinite(p.x) && std::isfinite(p.y); });
  if (surface.size() < 3 || !finite) {
    throw Error(ErrorCode::argument, where, "expected at least 3 points a surface, all of them finite");
  }
}

}  // namespace

CstFit fit_cst(const AirfoilCoordinates& coordinates, int degree, TrailingEdge trailing_edge) {
  require_fit_degree(degree);
  const std::string where = name_of(coordinates);
  check_points(coordinates.upper, where);
  check_points(coordinates.lower, where);
  const double upper_end = coordinates.upper.back().y, lower_end = coordinates.lower.back().y;
  CstFit fit;
  fit.gap = upper_end - lower_end;
  fit.frame = coordinates.frame;
  fit.warnings = coordinates.warnings;
  if (trailing_edge == TrailingEdge::kept && fit.gap >= least_gap) {
    fit.airfoil.te_upper = upper_end;
    fit.airfoil.te_lower = lower_end;
  }
  Residuals residuals;
  fit.airfoil.upper = solve(equations_of(coordinates.upper, degree, fit.airfoil.te_upper), where, residuals);
  fit.airfoil.lower = solve(equations_of(coordinates.lower, degree, fit.airfoil.te_lower), where, residuals);
  const std::size_t points = coordinates.upper.size() + coordinates.lower.size();
  fit.max_error = residuals.largest;
  fit.rms_error = std::sqrt(residuals.sum_of_squares / static_cast<double>(points));
  return fit;
}

namespace {

// Of the degree, those above and those below: the first whose surfaces are apart.
CstFit first_apart(const AirfoilCoordinates& coordinates, int degree, TrailingEdge trailing_edge) {
  CstFit wanted = fit_cst(coordinates, degree, trailing_edge);
  if (surfaces_apart(wanted.airfoil)) return wanted;
  std::vector<int> others;
  for (int other = degree + 1; other <= highest_degree; ++other) others.push_back(other);
  for (int other = degree - 1; other >= lowest_degree; --other) others.push_back(other);
  for (const int other : others) {
    try {
      CstFit fit = fit_cst(coordinates, other, trailing_edge);
      if (!surfaces_apart(fit.airfoil)) continue;
      fit.warnings.push_back(name_of(coordinates) + ": the fit of degree " + std::to_string(degree) +
                             " crosses itself, that of degree " + std::to_string(other) + " is taken");
      return fit;
    } catch (const Error&) {
      continue;  // too few points for so many coefficients
    }
  }
  return wanted;
}

}  // namespace

CstFit fit_cst_apart(const AirfoilCoordinates& coordinates, int degree, TrailingEdge trailing_edge) {
  CstFit fit = first_apart(coordinates, degree, trailing_edge);
  if (fit.max_error > poor_fit) {
    std::ostringstream sentence;
    sentence.precision(2);
    sentence << name_of(coordinates) << ": the fit is off by up to " << fit.max_error
             << " chords: coefficients of degree " << fit.airfoil.degree() << " do not have this shape";
    fit.warnings.push_back(sentence.str());
  }
  return fit;
}

}  // namespace remodel
