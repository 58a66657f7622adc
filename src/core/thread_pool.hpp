// Threads that are made once and wait for work.
//
// oneTBB would do; but its library is not compiled for the thread sanitizer, which then takes its own
// hand-over of tasks for races. Told to overlook those it would overlook ours, too.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <list>
#include <mutex>
#include <thread>
#include <vector>

namespace eigentrail {

/// Shares pieces of work among the thread that asks for it and helpers. Who asks works, too, and waits only
/// for helpers that have begun: work may ask for more work, at worst it does it alone.
class ThreadPool {
 public:
  ThreadPool() = default;
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  /// Calls work(0) ... work(count - 1), in no particular order, by at most `threads` >= 1 threads at once.
  /// After an exception nothing new is begun; it is rethrown when all have ended. May be called by many
  /// threads.
  void run(std::size_t count, std::size_t threads, const std::function<void(std::size_t)>& work);

  /// Helpers made so far: as many as were wanted at once.
  std::size_t n_helpers() const;

 private:
  class Batch;

  void make_helpers(std::size_t wanted);
  void help();

  mutable std::mutex mutex_;
  std::condition_variable work_or_end_;
  std::list<Batch*> open_;  ///< those that helpers may join, oldest first
  bool ends_ = false;
  std::vector<std::jthread> helpers_;
};

}  // namespace eigentrail
