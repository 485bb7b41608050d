#pragma once

// The line of a wake in the settings of a run.

#include <nlohmann/json.hpp>

#include "remodel/layers.h"

namespace remodel {

inline nlohmann::ordered_json to_json(const WakeLine& wake) {
  return {{"length", wake.length},
          {"direction", {wake.direction.x, wake.direction.y}},
          {"first", wake.first},
          {"growth", wake.growth},
          {"most", wake.most}};
}

inline WakeLine wake_from(const nlohmann::ordered_json& json) {
  return {.length = json.at("length"),
          .direction = {json.at("direction").at(0), json.at("direction").at(1)},
          .first = json.at("first"),
          .growth = json.at("growth"),
          .most = json.at("most")};
}

}  // namespace remodel
