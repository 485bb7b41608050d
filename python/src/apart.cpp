#include "apart.h"

#include <algorithm>
#include <vector>

#include "bindings.h"

namespace remodel::python {
namespace {

using ApartCalls = std::vector<std::shared_ptr<ApartCall>>;
using std::chrono::milliseconds;

constexpr milliseconds between_looks{10};  // for signals
constexpr milliseconds to_end_in_order{50};
constexpr std::chrono::minutes at_most{2};  // that the end of the process and a fork wait

// All that were left behind. It needs the GIL and is never destroyed: threads outlive static objects.
ApartCalls& left_behind() {
  static auto* calls = new ApartCalls;
  return *calls;
}

bool ended(ApartCall& call, milliseconds time) {
  py::gil_scoped_release released;
  return call.wait_for(time);
}

void answer_to_signals() {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

// How many are running still; the threads of the others are joined.
std::size_t count_left_behind() {
  ApartCalls& calls = left_behind();
  std::erase_if(calls, [](const std::shared_ptr<ApartCall>& call) {
    if (!call->of_this_process()) return false;
    if (!call->wait_for(milliseconds(0))) return false;
    call->join();
    return true;
  });
  return static_cast<std::size_t>(
      std::count_if(calls.begin(), calls.end(), [](const auto& call) { return call->of_this_process(); }));
}

template <class Look>
void wait_for_all(Look&& look) {
  const auto end = std::chrono::steady_clock::now() + at_most;
  while (count_left_behind() > 0 && std::chrono::steady_clock::now() < end) {
    {
      py::gil_scoped_release released;
      std::this_thread::sleep_for(between_looks);
    }
    look();
  }
}

}  // namespace

ApartCall::ApartCall(std::function<void()> work)
    : thread_([this, work = std::move(work)]() mutable {
        try {
          work();
        } catch (...) {
          error_ = std::current_exception();
        }
        work = nullptr;  // what it owns is gone before anybody hears of the end
        const std::scoped_lock lock(mutex_);
        ended_ = true;
        end_.notify_all();
      }) {}

bool ApartCall::wait_for(milliseconds time) {
  std::unique_lock lock(mutex_);
  return end_.wait_for(lock, time, [&] { return ended_; });
}

bool Apart::in_main_thread() {
  const py::module_ threading = py::module_::import("threading");
  return threading.attr("get_ident")().equal(threading.attr("main_thread")().attr("ident"));
}

void Apart::settle() {
  const std::shared_ptr<ApartCall> call = left_behind_;
  if (!call) return;
  if (!call->of_this_process())
    throw Error(ErrorCode::argument, "solver",
                "was in use when the process was forked, expected it to be idle");
  while (!ended(*call, between_looks)) answer_to_signals();
  count_left_behind();
  left_behind_.reset();
}

void Apart::await(std::function<void()> work, Stop& stop) {
  count_left_behind();
  const auto call = std::make_shared<ApartCall>(std::move(work));
  try {
    while (!ended(*call, between_looks)) answer_to_signals();
  } catch (const py::error_already_set&) {
    stop.wanted = true;
    if (ended(*call, to_end_in_order)) {
      call->join();
    } else {
      left_behind().push_back(call);
      left_behind_ = call;
    }
    throw;
  }
  call->join();
  call->rethrow();
}

void add_apart(py::module_& module) {
  module.def("_left_behind", &count_left_behind,
             "How many computations that Ctrl-C has ended here are running still, for tests.");
  // A second Ctrl-C ends the wait at the end of the process.
  py::module_::import("atexit").attr("register")(py::cpp_function([] { wait_for_all(answer_to_signals); }));
  py::module_::import("os").attr("register_at_fork")("before"_a =
                                                         py::cpp_function([] { wait_for_all([] {}); }));
}

}  // namespace remodel::python
