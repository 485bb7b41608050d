#include "remodel/crew.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>

#include "base/threads.h"

namespace remodel {
namespace {

class ThreadsAtWork {
 public:
  ThreadsAtWork(CrewJobs& jobs, const CrewWork& work) : jobs_(jobs), work_(work) {}

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
    const std::optional<CrewJobs::Job> job = jobs_.next(0);
    if (!job) return wait();
    const std::optional<std::string> result =
        work_(job->work, [this] { return failed_ || jobs_.cancelled(); });
    result ? jobs_.finish(job->number, *result) : jobs_.give_back(job->number);
    news_.notify_all();
  }
  // The wait is short, because nothing signals that an observer has cancelled, or that a job was posted.
  void wait() {
    std::unique_lock lock(mutex_);
    news_.wait_for(lock, std::chrono::milliseconds(2));
  }

  CrewJobs& jobs_;
  const CrewWork& work_;
  std::mutex mutex_;
  std::condition_variable news_;
  std::atomic<bool> failed_ = false;
};

}  // namespace

void ThreadCrew::work(CrewJobs& jobs, const CrewWork& work) {
  ThreadsAtWork at_work(jobs, work);
  const std::size_t threads = std::max<std::size_t>(threads_, 1);
  ThreadTeam(threads).run(threads, [&at_work](std::size_t) { at_work.run(); });
}

}  // namespace remodel
