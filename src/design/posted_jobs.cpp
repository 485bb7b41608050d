#include <chrono>
#include <exception>
#include <thread>
#include <utility>

#include "remodel/crew.h"

namespace remodel {

void PostedJobs::lead(Crew& crew, const CrewWork& work, const std::function<void(PostedJobs&)>& run) {
  PostedJobs jobs;
  std::exception_ptr of_run, of_crew;
  {
    const std::jthread own([&] {
      try {
        run(jobs);
      } catch (...) {
        of_run = std::current_exception();
      }
      jobs.end(false);
    });
    try {
      crew.work(jobs, work);
    } catch (...) {
      of_crew = std::current_exception();
      jobs.end(true);
    }
  }
  if (of_crew) std::rethrow_exception(of_crew);
  if (of_run) std::rethrow_exception(of_run);
}

// Nothing signals that an observer has cancelled: it is asked now and then.
std::optional<std::string> PostedJobs::result_of(std::uint64_t key, std::string work,
                                                 const std::function<bool()>& cancelled) {
  constexpr std::chrono::milliseconds between_questions{20};
  std::unique_lock lock(mutex_);
  const std::size_t number = next_number_++;
  posted_[number] = {.key = key, .work = std::move(work)};
  while (posted_[number].state != State::done) {
    lock.unlock();
    const bool is_cancelled = cancelled();
    lock.lock();
    cancelled_ = cancelled_ || is_cancelled;
    if (cancelled_ || failed_) break;
    news_.wait_for(lock, between_questions, [&] { return failed_ || posted_[number].state == State::done; });
  }
  const Posted posted = std::move(posted_[number]);
  posted_.erase(number);
  if (posted.state != State::done) return std::nullopt;
  return posted.result;
}

std::uint64_t PostedJobs::new_token() {
  const std::scoped_lock lock(mutex_);
  return ++next_token_;
}

bool PostedJobs::failed() const {
  const std::scoped_lock lock(mutex_);
  return failed_;
}

std::optional<CrewJobs::Job> PostedJobs::next(std::size_t worker) {
  const std::scoped_lock lock(mutex_);
  if (cancelled_) return std::nullopt;
  for (const bool is_of_worker : {true, false})
    for (auto& [number, posted] : posted_) {
      if (posted.state != State::waiting) continue;
      const auto found = worker_of_.find(posted.key);
      const bool is_free = found == worker_of_.end();
      if (is_of_worker ? is_free || found->second != worker : !is_free) continue;
      worker_of_[posted.key] = worker;
      posted.state = State::out;
      return Job{number, posted.work};
    }
  return std::nullopt;
}

void PostedJobs::finish(std::size_t number, const std::string& result) {
  const std::scoped_lock lock(mutex_);
  const auto found = posted_.find(number);
  if (found == posted_.end() || found->second.state == State::done) return;
  found->second.state = State::done;
  found->second.result = result;
  news_.notify_all();
}

void PostedJobs::give_back(std::size_t number) {
  const std::scoped_lock lock(mutex_);
  const auto found = posted_.find(number);
  if (found == posted_.end() || found->second.state != State::out) return;
  found->second.state = State::waiting;
  worker_of_.erase(found->second.key);
}

void PostedJobs::lose(std::size_t worker) {
  const std::scoped_lock lock(mutex_);
  std::erase_if(worker_of_, [&](const auto& of_key) { return of_key.second == worker; });
}

bool PostedJobs::ended() const {
  const std::scoped_lock lock(mutex_);
  return ended_;
}

bool PostedJobs::cancelled() const {
  const std::scoped_lock lock(mutex_);
  return cancelled_ || ended_;
}

void PostedJobs::end(bool failed) {
  const std::scoped_lock lock(mutex_);
  ended_ = true;
  failed_ = failed_ || failed;
  news_.notify_all();
}

}  // namespace remodel
