#pragma once

// A study's options as text, what is refused of them, and how a study grows.

#include <string>

#include "remodel/study.h"

namespace remodel {

// Throws Error (argument, geometry).
void require_good(const StudyOptions& options);

// The inverse of study_options_to_json(). Throws Error (format), naming `source`. Airfoils have their names
// alone.
StudyOptions study_options_from_json(const std::string& text, const std::string& source);

// The study with what `wanted` has more of; what a study is made of stays in its order. Throws Error
// (argument), naming `where`, where they differ in what all rows depend on.
StudyOptions grown(const StudyOptions& study, const StudyOptions& wanted, const std::string& where);

}  // namespace remodel
