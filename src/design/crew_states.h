#pragma once

// What a process of a crew has between the jobs of one key.

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "remodel/mesh.h"

namespace remodel {

// What jobs have left for the next ones, by their keys; each with the token of the job that left it: where
// another process has done a job since, it is of no use.
template <class State>
class CrewStates {
 public:
  std::unique_ptr<State> take(std::uint64_t key, std::uint64_t token) {
    const std::scoped_lock lock(mutex_);
    const auto found = states_.find(key);
    if (found == states_.end() || token == 0 || found->second.token != token) return nullptr;
    return std::move(found->second.state);
  }
  void put(std::uint64_t key, std::uint64_t token, std::unique_ptr<State> state) {
    const std::scoped_lock lock(mutex_);
    states_[key] = {token, std::move(state)};
  }

 private:
  struct Left {
    std::uint64_t token = 0;
    std::unique_ptr<State> state;
  };
  std::mutex mutex_;
  std::map<std::uint64_t, Left> states_;
};

// Asks whether a job is cancelled.
class CrewQuestion final : public StepObserver {
 public:
  explicit CrewQuestion(const std::function<bool()>& cancelled) : cancelled_(cancelled) {}
  bool cancelled() override { return told_ = told_ || cancelled_(); }
  bool told() const { return told_; }  // that it is

 private:
  const std::function<bool()>& cancelled_;
  bool told_ = false;
};

}  // namespace remodel
