#include "interrupt.h"

#include <unistd.h>

#include <csignal>
#include <string_view>

#include "command.h"

namespace remodel::app {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void note(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);
}

void end(int) {
  constexpr std::string_view message = "remodel: interrupted\n";
  static_cast<void>(!write(STDERR_FILENO, message.data(), message.size()));
  _exit(static_cast<int>(Status::limit));
}

}  // namespace

void end_at_interrupt() {
  std::signal(SIGINT, end);
}

InterruptFlag::InterruptFlag() {
  interrupted = 0;
  std::signal(SIGINT, note);
  std::signal(SIGTERM, note);
}

InterruptFlag::~InterruptFlag() {
  std::signal(SIGINT, end);
  std::signal(SIGTERM, SIG_DFL);
}

bool InterruptFlag::raised() const {
  return interrupted != 0;
}

}  // namespace remodel::app
