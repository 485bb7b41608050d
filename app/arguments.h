#pragma once

// Arguments and options of the command line. Only arguments.cpp, help.cpp and main.cpp include the parser,
// because CLI11 takes seconds per file to compile. Every refused value is an Error (argument) that names the
// option, what was found and what was expected.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace remodel::app {

struct IntegerRange {
  std::int64_t low = 0;
  std::int64_t high = std::numeric_limits<std::int64_t>::max();
  bool even = false;
};

// A range of finite numbers.
struct RealRange {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool above_low = false;  // low itself is refused
};

// The name of an option, the placeholder of its value in the help, and one sentence with unit and meaning.
// default_text is shown by --help; the default itself is the initial value of the variable that `set`
// assigns.
struct OptionText {
  std::string name;
  std::string value;
  std::string default_text;
  std::string description;
};

// `chosen` is called when the subcommand is the one given, after its options are set, and none of its own
// subcommands.
CLI::App& add_subcommand(CLI::App& program, const std::string& name, const std::string& description,
                         std::function<void()> chosen);

template <class Number>
Number number_in(const Number&);
template <class Number>
Number number_in(const std::optional<Number>&);
void add_integer(CLI::App& app, const OptionText& text, IntegerRange range,
                 std::function<void(std::int64_t)> set);
void add_real(CLI::App& app, const OptionText& text, RealRange range, std::function<void(double)> set);
// The same for a number, or an optional one, that outlives the parsing.
template <class Number>
void add_integer(CLI::App& app, const OptionText& text, IntegerRange range, Number& target) {
  add_integer(app, text, range, std::function<void(std::int64_t)>([&target](std::int64_t value) {
                target = static_cast<decltype(number_in(target))>(value);
              }));
}
template <class Number>
void add_real(CLI::App& app, const OptionText& text, RealRange range, Number& target) {
  add_real(app, text, range, std::function<void(double)>([&target](double value) { target = value; }));
}
// One of several words; `set` gets its index.
void add_choice(CLI::App& app, const OptionText& text, std::vector<std::string> words,
                std::function<void(std::size_t)> set);
// One of the strategies of a table; the help describes each.
template <class Infos, class Set>
void add_strategy_choice(CLI::App& app, const char* usual, const Infos& infos, Set set) {
  std::vector<std::string> names;
  std::string help;
  for (const auto& info : infos) {
    names.emplace_back(info.name);
    help += (help.empty() ? "" : "; ") + names.back() + ": " + info.description;
  }
  help += ". Unless this is given meshes with layers go by morph";
  add_choice(app, {"--strategy", "STRATEGY", usual, help}, names,
             [infos, set](std::size_t choice) { set(infos[choice].strategy); });
}
void add_flag(CLI::App& app, const std::string& name, const std::string& description, bool& target);

enum class Presence { optional, required };
// Any text: a file, a shape. A name without dashes is positional.
void add_text(CLI::App& app, const OptionText& text, Presence presence,
              std::function<void(const std::string&)> set);
void add_text(CLI::App& app, const OptionText& text, Presence presence, std::string& target);
void add_text(CLI::App& app, const OptionText& text, Presence presence, std::filesystem::path& target);
// The same, but may be given several times.
void add_texts(CLI::App& app, const OptionText& text, Presence presence, std::vector<std::string>& target);

// True if the option was given on the command line.
bool given(const CLI::App& app, const std::string& name);

std::int64_t parse_integer(const std::string& option, std::string_view text, IntegerRange range);
double parse_real(const std::string& option, std::string_view text, RealRange range);
// Splits a comma-separated list of exactly `count` elements.
std::vector<double> parse_reals(const std::string& option, std::string_view text, std::size_t count);
// Splits a comma-separated list whose elements are not empty.
std::vector<std::string> parse_list(const std::string& option, const std::string& text);

}  // namespace remodel::app
