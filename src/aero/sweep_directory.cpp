#include "aero/sweep_directory.h"

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <utility>

#include "base/checksum.h"
#include "remodel/error.h"
#include "remodel/io.h"

namespace remodel {
namespace {

namespace fs = std::filesystem;

constexpr const char* sweep_name = "sweep.json";
constexpr const char* chains_name = "chains";
constexpr std::size_t most_bytes = std::size_t{1} << 30;

// What has to be the same for flows to belong in one table.
Json settings_of(const SweepProblem& problem) {
  Json json = to_json(problem);
  for (const char* key : {"rows", "sections", "order", "chain", "seed"}) json.erase(key);
  return json;
}

// What a chain's file ends with.
std::string seal_of(const std::string& bytes) {
  Checksum sum;
  sum.add(bytes);
  return sum.text();
}

void add_row(std::vector<SweepRow>& rows, const SweepRow& more) {
  for (SweepRow& row : rows) {
    if (row.mach != more.mach || row.reynolds != more.reynolds) continue;
    row.values.insert(row.values.end(), more.values.begin(), more.values.end());
    std::sort(row.values.begin(), row.values.end());
    row.values.erase(std::unique(row.values.begin(), row.values.end()), row.values.end());
    return;
  }
  rows.push_back(more);
}

}  // namespace

std::size_t PlannedChain::flows() const {
  std::size_t of_a_section = 0;
  for (const SweepRow& row : plan->rows) of_a_section += row.values.size();
  return sections->size() * of_a_section;
}

bool SweepDirectory::exists(const fs::path& directory) {
  std::error_code ignored;
  return fs::exists(directory / sweep_name, ignored);
}

void SweepDirectory::require_there(const fs::path& directory) {
  if (!exists(directory))
    throw Error(ErrorCode::file, (directory / sweep_name).string(),
                "not found, expected a sweep's directory");
}

void SweepDirectory::require_new(const fs::path& directory) {
  std::error_code problem;
  if (!fs::exists(directory, problem)) return;
  if (!fs::is_directory(directory, problem))
    throw Error(ErrorCode::file, directory.string(), "is a file, expected a directory");
  if (exists(directory))
    throw Error(ErrorCode::argument, directory.string(),
                "holds a sweep: expected another directory, or --resume to go on with it");
  if (!fs::is_empty(directory))
    throw Error(ErrorCode::file, directory.string(),
                "is a directory with other files, expected a new, an empty or a sweep's directory");
}

SweepDirectory::SweepDirectory(fs::path directory, SweepProblem problem)
    : directory_(std::move(directory)), problem_(std::move(problem)) {
  // Further Reynolds numbers do not change it.
  if (problem_.model != FlowModel::euler) problem_.layer = sweep_layer(problem_);
  plans_ = plans_of_missing(problem_, {});
  save();
}

SweepDirectory::SweepDirectory(fs::path directory) : directory_(std::move(directory)) {
  const fs::path file = directory_ / sweep_name;
  require_there(directory_);
  const Json json = parse_design_json(read_text(file, most_bytes), file.string(), "a sweep");
  if (!json.is_object() || !json.contains("sweep") || !json.contains("plans"))
    throw Error(ErrorCode::format, file.string(), "found no sweep, expected the keys 'sweep' and 'plans'");
  problem_ = sweep_problem_from(json.at("sweep"), file.string());
  plans_ = sweep_plans_from(json.at("plans"), problem_, file.string());
}

void SweepDirectory::extend(const SweepProblem& by) {
  const Json own = settings_of(problem_), other = settings_of(by);
  for (const auto& [key, value] : other.items())
    if (!own.contains(key) || own.at(key) != value)
      throw Error(
          ErrorCode::argument, directory_.string(),
          "holds a sweep with " + (own.contains(key) ? own.at(key).dump() : std::string("none")) + " as '" +
              key + "', found " + value.dump() + ": expected the same, or another directory" +
              (key == "layer" ? " (unless the file has 'layers', they follow from all Reynolds numbers)"
                              : ""));
  for (const SweepSection& section : by.sections)
    if (std::ranges::count(problem_.sections, section) == 0) problem_.sections.push_back(section);
  for (const SweepRow& row : by.rows) add_row(problem_.rows, row);
  problem_.order = by.order, problem_.chain = by.chain, problem_.seed = by.seed;
  std::vector<SweepPlan> more = plans_of_missing(problem_, plans_);
  if (more.empty()) return;
  std::move(more.begin(), more.end(), std::back_inserter(plans_));
  save();
}

std::vector<PlannedChain> SweepDirectory::chains() const {
  std::vector<PlannedChain> chains;
  for (const SweepPlan& plan : plans_)
    for (const std::vector<std::size_t>& sections : plan.chains) chains.push_back({&plan, &sections});
  return chains;
}

fs::path SweepDirectory::file_of(std::size_t chain) const {
  char name[40];
  std::snprintf(name, sizeof name, "%06zu.cbor", chain + 1);
  return directory_ / chains_name / name;
}

bool SweepDirectory::is_finished(std::size_t chain) const {
  std::error_code ignored;
  return fs::exists(file_of(chain), ignored);
}

ChainWork SweepDirectory::work_of(const PlannedChain& chain) const {
  ChainWork work{
      .problem = problem_, .sections = *chain.sections, .directory = fs::absolute(directory_).string()};
  work.problem.rows = chain.plan->rows;
  work.problem.sections.clear();
  for (const std::size_t section : *chain.sections)
    work.problem.sections.push_back(problem_.sections[section]);
  return work;
}

void SweepDirectory::write(std::size_t chain, const std::string& result) const {
  fs::create_directory(directory_ / chains_name);
  write_text_atomically(file_of(chain), result + seal_of(result));
}

ChainResult SweepDirectory::read(std::size_t chain) const {
  const std::string file = file_of(chain).string();
  std::string bytes = read_text(file, most_bytes);
  const std::size_t sealed = seal_of("").size();
  const std::string seal = bytes.substr(bytes.size() - std::min(sealed, bytes.size()));
  bytes.resize(bytes.size() - seal.size());
  if (seal != seal_of(bytes))
    throw Error(ErrorCode::format, file,
                "is damaged: its checksum is another one; without this file its flows are found again");
  ChainResult result = decode_chain_result(bytes, file);
  for (const SweepFlow& flow : result.flows)
    if (flow.section >= problem_.sections.size())
      throw Error(ErrorCode::format, file,
                  "found section " + std::to_string(flow.section) + ", expected less than " +
                      std::to_string(problem_.sections.size()));
  return result;
}

void SweepDirectory::save() const {
  const Json json{{"sweep", to_json(problem_)}, {"plans", to_json(plans_)}};
  write_text_atomically(directory_ / sweep_name, json.dump(1) + "\n");
}

}  // namespace remodel
