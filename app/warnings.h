#pragma once

// What a person has to know although the command went on: a line on standard error when it has ended (an
// error is one line alone), and one of warnings[] in the JSON of its report.

#include <string>
#include <vector>

#include "remodel/io.h"
#include "remodel/mesh.h"

namespace remodel::app {

void warn(const std::string& sentence);  // once
void warn(const std::vector<std::string>& sentences);
// All so far, in their order: of this run of the program.
const std::vector<std::string>& warnings();
void print_warnings();

void warn_of(const ReadNotes& notes);
// That a limit ended refinement, and where; nothing where none did.
void warn_of_limit(Stopped stopped, const Mesh& mesh);

}  // namespace remodel::app
