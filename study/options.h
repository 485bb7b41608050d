#pragma once

// Validates a study's options, converts them to and from text, and extends those of an existing study.

#include <string>

#include "study/study.h"

namespace remodel {

// Throws Error (argument, geometry).
void require_good(const StudyOptions& options);

// The inverse of study_options_to_json(), except that the airfoils have names only and no designs. Throws
// Error (format), naming `source`.
StudyOptions study_options_from_json(const std::string& text, const std::string& source);

// Returns the options of the study extended by those elements of `wanted` that it lacks; existing elements
// keep their order. Throws Error (argument), naming `where`, if the two differ in an option that all rows
// depend on.
StudyOptions grown(const StudyOptions& study, const StudyOptions& wanted, const std::string& where);

}  // namespace remodel
