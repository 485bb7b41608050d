#include "launched.h"

#include <cstdlib>

namespace remodel::app {
namespace {

int number_in(const char* variable, int otherwise) {
  const char* text = std::getenv(variable);
  return text ? std::atoi(text) : otherwise;
}

}  // namespace

int launched_rank() {
  return number_in("OMPI_COMM_WORLD_RANK", number_in("PMI_RANK", 0));
}

int launched_local_rank() {
  return number_in("OMPI_COMM_WORLD_LOCAL_RANK",
                   number_in("MPI_LOCALRANKID", number_in("SLURM_LOCALID", launched_rank())));
}

int launched_ranks() {
  return number_in("OMPI_COMM_WORLD_SIZE", number_in("PMI_SIZE", 1));
}

}  // namespace remodel::app
