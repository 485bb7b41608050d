#pragma once

// Names of boundaries in formats that separate words by blanks.

#include <string>
#include <vector>

#include "remodel/frozen_mesh.h"

namespace remodel::io {

// '_' in the place of each blank.
std::string as_word(std::string name);
// Throws Error (argument) naming `file` where two boundaries would have one word.
void require_different_words(const std::vector<FrozenBoundary>& boundaries, const std::string& file);

}  // namespace remodel::io
