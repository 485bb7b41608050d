#pragma once

// `report DIR`, a subcommand of commands with directories: what is there, as one page.

#include <filesystem>
#include <functional>
#include <string>

#include "command.h"

namespace remodel::app {

struct PageCommand {
  const char* description;
  const char* directory_help;
  const char* key;  // of the directory, in the report
  // Writes the page; returns its figures, a JSON object.
  std::function<std::string(const std::filesystem::path& directory, const std::filesystem::path& page)> write;
};
void add_page_command(CLI::App& parent, Action& action, const PageCommand& of);

}  // namespace remodel::app
