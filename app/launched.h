#pragma once

// A process' place in an MPI program, from the environment variables that mpirun sets; needs no MPI.

namespace remodel::app {

// The rank of this process; 0 outside of an MPI program.
int launched_rank();
int launched_local_rank();  // its rank among those of its host
int launched_ranks();       // the number of ranks; 1 outside of an MPI program

}  // namespace remodel::app
