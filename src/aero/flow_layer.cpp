#include "remodel/flow_layer.h"

#include <algorithm>
#include <cmath>

#include "remodel/error.h"

namespace remodel {

LayerOptions layer_for_flow(FlowModel model, double reynolds) {
  constexpr double turbulent_y_plus = 1.0, laminar_y_plus = 0.3;
  if (model == FlowModel::euler)
    throw Error(ErrorCode::argument, "model", "found euler, expected a model with friction: laminar or sa");
  const bool turbulent = model == FlowModel::sa;
  LayerOptions layer;
  layer.thickness = 1.2 * boundary_layer_thickness(reynolds);
  if (!turbulent) layer.thickness = std::max(layer.thickness, 1.2 * std::min(5.0 / std::sqrt(reynolds), 0.5));
  layer.first_height =
      std::min(first_height(turbulent ? turbulent_y_plus : laminar_y_plus, reynolds), 0.1 * layer.thickness);
  return layer;
}

}  // namespace remodel
