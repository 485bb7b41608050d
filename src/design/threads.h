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

}  // namespace remodel
