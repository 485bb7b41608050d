// A sweep's file as docs/sweep.md describes it.

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "aero/problem_keys.h"
#include "aero/problem_place.h"
#include "aero/resolved_problem.h"
#include "aero/sweep_record.h"
#include "aero/unit_samples.h"
#include "remodel/design_problem.h"
#include "remodel/design_run.h"
#include "remodel/polar.h"
#include "remodel/sweep.h"

namespace remodel {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_sections = 100000, most_values = 10000, most_entries = 100000;
constexpr std::size_t most_file_bytes = std::size_t{16} << 20;

Sampling sampling_of(const Keys& keys) {
  return choice(keys, "method", {Sampling::sobol, Sampling::latin_hypercube});
}

constexpr int usual_sweep_degree = 8;

// Sections, one entry of the file after the other.
class SectionReader {
 public:
  SectionReader(const std::string& file, std::optional<int> degree, SweepProblem& problem)
      : file_(file), directory_(fs::path(file).parent_path()), degree_(degree), problem_(problem) {}

  void read(const Json& entry) {
    ++number_;
    const std::string where = file_ + ", section " + std::to_string(number_);
    if (entry.is_string()) return add_named(entry.get<std::string>(), where);
    if (!entry.is_object())
      throw Error(ErrorCode::format, where,
                  "found " + std::string(entry.type_name()) + ", expected a name, or an object");
    if (entry.contains("airfoil"))
      add_given(Keys(entry, where, {"name", "airfoil"}), entry);
    else if (entry.contains("directory"))
      add_directory(Keys(entry, where, {"directory"}));
    else if (entry.contains("designs"))
      add_designs(Keys(entry, where, {"designs"}));
    else
      add_samples(Keys(entry, where, {"samples", "around", "range", "method", "seed"}));
  }

 private:
  void add(SweepSection section) {
    if (problem_.sections.size() == most_sections)
      throw Error(
          ErrorCode::format, file_,
          "found more than " + std::to_string(most_sections) + " sections, expected that many at most");
    if (section.problem.empty() && !surfaces_apart(section.airfoil))
      section.problem = section.name + ": the surfaces cross";
    problem_.sections.push_back(std::move(section));
  }
  // A file that is no airfoil is a section that is not there; a name that nothing has is a mistake.
  void add_named(const std::string& name, const std::string& where) {
    try {
      const CstFit fit = airfoil_beside(directory_, name, degree_.value_or(usual_sweep_degree));
      problem_.warnings.insert(problem_.warnings.end(), fit.warnings.begin(), fit.warnings.end());
      add({.name = name, .airfoil = fit.airfoil});
    } catch (const Error& error) {
      std::error_code ignored;
      const bool is_file = fs::is_regular_file(directory_ / name, ignored);
      if (!is_file || error.code() == ErrorCode::file) throw Error(error.code(), where, error.what());
      add({.name = name, .problem = error.what()});
    }
  }
  void add_given(const Keys& keys, const Json& entry) {
    SweepSection section{.name = keys.get<std::string>("name")};
    try {
      section.airfoil = airfoil_from_json(entry.at("airfoil").dump(), "airfoil");
    } catch (const Error& error) {
      keys.fail(error.what());
    }
    add(std::move(section));
  }
  void add_directory(const Keys& keys) {
    const fs::path named = keys.get<std::string>("directory"), directory = directory_ / named;
    std::error_code problem;
    std::vector<std::string> names;
    for (const fs::directory_entry& entry : fs::directory_iterator(directory, problem)) {
      const std::string extension = entry.path().extension().string();
      if (entry.is_regular_file() && (extension == ".dat" || extension == ".txt" || extension == ".json"))
        names.push_back((named / entry.path().filename()).string());
    }
    if (problem) keys.fail("cannot read '" + directory.string() + "': " + problem.message());
    if (names.empty())
      keys.fail("found no .dat, .txt or .json in '" + directory.string() + "', expected files of sections");
    std::sort(names.begin(), names.end());
    for (const std::string& name : names) add_named(name, file_ + ", section " + std::to_string(number_));
  }
  void add_designs(const Keys& keys) {
    const std::string name = keys.get<std::string>("designs");
    const fs::path directory = directory_ / name;
    if (!fs::exists(directory / "history.sqlite") || !holds_design_run(directory))
      keys.fail("found no run of `remodel design` in '" + directory.string() + "'");
    const DesignRun run = read_design_run(directory);
    if (run.space->sections() == 0)
      keys.fail("found a run of a deformed shape, expected one of a section by its coefficients");
    if (run.space->sections() != 1)
      keys.fail("found a run of " + std::to_string(run.space->sections()) + " sections, expected one");
    for (const EvaluationRecord& row : run.rows) {
      SweepSection section{.name = name + "#" + std::to_string(row.evaluation),
                           .airfoil = run.space->section(row.coefficients, 0)};
      const auto is_same = [&](const SweepSection& other) { return other.airfoil == section.airfoil; };
      if (std::ranges::none_of(problem_.sections, is_same)) add(std::move(section));
    }
  }
  void add_samples(const Keys& keys) {
    const auto count = keys.whole<std::size_t>("samples", {}, 1, most_sections);
    const std::string around = keys.get<std::string>("around");
    const CstAirfoil start =
        start_named(keys, "around", degree_, usual_sweep_degree, directory_, problem_.warnings);
    const double range = keys.get<double>("range");
    if (!(range > 0.0 && range <= 1.0))
      keys.fail("found " + shown(range) + " as 'range', expected a number above 0, at most 1");
    const std::size_t half = start.upper.size();
    const auto samples =
        unit_samples(sampling_of(keys), count, 2 * half, keys.whole<std::uint64_t>("seed", 1, 0, UINT64_MAX));
    for (std::size_t i = 0; i < samples.size(); ++i) {
      SweepSection section{.name = around + "#" + std::to_string(i + 1), .airfoil = start};
      for (std::size_t c = 0; c < 2 * half; ++c)
        (c < half ? section.airfoil.upper[c] : section.airfoil.lower[c - half]) +=
            range * (2.0 * samples[i][c] - 1.0);
      add(std::move(section));
    }
  }

  const std::string& file_;
  fs::path directory_;
  std::optional<int> degree_;
  SweepProblem& problem_;
  std::size_t number_ = 0;
};

struct ConditionRanges {
  static constexpr ValueRange mach{0.01, 3}, alpha_deg{-90, 90}, cl{-10, 10}, reynolds{1, 1e10};
};

// A number, several, or "FIRST:LAST:STEP".
std::vector<double> values_of(const Keys& keys, const Json& object, const char* key, ValueRange range) {
  const Json& value = object.at(key);
  std::vector<double> values;
  if (value.is_string()) {
    try {
      values = parse_range(key, value.get<std::string>(), range);
    } catch (const Error& error) {
      keys.fail(error.what());
    }
  } else if (value.is_number()) {
    values = {value.get<double>()};
  } else {
    values = keys.get<std::vector<double>>(key);
  }
  if (values.empty() || values.size() > most_values)
    keys.fail("found " + std::to_string(values.size()) + " values as '" + key + "', expected 1 to " +
              std::to_string(most_values));
  std::sort(values.begin(), values.end());
  for (const double x : values)
    if (!(x >= range.low && x <= range.high))
      keys.fail("found " + shown(x) + " as '" + key + "', expected " + shown(range.low) + " to " +
                shown(range.high));
  if (std::adjacent_find(values.begin(), values.end()) != values.end())
    keys.fail("found a value twice in '" + std::string(key) + "', expected each once");
  return values;
}

std::vector<SweepRow> rows_of_grid(const Keys& keys, const Json& object, const SweepProblem& problem,
                                   const char* value_key, ValueRange value_range) {
  std::vector<double> reynolds{0.0};
  if (problem.model != FlowModel::euler)
    reynolds = values_of(keys, object, "reynolds", ConditionRanges::reynolds);
  const std::vector<double> values = values_of(keys, object, value_key, value_range);
  std::vector<SweepRow> rows;
  for (const double mach : values_of(keys, object, "mach", ConditionRanges::mach))
    for (const double re : reynolds) rows.push_back({.mach = mach, .reynolds = re, .values = values});
  return rows;
}

// Samples between two values each, in an order in which each is near the one before: a row for each.
std::vector<SweepRow> rows_of_samples(const Keys& keys, const Json& object, const SweepProblem& problem,
                                      const char* value_key, ValueRange value_range) {
  struct Axis {
    double low, high;
  };
  std::vector<Axis> axes;
  const auto add = [&](const char* key, ValueRange range) {
    const std::vector<double> ends = values_of(keys, object, key, range);
    if (ends.size() > 2)
      keys.fail("found " + std::to_string(ends.size()) + " values as '" + key +
                "' of samples, expected one, or the lowest and the highest");
    axes.push_back({ends.front(), ends.back()});
  };
  add("mach", ConditionRanges::mach);
  add(value_key, value_range);
  if (problem.model != FlowModel::euler) add("reynolds", ConditionRanges::reynolds);
  const auto count = keys.whole<std::size_t>("samples", {}, 1, most_values);
  auto left = unit_samples(sampling_of(keys), count, axes.size(),
                           keys.whole<std::uint64_t>("seed", 1, 0, UINT64_MAX));
  const auto at = [&](const std::vector<double>& unit, std::size_t axis) {
    return axes[axis].low + unit[axis] * (axes[axis].high - axes[axis].low);
  };
  const auto reynolds_at = [&](const std::vector<double>& unit) {  // by its logarithm
    return axes[2].low * std::pow(axes[2].high / axes[2].low, unit[2]);
  };
  std::vector<SweepRow> rows;
  std::vector<double> last(axes.size(), 0.0);
  while (!left.empty()) {
    const auto distance = [&](const std::vector<double>& unit) {
      double sum = 0.0;
      for (std::size_t d = 0; d < unit.size(); ++d) sum += (unit[d] - last[d]) * (unit[d] - last[d]);
      return sum;
    };
    const auto next = std::min_element(
        left.begin(), left.end(), [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
    last = *next;
    left.erase(next);
    rows.push_back({.mach = at(last, 0),
                    .reynolds = axes.size() > 2 ? reynolds_at(last) : 0.0,
                    .values = {at(last, 1)}});
  }
  return rows;
}

void read_conditions(const Json& json, const std::string& file, SweepProblem& problem) {
  const Json object = json.at("conditions");
  const Keys keys(object, file + ", conditions",
                  {"mach", "alpha_deg", "cl", "reynolds", "samples", "method", "seed"});
  keys.require("mach");
  if (keys.has("alpha_deg") == keys.has("cl")) keys.fail("expected one of 'alpha_deg' and 'cl'");
  require_reynolds(keys, problem.model);
  for (const char* key : {"method", "seed"})
    if (keys.has(key) && !keys.has("samples"))
      keys.fail("found '" + std::string(key) + "' without 'samples', expected both or none");
  problem.over_lift = keys.has("cl");
  const char* value = problem.over_lift ? "cl" : "alpha_deg";
  const ValueRange range = problem.over_lift ? ConditionRanges::cl : ConditionRanges::alpha_deg;
  problem.rows = keys.has("samples") ? rows_of_samples(keys, object, problem, value, range)
                                     : rows_of_grid(keys, object, problem, value, range);
}

void read_mesh(const Json& json, const std::string& file, SweepProblem& problem) {
  const Json object = object_of(json, "mesh");
  const Keys keys(object, file + ", mesh", {"points", "gradation", "farfield_radius", "layers"});
  const bool has_friction = problem.model != FlowModel::euler;
  problem.domain.points =
      keys.whole<int>("points", has_friction ? usual_points_with_friction : 200, 8, 100000);
  problem.gradation = keys.find<double>("gradation");
  problem.domain.farfield_radius = keys.get<double>("farfield_radius", problem.domain.farfield_radius);
  if (!keys.has("layers")) return;
  if (!has_friction) keys.fail("found 'layers' without friction, expected \"laminar\" or \"sa\" as 'model'");
  problem.layer = layer_given(object.at("layers"), file + ", mesh, layers", sweep_layer(problem));
}

constexpr std::size_t most_template_points = 100000;

// A grid's values of x or y: [FIRST, LAST, COUNT].
std::vector<double> grid_values(const Keys& keys, const char* key) {
  const auto given = keys.get<std::vector<double>>(key);
  const double most = static_cast<double>(most_template_points);
  if (given.size() != 3 || !(given[0] < given[1]) || !(given[2] >= 2 && given[2] <= most) ||
      given[2] != std::floor(given[2]))
    keys.fail("found " + Json(given).dump() + " as '" + key +
              "', expected the first value, a larger last one and their number, 2 or more");
  const auto count = static_cast<std::size_t>(given[2]);
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(count - 1);
    values[i] = (1.0 - part) * given[0] + part * given[1];
  }
  return values;
}

// x and y of a line of a table.
Point point_of_line(const std::string& line, const std::string& where) {
  std::size_t of_x = 0, of_y = 0;
  Point p;
  try {
    p.x = std::stod(line, &of_x);
    std::size_t at = line.find_first_not_of(" \t", of_x);
    if (at != std::string::npos && line[at] == ',') ++at;
    if (at == std::string::npos || at >= line.size()) throw std::invalid_argument("no y");
    p.y = std::stod(line.substr(at), &of_y);
    if (line.find_first_not_of(" \t\r", at + of_y) != std::string::npos || !std::isfinite(p.x + p.y))
      throw std::invalid_argument("more");
  } catch (const std::logic_error&) {
    throw Error(ErrorCode::format, where, "found '" + line + "', expected two numbers: x,y");
  }
  return p;
}

// A first line without numbers is a heading.
std::vector<Point> points_of_table(const fs::path& table) {
  std::istringstream lines(read_text(table, most_file_bytes));
  std::vector<Point> points;
  std::string line;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    if (number == 1 && line.find_first_of("0123456789") == std::string::npos) continue;
    points.push_back(point_of_line(line, table.string() + ", line " + std::to_string(number)));
  }
  return points;
}

std::vector<Point> read_template(const Keys& keys, const Json& json, const std::string& file) {
  std::vector<Point> points;
  if (json.is_string()) {
    points = points_of_table(fs::path(file).parent_path() / json.get<std::string>());
  } else if (json.is_object()) {
    const Keys grid(json, file + ", template", {"x", "y"});
    const std::vector<double> xs = grid_values(grid, "x"), ys = grid_values(grid, "y");
    if (xs.size() * ys.size() <= most_template_points)
      for (const double y : ys)
        for (const double x : xs) points.push_back({x, y});
  } else {
    keys.fail("found " + std::string(json.type_name()) +
              " as 'template', expected the name of a table of points, or a grid's 'x' and 'y'");
  }
  if (points.empty() || points.size() > most_template_points)
    keys.fail("found no points of 'template', or too many, expected 1 to " +
              std::to_string(most_template_points));
  return points;
}

void read_sections(const Keys& keys, const std::string& file, SweepProblem& problem) {
  keys.require("sections");
  std::optional<int> degree;
  if (keys.has("degree")) degree = keys.whole<int>("degree", {}, 1, 30);
  SectionReader reader(file, degree, problem);
  for (const Json& entry : keys.list("sections", most_entries)) reader.read(entry);
  if (problem.sections.empty()) keys.fail("found no sections, expected one at least");
  if (std::ranges::none_of(problem.sections, [](const SweepSection& s) { return s.problem.empty(); }))
    keys.fail("found no section that could be read; the first: " + problem.sections.front().problem);
}

}  // namespace

LayerOptions sweep_layer(const SweepProblem& problem) {
  if (problem.layer) return *problem.layer;
  std::vector<DesignPoint> points;
  for (const SweepRow& row : problem.rows)
    points.push_back({.conditions = {.mach = row.mach, .reynolds = row.reynolds}, .model = problem.model});
  return layer_for_points(points, false);
}

SweepProblem read_sweep(const std::string& file) {
  return parse_sweep(read_text(file, most_file_bytes), file);
}

SweepProblem parse_sweep(const std::string& text, const std::string& file) {
  const Json json = parse_design_json(text, file, "a sweep");
  const Keys keys(json, file,
                  {"sections", "degree", "conditions", "model", "transition", "mesh", "surface_stations",
                   "fields", "template", "chain", "order", "seed", "tolerance", "max_steps"});
  SweepProblem problem;
  problem.model = model_named(keys);
  problem.transition = transition_of(keys);
  keys.require("conditions");
  read_conditions(json, file, problem);
  read_mesh(json, file, problem);
  problem.stations = keys.whole<std::size_t>("surface_stations", 0, 0, 10000);
  problem.fields = keys.get<bool>("fields", false);
  if (keys.has("template")) problem.field_points = read_template(keys, json.at("template"), file);
  problem.chain = keys.whole<std::size_t>("chain", problem.chain, 1, most_sections);
  problem.order = choice(keys, "order", {SweepOrder::nearest, SweepOrder::given, SweepOrder::random});
  problem.seed = keys.whole<std::uint64_t>("seed", 1, 0, UINT64_MAX);
  problem.tolerance = keys.get<double>("tolerance", problem.tolerance);
  problem.max_steps = keys.whole<int>("max_steps", problem.max_steps, 1, 1000000);
  read_sections(keys, file, problem);
  validate(problem, file);
  return problem;
}

void validate(const SweepProblem& problem, const std::string& source) {
  const ProblemPlace place(source);
  if (problem.sections.empty()) place.fail("found no sections, expected one at least");
  if (problem.rows.empty()) place.fail("found no conditions, expected a row at least");
  const bool has_friction = problem.model != FlowModel::euler;
  for (const SweepRow& row : problem.rows) {
    place.require_number(row.mach, "mach", {0.01, 3});
    if (has_friction) place.require_number(row.reynolds, "reynolds", {1, 1e10});
    if (problem.over_lift && row.mach >= 1.0)
      place.fail("found Mach " + shown(row.mach) + " with lifts, expected less than 1, or angles");
    if (row.values.empty() || !std::ranges::is_sorted(row.values, std::less_equal<>()))
      place.fail(
          "found no values of a row, or values that do not ascend, expected each above the one before");
    for (const double value : row.values)
      problem.over_lift ? place.require_number(value, "cl", {-10, 10})
                        : place.require_number(value, "alpha_deg", {-90, 90});
  }
  if (problem.transition) {
    if (problem.model != FlowModel::sa)
      place.fail("found 'transition' without turbulence, expected \"sa\" as 'model'");
    for (const double x : *problem.transition) place.require_number(x, "transition", {0, 1});
  }
  if (problem.domain.points < 8 || problem.domain.points % 2 != 0)
    place.fail("found " + shown(problem.domain.points) + " as 'points', expected an even number, 8 or more");
  if (has_friction && problem.domain.points < 150)
    place.fail("found " + shown(problem.domain.points) + " as 'points', expected 150 or more with friction");
  if (problem.gradation) place.require_number(*problem.gradation, "gradation", {1e-3, 1e6});
  if (problem.layer) {
    place.require_number(problem.layer->first_height, "first_height", {1e-9, 1});
    place.require_number(problem.layer->growth, "growth", {1.02, 2});
    place.require_number(problem.layer->thickness, "thickness", {problem.layer->first_height, 1});
  }
  place.require_number(problem.domain.farfield_radius, "farfield_radius", {1.5, 1e6});
  place.require_number(problem.tolerance, "tolerance", {1e-13, 1e-2});
  if (problem.stations == 1) place.fail("found 1 as 'surface_stations', expected 0, or 2 or more");
  if (problem.chain == 0) place.fail("found 0 as 'chain', expected 1 or more");
}

}  // namespace remodel
