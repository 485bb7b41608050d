#pragma once

// What is meshed: an airfoil in its farfield, several airfoils with their places, a domain file, or a planar
// graph.

#include <optional>
#include <string>
#include <vector>

#include "remodel/domain.h"
#include "remodel/planar.h"
#include "report.h"

namespace CLI {
class App;
}

namespace remodel::app {

struct DomainInputOptions {
  std::vector<std::string> shapes;
  std::vector<std::string> places;  // "CHORD,DEGREES,X,Y", in the order of the shapes
  Crossings crossings = Crossings::insert;
};

// SHAPE..., --place, --crossings.
void add_domain_input(CLI::App& app, DomainInputOptions& options);

// Whether this is one airfoil where it lies, as opposed to a domain.
bool is_single_airfoil(const DomainInputOptions& options);

struct DomainInput {
  Domain domain;
  std::optional<PlanarFindings> findings;  // of a planar graph
};
// Throws Error as the readers do, and for more places than shapes.
DomainInput read_domain(const DomainInputOptions& options, const AirfoilDomainOptions& discretisation,
                        int cst_degree);

// input{...}: what was found in a planar graph, and mended.
void add_findings(Report& report, const DomainInput& input);

}  // namespace remodel::app
