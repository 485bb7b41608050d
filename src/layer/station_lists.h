#pragma once

// The stations of the curves of a domain, as a list for each curve in their order.

#include <vector>

#include "remodel/domain.h"

namespace remodel {

using Stations = std::vector<Parameters>;

inline Stations stations_of(const Domain& domain) {
  Stations stations;
  for (const Loop& loop : domain.loops)
    for (const Curve& curve : loop.curves) stations.push_back(curve.parameters);
  return stations;
}

// Precondition: the stations of a domain with as many curves.
inline Domain with_stations(Domain domain, const Stations& stations) {
  std::size_t next = 0;
  for (Loop& loop : domain.loops)
    for (Curve& curve : loop.curves) curve.parameters = stations[next++];
  return domain;
}

}  // namespace remodel
