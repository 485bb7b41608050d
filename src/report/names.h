#pragma once

// Names of airfoils and figures, numbers as text.

#include <string>
#include <string_view>

#include "remodel/study_report.h"

namespace remodel::report {

// The catalogue's name of an airfoil that a study names so itself, or by a file of that name
// ("x/rae2822.dat"); empty for others.
std::string catalogue_name(std::string_view name);
// As the paper calls it ("RAE 2822"); the name itself for others.
std::string title_of(std::string_view name);
// The order of the paper's appendix, others after it by name.
bool before_by_name(std::string_view a, std::string_view b);

// Letters, digits, '.', '-' and '_' of a name, for the name of a file; '_' for all others.
std::string file_name_of(std::string_view name);

// Triangles that the paper's remodelling loses a step: those it has, less those it preserves.
double papers_lost(const PaperRow& row);

std::string exact(double value);                    // 17 significant digits; empty for NaN
std::string fixed(double value, int decimals);      // "-" for NaN
std::string with_sign(double value, int decimals);  // "+1.2", "-" for NaN
std::string short_number(double value);             // "0.01", "4"

}  // namespace remodel::report
