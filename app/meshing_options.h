#pragma once

// The options that `mesh` and `optimise` share: how a shape is discretised and what its mesh promises.

#include <optional>

#include "remodel/domain.h"
#include "remodel/mesh.h"
#include "report.h"

namespace CLI {
class App;
}

namespace remodel::app {

struct MeshingOptions {
  AirfoilDomainOptions discretisation;
  QualityOptions quality;
  std::optional<double> gradation;  // not given: points / 50, the paper's pairing
  int cst_degree = 5;

  QualityOptions resolved_quality() const;
};

void add_meshing_options(CLI::App& app, MeshingOptions& options);
void add_cst_degree(CLI::App& app, int& degree);
void add_repeat(CLI::App& app, int& repeat);

// The resolved values, as "options" in JSON and as one line a group in text.
void describe(Report& report, const MeshingOptions& options);
Json to_json(const MeshingOptions& options);

}  // namespace remodel::app
