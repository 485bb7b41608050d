#include "interrupt.h"

#include <unistd.h>

#include <csignal>
#include <string_view>

#include "command.h"

namespace remodel::app {
namespace {

volatile std::sig_atomic_t signalled = 0;
bool on_terminal = false;
bool outlives_terminal = false;  // started by nohup

void write_error(std::string_view text) {
  static_cast<void>(!write(STDERR_FILENO, text.data(), text.size()));
}

// A terminal writes ^C over the line of progress: what comes next begins a clean line.
void clear_line() {
  if (on_terminal) write_error("\r\033[K");
}

void note(int signal) {
  signalled = 1;
  clear_line();
  std::signal(signal, SIG_DFL);
}

void end(int) {
  clear_line();
  write_error("remodel: interrupted\n");
  _exit(static_cast<int>(Status::limit));
}

void at_hang_up(void (*handler)(int)) {
  if (!outlives_terminal) std::signal(SIGHUP, handler);
}

}  // namespace

void end_at_interrupt() {
  on_terminal = isatty(STDERR_FILENO) != 0;
  outlives_terminal = std::signal(SIGHUP, SIG_IGN) == SIG_IGN;
  std::signal(SIGINT, end);
  at_hang_up(end);
}

InterruptFlag::InterruptFlag() {
  signalled = 0;
  std::signal(SIGINT, note);
  std::signal(SIGTERM, note);
  at_hang_up(note);
}

InterruptFlag::~InterruptFlag() {
  std::signal(SIGINT, end);
  std::signal(SIGTERM, SIG_DFL);
  at_hang_up(end);
}

bool InterruptFlag::raised() const {
  return signalled != 0;
}

}  // namespace remodel::app
