#pragma once

// Names of airfoils and figures, and numbers as text.

#include <string>
#include <string_view>

#include "study/study_report.h"

namespace remodel::report {

// The catalogue's name of an airfoil that a study names so itself, or by a file of that name
// ("x/rae2822.dat"); empty for others.
std::string catalogue_name(std::string_view name);
// The paper's name of an airfoil ("RAE 2822"); the given name if the paper has none.
std::string title_of(std::string_view name);
// Orders airfoils by the order of the paper's appendix; others come after it, by name.
bool before_by_name(std::string_view a, std::string_view b);

// Makes a file name: every character but letters, digits, '.', '-' and '_' becomes '_'.
std::string file_name_of(std::string_view name);

// Triangles that the paper's remodelling loses per step: all triangles minus the preserved ones.
double papers_lost(const PaperRow& row);

std::string exact(double value);                    // 17 significant digits; empty for NaN
std::string fixed(double value, int decimals);      // "-" for NaN
std::string with_sign(double value, int decimals);  // "+1.2", "-" for NaN
std::string short_number(double value);             // "0.01", "4"

}  // namespace remodel::report
