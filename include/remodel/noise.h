#pragma once

// Noise of values along a line of designs: what is left of them when a smooth function is taken away, and
// what that makes of finite differences. It depends on how the meshes of the designs are made.

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "remodel/design_space.h"
#include "remodel/evaluator.h"
#include "remodel/mesh.h"

namespace remodel {

// A polynomial of least squares through values at places along a line.
struct LineFit {
  double rms = 0.0;          // of the residuals, over the degrees of freedom that are left
  double slope = 0.0;        // at 0
  double slope_error = 0.0;  // standard deviation of the slope, if the residuals are independent
  // The step of central differences at 0 with the least error, of noise over the step and of the third
  // derivative times its square, and that error. 0 where there is no noise, or the degree is below 3.
  double step = 0.0;
  double step_error = 0.0;
  std::vector<double> residuals;  // in the order of the values
};

// Throws Error (argument) for a degree below 1, fewer than degree + 2 values, places that are not different,
// and numbers that are not finite.
LineFit fit_line(std::span<const double> places, std::span<const double> values, int degree);

// How the meshes of a line are made: generated each; one living mesh, from the first design to the last;
// copies of the mesh of the design in the middle (the hub), remodelled; or morphs of that mesh, which keep
// its connectivity (Strategy::reference).
enum class LineMeshes { fresh, living, hub, reference };
inline constexpr std::array all_line_meshes = {LineMeshes::fresh, LineMeshes::living, LineMeshes::hub,
                                               LineMeshes::reference};
const char* name_of(LineMeshes meshes);

// The values of a design on its mesh.
struct LineValues {
  std::vector<double> values;  // by LineObjective::names(); none where there are none
  std::string failure{};       // why there are none
};

// An objective is what is measured along a line. An exception of its functions ends the measurement.
class LineObjective {
 public:
  virtual ~LineObjective() = default;
  virtual std::vector<std::string> names() const = 0;
  // The next mesh has nothing to do with the last one.
  virtual void forget() = 0;
  virtual LineValues values(const Mesh& mesh, std::span<const double> design, StepObserver& observer) = 0;
  // Derivatives of the last values along a direction in the design, by the adjoint method on their mesh, as
  // the mesh follows designs; none where there is no such method.
  virtual std::vector<double> slopes(const Mesh& mesh, std::span<const double> direction, LineMeshes meshes) {
    static_cast<void>(mesh), static_cast<void>(direction), static_cast<void>(meshes);
    return {};
  }
};

// The objective of an evaluator, which has to outlive it. A design that has none says why.
std::unique_ptr<LineObjective> line_objective(Evaluator& evaluator);

struct NoiseOptions {
  // The direction in the space of designs, of any length but 0. Empty: each of the first half of the numbers
  // alike, of an airfoil its upper surface.
  std::vector<double> direction{};
  double spacing = 1e-3;  // between designs, in the design's numbers; above 0
  int count = 21;         // designs, the start in their middle: at least degree + 2
  int degree = 3;         // of the polynomial that is smooth enough; 1 or more
  QualityOptions quality{};
  StepObserver* observer = nullptr;
};

// A series is what was found on meshes that were made in one of the ways.
struct NoiseSeries {
  LineMeshes meshes = LineMeshes::fresh;
  std::vector<std::vector<double>> values;  // per design, by name; empty where there are none
  std::vector<LineFit> fits;                // by name; none where too few values are left
  // These are slopes by the adjoint method at place 0, by name: of an even number of designs the mean of the
  // two beside it. None where there is no such method, or no value.
  std::vector<double> adjoint;
  std::vector<std::string> failures;  // why there are no values, of each design without
};

struct NoiseResult {
  std::vector<std::string> names;   // of values
  std::vector<double> places;       // of designs on the line, around 0
  std::vector<NoiseSeries> series;  // for each of all_line_meshes
  Stopped stopped = Stopped::done;  // or why a mesh is unfinished, or interrupted: then series lack values
  bool complete() const;            // every series has its fits
};

// Evaluates designs along a line around the start, on meshes of each way. Throws Error (argument) for options
// out of range, and where a design of the line is not feasible.
NoiseResult measure_noise(const DesignSpace& space, LineObjective& objective, const NoiseOptions& options);

}  // namespace remodel
