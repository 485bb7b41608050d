#pragma once

// The mesh that a flow is looked for on: one of a file, or a fresh one of shapes, with a layer where there is
// friction.

#include <functional>
#include <initializer_list>
#include <optional>
#include <string>

#include "domain_input.h"
#include "layer_options.h"
#include "mesh_input.h"
#include "meshing_options.h"
#include "remodel/flow.h"

namespace remodel::app {

struct FlowMeshRequest {
  DomainInputOptions input;
  MeshingOptions meshing;
  FlowOptions flow = {};                   // its model, and which boundaries are open
  FlowConditions conditions = {};          // of models with friction: the Reynolds number and its length
  LayerChoice layers;                      // its sizes, in place of those that the Reynolds number gives
  std::function<bool(const char*)> given;  // whether an option is on the command line
};

// Throws Error (argument) for the first of the options that is on the command line.
void refuse_given(const std::function<bool(const char*)>& given, std::initializer_list<const char*> options,
                  const char* why);
// Whether the name is that of a mesh file.
bool is_mesh_file(const std::string& name);
// The mesh file among the shapes, if there is one. Throws Error (argument) where it is not alone, and for
// options of meshes, of which it has its own.
std::optional<std::string> mesh_file(const DomainInputOptions& input,
                                     const std::function<bool(const char*)>& given);
// Throws Error as the readers and generators do, and where a limit ends the generation.
MeshInput flow_mesh(const FlowMeshRequest& request);

}  // namespace remodel::app
