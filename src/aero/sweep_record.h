#pragma once

// A sweep and what its chains found as values of JSON: of files and of messages between processes, which have
// them as CBOR (RFC 8949), every double exact.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "aero/problem_json.h"
#include "remodel/sweep.h"

namespace remodel {

// Sections that have the same rows to find, in the order of their chains.
struct SweepPlan {
  std::vector<SweepRow> rows;
  std::vector<std::vector<std::size_t>> chains;  // indices of sections
};

// The work of one chain: a sweep of its sections and rows alone, and the numbers of these sections.
struct ChainWork {
  SweepProblem problem;
  std::vector<std::size_t> sections;
  std::string directory;  // the sweep's, where fields go
};
struct ChainResult {
  std::vector<SweepFlow> flows;
  double mesh_seconds = 0.0;
};

// What the flows of a sweep come to.
struct SweepCounts {
  std::size_t found = 0;
  std::size_t warned = 0;                       // of those found
  double seconds = 0.0;                         // of all searches
  std::optional<double> cold_seconds_estimate;  // SweepResult's; none where no flow was found cold
};
SweepCounts counts_of(const std::vector<SweepFlow>& flows);

// The layer that all flows share. Precondition: they have friction.
LayerOptions sweep_layer(const SweepProblem& problem);

Json to_json(const SweepProblem& problem);
Json to_json(const std::vector<SweepPlan>& plans);
// Of the sweep's own files, which anybody may have written. Throw Error (format) naming the source.
SweepProblem sweep_problem_from(const Json& json, const std::string& source);
std::vector<SweepPlan> sweep_plans_from(const Json& json, const SweepProblem& problem,
                                        const std::string& source);

std::string encode(const ChainWork& work);
ChainWork decode_chain_work(const std::string& bytes);
std::string encode(const ChainResult& result);
ChainResult decode_chain_result(const std::string& bytes, const std::string& source);

}  // namespace remodel
