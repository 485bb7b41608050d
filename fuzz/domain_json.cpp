// Domains as JSON; those that are valid are meshed on a small budget.

#include "fuzz.h"
#include "mesh/mesh_data.h"
#include "remodel/generate.h"
#include "remodel/join.h"

using namespace remodel;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const Domain domain = domain_from_json(fuzz::text_of(data, size), "input");
    fuzz::require(domain_from_json(domain_to_json(domain), "again") == domain, "JSON is not exact");
    try {
      Domain joined = domain;
      join_ends(joined, "input");
    } catch (const Error&) {
      ++fuzz::refusals;
    }
    validate(domain);
    const GenerateResult result = generate(domain, {.max_vertices = 3000});
    fuzz::require_empty(result.mesh.data().triangulation.check());
    fuzz::require_empty(check_boundary(result.mesh.data()));
    if (result.stopped == Stopped::done && result.exempt_triangles == 0)
      fuzz::require_empty(result.mesh.quick_check());
  } catch (const Error&) {
    ++fuzz::refusals;
  }
  return 0;
}
