#pragma once

// Reads the input of `mesh` and `update`: an airfoil in its farfield, several airfoils with their places, a
// domain file or a planar graph.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "remodel/domain.h"
#include "remodel/generate.h"
#include "remodel/join.h"
#include "remodel/planar.h"
#include "remodel/shape_domain.h"
#include "report.h"
#include "shape_input.h"

namespace CLI {
class App;
}

namespace remodel::app {

struct DomainInputOptions {
  std::vector<std::string> shapes;
  std::vector<std::string> places;  // "CHORD,DEGREES,X,Y", in the order of the shapes
  std::vector<std::string> names;   // of the airfoils' markers, likewise
  Crossings crossings = Crossings::insert;
  double join = default_join;
  std::optional<OutlineCurve> as_given;  // no fit: a curve through the points of coordinate files
  bool keep_coordinates = false;         // of coordinate files: their place, incidence and units
  bool farfield_stays = false;           // where it is, with coordinates that are kept, too
};

// SHAPE..., --place, --name, --crossings, --join, --as-given, --keep-coordinates.
void add_domain_input(CLI::App& app, DomainInputOptions& options);
// The last four: how files of shapes are read.
void add_reading_options(CLI::App& app, DomainInputOptions& options);

// True if the input is one airfoil without a place and a name, as opposed to a domain or an outline as given.
bool is_single_airfoil(const DomainInputOptions& options);

// Its warnings are said. Throws Error as domain_of_shapes() does, and for more places or names than shapes.
ShapesDomain read_domain(const DomainInputOptions& options, const AirfoilDomainOptions& discretisation,
                        const FitOptions& fit);

// Throws Error (argument) for options that were given and have no part in what was read: those of far fields
// and fits in a whole domain, and how segments cross where there is no planar graph.
void require_used(const ShapesDomain& input, const std::function<bool(const char*)>& given);

// Validates the domain of a single SHAPE, whose file errors name. Of several it is known as a "domain".
void validate_input(const DomainInputOptions& options, const Domain& domain);
// generate(), whose errors name the file of a single SHAPE.
GenerateResult generate_input(const DomainInputOptions& options, const Domain& domain,
                              const QualityOptions& quality, StepObserver* observer = nullptr);

// Reports under input{...} the defects of a planar graph that were found and resolved, under fits[] how well
// coordinate files were fitted, and under outlines[] those that were taken as given.
void add_findings(Report& report, const ShapesDomain& input);

}  // namespace remodel::app
