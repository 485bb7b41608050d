#pragma once

// How far the search for a flow has come, on a terminal.

#include <string>

#include "remodel/flow.h"

namespace remodel::app {

// While it lives, one line on standard error has the last Newton step, its residual and its lift coefficient;
// at its end that line is cleared. Silent where standard error is no terminal.
class FlowProgressLine {
 public:
  explicit FlowProgressLine(FlowOptions& options);
  // The next one of several flows, which the line begins with from now on.
  void begin(const std::string& which);
  ~FlowProgressLine();
  FlowProgressLine(const FlowProgressLine&) = delete;
  FlowProgressLine& operator=(const FlowProgressLine&) = delete;

 private:
  bool on_terminal_;
  std::string which_;
};

}  // namespace remodel::app
