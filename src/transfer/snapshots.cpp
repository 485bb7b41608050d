#include "remodel/snapshots.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "remodel/error.h"

namespace remodel {

namespace {

double squared_distance_of(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

void require_size(const char* what, std::size_t found, std::size_t expected) {
  if (found != expected)
    throw Error(ErrorCode::argument, what,
                "found " + std::to_string(found) + ", expected " + std::to_string(expected) +
                    " as in the snapshots kept");
}

}  // namespace

Snapshots::Snapshots(const SnapshotOptions& options) : options_(options) {
  if (options.limit < 1) throw Error(ErrorCode::argument, "limit", "found 0, expected 1 or more");
  if (!(options.regularisation >= 0.0) || !std::isfinite(options.regularisation))
    throw Error(ErrorCode::argument, "regularisation",
                "found " + std::to_string(options.regularisation) + ", expected 0 or more");
}

void Snapshots::drop_if_replaced(const Mesh& mesh) {
  if (!kept_.empty() && !mesh.changes_since(mark_).same_connectivity()) kept_.clear();
}

void Snapshots::add(Mesh& mesh, std::span<const double> design, std::vector<double> values) {
  drop_if_replaced(mesh);
  add(design, std::move(values));
  if (kept_.size() == 1) mark_ = mesh.mark();
}

void Snapshots::add(std::span<const double> design, std::vector<double> values) {
  const auto finite = [](double value) { return std::isfinite(value); };
  if (!std::all_of(design.begin(), design.end(), finite) ||
      !std::all_of(values.begin(), values.end(), finite))
    throw Error(ErrorCode::argument, "snapshot", "found a value that is not finite, expected finite ones");
  if (!kept_.empty()) {
    require_size("design", design.size(), kept_.front().design.size());
    require_size("values", values.size(), kept_.front().values.size());
  }
  kept_.push_back({{design.begin(), design.end()}, std::move(values)});
  if (kept_.size() > options_.limit) kept_.pop_front();
}

std::size_t Snapshots::nearest(std::span<const double> design) const {
  std::size_t best = 0;
  for (std::size_t i = 1; i < kept_.size(); ++i)
    if (squared_distance_of(kept_[i].design, design) < squared_distance_of(kept_[best].design, design))
      best = i;
  return best;
}

std::optional<SnapshotStart> Snapshots::start(const Mesh& mesh, std::span<const double> design) {
  drop_if_replaced(mesh);
  return start(design);
}

std::optional<SnapshotStart> Snapshots::start(std::span<const double> design) const {
  if (kept_.empty()) return std::nullopt;
  require_size("design", design.size(), kept_.front().design.size());
  const std::size_t base = nearest(design);
  SnapshotStart start{.values = kept_[base].values, .snapshots = kept_.size(), .base = base};
  const double distance = std::sqrt(squared_distance_of(kept_[base].design, design));
  if (distance == 0.0 || kept_.size() == 1) {
    start.misfit = distance == 0.0 ? 0.0 : 1.0;
    return start;
  }
  // Least squares of (differences c - wanted) and of the weighted coefficients.
  const auto rows = static_cast<Eigen::Index>(design.size()),
             columns = static_cast<Eigen::Index>(kept_.size());
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(rows + columns, columns);
  Eigen::VectorXd wanted = Eigen::VectorXd::Zero(rows + columns);
  double widest = 0.0;
  for (Eigen::Index k = 0; k < rows; ++k) {
    const double origin = kept_[base].design[static_cast<std::size_t>(k)];
    wanted[k] = design[static_cast<std::size_t>(k)] - origin;
    for (Eigen::Index i = 0; i < columns; ++i)
      system(k, i) = kept_[static_cast<std::size_t>(i)].design[static_cast<std::size_t>(k)] - origin;
  }
  for (Eigen::Index i = 0; i < columns; ++i) widest = std::max(widest, system.col(i).head(rows).norm());
  for (Eigen::Index i = 0; i < columns; ++i)
    system(rows + i, i) = std::max(std::sqrt(options_.regularisation), 1e-12) * widest;
  if (widest == 0.0) return start.misfit = 1.0, start;
  const Eigen::VectorXd coefficients = Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(system).solve(wanted);
  start.misfit = (system.topRows(rows) * coefficients - wanted.head(rows)).norm() / distance;
  const std::vector<double>& origin = kept_[base].values;
  for (Eigen::Index i = 0; i < columns; ++i) {
    const std::vector<double>& values = kept_[static_cast<std::size_t>(i)].values;
    if (static_cast<std::size_t>(i) == base) continue;
    for (std::size_t k = 0; k < values.size(); ++k)
      start.values[k] += coefficients[i] * (values[k] - origin[k]);
  }
  return start;
}

}  // namespace remodel
