#pragma once

// Help texts that fit the terminal, and a guess for a mistyped word.

#include <memory>
#include <string>
#include <vector>

namespace CLI {
class FormatterBase;
}

namespace remodel::app {

// Texts broken into lines of at most 100 characters, or of the terminal's width.
std::shared_ptr<CLI::FormatterBase> help_formatter();

// The candidate that takes the fewest insertions, deletions and replacements of a character to make of the
// word; "" if all take more than two, or as many as the word has characters.
std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace remodel::app
