// An evaluator of one's own: the airfoil of largest enclosed area that is nowhere thicker than 15 % of its
// chord.
//
//     own_evaluator DIRECTORY

#include <algorithm>
#include <iostream>

#include "remodel/optimise.h"
#include "remodel/shape_files.h"

using namespace remodel;

struct LargestArea : Evaluator {
  Evaluation evaluate(const EvaluationTask& task, std::unique_ptr<EvaluatorState>&) override {
    const FrozenMesh mesh = task.mesh.freeze();
    double area = 0.0, top = 0.0, bottom = 0.0;  // the area by Green's formula, along the airfoil's edges
    for (const FrozenBoundary& part : mesh.boundaries) {
      if (part.name != "airfoil") continue;
      for (const auto& [a, b] : part.edges) {
        const Point p = mesh.points[a], q = mesh.points[b];
        area -= 0.5 * (p.x * q.y - q.x * p.y);  // the domain, not the airfoil, is on the left
        top = std::max(top, p.y);
        bottom = std::min(bottom, p.y);
      }
    }
    return {.objective = -area, .constraints = {top - bottom - 0.15}, .outputs = {{"area", area}}};
  }
  std::string description() const override { return R"({"evaluator": "largest area"})"; }
};

int main(int, char** arguments) {
  LargestArea evaluator;
  const OptimiseResult result = optimise(load_airfoil("naca:0012", 3), evaluator,
                                         {.domain = {.points = 50},
                                          .quality = {.gradation = 1.0},
                                          .evaluations = 600,
                                          .directory = arguments[1]});
  std::cout << "area " << -result.objective << " square chords after " << result.evaluations << " designs, "
            << result.preserved_percent << " % of the triangles preserved\n";
}
