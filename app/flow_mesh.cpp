#include "flow_mesh.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "remodel/error.h"
#include "remodel/flow_layer.h"
#include "remodel/generate.h"
#include "remodel/layers.h"

namespace remodel::app {
namespace {

void require_whole(const DomainInputOptions& input, Stopped stopped) {
  if (stopped == Stopped::done) return;
  throw Error(ErrorCode::argument, input.shapes.front(),
              std::string("the mesh is unfinished (") + name_of(stopped) + "), expected a whole one");
}

// A domain whose curves are to be periodic has to know before it is meshed.
ShapesDomain domain_of_flow(const FlowMeshRequest& request, const MeshingOptions& meshing) {
  ShapesDomain input = read_domain(request.input, meshing.discretisation, meshing.fit);
  require_used(input, request.given);
  for (const FlowPeriod& pair : request.flow.periodic) {
    const PeriodicPair wanted = {pair.name, pair.moved};
    std::vector<PeriodicPair>& known = input.domain.periodic;
    if (std::find(known.begin(), known.end(), wanted) == known.end()) known.push_back(wanted);
  }
  return input;
}

// A fresh mesh with a layer that the Reynolds number asks for, as mesh --layers makes it.
MeshInput layered_input(const FlowMeshRequest& request) {
  refuse_given(
      request.given, {"--points", "--turning-share"},
      "given with a model with friction, expected --wall-spacing, --te-spacing and --max-spacing, which "
      "set the stations");
  require_compatible(request.layers);
  MeshingOptions meshing = request.meshing;
  meshing.gradation = meshing.gradation.value_or(gradation_with_layers);
  ShapesDomain domain = domain_of_flow(request, meshing);
  // What airfoils have a chord for, a domain of a file has the reference length for.
  if (!domain.in_farfield) domain.chord = request.conditions.reference_length;
  const double reynolds = request.conditions.reynolds * (domain.chord / request.conditions.reference_length);
  LayerOptions usual = layer_for_flow(request.flow.model, reynolds);
  usual.walls = walls_of_flow(domain.domain, request.flow);
  const LayerOptions layer = adjusted(usual, request.layers, reynolds);
  if (domain.in_farfield || request.layers.spacing_given)
    space_walls(domain.domain, request.layers.spacing.times(domain.chord), layer.walls);
  const LayerOptions in_place = in_units(layer, domain.chord);
  add_wake_line(request.layers, domain.chord, in_place, domain.domain);
  LayeredGenerateResult result = generate_layered(domain.domain, in_place, meshing.resolved_quality());
  require_whole(request.input, result.stopped);
  MeshInput input;
  input.frozen = result.mesh.freeze();
  input.layered = std::move(result.mesh);
  input.fits = std::move(domain.fits);
  return input;
}

constexpr std::initializer_list<const char*> layer_sizes = {
    "--y-plus",       "--first-height", "--growth",      "--layer-thickness", "--layer-count", "--wake",
    "--wall-spacing", "--te-spacing",   "--max-spacing", "--layer-wall",      "--wake-angle"};

constexpr const char* has_its_own = "given with a mesh, which has its own, expected with a shape";

}  // namespace

void refuse_given(const std::function<bool(const char*)>& given, std::initializer_list<const char*> options,
                  const char* why) {
  for (const char* option : options)
    if (given(option)) throw Error(ErrorCode::argument, option, why);
}

bool is_mesh_file(const std::string& name) {
  const std::string extension = std::filesystem::path(name).extension().string();
  return extension == ".vtkhdf" || extension == ".su2" || extension == ".msh" || extension == ".vtu";
}

std::optional<std::string> mesh_file(const DomainInputOptions& input,
                                     const std::function<bool(const char*)>& given) {
  const auto file = std::find_if(input.shapes.begin(), input.shapes.end(), is_mesh_file);
  if (file == input.shapes.end()) return std::nullopt;
  if (input.shapes.size() > 1 || !input.places.empty())
    throw Error(ErrorCode::argument, *file, "holds a mesh, expected it alone and without --place");
  refuse_given(
      given,
      {"--name", "--as-given", "--keep-coordinates", "--crossings", "--join", "--points", "--turning-share",
       "--farfield-radius", "--farfield-points", "--gradation", "--resolution", "--min-angle",
       "--max-gradation", "--min-edge", "--max-vertices", "--cst-degree", "--close-trailing-edge"},
      has_its_own);
  refuse_given(given, layer_sizes, has_its_own);
  return *file;
}

MeshInput flow_mesh(const FlowMeshRequest& request) {
  if (const auto file = mesh_file(request.input, request.given)) return read_any_mesh(*file);
  if (request.flow.model != FlowModel::euler) return layered_input(request);
  refuse_given(request.given, layer_sizes, "given without friction, expected --model laminar or sa");
  ShapesDomain domain = domain_of_flow(request, request.meshing);
  GenerateResult result = generate_input(request.input, domain.domain, request.meshing.resolved_quality());
  require_whole(request.input, result.stopped);
  MeshInput input;
  input.frozen = result.mesh.freeze();
  input.living = std::move(result.mesh);
  input.fits = std::move(domain.fits);
  return input;
}

}  // namespace remodel::app
