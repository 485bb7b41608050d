#pragma once

// The jobs of a crew, by their states: each is waiting, out with a worker, or done. What a job is, and where
// its result goes, a derived class says.

#include <atomic>
#include <functional>
#include <mutex>
#include <vector>

#include "remodel/crew.h"

namespace remodel {

class JobQueue : public CrewJobs {
 public:
  std::optional<Job> next(std::size_t worker) final;
  void give_back(std::size_t number) final;
  bool ended() const final;
  bool cancelled() const final;

 protected:
  explicit JobQueue(std::size_t jobs) : states_(jobs, State::waiting) {}
  void mark_done(std::size_t number);  // before a crew has begun
  // Calls `store` under the lock unless the job is done, and marks it.
  void finish_once(std::size_t number, const std::function<void()>& store);
  bool is_done(std::size_t number) const { return states_[number] == State::done; }

 private:
  enum class State { waiting, out, done };
  // Called under the lock.
  virtual bool can_begin(std::size_t number) const {
    static_cast<void>(number);
    return true;
  }
  virtual std::string work_of(std::size_t number) const = 0;
  // Called without it, from any thread.
  virtual bool asks_to_cancel() const = 0;

  mutable std::mutex mutex_;
  std::vector<State> states_;
  std::size_t done_ = 0;
  std::size_t first_waiting_ = 0;  // jobs before this index are not waiting
  mutable std::atomic<bool> cancelled_ = false;
};

}  // namespace remodel
