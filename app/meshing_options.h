#pragma once

// The options that `mesh` and `optimise` share: the discretisation of a shape and the quality of its mesh.

#include <optional>

#include "remodel/domain.h"
#include "remodel/mesh.h"
#include "report.h"

namespace CLI {
class App;
}

namespace remodel::app {

// --cst-degree, --close-trailing-edge: the fit of a coordinate file.
struct FitOptions {
  int degree = 5;
  bool close_trailing_edge = false;
  TrailingEdge trailing_edge() const {
    return close_trailing_edge ? TrailingEdge::closed : TrailingEdge::kept;
  }
};

struct MeshingOptions {
  AirfoilDomainOptions discretisation;
  QualityOptions quality;
  std::optional<double> gradation;  // not given: points / 50, the paper's pairing
  FitOptions fit;

  QualityOptions resolved_quality() const;
};

void add_meshing_options(CLI::App& app, MeshingOptions& options);
// --turning-share, where stations are not those of a design that changes.
void add_turning_share(CLI::App& app, AirfoilDomainOptions& options);
void add_fit_options(CLI::App& app, FitOptions& options);
void add_repeat(CLI::App& app, int& repeat);

// Reports the resolved values: as "options" in JSON, as one line per group in text.
// `farfield`: whether there is one, and airfoils in it; else the discretisation is the domain's own.
// `points`: whether the airfoils have that many, and not those of their files.
void describe(Report& report, const MeshingOptions& options, bool farfield, bool points);
Json to_json(const MeshingOptions& options);

}  // namespace remodel::app
