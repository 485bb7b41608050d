#include "arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "number_text.h"
#include "remodel/error.h"

namespace remodel::app {
namespace {

[[noreturn]] void refuse(const std::string& option, std::string_view found, const std::string& expected) {
  throw Error(ErrorCode::argument, option, "found '" + std::string(found) + "', expected " + expected);
}

std::string describe(const IntegerRange& range) {
  const std::string kind = range.even ? "an even integer" : "an integer";
  if (range.high == std::numeric_limits<std::int64_t>::max()) {
    return kind + " of at least " + std::to_string(range.low);
  }
  return kind + " from " + std::to_string(range.low) + " to " + std::to_string(range.high);
}

std::string describe(const RealRange& range) {
  if (std::isinf(range.low) && std::isinf(range.high)) return "a finite number";
  const std::string low = short_text(range.low);
  const std::string from = range.above_low ? "above " + low : "of at least " + low;
  if (std::isinf(range.high)) return "a finite number " + from;
  if (range.above_low) return "a number " + from + " up to " + short_text(range.high);
  return "a number from " + low + " to " + short_text(range.high);
}

// True where the whole text is one number of the type.
template <typename Number>
bool parse_whole(std::string_view text, Number& number) {
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stop == end && !text.empty();
}

void dress(CLI::Option* option, const OptionText& text, Presence presence) {
  option->type_name(text.value)->default_str(text.default_text);
  option->required(presence == Presence::required);
}

}  // namespace

bool given(const CLI::App& app, const std::string& name) {
  return app.get_option(name)->count() > 0;
}

std::int64_t parse_integer(const std::string& option, std::string_view text, IntegerRange range) {
  std::int64_t number = 0;
  const bool whole = parse_whole(text, number);
  if (!whole || number < range.low || number > range.high || (range.even && number % 2 != 0)) {
    refuse(option, text, describe(range));
  }
  return number;
}

double parse_real(const std::string& option, std::string_view text, RealRange range) {
  double number = 0.0;
  const bool whole = parse_whole(text, number) && std::isfinite(number);
  const bool too_low = range.above_low ? !(number > range.low) : number < range.low;
  if (!whole || too_low || number > range.high) refuse(option, text, describe(range));
  return number;
}

std::vector<double> parse_reals(const std::string& option, std::string_view text, std::size_t count) {
  std::vector<double> numbers;
  std::string_view rest = text;
  while (true) {
    const std::size_t comma = rest.find(',');
    double number = 0.0;
    if (!parse_whole(rest.substr(0, comma), number) || !std::isfinite(number)) break;
    numbers.push_back(number);
    if (comma == std::string_view::npos) {
      if (numbers.size() == count) return numbers;
      break;
    }
    rest.remove_prefix(comma + 1);
  }
  refuse(option, text, std::to_string(count) + " finite numbers separated by commas");
}

std::vector<std::string> parse_list(const std::string& option, const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    if (words.back().empty()) refuse(option, text, "values separated by commas");
    begin = end + 1;
  }
  return words;
}

CLI::App& add_subcommand(CLI::App& program, const std::string& name, const std::string& description,
                         std::function<void()> chosen) {
  CLI::App* app = program.add_subcommand(name, description);
  app->callback([app, chosen = std::move(chosen)] {
    if (app->get_subcommands().empty()) chosen();
  });
  return *app;
}

void add_integer(CLI::App& app, const OptionText& text, IntegerRange range,
                 std::function<void(std::int64_t)> set) {
  add_text(app, text, Presence::optional,
           [name = text.name, range, set = std::move(set)](const std::string& found) {
             set(parse_integer(name, found, range));
           });
}

void add_real(CLI::App& app, const OptionText& text, RealRange range, std::function<void(double)> set) {
  add_text(app, text, Presence::optional,
           [name = text.name, range, set = std::move(set)](const std::string& found) {
             set(parse_real(name, found, range));
           });
}

void add_choice(CLI::App& app, const OptionText& text, std::vector<std::string> words,
                std::function<void(std::size_t)> set) {
  add_text(app, text, Presence::optional,
           [name = text.name, words = std::move(words), set = std::move(set)](const std::string& found) {
             std::string expected = "one of";
             for (std::size_t i = 0; i < words.size(); ++i) {
               if (words[i] == found) return set(i);
               expected += (i == 0 ? " " : ", ") + words[i];
             }
             refuse(name, found, expected);
           });
}

void add_flag(CLI::App& app, const std::string& name, const std::string& description, bool& target) {
  app.add_flag(name, target, description);
}

void add_text(CLI::App& app, const OptionText& text, Presence presence,
              std::function<void(const std::string&)> set) {
  dress(app.add_option_function<std::string>(text.name, set, text.description), text, presence);
}

void add_text(CLI::App& app, const OptionText& text, Presence presence, std::string& target) {
  dress(app.add_option(text.name, target, text.description), text, presence);
}

void add_text(CLI::App& app, const OptionText& text, Presence presence, std::filesystem::path& target) {
  add_text(app, text, presence, [&target](const std::string& found) { target = found; });
}

void add_texts(CLI::App& app, const OptionText& text, Presence presence, std::vector<std::string>& target) {
  CLI::Option* option = app.add_option(text.name, target, text.description);
  option->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  dress(option, text, presence);
}

}  // namespace remodel::app
