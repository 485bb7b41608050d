#include "aero/flow_march.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace remodel::aero {

namespace {

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

class Marcher {
 public:
  Marcher(std::span<const double> values, const MarchSearch& search, const MarchOptions& options)
      : values_(values), search_(search), options_(options) {}

  March run(std::size_t start) {
    std::vector<std::size_t> up, down;
    for (std::size_t i = start; i < values_.size(); ++i) up.push_back(i);
    walk(up);
    // Values before the first flow are looked for once more, from that.
    const std::size_t first = first_.value_or(start);
    for (std::size_t i = first; i-- > 0;) down.push_back(i);
    if (first_) search_.return_to_first(), last_ = values_[first];
    walk(down);
    if (stopped_ == FlowStatus::interrupted) result_.interrupted = true;
    return std::move(result_);
  }

 private:
  // One direction.
  void walk(const std::vector<std::size_t>& order) {
    std::string missed;
    int misses = 0;
    for (const std::size_t i : order) {
      if (stopped_ == FlowStatus::interrupted) return;
      if (stopped_) {
        add_untried(values_[i], "not looked for: the search had ended before");
      } else if (misses >= options_.misses) {
        add_untried(values_[i], "not looked for: no flow was found at " + missed);
      } else if (reach(values_[i], misses == 0)) {
        if (!first_) first_ = i;
        misses = 0, missed.clear();
      } else {
        ++misses, missed += (missed.empty() ? "" : " and ") + number_text(values_[i]);
      }
    }
  }

  FlowResult find(double value) {
    FlowResult flow = search_.find(value);
    if (flow.status == FlowStatus::interrupted || flow.status == FlowStatus::memory) stopped_ = flow.status;
    return flow;
  }

  bool reach(double target, bool halving) {
    FlowResult flow = find(target);
    if (last_ && halving) {
      double step = target - *last_;
      for (int i = 0; i < options_.halvings && !flow.converged() && !stopped_; ++i) {
        step *= 0.5;
        step_towards(target, step, flow);
      }
    }
    if (stopped_ == FlowStatus::interrupted) return false;
    const bool found = flow.converged();
    if (found) last_ = target;
    std::string reason = found ? "" : flow.reason;
    if (!found && last_ && halving && options_.halvings > 0 && !stopped_)
      reason += "; steps were halved back to " + number_text(*last_);
    add({.value = target,
         .asked = true,
         .tried = true,
         .flow = std::move(flow),
         .reason = std::move(reason)});
    return found;
  }

  // Goes on from the last flow by this step while that finds flows, to the target at most. `at_target`: the
  // last search there.
  void step_towards(double target, double step, FlowResult& at_target) {
    while (!stopped_) {
      const double next = *last_ + step;
      if (std::fabs(target - next) < 0.25 * std::fabs(step) || (target - next) * step < 0.0) {
        at_target = find(target);
        return;
      }
      FlowResult flow = find(next);
      if (!flow.converged()) {
        if (stopped_) at_target = std::move(flow);
        return;
      }
      last_ = next;
      add({.value = next, .asked = false, .tried = true, .flow = std::move(flow), .reason = {}});
    }
  }

  void add_untried(double value, std::string reason) {
    add({.value = value, .asked = true, .tried = false, .flow = {}, .reason = std::move(reason)});
  }
  // In place of an earlier search at the same value.
  void add(MarchedFlow flow) {
    std::vector<MarchedFlow>& flows = result_.flows;
    const auto place =
        std::lower_bound(flows.begin(), flows.end(), flow.value,
                         [](const MarchedFlow& earlier, double value) { return earlier.value < value; });
    const bool tried = flow.tried;
    if (place != flows.end() && place->value == flow.value)
      *place = std::move(flow);
    else
      flows.insert(place, std::move(flow));
    if (tried && search_.on_flow) search_.on_flow(flows);
  }

  std::span<const double> values_;
  const MarchSearch& search_;
  const MarchOptions& options_;
  std::optional<std::size_t> first_;  // index of the first value whose flow was found
  std::optional<double> last_;        // where the last flow was found
  std::optional<FlowStatus> stopped_;
  March result_;
};

}  // namespace

March march(std::span<const double> values, std::size_t start, const MarchSearch& search,
            const MarchOptions& options) {
  return Marcher(values, search, options).run(start);
}

}  // namespace remodel::aero
