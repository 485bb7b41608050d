#pragma once

// Whether a search for a flow with friction leads on, and what it does where it does not: FrictionPolicy has
// the numbers.

#include <algorithm>
#include <cstdio>
#include <limits>
#include <string>

#include "flow/search/friction_search.h"

namespace remodel::flow {

class Lead {
 public:
  explicit Lead(double residual) : least_(residual), least_of_all_(residual) {}

  void note(double residual, double cfl, double lift) {
    const bool has_fallen = residual < FrictionPolicy::fall * least_;
    since_least_ = has_fallen ? 0 : since_least_ + (cfl > 1e4 ? 1 : 0);
    if (has_fallen) least_ = residual;
    ++since_least_of_all_;
    if (residual < FrictionPolicy::fall * least_of_all_) least_of_all_ = residual, since_least_of_all_ = 0;
    if (returns_ > 0) low_ = std::min(low_, lift), high_ = std::max(high_, lift);
  }
  bool falls_no_more() const { return since_least_ > FrictionPolicy::patience; }
  int since_least_of_all() const { return since_least_of_all_; }

  // Back to steps in time; false: that has been done often enough.
  bool returns() {
    if (returns_ == FrictionPolicy::most_returns) return false;
    ++returns_, since_least_ = 0, least_ = std::numeric_limits<double>::infinity();
    steps_in_time_ = FrictionPolicy::steps_of_return;
    return true;
  }
  double limited(double cfl) {
    return --steps_in_time_ > 0 ? std::min(cfl, FrictionPolicy::return_cfl) : cfl;
  }

  std::string reason() const {
    const std::string falls_no_more = "the residual falls no more";
    if (!(high_ - low_ >= 1e-4)) return falls_no_more;
    char lifts[80];
    std::snprintf(lifts, sizeof lifts, ", and the lift coefficient has been from %.4f to %.4f", low_, high_);
    return falls_no_more + lifts;
  }

 private:
  double least_, least_of_all_;
  int since_least_ = 0, since_least_of_all_ = 0, returns_ = 0, steps_in_time_ = 0;
  // Of the lift since the first return.
  double low_ = std::numeric_limits<double>::infinity(), high_ = -std::numeric_limits<double>::infinity();
};

}  // namespace remodel::flow
