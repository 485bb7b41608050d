#pragma once

// Ctrl-C in long calls that ask for it, and meshes that threads share. apart.h has the calls that do not.

#include <pybind11/pybind11.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>
#include <thread>

#include "remodel/mesh.h"

namespace remodel::python {

namespace py = pybind11;

// Asks Python, at most every 20 ms, whether a signal has come. Python runs signal handlers in its main thread
// alone: elsewhere the answer is no.
class Interrupts final : public StepObserver {
 public:
  bool cancelled() override {
    using namespace std::chrono;
    const std::int64_t now = duration_cast<milliseconds>(steady_clock::now().time_since_epoch()).count();
    if (raised_ || now - asked_ < 20) return raised_;
    asked_ = now;
    py::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) keep(py::error_already_set());
    return raised_;
  }
  // Ends the call in order with a Python exception: the first one counts. Needs the GIL.
  void keep(py::error_already_set error) {
    if (!error_) error_.emplace(std::move(error));
    raised_ = true;
  }
  // Throws what was kept, if anything. Needs the GIL.
  void rethrow() {
    raised_ = false;
    if (!error_) return;
    py::error_already_set error = std::move(*error_);
    error_.reset();
    throw error;
  }

 private:
  std::atomic<bool> raised_ = false;
  std::atomic<std::int64_t> asked_ = 0;
  std::optional<py::error_already_set> error_;
};

// A function of Python's that is told how a run goes: True ends the run, and so does what it raises.
class Callback {
 public:
  explicit Callback(py::object call) : call_(std::move(call)) {}
  // figures() makes the dict that it is called with. From any thread, with or without the GIL.
  template <class Figures>
  void tell(Figures&& figures, Interrupts& interrupts) {
    if (call_.is_none()) return;
    py::gil_scoped_acquire gil;
    try {
      const py::object answer = call_(figures());
      if (answer.is(py::bool_(true))) ended_ = true;
    } catch (py::error_already_set& error) {
      interrupts.keep(std::move(error));
    }
  }
  bool ended() const { return ended_; }

 private:
  py::object call_;
  std::atomic<bool> ended_ = false;
};

// Runs work without the GIL; Ctrl-C ends it and becomes KeyboardInterrupt. work(StepObserver&) -> result
template <class Work>
auto interruptible(Work&& work) {
  Interrupts interrupts;
  auto result = [&] {
    py::gil_scoped_release released;
    return work(interrupts);
  }();
  interrupts.rethrow();
  return result;
}

// A lock that one thread holds at a time. Whoever waits gives the GIL away and answers to signals.
class ThreadLock {
 public:
  class Held {
   public:
    explicit Held(ThreadLock& lock) : lock_(lock) { lock_.acquire(); }
    ~Held() { lock_.release(); }
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;

   private:
    ThreadLock& lock_;
  };

 private:
  void acquire();  // needs the GIL; throws Error (argument) where waiting would never end
  void release() {
    owner_ = std::thread::id();
    mutex_.unlock();
  }

  std::timed_mutex mutex_;
  std::atomic<std::thread::id> owner_;
  std::atomic<pid_t> process_ = 0;
};

}  // namespace remodel::python
