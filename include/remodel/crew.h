#pragma once

// Work that is cut into jobs, each a function of bytes, and crews that do it: threads of this process, or the
// ranks of an MPI program.

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

namespace remodel {

// Does one job, from bytes to bytes. `cancelled` is asked often; the result is empty if it returned true.
// Called from several threads at once. Throws Error (format) for bytes of another version.
using CrewWork = std::function<std::optional<std::string>(const std::string& work,
                                                          const std::function<bool()>& cancelled)>;

// The jobs that a crew works on. All members may be called from any thread.
class CrewJobs {
 public:
  struct Job {
    std::size_t number = 0;
    std::string work;  // bytes for CrewWork
  };
  virtual ~CrewJobs() = default;
  // Returns the most urgent job that can be begun. Nothing if all others wait for jobs in progress, or if
  // ended().
  virtual std::optional<Job> next() = 0;
  // Stores what a job gave. Does nothing for a job that is finished already. Throws Error.
  virtual void finish(std::size_t number, const std::string& result) = 0;
  // Returns a job that was begun but not finished, so that another worker does it.
  virtual void give_back(std::size_t number) = 0;
  // True once all jobs are finished or the work is cancelled.
  virtual bool ended() const = 0;
  virtual bool cancelled() const = 0;
};

class Crew {
 public:
  virtual ~Crew() = default;
  // Returns when jobs.ended(). Rethrows the exception of a job or of finish() after all workers have stopped.
  virtual void work(CrewJobs& jobs, const CrewWork& work) = 0;
};

// A crew of threads of this process, at least 1.
class ThreadCrew final : public Crew {
 public:
  explicit ThreadCrew(std::size_t threads) : threads_(threads) {}
  void work(CrewJobs& jobs, const CrewWork& work) override;

 private:
  std::size_t threads_;
};

}  // namespace remodel
