#include "design/threads.h"

namespace remodel {

ThreadTeam::ThreadTeam(std::size_t threads) {
  try {
    for (std::size_t i = 1; i < threads; ++i) threads_.emplace_back([this] { wait_for_work(); });
  } catch (...) {
    close();
    throw;
  }
}

ThreadTeam::~ThreadTeam() {
  close();
}

void ThreadTeam::close() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  work_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void ThreadTeam::run(std::size_t count, const std::function<void(std::size_t)>& task) {
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

void ThreadTeam::wait_for_work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    work_.wait(lock, [this] { return closing_ || next_ < count_; });
    if (closing_) return;
    take_tasks(lock);
  }
}

void ThreadTeam::take_tasks(std::unique_lock<std::mutex>& lock) {
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
