#include "help.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <numeric>
#include <sstream>

#include "terminal.h"

namespace remodel::app {
namespace {

// Breaks the text at spaces; the first line is as long as the others.
std::vector<std::string> lines_of(const std::string& text, std::size_t width) {
  std::vector<std::string> lines;
  std::istringstream paragraphs(text);
  for (std::string paragraph; std::getline(paragraphs, paragraph);) {
    std::istringstream words(paragraph);
    std::string line;
    for (std::string word; words >> word;) {
      if (!line.empty() && line.size() + 1 + word.size() > width) lines.push_back(std::exchange(line, ""));
      line += (line.empty() ? "" : " ") + word;
    }
    lines.push_back(line);
  }
  return lines;
}

struct Example {
  const char* command;
  const char* what;
};
constexpr Example examples[] = {
    {"remodel mesh naca:2412 -o a.vtkhdf",
     "a mesh around an airfoil, in the format that remembers all of it"},
    {"remodel update a.vtkhdf rae2822 -o b.vtkhdf", "the same mesh around another airfoil"},
    {"remodel flow rae2822 --mach 0.7 --alpha 2 --cp-plot cp.svg", "lift, drag and the pressures, as a plot"},
    {"remodel optimise --from naca:0012 --to rae2822 --evaluations 500 -o run",
     "one airfoil becomes another, on one living mesh"}};

class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option(const CLI::Option* option, bool positional) const override {
    return entry(make_option_name(option, positional) + make_option_opts(option), make_option_desc(option));
  }
  // One line: what it says of its details, after a semicolon or a colon, is in its own help.
  std::string make_subcommand(const CLI::App* subcommand) const override {
    const std::string text = subcommand->get_description();
    std::string name = "  " + subcommand->get_display_name(true);
    constexpr std::size_t column = 12;
    name.resize(std::max(column, name.size() + 1), ' ');
    return name + text.substr(0, text.find_first_of(";:")) + "\n";
  }
  std::string make_usage(const CLI::App* app, std::string name) const override {
    std::string text = CLI::Formatter::make_usage(app, std::move(name));
    if (app->get_parent() != nullptr) return text;
    text += "\nExamples:\n";
    for (const Example& example : examples)
      text += std::string("  ") + example.command + "\n      " + example.what + "\n";
    return text;
  }
  std::string make_description(const CLI::App* app) const override {
    return paragraph(CLI::Formatter::make_description(app));
  }
  std::string make_footer(const CLI::App* app) const override { return paragraph(app->get_footer()); }

 private:
  std::string paragraph(const std::string& text) const {
    std::string lines;
    for (const std::string& line : lines_of(text, width_)) lines += line + "\n";
    return lines;
  }

  // The name, and beside it or, where it is long, below it what it does.
  std::string entry(const std::string& name, const std::string& text) const {
    const std::size_t column = std::min(get_column_width(), width_ / 3);
    const std::string indent(column, ' ');
    std::string lines;
    for (const std::string& line : lines_of(name, width_ - 4))
      lines += (lines.empty() ? "  " : "\n    ") + line;
    if (lines.size() + 2 > column)
      lines += "\n" + indent;
    else
      lines.resize(column, ' ');
    bool first = true;
    for (const std::string& line : lines_of(text, width_ - column)) {
      lines += (first ? "" : indent) + line + "\n";
      first = false;
    }
    return first ? lines + "\n" : lines;
  }

  std::size_t width_ = std::clamp<std::size_t>(terminal_columns(STDOUT_FILENO, 100), 50, 100);
};

// Levenshtein's distance.
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

}  // namespace

std::shared_ptr<CLI::FormatterBase> help_formatter() {
  return std::make_shared<HelpFormatter>();
}

std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates) {
  std::string nearest;
  std::size_t least = std::min<std::size_t>(3, word.size());
  for (const std::string& candidate : candidates) {
    const std::size_t far = distance(word, candidate);
    if (far < least) {
      least = far;
      nearest = candidate;
    }
  }
  return nearest;
}

}  // namespace remodel::app
