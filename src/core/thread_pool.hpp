// Threads that are created once and wait for work.
//
// Intel's oneTBB could do this, but its library is not compiled for the thread sanitizer, which then reports
// its internal transfer of tasks as data races. Suppressing these reports would also hide races of
// eigentrail.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <list>
#include <mutex>
#include <thread>
#include <vector>

namespace eigentrail {

/// Distributes pieces of work between the calling thread and helper threads. The caller works as well, and
/// waits only for helpers that have begun. Work may therefore request further work without a deadlock: in the
/// worst case the caller does all of it.
class ThreadPool {
 public:
  ThreadPool() = default;
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  /// Calls work(0) ... work(count - 1) in no particular order, on at most `threads` >= 1 threads at once.
  /// After an exception no new call begins; the exception is rethrown when all running calls have ended. May
  /// be called from several threads at once.
  void run(std::size_t count, std::size_t threads, const std::function<void(std::size_t)>& work);

  /// Number of helper threads created so far.
  std::size_t n_helpers() const;

 private:
  struct Batch;

  void make_helpers(std::size_t wanted);
  void help();

  mutable std::mutex mutex_;
  std::condition_variable work_or_end_;
  std::list<Batch*> open_;  ///< batches that helpers may join, oldest first
  bool ends_ = false;
  std::vector<std::jthread> helpers_;
};

}  // namespace eigentrail
