// Triangle's .poly files; the domains of those that are accepted are meshed on a small budget.

#include "fuzz.h"
#include "mesh/mesh_data.h"
#include "remodel/generate.h"
#include "remodel/io.h"

using namespace remodel;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const PlanarGraph graph = parse_poly(fuzz::text_of(data, size), "input");
    if (graph.segments.size() > 500) return 0;  // crossings grow with the square
    PlanarFindings findings;
    const Domain domain = planar_domain(graph, "input", Crossings::insert, &findings);
    try {
      planar_domain(graph, "input", Crossings::refuse);
      fuzz::require(findings.crossings == 0, "crossings are not refused");
    } catch (const Error&) {
      fuzz::require(findings.crossings > 0, "a graph without crossings is refused");
    }
    validate(domain);
    fuzz::require(domain_from_json(domain_to_json(domain), "again") == domain, "JSON is not exact");
    const GenerateResult result = generate(domain, {.max_vertices = 3000});
    fuzz::require_empty(result.mesh.data().triangulation.check());
    fuzz::require_empty(check_boundary(result.mesh.data()));
    if (result.stopped == Stopped::done) fuzz::require_empty(result.mesh.quick_check());
    fuzz::require(Mesh::restore(result.mesh.state(), "state").state() == result.mesh.state(),
                  "a restored mesh is another one");
  } catch (const Error&) {
    ++fuzz::refusals;
  }
  return 0;
}
