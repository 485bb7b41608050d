#include "remodel/mesh.h"

namespace remodel {

const char* name_of(Stopped stopped) {
  switch (stopped) {
    case Stopped::done:
      return "done";
    case Stopped::vertex_budget:
      return "vertex-budget";
    case Stopped::minimum_edge:
      return "minimum-edge";
    case Stopped::interrupted:
      return "interrupted";
  }
  return "unknown";
}

}  // namespace remodel
