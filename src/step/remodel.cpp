#include "remodel/remodel.h"

#include <algorithm>

#include "step/step.h"

namespace remodel {

double angle_with_slack(const QualityOptions& quality) {
  constexpr double slack = 2.0, largest = 34.0;
  return std::max(quality.refine_angle_deg, std::min(quality.min_angle_deg + slack, largest));
}

const char* name_of(Method method) {
  switch (method) {
    case Method::automatic:
      return "auto";
    case Method::specialised:
      return "specialised";
    case Method::general:
      return "general";
  }
  return "unknown";
}

RemodelResult remodel(Mesh& mesh, const Domain& domain, const RemodelOptions& options) {
  Step step(mesh, domain, options, Step::Journal::when_needed);
  RemodelResult result = step.run();
  step.keep();
  return result;
}

struct Trial::Impl {
  Step step;
  RemodelResult result;
};

Trial::Trial(Mesh& mesh, const Domain& domain, const RemodelOptions& options)
    : impl_(new Impl{.step = {mesh, domain, options, Step::Journal::always}, .result = {}}) {
  impl_->result = impl_->step.run();
}
Trial::~Trial() = default;
const RemodelResult& Trial::result() const {
  return impl_->result;
}
void Trial::keep() {
  impl_->step.keep();
}

}  // namespace remodel
