#pragma once

// The wake of a run: a line behind the walls of its start, which stays there in all designs.

#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "remodel/layers.h"

namespace remodel {

struct StartWake {
  WakeLine line;
  Loop loop;
};

// None without a line. Throws as add_wake() does.
inline std::optional<StartWake> start_wake(Domain walls, const std::optional<WakeLine>& line,
                                           const LayerOptions& layer) {
  if (!line) return std::nullopt;
  add_wake(walls, *line, layer);
  return StartWake{*line, std::move(walls.loops.back())};
}

// The loops of bodies, and behind them that of the wake, if there is one.
inline Domain with_wake(Domain bodies, const std::optional<StartWake>& wake) {
  if (wake) bodies.loops.push_back(wake->loop);
  return bodies;
}

// In the settings of a run.
inline nlohmann::ordered_json to_json(const WakeLine& wake) {
  return {{"length", wake.length},
          {"direction", {wake.direction.x, wake.direction.y}},
          {"first", wake.first},
          {"growth", wake.growth},
          {"most", wake.most}};
}

// That of a layer's settings, if they have one. Throws Json's exceptions.
inline std::optional<WakeLine> wake_in(const nlohmann::ordered_json& layer) {
  if (!layer.contains("wake")) return std::nullopt;
  const nlohmann::ordered_json& json = layer.at("wake");
  return WakeLine{.length = json.at("length"),
                  .direction = {json.at("direction").at(0), json.at("direction").at(1)},
                  .first = json.at("first"),
                  .growth = json.at("growth"),
                  .most = json.at("most")};
}

}  // namespace remodel
