#pragma once

// Distributes jobs over the ranks of an MPI program. Rank 0 owns them and hands them out; the other ranks ask
// for jobs and send results back. A rank that is silent for too long counts as lost and its job
// is given to another. Should it answer after all, results that are already stored are not replaced.

#include <memory>

#include "command.h"
#include "remodel/crew.h"

namespace CLI {
class App;
}

namespace remodel::app {

struct RanksOptions {
  double timeout = 60.0;  // seconds of silence
};

class Ranks {
 public:
  virtual ~Ranks() = default;  // on rank 0 it ends the others
  // For rank 0: a crew of all ranks, in which rank 0 works too, on the given number of threads.
  virtual std::unique_ptr<Crew> crew(std::size_t threads) = 0;
  // For all other ranks: does jobs until rank 0 has no more. Returns false if rank 0 was lost.
  virtual bool serve(const CrewWork& work) = 0;
};

// Replaces the process by remodel-mpi, the same program built with MPI, which is installed beside remodel.
// Returns if there is no such program. In remodel-mpi itself it does nothing.
void go_on_with_mpi(char** argv);

// --rank-timeout
void add_rank_option(CLI::App& app, RanksOptions& options);

// Calls `lead` with a crew: threads of this process (0: as many as cores), or in an MPI program all ranks,
// with so many threads on rank 0 (0: one). The other ranks do `work` until rank 0 has no more.
Status with_crew(std::size_t threads, const RanksOptions& options, const CrewWork& work,
                 const std::function<Status(Crew&)>& lead);

// Under mpirun it calls `run` on rank 0, with jobs that all ranks do the work of, one at a time; otherwise
// with null. `work` makes that on each rank, before MPI begins.
Status with_posted_jobs(const RanksOptions& options, const std::function<CrewWork()>& work,
                        const std::function<Status(PostedJobs*)>& run);

// Initialises MPI. Throws Error (argument) in the program without MPI.
std::unique_ptr<Ranks> begin_ranks(const RanksOptions& options);

}  // namespace remodel::app
