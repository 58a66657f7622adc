// Processes that mpirun has started, by MPI.
//
// The first process gives out pieces one by one to its own threads and, on request, to those of the others.
// All messages are sent and received by the thread that called MPI_Init_thread; threads that compute hand it
// their results. It looks for messages and sleeps in between, because the waiting functions of MPI keep a
// core busy that a computing thread could use.
#include <mpi.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>

#include "commands.hpp"
#include "core/archive.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "launcher.hpp"
#include "mpi_session.hpp"
#include "output.hpp"
#include "team.hpp"

namespace eigentrail::app {
namespace {

constexpr int leader = 0;
constexpr std::int64_t no_piece = -1;

enum Tag : int { request_tag = 1, answer_tag = 2, result_tag = 3 };

/// What a piece, or a process, has come to: 0, or the exit code of an error and its message.
struct Outcome {
  std::int64_t code = done;
  std::string bytes;  ///< the result or the message
};

/// The outcome of calling `work`, whose exceptions become codes and messages.
template <class Work>
Outcome outcome_of(Work&& work) {
  try {
    return {done, work()};
  } catch (const InputError& error) {
    return {bad_input, error.what()};
  } catch (const std::exception& error) {
    return {numbers_failed, error.what()};
  }
}

/// Sleeps between looks for messages: first briefly, then longer, because each look costs some 20 us of
/// computing time. The longest sleep is short compared with pieces that are worth sharing.
class Backoff {
 public:
  void sleep() {
    std::this_thread::sleep_for(pause_);
    pause_ = std::min(2 * pause_, longest);
  }
  void restart() { pause_ = shortest; }

 private:
  static constexpr std::chrono::microseconds shortest{50}, longest{3200};
  std::chrono::microseconds pause_ = shortest;
};

[[noreturn]] void throw_error(const Outcome& outcome) {
  if (outcome.code == bad_input) throw InputError(outcome.bytes);
  throw std::runtime_error(outcome.bytes);
}

/// Another process has failed, and the first one reports it.
struct OtherProcessFailed {
  int code;
};

void wait_for(MPI_Request request) {
  int complete = 0;
  Backoff backoff;
  while (MPI_Test(&request, &complete, MPI_STATUS_IGNORE), complete == 0) backoff.sleep();
}

/// Sends a message. Long ones wait until they are received, so MPI_Send would keep the core busy.
void send(const void* data, std::size_t size, int to, Tag tag) {
  MPI_Request request{};
  MPI_Isend(data, static_cast<int>(size), MPI_BYTE, to, tag, MPI_COMM_WORLD, &request);
  wait_for(request);
}

/// Sends bytes of one process to all. MPI counts with int, so long texts go in slices.
void broadcast(std::string& bytes, int from) {
  MPI_Request request{};
  std::uint64_t size = bytes.size();
  MPI_Ibcast(&size, 1, MPI_UINT64_T, from, MPI_COMM_WORLD, &request);
  wait_for(request);
  bytes.resize(size);
  constexpr std::uint64_t slice = 1U << 30U;
  for (std::uint64_t begin = 0; begin < size; begin += slice) {
    const int count = static_cast<int>(std::min(slice, size - begin));
    MPI_Ibcast(bytes.data() + begin, count, MPI_BYTE, from, MPI_COMM_WORLD, &request);
    wait_for(request);
  }
}

/// One number of every process.
std::vector<std::int64_t> all_numbers(std::int64_t own, int size) {
  std::vector<std::int64_t> numbers(static_cast<std::size_t>(size));
  MPI_Request request{};
  MPI_Iallgather(&own, 1, MPI_INT64_T, numbers.data(), 1, MPI_INT64_T, MPI_COMM_WORLD, &request);
  wait_for(request);
  return numbers;
}

void wait_for_all() {
  MPI_Request request{};
  MPI_Ibarrier(MPI_COMM_WORLD, &request);
  wait_for(request);
}

/// Threads of this process that compute pieces which the communicating thread hands to them.
class ComputingThreads {
 public:
  ComputingThreads(std::size_t count, const Piece& piece) : working_(count) {
    for (std::size_t i = 0; i < count; ++i) threads_.emplace_back([this, &piece] { work(piece); });
  }

  /// Number of threads that wait for a piece and have not been given one.
  std::size_t idle() const {
    const std::scoped_lock lock(mutex_);
    return waiting_ - inbox_.size();
  }
  void give(std::int64_t piece) {
    const std::scoped_lock lock(mutex_);
    inbox_.push_back(piece);
    arrived_.notify_one();
  }
  std::optional<std::pair<std::int64_t, Outcome>> finished() {
    const std::scoped_lock lock(mutex_);
    if (results_.empty()) return std::nullopt;
    auto result = std::move(results_.front());
    results_.pop_front();
    return result;
  }
  /// Whether all threads have been told that there is no further piece.
  bool ended() const {
    const std::scoped_lock lock(mutex_);
    return working_ == 0 && results_.empty();
  }

 private:
  void work(const Piece& piece) {
    while (true) {
      std::unique_lock lock(mutex_);
      ++waiting_;
      arrived_.wait(lock, [this] { return !inbox_.empty(); });
      --waiting_;
      const std::int64_t number = inbox_.front();
      inbox_.pop_front();
      if (number == no_piece) {
        --working_;
        return;
      }
      lock.unlock();
      Outcome outcome = outcome_of([&] { return piece(static_cast<std::size_t>(number)); });
      lock.lock();
      results_.emplace_back(number, std::move(outcome));
    }
  }

  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<std::int64_t> inbox_;
  std::deque<std::pair<std::int64_t, Outcome>> results_;
  std::size_t waiting_ = 0;
  std::size_t working_;
  std::vector<std::jthread> threads_;
};

/// This process among all.
class Processes {
 public:
  Processes() {
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
  }

  bool leads() const { return rank_ == leader; }
  int size() const { return size_; }

  /// Waits until all processes have come here, each with its outcome. If one has failed, the first process
  /// throws the error of the first that has; the others end silently. Does nothing after that.
  void agree(const Outcome& own) {
    if (failed_) return;
    const std::vector<std::int64_t> codes = all_numbers(own.code, size_);
    const auto failed =
        std::find_if(codes.begin(), codes.end(), [](std::int64_t code) { return code != done; });
    if (failed == codes.end()) return;
    failed_ = true;
    Outcome told{*failed, own.bytes};
    broadcast(told.bytes, static_cast<int>(failed - codes.begin()));
    if (!leads()) throw OtherProcessFailed{static_cast<int>(*failed)};
    throw_error(told);
  }

 private:
  int rank_ = 0, size_ = 1;
  bool failed_ = false;
};

class MpiWorkers final : public Workers {
 public:
  MpiWorkers(Processes& processes, std::size_t threads) : processes_(processes), threads_(threads) {
    processes.agree({});
    for (const std::int64_t of_process : all_numbers(static_cast<std::int64_t>(threads), processes.size()))
      all_threads_ += static_cast<std::size_t>(of_process);
  }

  std::vector<std::string> compute(const Pieces& pieces, const Finished& finished) override {
    processes_.agree({});
    std::vector<std::string> results(pieces.numbers.size());
    const Piece piece = [&pieces](std::size_t i) { return pieces.compute(pieces.numbers[i]); };
    Outcome outcome;
    if (processes_.leads()) {
      outcome = lead(piece, results, [&](std::size_t done, std::size_t i, const std::string& result) {
        finished(done, pieces.numbers[i], result);
      });
    } else {
      assist(piece);
    }
    processes_.agree(outcome);
    std::string all = processes_.leads() ? packed(results) : std::string();
    broadcast(all, leader);
    if (!processes_.leads()) unpack(all, results);
    return results;
  }
  std::size_t size() const override { return all_threads_; }

 private:
  Outcome lead(const Piece& piece, std::vector<std::string>& results, const Finished& finished) const;
  void assist(const Piece& piece) const;

  Processes& processes_;
  std::size_t threads_;
  std::size_t all_threads_ = 0;
};

Outcome MpiWorkers::lead(const Piece& piece, std::vector<std::string>& results,
                         const Finished& finished) const {
  ComputingThreads own(threads_, piece);
  Outcome failure;
  std::size_t next = 0, n_finished = 0;
  std::size_t others = all_threads_ - threads_;  // threads of other processes that have not been released
  const auto next_piece = [&] {
    const bool left = failure.code == done && next < results.size();
    return left ? static_cast<std::int64_t>(next++) : no_piece;
  };
  const auto take = [&](std::int64_t number, Outcome outcome) {
    if (outcome.code == done) {
      const auto i = static_cast<std::size_t>(number);
      results[i] = std::move(outcome.bytes);
      outcome = outcome_of([&] { return finished(++n_finished, i, results[i]), std::string(); });
    }
    if (outcome.code != done && failure.code == done) failure = std::move(outcome);
  };
  Backoff backoff;
  while (others > 0 || !own.ended()) {
    bool idle = true;
    for (std::size_t i = own.idle(); i > 0; --i) {
      idle = false;
      own.give(next_piece());
    }
    while (auto result = own.finished()) take(result->first, std::move(result->second));
    int there = 0;
    MPI_Status status{};
    while (MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status), there != 0) {
      idle = false;
      int size = 0;
      MPI_Get_count(&status, MPI_BYTE, &size);
      std::string bytes(static_cast<std::size_t>(size), '\0');
      MPI_Recv(bytes.data(), size, MPI_BYTE, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD,
               MPI_STATUS_IGNORE);
      if (status.MPI_TAG == request_tag) {
        const std::int64_t answer = next_piece();
        others -= answer == no_piece ? 1 : 0;
        send(&answer, sizeof answer, status.MPI_SOURCE, answer_tag);
      } else {
        std::int64_t number = no_piece;
        Outcome outcome;
        unpack(bytes, number, outcome.code, outcome.bytes);
        take(number, std::move(outcome));
      }
    }
    idle ? backoff.sleep() : backoff.restart();
  }
  return failure;
}

void MpiWorkers::assist(const Piece& piece) const {
  ComputingThreads own(threads_, piece);
  std::size_t requested = 0;
  Backoff backoff;
  while (!own.ended()) {
    bool idle = true;
    // Results first: the answer "no piece" then tells the first process that it has all results of a thread.
    while (auto result = own.finished()) {
      idle = false;
      const auto& [number, outcome] = *result;
      const std::string message = packed(number, outcome.code, outcome.bytes);
      send(message.data(), message.size(), leader, result_tag);
    }
    for (; requested < own.idle(); ++requested) {
      idle = false;
      send(nullptr, 0, leader, request_tag);
    }
    int there = 0;
    while (MPI_Iprobe(leader, answer_tag, MPI_COMM_WORLD, &there, MPI_STATUS_IGNORE), there != 0) {
      idle = false;
      std::int64_t answer = no_piece;
      MPI_Recv(&answer, sizeof answer, MPI_BYTE, leader, answer_tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
      own.give(answer);
      --requested;
    }
    idle ? backoff.sleep() : backoff.restart();
  }
}

/// Number of cores that this process has for itself: those it is bound to, or its share of the machine.
std::size_t own_cores() {
  cpu_set_t bound;
  const bool known = sched_getaffinity(0, sizeof bound, &bound) == 0;
  const int cores = known ? CPU_COUNT(&bound) : 1;
  const bool all = cores >= sysconf(_SC_NPROCESSORS_ONLN);
  MPI_Comm machine{};
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  int here = 1;
  MPI_Comm_size(machine, &here);
  MPI_Comm_free(&machine);
  return static_cast<std::size_t>(std::max(1, all ? cores / here : cores));
}

class MpiTeam final : public Team {
 public:
  std::unique_ptr<Workers> workers(int jobs) override {
    return std::make_unique<MpiWorkers>(processes_, jobs > 0 ? static_cast<std::size_t>(jobs) : cores_);
  }
  bool leads() const override { return processes_.leads(); }

  /// The command in this process. An error is printed before any process ends: launchers stop all others at
  /// the first one that ends with an error.
  int run(const std::function<int(Team&)>& command) {
    if (!leads() && (std::freopen("/dev/null", "w", stdout) == nullptr ||
                     std::freopen("/dev/null", "w", stderr) == nullptr))
      throw std::runtime_error("/dev/null: cannot be opened");
    int code = done;
    try {
      const Outcome own = outcome_of([&] { return code = command(*this), std::string(); });
      processes_.agree(own);
      if (own.code != done) throw_error(own);
    } catch (const OtherProcessFailed& failed) {
      code = failed.code;
    } catch (const std::exception& error) {
      code = report_error(error);
    }
    wait_for_all();
    return code;
  }

 private:
  MpiSession session_;
  Processes processes_;
  std::size_t cores_ = own_cores();
};

}  // namespace

int together(const std::function<int(Team&)>& command) {
  if (!launched()) return alone(command);
  MpiTeam team;
  return team.run(command);
}

}  // namespace eigentrail::app
