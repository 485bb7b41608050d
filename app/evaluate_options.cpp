#include "evaluate_options.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace remodel::app {
namespace {

// The quotes around the end of a text of a shell: none, single or double ones.
char quotes_at_end(std::string_view text) {
  char quotes = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\\' && quotes != '\'')
      ++i;
    else if (quotes == 0 && (text[i] == '\'' || text[i] == '"'))
      quotes = text[i];
    else if (text[i] == quotes)
      quotes = 0;
  }
  return quotes;
}

// The shell is given the names of files as its parameters, so that they stay words of their own.
std::vector<std::string> shell_words(const std::string& command) {
  std::string text;
  std::vector<std::string> files;
  std::size_t done = 0;
  for (const CommandPlace& place : command_places(command)) {
    const std::string name = command.substr(place.at, place.size);
    text += command.substr(done, place.at - done);
    done = place.at + place.size;
    const auto known = static_cast<std::size_t>(std::find(files.begin(), files.end(), name) - files.begin());
    if (known == files.size()) files.push_back(name);
    const std::string parameter = "${" + std::to_string(known + 1) + "}";
    switch (quotes_at_end(std::string_view(command).substr(0, place.at))) {
      case '"':
        text += parameter;
        break;
      case '\'':
        text += "'\"" + parameter + "\"'";
        break;
      default:
        text += "\"" + parameter + "\"";
        break;
    }
  }
  text += command.substr(done);
  if (files.empty()) text += " \"$@\"";
  std::vector<std::string> words{"/bin/sh", "-c", text, "sh"};
  words.insert(words.end(), files.begin(), files.end());
  return words;
}

}  // namespace

void add_evaluate_option(CLI::App& app, const std::string& description, EvaluateOptions& options) {
  add_text(app, {"--evaluate,--evaluator", "COMMAND", "", description}, Presence::optional, options.command);
}

void add_evaluation_options(CLI::App& app, EvaluateOptions& options) {
  add_real(app,
           {"--time-limit", "SECONDS", "0: none",
            "Time for one evaluation by --evaluate; one that takes longer is ended, and its design counts as "
            "infeasible; at least 0"},
           {.low = 0.0, .high = 1e9}, options.run.time_limit);
  add_choice(app,
             {"--keep-evaluations", "WHICH", "failed",
              "Directories of evaluations by --evaluate that stay in DIR/evaluations: none, failed, all"},
             {"none", "failed", "all"},
             [&](std::size_t choice) { options.run.keep = static_cast<KeepEvaluations>(choice); });
  add_integer(app,
              {"--snapshots", "N", "0: the last state alone",
               "States of earlier designs that are kept with each mesh, the latest: while its connectivity "
               "stays, their combination that reproduces the new design is the state handed to --evaluate; "
               "0 to 1000"},
              {.low = 0, .high = 1000}, options.run.snapshots);
}

std::unique_ptr<Evaluator> shell_evaluator(const EvaluateOptions& options) {
  return command_evaluator(shell_words(options.command), options.run);
}

}  // namespace remodel::app
