// The part of ranks.h in the program without MPI: it becomes remodel-mpi.

#include <unistd.h>

#include <filesystem>

#include "launched.h"
#include "ranks.h"
#include "remodel/error.h"

namespace remodel::app {

void go_on_with_mpi(char** argv) {
  std::error_code ignored;
  const auto here = std::filesystem::read_symlink("/proc/self/exe", ignored);
  const std::string program = here.parent_path() / "remodel-mpi";
  ::execv(program.c_str(), argv);  // returns only on failure
}

std::unique_ptr<Ranks> begin_ranks(const RanksOptions&) {
  throw Error(
      ErrorCode::argument, "mpirun",
      "found " + std::to_string(launched_ranks()) +
          " MPI ranks, expected one: this program was built without MPI, and no remodel-mpi is beside it");
}

}  // namespace remodel::app
