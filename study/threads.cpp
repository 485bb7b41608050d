#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>

#include "base/threads.h"
#include "study/study.h"

namespace remodel {
namespace {

class Workers {
 public:
  explicit Workers(StudyJobs& jobs) : jobs_(jobs) {}

  // The first worker that fails ends the others.
  void run() {
    try {
      while (!failed_ && !jobs_.ended()) one_job();
    } catch (...) {
      failed_ = true;
      news_.notify_all();
      throw;
    }
    news_.notify_all();
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
  // The wait is short, because nothing signals that an observer has cancelled.
  void wait() {
    std::unique_lock lock(mutex_);
    news_.wait_for(lock, std::chrono::milliseconds(20));
  }

  StudyJobs& jobs_;
  std::mutex mutex_;
  std::condition_variable news_;
  std::atomic<bool> failed_ = false;
};

}  // namespace

void StudyThreads::work(StudyJobs& jobs) {
  Workers workers(jobs);
  const std::size_t threads = std::max<std::size_t>(threads_, 1);
  ThreadTeam(threads).run(threads, [&workers](std::size_t) { workers.run(); });
}

}  // namespace remodel
