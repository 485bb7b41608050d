#pragma once

// What the evaluator of a design problem keeps from design to design of a living mesh.

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "remodel/evaluator.h"
#include "remodel/flow.h"
#include "remodel/flow_function.h"

namespace remodel {

// Asks the observer of the evaluation under way: flows outlive it. They may ask from several threads.
class LatestObserver final : public StepObserver {
 public:
  void ask(StepObserver& observer) { latest_ = &observer; }
  bool cancelled() override {
    const std::scoped_lock lock(mutex_);
    return latest_ != nullptr && latest_->cancelled();
  }

 private:
  StepObserver* latest_ = nullptr;
  std::mutex mutex_;
};

// The flows of the designs that the search may go on from: of the last one, and of the one that the last step
// was from. A trial may have led to another of several flows that a section can have at such Mach numbers;
// the next one is to begin with the flow that the search knows, not with that.
class KnownFlows {
 public:
  // Flows go on from those of `from`, if these are known and not the last ones anyway.
  void go_on_from(std::span<const double> from, std::vector<LivingFlow>& flows) {
    if (known_.empty() || from.empty()) return;
    const auto is_from = [&](const Known& known) { return std::ranges::equal(known.design, from); };
    const auto found = std::find_if(known_.rbegin(), known_.rend(), is_from);
    if (found == known_.rend() || found == known_.rbegin()) return;
    for (std::size_t i = 0; i < flows.size(); ++i) flows[i].go_on_from(found->flows[i]);
  }
  void note(std::span<const double> design, std::span<const double> from,
            const std::vector<LivingFlow>& flows) {
    const auto is_needed = [&](const Known& known) {
      return !std::ranges::equal(known.design, design) &&
             (std::ranges::equal(known.design, from) || &known == &known_.back());
    };
    std::vector<Known> needed;
    for (const Known& known : known_)
      if (is_needed(known)) needed.push_back(known);
    known_ = std::move(needed);
    Known& last = known_.emplace_back(Known{.design = {design.begin(), design.end()}, .flows = {}});
    for (const LivingFlow& flow : flows) last.flows.push_back(flow.keep());
  }

 private:
  struct Known {
    std::vector<double> design;
    std::vector<KeptFlow> flows;  // of each point
  };
  std::vector<Known> known_;  // the last one is the last
};

struct FlowMemory final : EvaluatorState {
  LatestObserver observer;
  std::vector<LivingFlow> flows;
  KnownFlows known;
  // A number for the mesh's connectivity that no other one has had in the run: twice that of the evaluation
  // that found it first, and one more where the target's mesh has joined it since.
  std::uint64_t connectivity = 0;
  std::vector<std::uint64_t> tokens;  // of each point's last job, where ranks find the flows
  // Of inverse design: the target's pressures at stations, on a copy of the mesh that followed to it.
  std::vector<LivingFlow> target_flows;
  std::vector<StationPressures> target;
  std::optional<std::uint64_t> aimed_at = {};  // the connectivity that the copy was made of
  bool is_like = false;                        // and has itself
  std::string bytes() const override { return std::to_string(connectivity); }
};

}  // namespace remodel
