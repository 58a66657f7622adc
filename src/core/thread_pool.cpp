#include "core/thread_pool.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <system_error>

#include "core/blas.hpp"
#include "core/parallel.hpp"

namespace eigentrail {

/// The work of one call of run. The pool's mutex guards what is not constant but for `next`, which is atomic.
struct ThreadPool::Batch {
  const std::size_t count;
  const std::function<void(std::size_t)>& work;
  std::size_t seats;  ///< how many helper threads may still join
  std::atomic<std::size_t> next{0};
  std::size_t inside = 0;  ///< helpers that have joined and not left
  std::exception_ptr failure = {};
  std::condition_variable empty = {};

  /// Works until no piece is left; the caller must not hold the pool's mutex. Returns the exception if a
  /// piece throws.
  std::exception_ptr take_pieces() {
    try {
      for (std::size_t i = next++; i < count; i = next++) work(i);
    } catch (...) {
      next = count;
      return std::current_exception();
    }
    return nullptr;
  }

  void note(std::exception_ptr of_thread) {
    if (!failure) failure = std::move(of_thread);
  }
};

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  work_or_end_.notify_all();
}

void ThreadPool::run(std::size_t count, std::size_t threads, const std::function<void(std::size_t)>& work) {
  const std::size_t helpers = count == 0 ? 0 : std::min(threads, count) - 1;
  Batch batch{count, work, helpers};
  if (helpers > 0) {
    const std::lock_guard lock(mutex_);
    make_helpers(helpers);
    open_.push_back(&batch);
  }
  for (std::size_t i = 0; i < helpers; ++i) work_or_end_.notify_one();
  std::exception_ptr failure = batch.take_pieces();
  if (helpers > 0) {
    std::unique_lock lock(mutex_);
    open_.remove(&batch);
    batch.note(std::move(failure));
    batch.empty.wait(lock, [&batch] { return batch.inside == 0; });
    failure = batch.failure;
  }
  if (failure) std::rethrow_exception(failure);
}

std::size_t ThreadPool::n_helpers() const {
  const std::lock_guard lock(mutex_);
  return helpers_.size();
}

/// If the system cannot start more threads, or has no memory for them, those that exist do the work.
void ThreadPool::make_helpers(std::size_t wanted) {
  try {
    while (helpers_.size() < wanted && blas_has_memory_for(helpers_.size() + 2))
      helpers_.emplace_back([this] { help(); });
  } catch (const std::system_error&) {
  }
}

void ThreadPool::help() {
  std::unique_lock lock(mutex_);
  while (true) {
    work_or_end_.wait(lock, [this] { return ends_ || !open_.empty(); });
    if (ends_) return;
    Batch& batch = *open_.front();
    ++batch.inside;
    if (--batch.seats == 0) open_.pop_front();
    lock.unlock();
    std::exception_ptr failure = batch.take_pieces();
    lock.lock();
    batch.note(std::move(failure));
    // The mutex must be held here: the batch is destroyed as soon as its owner sees that no helper is inside.
    if (--batch.inside == 0) batch.empty.notify_one();
  }
}

void in_parallel(std::size_t count, int jobs, const std::function<void(std::size_t)>& work) {
  // For the whole process: each step of a trace distributes work several times, and traces may run at the
  // same time.
  static ThreadPool pool;
  const unsigned int threads =
      jobs > 0 ? static_cast<unsigned int>(jobs) : std::thread::hardware_concurrency();
  pool.run(count, std::max(1U, threads), work);
}

}  // namespace eigentrail
