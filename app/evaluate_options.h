#pragma once

// `--evaluate COMMAND`: a program of the user's judges designs.

#include <filesystem>
#include <memory>
#include <string>

#include "arguments.h"
#include "remodel/evaluator.h"

namespace remodel::app {

struct EvaluateOptions {
  std::string command;  // empty: none
  CommandOptions run;
};

// --evaluate alone.
void add_evaluate_option(CLI::App& app, const std::string& description, EvaluateOptions& options);
// Those of its limits.
void add_evaluation_options(CLI::App& app, EvaluateOptions& options);

// A shell runs the command, whose file names (remodel/evaluator.h) become words of their own, whatever they
// hold.
std::unique_ptr<Evaluator> shell_evaluator(const EvaluateOptions& options);

}  // namespace remodel::app
