#pragma once

// A study's jobs done by the ranks of an MPI program. Rank 0 alone has the study and hands jobs out; the
// others ask for jobs and send rows back. A rank that is silent for too long is taken for lost: its job is
// given to another, and should it speak again, rows that are there already are left as they are.

#include <memory>

#include "remodel/study.h"

namespace remodel::app {

// The rank of this process, as mpirun tells it, and 0 outside of an MPI program; how many there are, or 1.
int launched_rank();
int launched_local_rank();  // on its host
int launched_ranks();

struct RanksOptions {
  double timeout = 60.0;  // seconds of silence
};

class StudyRanks {
 public:
  virtual ~StudyRanks() = default;  // rank 0: ends the others
  // Of rank 0, which works itself too, by threads. Does nothing but that where it is alone.
  virtual std::unique_ptr<StudyCrew> crew(std::size_t threads) = 0;
  // All other ranks: does jobs until rank 0 has no more. False if rank 0 has been lost.
  virtual bool serve() = 0;
};

// Begins MPI. Throws Error (argument) in a program of several ranks that was built without MPI.
std::unique_ptr<StudyRanks> begin_ranks(const RanksOptions& options);

}  // namespace remodel::app
