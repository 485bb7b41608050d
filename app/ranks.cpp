// The ranks of an MPI program as a crew. All sends and receives are non-blocking, so that a rank that
// dies in the middle of a message blocks no other.
//
//   worker -> rank 0   ask     nothing                  a request for a job
//                      rows    job number, rows         a finished job
//                      failed  text                     the message of an exception: our own bug
//                      beat    nothing                  a heartbeat, once a second
//                      bye     nothing                  the answer to stop
//   rank 0 -> worker   job     job number, work
//                      beat    nothing                  the answer to a beat
//                      stop    nothing                  no more jobs; the current one is dropped
//                      leave   1 if a rank was lost     the answer to bye

#define OMPI_SKIP_MPICXX 1
#include "ranks.h"

#include <mpi.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <list>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "interrupt.h"
#include "launched.h"
#include "timing.h"

namespace remodel::app {
namespace {

enum Tag { ask_tag = 1, rows_tag, failed_tag, beat_tag, bye_tag, job_tag, stop_tag, leave_tag };

constexpr double beat_pause = 1.0;                  // seconds
constexpr double longest_farewell = 10.0;           // seconds
constexpr std::chrono::milliseconds idle_pause{1};  // MPI's own waits are busy loops

std::string numbered(std::size_t number, const std::string& bytes) {
  std::string text(sizeof number, '\0');
  std::memcpy(text.data(), &number, sizeof number);
  return text + bytes;
}

std::pair<std::size_t, std::string> parts_of(const std::string& text) {
  std::size_t number = 0;
  if (text.size() < sizeof number) throw std::runtime_error("an MPI message is too short");
  std::memcpy(&number, text.data(), sizeof number);
  return {number, text.substr(sizeof number)};
}

struct Message {
  int rank = 0;
  int tag = 0;
  std::string bytes;
};

// Sends and receives messages; both may be in progress at any time.
class Mail {
 public:
  void send(int rank, Tag tag, std::string bytes = {}) {
    Transfer& transfer = sending_.emplace_back(Transfer{{rank, tag, std::move(bytes)}, MPI_REQUEST_NULL});
    std::string& text = transfer.message.bytes;
    MPI_Isend(text.data(), static_cast<int>(text.size()), MPI_BYTE, rank, tag, MPI_COMM_WORLD,
              &transfer.request);
  }

  // Returns the messages that have arrived completely; those of each rank in the order they were sent.
  std::vector<Message> received() {
    begin_receiving();
    all_sent();
    std::vector<Message> messages;
    std::set<int> behind;  // ranks with an incomplete message
    std::erase_if(receiving_, [&](Transfer& transfer) {
      if (!finished(transfer)) behind.insert(transfer.message.rank);
      if (behind.contains(transfer.message.rank)) return false;
      messages.push_back(std::move(transfer.message));
      return true;
    });
    return messages;
  }
  bool all_sent() {
    std::erase_if(sending_, finished);
    return sending_.empty();
  }

 private:
  struct Transfer {
    Message message;
    MPI_Request request;
  };

  void begin_receiving() {
    while (true) {
      int found = 0, size = 0;
      MPI_Message handle;
      MPI_Status status;
      if (MPI_Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &found, &handle, &status) != MPI_SUCCESS ||
          found == 0)
        return;
      MPI_Get_count(&status, MPI_BYTE, &size);
      Transfer& transfer = receiving_.emplace_back(
          Transfer{{status.MPI_SOURCE, status.MPI_TAG, std::string(static_cast<std::size_t>(size), '\0')},
                   MPI_REQUEST_NULL});
      MPI_Imrecv(transfer.message.bytes.data(), size, MPI_BYTE, &handle, &transfer.request);
    }
  }
  // A failed transfer is finished too: the protocol repeats what the other side waits for.
  static bool finished(Transfer& transfer) {
    int done = 0;
    return MPI_Test(&transfer.request, &done, MPI_STATUS_IGNORE) != MPI_SUCCESS || done != 0;
  }

  std::list<Transfer> sending_, receiving_;
};

// The state of another rank as rank 0 knows it.
struct Peer {
  std::optional<std::size_t> job;
  bool asks = false;
  bool lost = false;
  double heard_at = 0.0;
};

// Forwards to a crew's jobs until it is stopped; then there are no more.
class StoppableJobs : public CrewJobs {
 public:
  explicit StoppableJobs(CrewJobs& jobs) : jobs_(jobs) {}
  void stop() { stopped_ = true; }
  std::optional<Job> next(std::size_t worker) override {
    return stopped_ ? std::nullopt : jobs_.next(worker);
  }
  void finish(std::size_t number, const std::string& rows) override { jobs_.finish(number, rows); }
  void give_back(std::size_t number) override { jobs_.give_back(number); }
  void lose(std::size_t worker) override { jobs_.lose(worker); }
  bool ended() const override { return stopped_ || jobs_.ended(); }
  bool cancelled() const override { return stopped_ || jobs_.cancelled(); }

 private:
  CrewJobs& jobs_;
  std::atomic<bool> stopped_ = false;
};

class MpiRanks;

// The crew of rank 0: hands jobs to the other ranks while its own threads work too.
class RankCrew : public Crew {
 public:
  RankCrew(MpiRanks& ranks, std::size_t threads) : ranks_(ranks), threads_(threads) {}
  void work(CrewJobs& jobs, const CrewWork& work) override;

 private:
  void serve(CrewJobs& jobs);
  void take(const Message& message, CrewJobs& jobs);
  void hand_out(CrewJobs& jobs);
  void look_for_lost(CrewJobs& jobs);

  MpiRanks& ranks_;
  std::size_t threads_;
  std::vector<Peer> peers_;
  Stopwatch watch_;
};

class MpiRanks : public Ranks {
 public:
  explicit MpiRanks(const RanksOptions& options) : options_(options) {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    // The sequential MUMPS brings functions of the same names, which know one rank: app/CMakeLists.txt links
    // it behind.
    if (rank_ != launched_rank() || size_ != launched_ranks())
      throw std::logic_error("MPI's own functions are not those that this program has found");
  }
  ~MpiRanks() override;

  std::unique_ptr<Crew> crew(std::size_t threads) override {
    if (size_ == 1) return std::make_unique<ThreadCrew>(threads);
    return std::make_unique<RankCrew>(*this, threads);
  }
  bool serve(const CrewWork& work) override;

 private:
  friend class RankCrew;
  void take(const Message& message);
  void do_job(const std::string& bytes, const CrewWork& work);
  bool job_cancelled();
  void look_around();
  // True if rank 0 has been silent for the timeout.
  bool alone() const { return heard_at_ + options_.timeout < watch_.seconds(); }
  void end_others();

  RanksOptions options_;
  int rank_ = 0, size_ = 1;
  Mail mail_;
  std::vector<bool> lost_;  // on rank 0 by rank; elsewhere one element: whether any rank is lost
  // The following members are used by all ranks but 0.
  Stopwatch watch_;
  double heard_at_ = 0.0, beat_at_ = 0.0, looked_at_ = 0.0;
  bool stopped_ = false, left_ = false;
  std::vector<std::string> jobs_;
};

void RankCrew::work(CrewJobs& jobs, const CrewWork& work) {
  peers_.resize(static_cast<std::size_t>(ranks_.size_));
  StoppableJobs stoppable(jobs);
  std::exception_ptr failure, failure_of_own;
  {
    std::jthread own([&] {
      try {
        ThreadCrew(threads_).work(stoppable, work);
      } catch (...) {
        failure_of_own = std::current_exception();
      }
      stoppable.stop();
    });
    try {
      while (!stoppable.ended()) serve(stoppable);
    } catch (...) {
      failure = std::current_exception();
    }
    stoppable.stop();
  }
  ranks_.lost_ = std::vector<bool>(peers_.size());
  for (std::size_t rank = 0; rank < peers_.size(); ++rank) ranks_.lost_[rank] = peers_[rank].lost;
  if (failure_of_own) std::rethrow_exception(failure_of_own);
  if (failure) std::rethrow_exception(failure);
}

void RankCrew::serve(CrewJobs& jobs) {
  const std::vector<Message> messages = ranks_.mail_.received();
  for (const Message& message : messages) take(message, jobs);
  hand_out(jobs);
  look_for_lost(jobs);
  if (messages.empty()) std::this_thread::sleep_for(idle_pause);
}

void RankCrew::take(const Message& message, CrewJobs& jobs) {
  Peer& peer = peers_[static_cast<std::size_t>(message.rank)];
  peer.heard_at = watch_.seconds();
  peer.lost = false;
  switch (message.tag) {
    case ask_tag:
      peer.asks = true;
      break;
    case rows_tag: {
      const auto [number, rows] = parts_of(message.bytes);
      jobs.finish(number, rows);
      peer.job.reset();
      break;
    }
    case failed_tag:
      throw std::runtime_error("rank " + std::to_string(message.rank) + ": " + message.bytes);
    default:
      ranks_.mail_.send(message.rank, beat_tag);
  }
}

void RankCrew::hand_out(CrewJobs& jobs) {
  for (std::size_t rank = 1; rank < peers_.size(); ++rank) {
    Peer& peer = peers_[rank];
    if (!peer.asks || peer.lost) continue;
    std::optional<CrewJobs::Job> job = jobs.next(rank);
    if (!job) continue;
    peer.asks = false;
    peer.job = job->number;
    ranks_.mail_.send(static_cast<int>(rank), job_tag, numbered(job->number, job->work));
  }
}

void RankCrew::look_for_lost(CrewJobs& jobs) {
  for (std::size_t rank = 1; rank < peers_.size(); ++rank) {
    Peer& peer = peers_[rank];
    const double silence = watch_.seconds() - peer.heard_at;
    if (!peer.lost && silence > ranks_.options_.timeout) {
      peer.lost = true;
      std::fprintf(stderr, "remodel: rank %zu has been silent for %.0f s: its job is done again\n", rank,
                   silence);
      if (peer.job) jobs.give_back(*peer.job);
      peer.job.reset();
      jobs.lose(rank);
    }
  }
}

MpiRanks::~MpiRanks() {
  if (rank_ == 0) end_others();
  // MPI_Finalize() would wait for a lost rank.
  if (std::find(lost_.begin(), lost_.end(), true) == lost_.end()) MPI_Finalize();
}

void MpiRanks::end_others() {
  const auto pause = [] { std::this_thread::sleep_for(idle_pause); };
  lost_.resize(static_cast<std::size_t>(size_));
  std::set<int> awaited;
  for (int rank = 1; rank < size_; ++rank) {
    if (lost_[static_cast<std::size_t>(rank)]) continue;
    mail_.send(rank, stop_tag);
    awaited.insert(rank);
  }
  const Stopwatch watch;
  while (!awaited.empty() && watch.seconds() < std::min(options_.timeout, longest_farewell)) {
    for (const Message& message : mail_.received())
      if (message.tag == bye_tag) awaited.erase(message.rank);
    pause();
  }
  for (const int rank : awaited) lost_[static_cast<std::size_t>(rank)] = true;
  const bool any = std::find(lost_.begin(), lost_.end(), true) != lost_.end();
  for (int rank = 1; rank < size_; ++rank)
    if (!lost_[static_cast<std::size_t>(rank)]) mail_.send(rank, leave_tag, any ? "1" : "0");
  const Stopwatch leaving;
  while (!mail_.all_sent() && leaving.seconds() < 1.0) pause();
}

bool MpiRanks::serve(const CrewWork& work) {
  const InterruptFlag interrupt;  // mpirun passes signals to all ranks; only rank 0 acts on them
  mail_.send(0, ask_tag);
  while (!stopped_ && !alone()) {
    look_around();
    if (jobs_.empty()) {
      std::this_thread::sleep_for(idle_pause);
      continue;
    }
    const std::string job = std::move(jobs_.back());
    jobs_.pop_back();
    do_job(job, work);
  }
  mail_.send(0, bye_tag);
  while (!left_ && !alone()) {
    look_around();
    std::this_thread::sleep_for(idle_pause);
  }
  if (!left_) lost_ = {true};
  return left_;
}

// Sends a heartbeat if one is due, and handles the messages that have arrived.
void MpiRanks::look_around() {
  if (watch_.seconds() > beat_at_ + beat_pause) {
    beat_at_ = watch_.seconds();
    mail_.send(0, beat_tag);
  }
  for (const Message& message : mail_.received()) take(message);
}

void MpiRanks::take(const Message& message) {
  heard_at_ = watch_.seconds();
  if (message.tag == job_tag) jobs_.push_back(message.bytes);
  if (message.tag == stop_tag) stopped_ = true;
  if (message.tag == leave_tag) {
    left_ = true;
    lost_ = {message.bytes == "1"};
  }
}

bool MpiRanks::job_cancelled() {
  if (watch_.seconds() < looked_at_ + 0.01) return stopped_;
  looked_at_ = watch_.seconds();
  look_around();
  return stopped_ || alone();
}

void MpiRanks::do_job(const std::string& bytes, const CrewWork& work) {
  const auto [number, job] = parts_of(bytes);
  try {
    const std::optional<std::string> rows = work(job, [this] { return job_cancelled(); });
    if (rows) mail_.send(0, rows_tag, numbered(number, *rows));
  } catch (const std::exception& problem) {
    mail_.send(0, failed_tag, problem.what());
  }
  mail_.send(0, ask_tag);
}

}  // namespace

void go_on_with_mpi(char**) {}

std::unique_ptr<Ranks> begin_ranks(const RanksOptions& options) {
  return std::make_unique<MpiRanks>(options);
}

}  // namespace remodel::app
