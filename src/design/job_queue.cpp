#include "design/job_queue.h"

#include <algorithm>
#include <utility>

namespace remodel {

std::optional<CrewJobs::Job> JobQueue::next(std::size_t) {
  if (cancelled()) return std::nullopt;
  const std::scoped_lock lock(mutex_);
  while (first_waiting_ < states_.size() && states_[first_waiting_] != State::waiting) ++first_waiting_;
  for (std::size_t i = first_waiting_; i < states_.size(); ++i) {
    if (states_[i] != State::waiting || !can_begin(i)) continue;
    std::string work = work_of(i);
    states_[i] = State::out;
    return Job{i, std::move(work)};
  }
  return std::nullopt;
}

void JobQueue::mark_done(std::size_t number) {
  states_[number] = State::done;
  ++done_;
}

void JobQueue::finish_once(std::size_t number, const std::function<void()>& store) {
  const std::scoped_lock lock(mutex_);
  if (states_[number] == State::done) return;
  store();
  mark_done(number);
}

void JobQueue::give_back(std::size_t number) {
  const std::scoped_lock lock(mutex_);
  if (states_[number] != State::out) return;
  states_[number] = State::waiting;
  first_waiting_ = std::min(first_waiting_, number);
}

bool JobQueue::ended() const {
  if (cancelled()) return true;
  const std::scoped_lock lock(mutex_);
  return done_ == states_.size();
}

// What is cancelled stays cancelled, whatever the observer answers later: crews may have left.
bool JobQueue::cancelled() const {
  if (!cancelled_ && asks_to_cancel()) cancelled_ = true;
  return cancelled_;
}

}  // namespace remodel
