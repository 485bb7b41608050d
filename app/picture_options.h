#pragma once

// Options that the subcommands for pictures share.

#include <string>

#include "remodel/draw.h"

namespace CLI {
class App;
}

namespace remodel::app {

// --window.
void add_window(CLI::App& app, const std::string& default_text, DrawOptions& options);

}  // namespace remodel::app
