// The program built without MPI.

#include "remodel/error.h"
#include "study_ranks.h"

namespace remodel::app {

std::unique_ptr<StudyRanks> begin_ranks(const RanksOptions&) {
  throw Error(ErrorCode::argument, "study",
              "found " + std::to_string(launched_ranks()) +
                  " MPI ranks, expected one: this program was built without MPI");
}

}  // namespace remodel::app
