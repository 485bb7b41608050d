#pragma once

// Threads that wait for work, so that a piece of a millisecond is worth handing out.

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace remodel {

class ThreadTeam {
 public:
  // The thread that calls run() is one of them.
  explicit ThreadTeam(std::size_t threads);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  // Calls task(0) to task(count - 1), each once, on whichever thread is free; returns when all have ended. Of
  // the exceptions that tasks threw, that of the smallest number is thrown then: which one does not depend on
  // the threads.
  void run(std::size_t count, const std::function<void(std::size_t)>& task);

 private:
  void wait_for_work();
  void take_tasks(std::unique_lock<std::mutex>& lock);
  void close();

  std::mutex mutex_;
  std::condition_variable work_, done_;
  const std::function<void(std::size_t)>* task_ = nullptr;
  std::size_t next_ = 0, count_ = 0, ended_ = 0;
  std::vector<std::exception_ptr> thrown_;
  bool closing_ = false;
  std::vector<std::thread> threads_;
};

inline ThreadTeam::ThreadTeam(std::size_t threads) {
  try {
    for (std::size_t i = 1; i < threads; ++i) threads_.emplace_back([this] { wait_for_work(); });
  } catch (...) {
    close();
    throw;
  }
}

inline ThreadTeam::~ThreadTeam() {
  close();
}

inline void ThreadTeam::close() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  work_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

inline void ThreadTeam::run(std::size_t count, const std::function<void(std::size_t)>& task) {
  std::unique_lock lock(mutex_);
  task_ = &task;
  next_ = ended_ = 0;
  count_ = count;
  thrown_.assign(count, nullptr);
  if (!threads_.empty() && count > 1) work_.notify_all();
  take_tasks(lock);
  done_.wait(lock, [this] { return ended_ == count_; });
  for (const std::exception_ptr& thrown : thrown_)
    if (thrown) std::rethrow_exception(thrown);
}

inline void ThreadTeam::wait_for_work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    work_.wait(lock, [this] { return closing_ || next_ < count_; });
    if (closing_) return;
    take_tasks(lock);
  }
}

inline void ThreadTeam::take_tasks(std::unique_lock<std::mutex>& lock) {
  while (next_ < count_) {
    const std::size_t mine = next_++;
    lock.unlock();
    std::exception_ptr thrown;
    try {
      (*task_)(mine);
    } catch (...) {
      thrown = std::current_exception();
    }
    lock.lock();
    thrown_[mine] = thrown;
    if (++ended_ == count_) done_.notify_all();
  }
}

}  // namespace remodel
