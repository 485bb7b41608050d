#include "optimise/design_domains.h"

#include "optimise/checksum.h"
#include "remodel/error.h"

namespace remodel {

DesignDomains::DesignDomains(const OptimiseOptions& options) : options_(options.domain) {
  if (!options.start) return;
  others_ = options.start->mesh.domain();
  place_ = options.start->place;
}

Domain DesignDomains::operator()(const CstAirfoil& design) const {
  return others_ ? with_airfoil(*others_, place_, design) : airfoil_domain(design, options_);
}

bool DesignDomains::feasible(const CstAirfoil& design) const {
  if (!surfaces_apart(design)) return false;
  try {
    validate((*this)(design));
    return true;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::geometry) throw;
    return false;
  }
}

const QualityOptions& quality_of(const OptimiseOptions& options) {
  return options.start ? options.start->mesh.options() : options.quality;
}

std::string identity_of(const MeshStart& start) {
  const MeshState state = start.mesh.state();
  Checksum sum;
  for (const double value : state.coordinates) sum.add(value);
  for (const double value : state.length_scales) sum.add(value);
  for (const std::uint32_t value : state.triangle_vertices) sum.add(std::uint64_t{value});
  for (const double value : start.place.parameters) sum.add(value);
  for (const double value : start.place.base) sum.add(value);
  for (const std::string& name : start.place.names) sum.add(name);
  sum.add(std::uint64_t{start.place.loop});
  sum.add(domain_to_json(state.domain));
  return sum.text();
}

}  // namespace remodel
