#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "remodel/study.h"

namespace remodel {
namespace {

class Workers {
 public:
  explicit Workers(StudyJobs& jobs) : jobs_(jobs) {}

  void run() {
    try {
      while (!failed_ && !jobs_.ended()) one_job();
    } catch (...) {
      const std::scoped_lock lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      failed_ = true;
    }
    news_.notify_all();
  }

  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void one_job() {
    const std::optional<StudyJobs::Job> job = jobs_.next();
    if (!job) return wait();
    const std::optional<std::string> rows =
        run_study_job(job->work, [this] { return failed_ || jobs_.cancelled(); });
    rows ? jobs_.finish(job->number, *rows) : jobs_.give_back(job->number);
    news_.notify_all();
  }
  // Not for long: what an observer cancels, nobody tells.
  void wait() {
    std::unique_lock lock(mutex_);
    news_.wait_for(lock, std::chrono::milliseconds(20));
  }

  StudyJobs& jobs_;
  std::mutex mutex_;
  std::condition_variable news_;
  std::atomic<bool> failed_ = false;
  std::exception_ptr failure_;
};

}  // namespace

void StudyThreads::work(StudyJobs& jobs) {
  Workers workers(jobs);
  {
    std::vector<std::jthread> others;
    for (std::size_t i = 1; i < threads_; ++i) others.emplace_back([&workers] { workers.run(); });
    workers.run();
  }
  workers.rethrow();
}

}  // namespace remodel
