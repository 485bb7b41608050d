#include "remodel/design_space.h"

#include <nlohmann/json.hpp>

#include "remodel/error.h"

namespace remodel {

bool DesignSpace::feasible(std::span<const double> design) const {
  try {
    if (layers() != nullptr) validate(walls(design));
    validate(domain(design));
    return true;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::geometry) throw;
    return false;
  }
}

std::vector<Point> DesignSpace::outline(std::span<const double> design) const {
  const Domain shape = domain(design);
  std::vector<Point> points;
  for (std::size_t loop = 0; loop < shape.loops.size(); ++loop) {
    const std::vector<Point> more = shape.points(loop);
    points.insert(points.end(), more.begin(), more.end());
  }
  return points;
}

std::string DesignSpace::text(std::span<const double> design) const {
  return nlohmann::json(std::vector<double>(design.begin(), design.end())).dump() + "\n";
}

}  // namespace remodel
