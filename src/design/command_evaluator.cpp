// An evaluator that is a program of the user's: one process a design, in a directory of its own.

#include <stdlib.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <mutex>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <set>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

#include "base/stopwatch.h"
#include "design/child_process.h"
#include "design/solver_state.h"
#include "remodel/error.h"
#include "remodel/evaluator.h"
#include "remodel/io.h"

namespace remodel {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// Of a name that begins like this.
fs::path unique_directory(const fs::path& start) {
  std::string name = start.string() + "XXXXXX";
  if (mkdtemp(name.data()) == nullptr)
    throw Error(ErrorCode::file, name, std::string("cannot make the directory: ") + std::strerror(errno));
  return name;
}

// Evaluations run in DIR/running-XXXXXX/NUMBER and go to DIR/NUMBER where they are kept: a program that
// outlived the run it belonged to writes to a name that no later run has.
class EvaluationDirectories {
 public:
  explicit EvaluationDirectories(const fs::path& parent)
      : parent_(parent.empty() ? parent : fs::absolute(parent)) {}
  // Here and not with each evaluation, as another thread may be about to make one.
  ~EvaluationDirectories() {
    if (running_.empty()) return;
    std::error_code ignored;
    fs::remove(running_, ignored);
    fs::remove(parent_, ignored);  // where none was kept
  }
  EvaluationDirectories(const EvaluationDirectories&) = delete;
  EvaluationDirectories& operator=(const EvaluationDirectories&) = delete;

  bool temporary() const { return parent_.empty(); }
  fs::path kept(std::uint64_t number) const {
    const std::string digits = std::to_string(number);
    return parent_ / (std::string(6 - std::min<std::size_t>(6, digits.size()), '0') + digits);
  }
  // An empty one. What an earlier run kept under its number goes.
  fs::path make(std::uint64_t number) {
    if (temporary()) return unique_directory(fs::temp_directory_path() / "remodel-evaluation-");
    const std::scoped_lock lock(mutex_);
    if (running_.empty()) running_ = start();
    const fs::path old = kept(number), path = running_ / old.filename();
    std::error_code problem;
    fs::remove_all(old, problem);
    if (!problem) fs::create_directories(path, problem);
    if (problem)
      throw Error(ErrorCode::file, path.string(), "cannot make the directory: " + problem.message());
    return path;
  }

 private:
  static constexpr const char* prefix = "running-";

  // Without what runs that were killed have left.
  fs::path start() const {
    std::error_code ignored;
    fs::create_directories(parent_, ignored);
    std::vector<fs::path> left;
    for (const fs::directory_entry& entry : fs::directory_iterator(parent_, ignored))
      if (entry.path().filename().string().starts_with(prefix)) left.push_back(entry.path());
    for (const fs::path& path : left) fs::remove_all(path, ignored);
    return unique_directory(parent_ / prefix);
  }

  const fs::path parent_;
  fs::path running_;
  std::mutex mutex_;
};

// The directory of one evaluation, which goes with all that is in it unless it is to be kept.
class EvaluationDirectory {
 public:
  EvaluationDirectory(EvaluationDirectories& all, KeepEvaluations keep, std::uint64_t number)
      : path_(all.make(number)),
        kept_(all.kept(number)),
        keep_(!all.temporary() && keep != KeepEvaluations::none),
        keep_good_(keep == KeepEvaluations::all) {}
  ~EvaluationDirectory() {
    std::error_code ignored;
    if (keep_ && (keep_good_ || !good_))
      fs::rename(path_, kept_, ignored);
    else
      fs::remove_all(path_, ignored);
  }
  EvaluationDirectory(const EvaluationDirectory&) = delete;
  EvaluationDirectory& operator=(const EvaluationDirectory&) = delete;
  const fs::path& path() const { return path_; }
  void succeeded() { good_ = true; }
  void forget() { keep_ = false; }
  // A message about its files, with the names that they are going to have.
  std::string as_kept(std::string message) const {
    const std::string now = path_.string(), then = kept_.string();
    if (!keep_) return message;
    for (std::size_t at = message.find(now); at != std::string::npos;
         at = message.find(now, at + then.size()))
      message.replace(at, now.size(), then);
    return message;
  }

 private:
  fs::path path_, kept_;
  bool keep_, keep_good_, good_ = false;
};

// The end of what a program said, on one line.
std::string end_of(const fs::path& file) {
  constexpr std::size_t most = 300;
  std::string text = read_text(file);
  text.erase(text.find_last_not_of(" \n\r\t") + 1);
  if (text.size() > most) text.erase(0, text.size() - most);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

Evaluation evaluation_from(const std::string& text) {
  const Json json = Json::parse(text);
  Evaluation evaluation;
  json.at("objective").get_to(evaluation.objective);
  const auto read = [&](const char* key, auto& value) {
    if (json.contains(key)) json.at(key).get_to(value);
  };
  read("constraints", evaluation.constraints);
  read("gradient", evaluation.gradient);
  read("constraint_gradients", evaluation.constraint_gradients);
  read("outputs", evaluation.outputs);
  return evaluation;
}

constexpr std::array<std::array<std::string_view, 2>, 6> known_words{{{"{mesh}", "mesh.su2"},
                                                                      {"{design}", "design.json"},
                                                                      {"{state}", "state.csv"},
                                                                      {"{result}", "result.json"},
                                                                      {"{case}", "case"},
                                                                      {"{directory}", ""}}};

// How many letters have to be changed, added or left out to make one word of the other.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = std::exchange(row[j], std::min({changed, row[j] + 1, row[j - 1] + 1}));
    }
  }
  return row.back();
}

// At most two letters off a word of ours, with an extension or without.
bool is_misspelt(std::string_view word) {
  const std::string_view stem = word.substr(0, word.find('.'));
  return std::any_of(known_words.begin(), known_words.end(), [&](const auto& known) {
    const std::string_view meant = known[0].substr(1, known[0].size() - 2);
    return edit_distance(word, meant) <= 2 || edit_distance(stem, meant) <= 2;
  });
}

// A word in braces that is nearly that of a file. Braces after a dollar sign, or with anything else in them
// (awk '{print}'), belong to a shell and the programs that it runs.
void refuse_unknown_words(const std::string& text, const std::vector<CommandPlace>& places) {
  const auto letter = [](char c) { return c >= 'a' && c <= 'z'; };
  const auto plain = [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '.' || c == '_'; };
  for (std::size_t at = text.find('{'); at != std::string::npos; at = text.find('{', at + 1)) {
    const std::size_t end = text.find('}', at);
    if (end == std::string::npos) return;
    const std::string inner = text.substr(at + 1, end - at - 1);
    if (inner.empty() || !letter(inner[0]) || !std::all_of(inner.begin(), inner.end(), plain)) continue;
    if (at > 0 && text[at - 1] == '$') continue;
    if (std::any_of(places.begin(), places.end(), [&](const CommandPlace& place) { return place.at == at; }))
      continue;
    if (!is_misspelt(inner)) continue;
    std::string expected;
    for (const auto& word : known_words) expected += (expected.empty() ? "" : ", ") + std::string(word[0]);
    throw Error(ErrorCode::argument, text,
                "found {" + inner + "}, expected one of " + expected +
                    " (a space in the braces leaves them to the shell)");
  }
}

// The files that the words of a command name.
struct CommandFiles {
  std::set<std::string> names;
  StateFiles state;
  bool result = false;  // a file; otherwise standard output
};

CommandFiles files_of(const std::vector<std::string>& words) {
  CommandFiles files;
  for (const std::string& word : words) {
    const std::vector<CommandPlace> places = command_places(word);
    refuse_unknown_words(word, places);
    for (const CommandPlace& place : places) {
      if (place.file.starts_with("mesh.")) mesh_format(place.file);  // refuses others
      std::string& restart = files.state.restart;
      if (place.file.starts_with("state.") && !restart.empty() && restart != place.file)
        throw Error(ErrorCode::argument, word,
                    "found two files of the state, expected {state} or {state.dat}");
      if (place.file.starts_with("state.")) restart = place.file;
      files.state.foam_case = files.state.foam_case || place.file == "case";
      files.result = files.result || place.file == "result.json";
      files.names.insert(place.file);
    }
  }
  return files;
}

std::vector<std::string> with_files(std::vector<std::string> words, const fs::path& directory) {
  for (std::string& word : words) {
    const std::vector<CommandPlace> places = command_places(word);
    for (auto place = places.rbegin(); place != places.rend(); ++place)
      word.replace(place->at, place->size,
                   (place->file.empty() ? directory : directory / place->file).string());
  }
  return words;
}

class CommandEvaluator final : public Evaluator {
 public:
  CommandEvaluator(std::vector<std::string> command, CommandOptions options)
      : command_(std::move(command)),
        words_(command_),
        options_(std::move(options)),
        directories_(options_.directory) {
    if (std::all_of(words_.begin(), words_.end(),
                    [](const std::string& word) { return command_places(word).empty(); }))
      words_.insert(words_.end(), {"{mesh}", "{design}"});
    files_ = files_of(words_);
  }

  Evaluation evaluate(const EvaluationTask& task, std::unique_ptr<EvaluatorState>& state) override {
    EvaluationDirectory directory(directories_, options_.keep, task.evaluation);
    try {
      const Evaluation evaluation = evaluate_in(directory.path(), task, state);
      if (std::isfinite(evaluation.objective)) directory.succeeded();
      return evaluation;
    } catch (const std::exception& problem) {
      if (task.observer.cancelled()) directory.forget();
      throw std::runtime_error(directory.as_kept(problem.what()));
    }
  }

  std::unique_ptr<EvaluatorState> restore(const std::string& bytes, const Mesh& mesh,
                                          const std::string& source) override {
    return SolverState::from(bytes, mesh.freeze(), source, options_.snapshots);
  }
  std::unique_ptr<EvaluatorState> restore_layered(const std::string& bytes, const LayeredMesh& mesh,
                                                  const std::string& source) override {
    return SolverState::from(bytes, mesh.freeze(options_.layer_cells), source, options_.snapshots);
  }
  std::string description() const override {
    Json description{{"command", command_}};
    if (options_.layer_cells == LayerCells::triangles) description["layer_cells"] = "triangles";
    if (options_.snapshots != 0) description["snapshots"] = options_.snapshots;
    return description.dump();
  }

 private:
  Evaluation evaluate_in(const fs::path& directory, const EvaluationTask& task,
                         std::unique_ptr<EvaluatorState>& state) const;
  void run(const fs::path& directory, const fs::path& output, StepObserver& observer) const;
  const std::string& name() const { return command_.front(); }

  std::vector<std::string> command_;
  std::vector<std::string> words_;  // with the files that a command without any is given
  CommandOptions options_;
  EvaluationDirectories directories_;
  CommandFiles files_;
};

void write_mesh_of(const EvaluationTask& task, const fs::path& file, const WriteOptions& options,
                   LayerCells cells) {
  if (task.with_layers)
    write_mesh(task.with_layers(), file, options, cells);
  else
    write_mesh(task.mesh, file, options);
}

Evaluation CommandEvaluator::evaluate_in(const fs::path& directory, const EvaluationTask& task,
                                         std::unique_ptr<EvaluatorState>& state) const {
  for (const std::string& file : files_.names) {
    if (file.starts_with("mesh."))
      write_mesh_of(task, directory / file, {.su2_boxes = options_.su2_boxes}, options_.layer_cells);
    if (file == "case") {
      fs::create_directory(directory / file);
      write_mesh_of(task, directory / file / "case.foam", {}, options_.layer_cells);
    }
    if (file == "design.json")
      write_text_atomically(directory / file,
                            Json(std::vector<double>(task.design.begin(), task.design.end())).dump());
  }
  FrozenMesh mesh;
  StartRecord start;
  auto* const before = dynamic_cast<SolverState*>(state.get());
  if (files_.state.any()) {
    mesh = task.freeze(options_.layer_cells);
    if (before != nullptr) start = before->write(mesh, task.design, directory, files_.state);
  }
  const fs::path output = directory / "output";
  run(directory, output, task.observer);
  Evaluation evaluation;
  try {
    evaluation = evaluation_from(read_text(files_.result ? directory / "result.json" : output));
  } catch (const Json::exception& problem) {
    throw std::runtime_error(name() + ": expected one JSON object with an objective: " + problem.what());
  }
  if (!files_.state.any()) return evaluation;
  std::unique_ptr<SolverState> left = SolverState::read(directory, files_.state, std::move(mesh));
  if (options_.snapshots != 0) {
    if (left) left->remember(before, task.design, options_.snapshots);
    evaluation.outputs["state_snapshots"] = static_cast<double>(start.snapshots);
    evaluation.outputs["state_misfit"] = start.misfit;
  }
  state = std::move(left);
  return evaluation;
}

void CommandEvaluator::run(const fs::path& directory, const fs::path& output, StepObserver& observer) const {
  const fs::path errors = directory / "errors";
  ChildProcess child(with_files(words_, directory), output, errors);
  const Stopwatch watch;
  for (auto pause = std::chrono::milliseconds(1); !child.ended();) {
    if (observer.cancelled()) throw std::runtime_error(name() + ": cancelled");
    if (options_.time_limit > 0.0 && watch.seconds() > options_.time_limit)
      throw std::runtime_error(name() + ": ended after its time limit of " +
                               Json(options_.time_limit).dump() + " seconds");
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, std::chrono::milliseconds(50));
  }
  if (const std::string failure = child.failure(); !failure.empty())
    throw std::runtime_error(name() + ": " + failure + ": " + end_of(errors));
}

}  // namespace

std::vector<CommandPlace> command_places(std::string_view text) {
  std::vector<CommandPlace> places;
  for (std::size_t at = text.find('{'); at != std::string_view::npos; at = text.find('{', at + 1)) {
    const std::size_t end = text.find('}', at);
    if (end == std::string_view::npos) break;
    const std::string_view name = text.substr(at, end + 1 - at), inner = name.substr(1, name.size() - 2);
    const auto plain = [](char c) { return c == '.' || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); };
    for (const auto& [known, file] : known_words)
      if (name == known) places.push_back({at, name.size(), std::string(file)});
    if (std::all_of(inner.begin(), inner.end(), plain) &&
        (inner.starts_with("mesh.") || inner == "state.csv" || inner == "state.dat"))
      places.push_back({at, name.size(), std::string(inner)});
  }
  return places;
}

std::unique_ptr<Evaluator> command_evaluator(std::vector<std::string> command, CommandOptions options) {
  if (command.empty()) throw Error(ErrorCode::argument, "command", "found no word, expected a program");
  return std::make_unique<CommandEvaluator>(std::move(command), std::move(options));
}

}  // namespace remodel
