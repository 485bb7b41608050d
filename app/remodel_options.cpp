#include "remodel_options.h"

#include <array>

#include "arguments.h"

namespace remodel::app {

void add_remodel_options(CLI::App& app, RemodelOptions& options) {
  add_real(
      app,
      {"--distance", "D", "1", "Removal radius over the distance of old and new vertex: at least 0, no unit"},
      {.low = 0.0}, [&](double value) { options.distance = value; });
  static constexpr std::array methods{Method::automatic, Method::specialised, Method::general};
  std::vector<std::string> words;
  for (const Method method : methods) words.emplace_back(name_of(method));
  add_choice(app,
             {"--method", "METHOD", "auto",
              "auto, specialised (vertices correspond one to one) or general (any loops)"},
             words, [&](std::size_t choice) { options.method = methods[choice]; });
}

}  // namespace remodel::app
