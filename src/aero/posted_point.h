#pragma once

// The flow of one point of a design as a job of a crew, from bytes to bytes.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "aero/flow_memory.h"
#include "design/crew_states.h"
#include "remodel/flow.h"
#include "remodel/mesh.h"

namespace remodel {

// A value and its derivatives by the design, of one flow.
struct Slope {
  double value = 0.0;
  std::vector<double> by;
};

// What came of a point.
struct PointFlow {
  FlowResult flow;
  std::vector<std::pair<std::string, double>> of_outlets = {};
  std::map<std::size_t, Slope> slopes;  // of the functions that are asked for
  double gradient_seconds = 0.0;
};

struct PostedPoint {
  std::string run;  // identity_of() its parts
  std::uint64_t point = 0;
  std::uint64_t token = 0, before = 0;  // of this job, and of the point's last one; 0: none
  std::vector<double> design, from;     // as EvaluationTask has them
  bool gradient = false;
  std::optional<StationPressures> target;
  Mesh mesh;
};

// Of the flow coefficients and counts alone.
struct EvaluatedPoint {
  std::string problem;  // why there is none; or empty
  PointFlow point;
};

// What a process has of a point: its flow, in a memory of its own, and the last design.
struct PointState {
  FlowMemory memory;
  std::vector<double> design, from;
};
using PointStates = CrewStates<PointState>;

std::string encode(const PostedPoint& point, const Mesh& mesh);
std::string encode(const EvaluatedPoint& point);
// Throw Error (format).
PostedPoint decode_posted_point(const std::string& bytes);
EvaluatedPoint decode_evaluated_point(const std::string& bytes);

}  // namespace remodel
