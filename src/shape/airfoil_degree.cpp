#include "remodel/airfoil_degree.h"

#include <Eigen/Dense>
#include <utility>
#include <vector>

#include "remodel/error.h"

namespace remodel {
namespace {

// Bernstein degree elevation by one: b_i = i/(n+1) a_{i-1} + (1 - i/(n+1)) a_i.
void raise(std::vector<double>& coefficients) {
  const std::size_t n = coefficients.size();  // degree + 1 of the old and the degree of the new
  std::vector<double> raised(n + 1);
  raised.front() = coefficients.front();
  raised.back() = coefficients.back();
  for (std::size_t i = 1; i < n; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(n);
    raised[i] = share * coefficients[i - 1] + (1.0 - share) * coefficients[i];
  }
  coefficients = std::move(raised);
}

// Coefficients of a surface at as many stations as are more than enough, with cosine spacing.
std::vector<double> lowered(const std::vector<double>& coefficients, const CstAirfoil& of, int degree) {
  constexpr int stations = 400;
  const Eigen::Index columns = degree + 1;
  Eigen::MatrixXd basis(stations - 1, columns);
  Eigen::VectorXd heights(stations - 1);
  std::vector<double> own(coefficients.size()), row(static_cast<std::size_t>(columns));
  for (int i = 1; i < stations; ++i) {
    const double t = 0.5 * i / stations;
    cst_basis(t, static_cast<int>(coefficients.size()) - 1, of.e1, of.e2, own);
    cst_basis(t, degree, of.e1, of.e2, row);
    heights(i - 1) = Eigen::Map<const Eigen::VectorXd>(own.data(), static_cast<Eigen::Index>(own.size()))
                         .dot(Eigen::Map<const Eigen::VectorXd>(
                             coefficients.data(), static_cast<Eigen::Index>(coefficients.size())));
    basis.row(i - 1) = Eigen::Map<const Eigen::RowVectorXd>(row.data(), columns);
  }
  const Eigen::VectorXd solved = basis.colPivHouseholderQr().solve(heights);
  return {solved.begin(), solved.end()};
}

}  // namespace

CstAirfoil raise_degree(const CstAirfoil& airfoil, int degree) {
  CstAirfoil result = airfoil;
  while (result.degree() < degree) {
    raise(result.upper);
    raise(result.lower);
  }
  return result;
}

CstAirfoil with_degree(const CstAirfoil& airfoil, int degree) {
  if (degree < 1 || degree > 50)
    throw Error(ErrorCode::argument, "CST degree", "found " + std::to_string(degree) + ", expected 1 to 50");
  if (degree >= airfoil.degree()) return raise_degree(airfoil, degree);
  CstAirfoil result = airfoil;
  result.upper = lowered(airfoil.upper, airfoil, degree);
  result.lower = lowered(airfoil.lower, airfoil, degree);
  return result;
}

}  // namespace remodel
