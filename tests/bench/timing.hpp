// Time of repeated work: CPU time of the process. All that is timed runs in one thread, where it is what a
// clock on the wall shows on a machine with nothing else to do, and it stays so beside other programs.
#pragma once

#include <algorithm>
#include <ctime>
#include <vector>

namespace eigentrail::test {

/// Value in the middle of the sorted list (the upper one of two); the list is not empty.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// CPU time so far.
inline double cpu_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

template <class Work>
double seconds_of(Work&& work) {
  const double begin = cpu_seconds();
  work();
  return cpu_seconds() - begin;
}

/// Median over `repeats` >= 1 calls of `work`, after one that warms up caches and libraries.
template <class Work>
double median_seconds(int repeats, Work&& work) {
  std::vector<double> times;
  work();
  for (int i = 0; i < repeats; ++i) times.push_back(seconds_of(work));
  return median(std::move(times));
}

/// Times of several works, taken in rounds of all of them: on a machine whose speed changes a ratio within a
/// round says more than one of medians.
class Rounds {
 public:
  /// The works' times in one round, in the same order every time.
  void add(const std::vector<double>& seconds) { rounds_.push_back(seconds); }

  double seconds(std::size_t work) const {
    return median_of([work](const std::vector<double>& round) { return round[work]; });
  }
  /// Time of one work / that of another.
  double ratio(std::size_t work, std::size_t other) const {
    return median_of([=](const std::vector<double>& round) { return round[work] / round[other]; });
  }

 private:
  template <class Value>
  double median_of(Value&& value) const {
    std::vector<double> values;
    for (const std::vector<double>& round : rounds_) values.push_back(value(round));
    return median(std::move(values));
  }

  std::vector<std::vector<double>> rounds_;
};

}  // namespace eigentrail::test
