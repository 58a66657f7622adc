// Processes that mpirun has started, by MPI.
//
// The first process gives out pieces one by one: to its own threads, and to those of the others, each of
// which sends what it has computed and waits for the number of its next piece. Who waits for a message looks
// for it and sleeps in between, because the waiting functions of MPI keep a core busy that a computing thread
// could use.
#include <mpi.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "commands.hpp"
#include "core/archive.hpp"
#include "eigentrail/core/errors.hpp"
#include "launcher.hpp"
#include "mpi_session.hpp"
#include "output.hpp"
#include "team.hpp"

namespace eigentrail::app {
namespace {

constexpr int leader = 0;
constexpr std::int64_t no_piece = -1;

constexpr int report_tag = 0;
constexpr int answer_tag = 1;  ///< of the first thread of a process; those of the others follow

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
  } catch (const std::exception& error) {
    return {exit_code_of(error), error.what()};
  }
}

[[noreturn]] void throw_error(const Outcome& outcome) {
  if (outcome.code == bad_input) throw InputError(outcome.bytes);
  throw std::runtime_error(outcome.bytes);
}

/// Another process has failed, and the first one reports it.
struct OtherProcessFailed {
  int code;
};

/// Looks until there is what is waited for. The sleeps between are first brief, then longer, because each
/// look costs some 20 us of computing time; the longest is short compared with pieces that are worth sharing.
template <class Look>
void wait_until(Look look) {
  constexpr std::chrono::microseconds shortest{50}, longest{3200};
  for (auto pause = shortest; !look(); pause = std::min(2 * pause, longest))
    std::this_thread::sleep_for(pause);
}

void wait_for(MPI_Request request) {
  wait_until([&request] {
    int complete = 0;
    MPI_Test(&request, &complete, MPI_STATUS_IGNORE);
    return complete != 0;
  });
}

/// Sends a message. Long ones wait until they are received, so MPI_Send would keep the core busy.
void send(const std::string& bytes, int to, int tag) {
  MPI_Request request{};
  MPI_Isend(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, to, tag, MPI_COMM_WORLD, &request);
  wait_for(request);
}

/// The next message with this tag, and the process that has sent it.
std::pair<std::string, int> receive(int tag) {
  MPI_Status status{};
  wait_until([&] {
    int there = 0;
    MPI_Iprobe(MPI_ANY_SOURCE, tag, MPI_COMM_WORLD, &there, &status);
    return there != 0;
  });
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  MPI_Recv(bytes.data(), size, MPI_BYTE, status.MPI_SOURCE, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return {std::move(bytes), status.MPI_SOURCE};
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

/// Takes the outcome of a piece, or no piece, from a thread and gives it the number of its next one.
using Report = std::function<std::int64_t(std::int64_t piece, Outcome outcome)>;

/// Threads of this process that compute pieces until there are none, and report to report_of(thread).
template <class ReportOf>
std::vector<std::jthread> computing_threads(std::size_t count, const Pieces& pieces, ReportOf report_of) {
  std::vector<std::jthread> threads;
  for (std::size_t thread = 0; thread < count; ++thread) {
    threads.emplace_back([&pieces, report = Report(report_of(thread))] {
      std::int64_t piece = report(no_piece, {});
      while (piece != no_piece) {
        const std::size_t number = pieces.numbers[static_cast<std::size_t>(piece)];
        piece = report(piece, outcome_of([&] { return pieces.compute(number); }));
      }
    });
  }
  return threads;
}

/// This process among all.
class Processes : public MpiSession {
 public:
  Processes() : MpiSession(MPI_THREAD_MULTIPLE) {}

  /// Waits until all processes have come here, each with its outcome. If one has failed, the first process
  /// throws the error of the first that has; the others end silently. Does nothing after that.
  void agree(const Outcome& own) {
    if (failed_) return;
    const std::vector<std::int64_t> codes = all_numbers(own.code, size());
    const auto failed = std::ranges::find_if(codes, [](std::int64_t code) { return code != done; });
    if (failed == codes.end()) return;
    failed_ = true;
    Outcome told{*failed, own.bytes};
    broadcast(told.bytes, static_cast<int>(failed - codes.begin()));
    if (!leads()) throw OtherProcessFailed{static_cast<int>(*failed)};
    throw_error(told);
  }

 private:
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
    Outcome outcome;
    if (processes_.leads()) {
      outcome = lead(pieces, results, finished);
    } else {
      assist(pieces);
    }
    processes_.agree(outcome);
    std::string all = processes_.leads() ? packed(results) : std::string();
    broadcast(all, leader);
    if (!processes_.leads()) unpack(all, results);
    return results;
  }
  std::size_t size() const override { return all_threads_; }

 private:
  Outcome lead(const Pieces& pieces, std::vector<std::string>& results, const Finished& finished) const;
  void assist(const Pieces& pieces) const;

  Processes& processes_;
  std::size_t threads_;
  std::size_t all_threads_ = 0;
};

Outcome MpiWorkers::lead(const Pieces& pieces, std::vector<std::string>& results,
                         const Finished& finished) const {
  std::mutex mutex;
  Outcome failure;
  std::size_t next = 0, n_finished = 0;
  const Report report = [&](std::int64_t number, Outcome outcome) {
    const std::scoped_lock lock(mutex);
    if (number != no_piece && outcome.code == done) {
      const auto i = static_cast<std::size_t>(number);
      results[i] = std::move(outcome.bytes);
      outcome =
          outcome_of([&] { return finished(++n_finished, pieces.numbers[i], results[i]), std::string(); });
    }
    if (outcome.code != done && failure.code == done) failure = std::move(outcome);
    const bool left = failure.code == done && next < results.size();
    return left ? static_cast<std::int64_t>(next++) : no_piece;
  };
  {
    const auto own = computing_threads(threads_, pieces, [&](std::size_t) { return report; });
    for (std::size_t others = all_threads_ - threads_; others > 0;) {
      const auto [message, process] = receive(report_tag);
      std::int32_t thread = 0;
      std::int64_t number = no_piece;
      Outcome outcome;
      unpack(message, thread, number, outcome.code, outcome.bytes);
      const std::int64_t answer = report(number, std::move(outcome));
      if (answer == no_piece) --others;
      send(packed(answer), process, answer_tag + thread);
    }
  }
  return failure;
}

void MpiWorkers::assist(const Pieces& pieces) const {
  const auto own = computing_threads(threads_, pieces, [](std::size_t i) {
    return [thread = static_cast<std::int32_t>(i)](std::int64_t number, const Outcome& outcome) {
      send(packed(thread, number, outcome.code, outcome.bytes), leader, report_tag);
      std::int64_t answer = no_piece;
      unpack(receive(answer_tag + thread).first, answer);
      return answer;
    };
  });
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
