#pragma once

namespace remodel::app {

// While one lives, the first SIGINT or SIGTERM only sets a flag; a second one ends the process as usual.
class InterruptFlag {
 public:
  InterruptFlag();
  ~InterruptFlag();
  InterruptFlag(const InterruptFlag&) = delete;
  InterruptFlag& operator=(const InterruptFlag&) = delete;

  bool raised() const;
};

}  // namespace remodel::app
