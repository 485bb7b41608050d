#include <algorithm>
#include <thread>

#include "arguments.h"
#include "launched.h"
#include "ranks.h"

namespace remodel::app {

void add_rank_option(CLI::App& app, RanksOptions& options) {
  add_real(app,
           {"--rank-timeout", "SECONDS", "60", "Silence after which an MPI rank counts as lost: 1 to 86400"},
           {.low = 1.0, .high = 86400.0}, options.timeout);
}

Status with_crew(std::size_t threads, const RanksOptions& options, const CrewWork& work,
                 const std::function<Status(Crew&)>& lead) {
  if (launched_ranks() == 1) {
    ThreadCrew crew(threads != 0 ? threads : std::max(1U, std::thread::hardware_concurrency()));
    return lead(crew);
  }
  const std::unique_ptr<Ranks> ranks = begin_ranks(options);
  if (launched_rank() > 0) return ranks->serve(work) ? Status::done : Status::limit;
  const std::unique_ptr<Crew> crew = ranks->crew(std::max<std::size_t>(1, threads));
  return lead(*crew);
}

Status with_posted_jobs(const RanksOptions& options, const std::function<CrewWork()>& work,
                        const std::function<Status(PostedJobs*)>& run) {
  if (launched_ranks() == 1) return run(nullptr);
  const CrewWork made = work();
  return with_crew(1, options, made, [&](Crew& crew) {
    Status status = Status::done;
    PostedJobs::lead(crew, made, [&](PostedJobs& jobs) { status = run(&jobs); });
    return status;
  });
}

}  // namespace remodel::app
