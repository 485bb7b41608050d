#pragma once

#include "remodel/mesh.h"

namespace remodel::app {

// From now on the first SIGINT, or the SIGHUP of a terminal that is closed, ends the process with the exit
// status of a limit, except during the lifetime of an InterruptFlag. SIGHUP stays ignored where it was
// (nohup).
void end_at_interrupt();

// Thrown where an interrupt leaves nothing to report: the program ends as end_at_interrupt() has it.
struct Interrupted {};

// During the lifetime of an object the first SIGINT, SIGTERM or SIGHUP only sets a flag; a second one ends
// the process as usual.
class InterruptFlag {
 public:
  InterruptFlag();
  ~InterruptFlag();
  InterruptFlag(const InterruptFlag&) = delete;
  InterruptFlag& operator=(const InterruptFlag&) = delete;

  bool raised() const;
};

// Ends generation and remodelling in order.
class InterruptObserver : public StepObserver {
 public:
  bool cancelled() override { return flag_.raised(); }

 private:
  InterruptFlag flag_;
};

}  // namespace remodel::app
