#pragma once

// A job of a study as a value, and its encoding as CBOR (RFC 8949), which keeps every double exact.

#include <functional>
#include <string>

#include "study/rows.h"
#include "study/study.h"

namespace remodel {

enum class JobKind {
  path,    // the optimiser's path of a scenario
  fresh,   // (scenario, I, G): the fresh meshes of all compared evaluations
  replay,  // (scenario, I, G, D, strategy): the path around one living mesh
};

// The complete input of a job. Members that a kind does not use are empty.
struct StudyWork {
  JobKind kind = JobKind::path;
  CstAirfoil from, to;  // of the same degree
  std::uint64_t evaluations = 0, compare_every = 0, check_every = 1, validate_every = 1;
  // path
  double sigma = 0.0;
  std::uint64_t seed = 0;
  std::vector<int> points;  // of all pairs
  // fresh and replay
  StudyPair pair;
  StudyPath path;
  // replay
  double distance = 1.0;
  std::string strategy;
  FreshRows fresh;
};

std::string encode(const StudyWork& work);
StudyWork decode_work(const std::string& bytes);  // throws Error (format)
std::string encode(const StudyRows& rows);
StudyRows decode_rows(const std::string& bytes);  // throws Error (format)

// Thrown when `cancelled` returns true.
struct StudyCancelled {};
using StudyCancelQuestion = std::function<bool()>;

// One function per kind of job. They throw StudyCancelled.
PathRows compute_path(const StudyWork& work, const StudyCancelQuestion& cancelled);
FreshRows compute_fresh(const StudyWork& work, const StudyCancelQuestion& cancelled);
ReplayRows compute_replay(const StudyWork& work, const StudyCancelQuestion& cancelled);

}  // namespace remodel
