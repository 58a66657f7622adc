#include "core/parallel.hpp"

#include <algorithm>
#include <thread>

#include "core/thread_pool.hpp"

namespace eigentrail {
namespace {

/// One pool for the whole process, created on first use. Each step of a trace distributes work several times,
/// and traces may run at the same time.
ThreadPool& pool() {
  static ThreadPool pool;
  return pool;
}

}  // namespace

void in_parallel(std::size_t count, int jobs, const std::function<void(std::size_t)>& work) {
  if (jobs == 1 || count <= 1) {  // no pool needed
    for (std::size_t i = 0; i < count; ++i) work(i);
    return;
  }
  const unsigned int threads =
      jobs > 0 ? static_cast<unsigned int>(jobs) : std::thread::hardware_concurrency();
  pool().run(count, std::max(1U, threads), work);
}

}  // namespace eigentrail
