#pragma once

// Long calls that do not ask often enough whether to end: a factorisation, the validator. They run on a
// thread of their own while Python's main thread waits and answers to signals.

#include <pybind11/pybind11.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "remodel/mesh.h"

namespace remodel::python {

namespace py = pybind11;

// What such a call asks whether it should end. It knows nothing of Python.
class Stop final : public StepObserver {
 public:
  bool cancelled() override { return wanted; }
  std::atomic<bool> wanted = false;
};

// Work on a thread of its own, which never has the GIL.
class ApartCall {
 public:
  // Throws std::system_error where there is no thread to have.
  explicit ApartCall(std::function<void()> work);
  bool wait_for(std::chrono::milliseconds time);  // whether it has ended
  bool of_this_process() const { return process_ == getpid(); }
  void join() { thread_.join(); }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::mutex mutex_;
  std::condition_variable end_;
  bool ended_ = false;
  std::exception_ptr error_;
  const pid_t process_ = getpid();
  std::thread thread_;
};

// The calls of one object, one at a time. One that does not end soon after Ctrl-C is left behind: it goes on
// to its next look at `stop`, or to its end, on what it owns, and nobody hears of its result. The object's
// next call waits for it, as the end of the process and a fork do.
class Apart {
 public:
  // Runs work() -> result without the GIL. The work owns what it refers to, `stop` as well if it asks that,
  // and there is no Python object in it or in its result. Throws KeyboardInterrupt, or whatever a signal's
  // handler raised.
  template <class Work>
  auto run(const std::shared_ptr<Stop>& stop, Work work) {
    using Result = decltype(work());
    settle();
    stop->wanted = false;
    if (!in_main_thread()) {
      py::gil_scoped_release released;
      return work();
    }
    const auto result = std::make_shared<std::optional<Result>>();
    await([result, work = std::move(work)]() mutable { result->emplace(work()); }, *stop);
    return std::move(**result);
  }
  // Waits until nothing is left behind. Throws as run() does, and Error (argument) in a process that was
  // forked meanwhile.
  void settle();

 private:
  static bool in_main_thread();
  void await(std::function<void()> work, Stop& stop);

  std::shared_ptr<ApartCall> left_behind_;
};

void add_apart(py::module_& module);

}  // namespace remodel::python
