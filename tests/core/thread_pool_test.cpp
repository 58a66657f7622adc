#include "core/thread_pool.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <latch>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "core/parallel.hpp"

namespace eigentrail::test::thread_pool_test {
namespace {

/// How often each of `count` pieces was done.
std::vector<int> times_done(ThreadPool& pool, std::size_t count, std::size_t threads) {
  std::vector<int> times(count);
  pool.run(count, threads, [&](std::size_t i) { ++times[i]; });
  return times;
}

TEST(ThreadPool, DoesEachPieceOnce) {
  ThreadPool pool;
  for (const std::size_t threads : {1, 2, 3, 8}) {
    EXPECT_EQ(times_done(pool, 1000, threads), std::vector<int>(1000, 1)) << threads << " threads";
  }
}

TEST(ThreadPool, DoesNothingWhenThereIsNothingToDo) {
  ThreadPool pool;
  pool.run(0, 4, [](std::size_t) { FAIL() << "called without work"; });
  EXPECT_EQ(pool.n_helpers(), 0U);
}

TEST(ThreadPool, MakesNoMoreThreadsThanPiecesAndKeepsThem) {
  ThreadPool pool;
  EXPECT_EQ(times_done(pool, 3, 64), std::vector<int>(3, 1));
  EXPECT_EQ(pool.n_helpers(), 2U) << "the calling thread is the third";
  for (int i = 0; i < 100; ++i) times_done(pool, 3, 64);
  EXPECT_EQ(pool.n_helpers(), 2U);
}

TEST(ThreadPool, WorksOnAllThreadsAtOnce) {
  ThreadPool pool;
  constexpr std::size_t threads = 4;
  std::latch all_are_there(threads);
  pool.run(threads, threads, [&](std::size_t) { all_are_there.arrive_and_wait(); });
  SUCCEED() << "one thread less, and it would have waited forever";
}

TEST(ThreadPool, NeverWorksOnMoreThreadsThanAllowed) {
  ThreadPool pool;
  times_done(pool, 8, 8);  // there are seven helpers now
  std::atomic<int> inside{0}, most{0};
  pool.run(2000, 2, [&](std::size_t) {
    const int now = ++inside;
    int seen = most;
    while (now > seen && !most.compare_exchange_weak(seen, now)) {
    }
    --inside;
  });
  EXPECT_LE(most, 2);
}

/// The message of the exception that work on `threads` threads ends with.
std::string failure(ThreadPool& pool, std::size_t threads, std::atomic<int>& begun) {
  try {
    pool.run(10000, threads, [&](std::size_t i) {
      ++begun;
      if (i == 5) throw std::runtime_error("piece 5");
    });
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "none";
}

TEST(ThreadPool, PassesAnExceptionOnAndBeginsNothingNew) {
  ThreadPool pool;
  for (const std::size_t threads : {1, 2, 4}) {
    std::atomic<int> begun{0};
    EXPECT_EQ(failure(pool, threads, begun), "piece 5");
    EXPECT_LT(begun, 10000);
    EXPECT_EQ(times_done(pool, 50, threads), std::vector<int>(50, 1)) << "the pool works on";
  }
}

TEST(ThreadPool, PassesAnExceptionOfAHelperOn) {
  ThreadPool pool;
  const std::thread::id caller = std::this_thread::get_id();
  std::latch both_are_there(2);
  const auto work = [&](std::size_t) {
    both_are_there.arrive_and_wait();
    if (std::this_thread::get_id() != caller) throw std::runtime_error("of a helper");
  };
  EXPECT_THROW(pool.run(2, 2, work), std::runtime_error);
}

TEST(ThreadPool, WorkMayAskForMoreWork) {
  ThreadPool pool;
  std::vector<std::vector<int>> times(6);
  pool.run(times.size(), 3, [&](std::size_t i) {
    times[i].resize(40);
    pool.run(times[i].size(), 3, [&](std::size_t j) { ++times[i][j]; });
  });
  for (const std::vector<int>& some : times) EXPECT_EQ(some, std::vector<int>(40, 1));
}

TEST(ThreadPool, ServesSeveralThreads) {
  ThreadPool pool;
  std::vector<std::vector<int>> times(4);
  {
    std::vector<std::jthread> callers;
    for (std::vector<int>& some : times) callers.emplace_back([&] { some = times_done(pool, 500, 3); });
  }
  for (const std::vector<int>& some : times) EXPECT_EQ(some, std::vector<int>(500, 1));
}

TEST(InParallel, GivesTheSameForAnyNumberOfThreads) {
  const auto sums = [](int jobs) {
    std::vector<double> values(97);
    in_parallel(values.size(), jobs, [&](std::size_t i) {
      for (int k = 1; k < 200; ++k) values[i] += 1.0 / (k + static_cast<double>(i));
    });
    return values;
  };
  const std::vector<double> alone = sums(1);
  for (const int jobs : {0, 2, 5, 200}) EXPECT_EQ(sums(jobs), alone) << jobs << " jobs";
}

}  // namespace
}  // namespace eigentrail::test::thread_pool_test
