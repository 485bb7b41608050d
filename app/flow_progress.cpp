#include "flow_progress.h"

#include <cstdio>

#include "progress.h"
#include "terminal.h"

namespace remodel::app {

FlowProgressLine::FlowProgressLine(FlowOptions& options)
    : on_terminal_(progress_style(false) == ProgressStyle::bar) {
  if (!on_terminal_) return;
  options.on_step = [this](const FlowProgress& progress) {
    char text[100];
    std::snprintf(text, sizeof text, "step %d  residual %.2e  CL %.4f", progress.newton_step,
                  progress.residual, progress.cl);
    draw_status_line(which_ + text);
  };
}

void FlowProgressLine::begin(const std::string& which) {
  which_ = which;
  if (on_terminal_) draw_status_line(which_);
}

FlowProgressLine::~FlowProgressLine() {
  if (on_terminal_) draw_status_line("");
}

}  // namespace remodel::app
