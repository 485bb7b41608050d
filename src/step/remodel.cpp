#include "remodel/remodel.h"

#include <algorithm>
#include <array>

#include "remodel/error.h"
#include "step/step.h"

namespace remodel {

namespace {

constexpr std::array method_names{"auto", "specialised", "general"};

}  // namespace

double angle_with_slack(const QualityOptions& quality, double slack_deg) {
  constexpr double largest = 34.0;
  return std::max(quality.refine_angle_deg, std::min(quality.min_angle_deg + slack_deg, largest));
}

const char* name_of(Method method) {
  return method_names[static_cast<std::size_t>(method)];
}

Method method_named(const std::string& name) {
  for (const Method method : {Method::automatic, Method::specialised, Method::general})
    if (name == name_of(method)) return method;
  throw Error(ErrorCode::argument, "method", "found '" + name + "', expected auto, specialised or general");
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
