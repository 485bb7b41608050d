// Mesh.update(), Step and Trial.

#include <algorithm>
#include <optional>
#include <utility>

#include "living_layers.h"
#include "living_steps.h"
#include "remodel/import.h"
#include "remodel/io.h"
#include "remodel/shape_files.h"

namespace remodel::python {
namespace {

bool closed(const CstAirfoil& airfoil) {
  return airfoil.te_upper == airfoil.te_lower;
}

Loop with_curve(Loop loop, CstAirfoil airfoil) {
  std::optional<Curve> base;
  if (!closed(airfoil)) {
    base = {.name = loop.curves.front().name,
            .shape = Line{airfoil.at(1.0), airfoil.at(0.0)},
            .parameters = {0.0}};
    if (loop.curves.size() > 1) base->parameters = std::move(loop.curves[1].parameters);
  }
  loop.curves.resize(1);
  loop.curves.front().shape = std::move(airfoil);
  if (base) loop.curves.push_back(std::move(*base));
  return loop;
}

// The domain with an airfoil in the place of its own, or of the one called `boundary`.
Domain with_section(const Domain& now, const CstAirfoil& airfoil, const std::string& boundary) {
  Domain domain = now;
  const std::vector<std::size_t> loops = airfoil_loops(domain, boundary);
  if (loops.size() > 1)
    throw Error(ErrorCode::argument, "boundary",
                "not given, expected the name of one of " + std::to_string(loops.size()) + " airfoils");
  if (loops.size() == 1) {
    Loop& loop = domain.loops[loops[0]];
    loop = with_curve(std::move(loop), airfoil);
    return domain;
  }
  return with_airfoil(domain, find_airfoil(domain, boundary.empty() ? "airfoil" : boundary, "mesh"), airfoil);
}

// Elements of a coordinate file; 1 of other shapes.
std::size_t elements_in(const std::string& shape) {
  return is_coordinate_file(shape) && !is_whole_domain(shape) ? read_outlines(shape).elements.size() : 1;
}

// A file of several elements or of a whole domain. Elements have as many points and the far field that the
// mesh has, and the stations of its outlines of their names.
Domain domain_in_place(const Domain& now, const std::string& file) {
  ShapesDomain next = domain_of_shapes({{.shape = file}}, discretisation_of(now), {.farfield_stays = true});
  warn(next.warnings);
  if (next.in_farfield) {
    take_names(next.domain, now);
    for (Loop& loop : next.domain.loops) take_stations(loop, now);
  }
  return std::move(next.domain);
}

std::vector<std::uint64_t> values(const std::vector<VertexKey>& keys) {
  std::vector<std::uint64_t> result;
  for (const VertexKey key : keys) result.push_back(key.value());
  return result;
}

std::vector<std::uint32_t> values(const std::vector<TriangleId>& ids) {
  std::vector<std::uint32_t> result;
  for (const TriangleId id : ids) result.push_back(id.index);
  return result;
}

// The fate of each triangle after the step: 0 kept, 1 moved, 2 new.
py::array_t<std::uint8_t> fates_of(const StepRecord& step) {
  const Snapshot mesh = after_step(step);
  const std::vector<std::uint64_t> moved = values(step.changes.moved);
  const std::vector<std::uint32_t> born = values(step.changes.born);
  py::array_t<std::uint8_t> result(static_cast<py::ssize_t>(mesh->triangles.size()));
  std::uint8_t* fate = result.mutable_data();
  for (std::size_t i = 0; i < mesh->triangles.size(); ++i) {
    bool touched = false;
    for (const std::uint32_t v : mesh->triangles[i])
      touched = touched || std::binary_search(moved.begin(), moved.end(), mesh->vertex_keys[v]);
    fate[i] = std::binary_search(born.begin(), born.end(), mesh->triangle_ids[i]) ? 2 : touched ? 1 : 0;
  }
  return result;
}

void add_changes(py::module_& module) {
  py::class_<Changes, std::shared_ptr<Changes>>(
      module, "Changes",
      "The changes of one step: vertices by key (Mesh.vertex_keys), triangles by id (Mesh.triangle_ids); all "
      "ascend.")
      .def(record_pickle<Changes>())
      .def_property_readonly(
          "moved", [](const Changes& c) { return copied(values(c.moved)); },
          "Keys of vertices at another place.")
      .def_property_readonly(
          "inserted", [](const Changes& c) { return copied(values(c.inserted)); }, "Keys of new vertices.")
      .def_property_readonly(
          "removed", [](const Changes& c) { return copied(values(c.removed)); },
          "Keys of vertices that are gone.")
      .def_property_readonly(
          "born", [](const Changes& c) { return copied(values(c.born)); }, "Ids of new triangles.")
      .def_property_readonly(
          "gone", [](const Changes& c) { return copied(values(c.gone)); }, "Ids of triangles that are gone.")
      .def_property_readonly("same_connectivity", &Changes::same_connectivity,
                             "Whether the same triangles join the same vertices.");
}

void add_step(py::module_& module) {
  py::class_<StepRecord, std::shared_ptr<StepRecord>> type(module, "Step", "The record of one update.");
  const auto figure = [&](const char* name, auto member, const char* doc) {
    type.def_property_readonly(
        name, [member](const StepRecord& s) { return s.result.*member; }, doc);
  };
  figure("triangles_before", &RemodelResult::triangles_before, "Triangles before the step.");
  figure("triangles", &RemodelResult::triangles, "Triangles after it.");
  figure("preserved", &RemodelResult::preserved,
         "Old triangles that are still there, with unmoved vertices.");
  figure("connected", &RemodelResult::connected,
         "Old triangles whose three vertices are still joined, moved or not.");
  figure("moved", &RemodelResult::moved, "Vertices at another place: of the boundary, unless morphed.");
  figure("inserted", &RemodelResult::inserted, "New vertices.");
  figure("removed", &RemodelResult::removed, "Removed vertices.");
  figure("full_adjustment", &RemodelResult::full_adjustment,
         "Whether all boundary vertices moved in place: the connectivity is the same.");
  figure("flipped", &RemodelResult::flipped, "Edges flipped.");
  figure("morphed", &RemodelResult::morphed, "Whether the interior moved along with the boundary.");
  figure("refreshed", &RemodelResult::refreshed, "Whether the strategy generated the mesh afresh.");
  figure("regenerated", &RemodelResult::regenerated,
         "Whether the step could not be completed, and the mesh was generated afresh.");
  figure("abandoned", &RemodelResult::abandoned, "The same with regenerate=False: the mesh is as it was.");
  figure("held", &RemodelResult::held,
         "Whether the mesh is the morph of its reference (strategy='reference').");
  figure("reason", &RemodelResult::reason, "Why it was regenerated or abandoned.");
  type.def_property_readonly(
      "preserved_percent", [](const StepRecord& s) { return s.result.preserved_percent(); },
      "preserved over triangles_before.");
  type.def_property_readonly(
      "connectivity_percent", [](const StepRecord& s) { return s.result.connectivity_percent(); },
      "connected over triangles_before.");
  type.def_property_readonly("fates", &fates_of,
                             "Per triangle of `after`: 0 kept, 1 moved with a boundary vertex, 2 new.");
  add_step_parts(type);
  type.def("__repr__", [](const StepRecord& s) {
    return "Step(" + std::to_string(s.result.triangles) + " triangles, " +
           std::to_string(s.result.preserved_percent()) + " % preserved)";
  });
}

}  // namespace

Domain next_domain(const Domain& now, const py::object& shape, const std::string& boundary) {
  if (py::isinstance<Domain>(shape)) return shape.cast<Domain>();
  if (py::isinstance<CstAirfoil>(shape)) return with_section(now, shape.cast<CstAirfoil>(), boundary);
  const std::string name = name_of_shape(shape);
  const KeptPipes once;
  if (is_whole_domain(name) || elements_in(name) > 1) {
    if (!boundary.empty())
      throw Error(ErrorCode::argument, "boundary",
                  "given with '" + name + "', a whole domain, expected one airfoil to put there");
    return domain_in_place(now, name);
  }
  const CstFit fit = load_fit(name, 5);
  warn(fit.warnings);
  return with_section(now, fit.airfoil, boundary);
}

Domain next_domain(const Mesh& mesh, const py::object& shape, const std::string& boundary) {
  return next_domain(mesh.domain(), shape, boundary);
}

Domain next_domain(const LayeredMesh& mesh, const py::object& shape, const std::string& boundary) {
  const KeptPipes once;
  if (!py::isinstance<Domain>(shape) && !py::isinstance<CstAirfoil>(shape))
    if (const std::string name = name_of_shape(shape); elements_in(name) > 1)
      throw Error(ErrorCode::argument, "shape",
                  "found '" + name + "', a file of " + std::to_string(elements_in(name)) +
                      " elements, expected one section, or a Domain with stations for layers");
  return next_domain(mesh.domain(), shape, boundary);
}

RemodelOptions remodel_options(double distance, const std::string& method, const std::string& strategy,
                               bool regenerate, double delaunay_slack) {
  return {.distance = distance,
          .method = method_named(method),
          .strategy = strategy_named(strategy),
          .delaunay_slack_deg = delaunay_slack,
          .regenerate = regenerate};
}

void add_steps(py::module_& module) {
  add_changes(module);
  add_step(module);
  add_trial<LivingMesh>(module, "Trial", "The Step to the design that is tried.");
  auto type = py::reinterpret_borrow<py::class_<LivingMesh, LivingMeshPointer>>(module.attr("Mesh"));
  add_update(
      type,
      R"(Remodels the mesh, in place, to an Airfoil in the place of its own, or to another Domain; returns a Step.
shape may also be a name or a file, as for Domain(): one section takes the place of the mesh's own, as an Airfoil does;
a file of several elements, of a domain or of a planar graph is another Domain, whose elements have as many points as
the mesh's airfoils. A UserWarning says what was moved, joined, mended or left out.

boundary: the airfoil's name, where there are several. distance: D, the removal radius over the distance of old and
new vertices. strategy: 'renew' keeps long runs in order, 'chain' is the paper's method to the
letter, 'morph' moves the interior first, so that more triangles stay joined. 'reference' makes each design's mesh
the morph of one reference mesh, whatever designs came in between, as long as connectivity can be held; the angles
opposite an inner edge may then exceed 180 degrees by delaunay_slack, 0 to 60.
regenerate=False: a step that cannot be completed leaves the mesh as it was (Step.abandoned). record=True keeps
the arrays before and after in the Step. The mesh is valid before and after: what raises (GeometryError,
ArgumentError, KeyboardInterrupt) leaves it as it was, to the last bit.)");
}

}  // namespace remodel::python
