#include "design_constraints.h"

#include <algorithm>

namespace remodel::app {

Json violations(const std::vector<std::string>& names, double tolerance,
                const std::vector<double>& constraints) {
  Json result = Json::object();
  for (std::size_t i = 0; i < std::min(names.size(), constraints.size()); ++i) {
    const double before = result.value(names[i], 0.0);
    result[names[i]] = std::max(before, constraints[i] > tolerance ? constraints[i] : 0.0);
  }
  return result;
}

}  // namespace remodel::app
