#include "aero/field_template.h"

#include <algorithm>
#include <limits>

#include "transfer/box_tree.h"
#include "transfer/intersection.h"

namespace remodel {
TemplatePlaces::TemplatePlaces(const FrozenMesh& mesh, std::span<const Point> points) {
  constexpr double rounding = 1e-12;
  places_.resize(points.size());
  if (points.empty()) return;
  const FrozenMesh split = with_split_quads(mesh);
  std::vector<Box> boxes;
  for (const auto& [a, b, c] : split.triangles)
    boxes.push_back(box_of(split.points[a], split.points[b], split.points[c]));
  const BoxTree tree(boxes);
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::vector<std::uint32_t> near;
    tree.for_each(box_of(points[i], points[i], points[i]), [&](std::uint32_t t) { near.push_back(t); });
    std::sort(near.begin(), near.end());
    for (const std::uint32_t t : near) {
      const auto& [a, b, c] = split.triangles[t];
      const auto weights = weights_at({split.points[a], split.points[b], split.points[c]}, points[i]);
      if (std::ranges::any_of(weights, [](double w) { return !(w >= -rounding); })) continue;
      places_[i] = {split.triangles[t], weights, true};
      break;
    }
  }
}

std::vector<double> TemplatePlaces::at(const std::vector<double>& values) const {
  std::vector<double> result(places_.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Place& place = places_[i];
    if (!place.is_in_mesh) continue;
    result[i] = 0.0;
    for (std::size_t k = 0; k < 3; ++k) result[i] += place.weights[k] * values[place.corners[k]];
  }
  return result;
}

std::vector<std::string> template_fields(FlowModel model) {
  std::vector<std::string> names{"density", "velocity_x", "velocity_y", "pressure"};
  if (model == FlowModel::sa) names.emplace_back("viscosity_ratio");
  return names;
}

std::vector<double> template_values(const FlowResult& flow, const TemplatePlaces& places) {
  std::vector<double> result;
  const auto add = [&](const std::vector<double>& values) {
    const std::vector<double> found = places.at(values);
    result.insert(result.end(), found.begin(), found.end());
  };
  for (const auto* values : {&flow.density, &flow.velocity_x, &flow.velocity_y, &flow.pressure}) add(*values);
  if (flow.model == FlowModel::sa && flow.friction) add(flow.friction->viscosity_ratio);
  return result;
}

}  // namespace remodel
