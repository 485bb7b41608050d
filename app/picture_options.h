#pragma once

// Options that the subcommands for pictures share.

#include <initializer_list>
#include <string>

#include "remodel/draw.h"

namespace CLI {
class App;
}

namespace remodel::app {

// --window.
void add_window(CLI::App& app, const std::string& default_text, DrawOptions& options);

// Throws Error (argument) where the file has none of the extensions (".png"), and what require_writable()
// does.
void require_picture(const std::string& file, std::initializer_list<const char*> extensions);

}  // namespace remodel::app
