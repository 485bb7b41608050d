#pragma once

// Work that is cut into jobs, each a function of bytes, and crews that do it: threads of this process, or the
// ranks of an MPI program.

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
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
  // Returns the most urgent job that `worker` can begin. Nothing if all others wait for jobs in progress, or
  // if ended(). All threads of a process are one worker; worker 0 is the process that owns the jobs.
  virtual std::optional<Job> next(std::size_t worker) = 0;
  // Stores what a job gave. Does nothing for a job that is finished already. Throws Error.
  virtual void finish(std::size_t number, const std::string& result) = 0;
  // Returns a job that was begun but not finished, so that another worker does it.
  virtual void give_back(std::size_t number) = 0;
  // A worker is lost: what was given back before is all that it had. It may come back.
  virtual void lose(std::size_t worker) { static_cast<void>(worker); }
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

// Jobs that a run posts as it goes. Those of one key are done one after the other by one worker, so that it
// can keep what it has of the last one; who that is, the crew finds out: the first one that is free. Where
// that worker is lost, another takes its place, without what was kept.
class PostedJobs final : public CrewJobs {
 public:
  // Calls `run` on a thread of its own while the crew works on the jobs that it posts. Rethrows what `run` or
  // the crew has thrown, when both have ended.
  static void lead(Crew& crew, const CrewWork& work, const std::function<void(PostedJobs&)>& run);

  // Posts a job and waits for its result. Nothing where `cancelled`, which is asked meanwhile, returned true,
  // or the crew has failed. May be called from several threads at once, with a key of its own each.
  std::optional<std::string> result_of(std::uint64_t key, std::string work,
                                       const std::function<bool()>& cancelled);
  // A number that no other call has returned, from 1.
  std::uint64_t new_token();
  // True once the crew has thrown.
  bool failed() const;

  std::optional<Job> next(std::size_t worker) override;
  void finish(std::size_t number, const std::string& result) override;
  void give_back(std::size_t number) override;
  void lose(std::size_t worker) override;
  bool ended() const override;
  bool cancelled() const override;

 private:
  enum class State { waiting, out, done };
  struct Posted {
    std::uint64_t key = 0;
    std::string work;
    State state = State::waiting;
    std::string result{};
  };
  void end(bool failed);

  mutable std::mutex mutex_;
  std::condition_variable news_;
  std::map<std::size_t, Posted> posted_;
  std::map<std::uint64_t, std::size_t> worker_of_;  // by key
  std::size_t next_number_ = 0;
  std::uint64_t next_token_ = 0;
  bool cancelled_ = false, ended_ = false, failed_ = false;
};

}  // namespace remodel
