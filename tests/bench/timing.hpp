// CPU time of repeated work. All timed work runs in one thread. There CPU time equals wall time on an idle
// machine, and it does not depend on other programs that run.
#pragma once

#include <algorithm>
#include <ctime>
#include <vector>

#include "eigentrail/core/types.hpp"

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

/// Exponent of a power law: the least-squares slope of log y over log x.
inline double exponent(const std::vector<double>& x, const std::vector<double>& y) {
  const auto count = static_cast<Eigen::Index>(x.size());
  const Vector log_x = Eigen::Map<const Vector>(x.data(), count).array().log();
  const Vector log_y = Eigen::Map<const Vector>(y.data(), count).array().log();
  const Vector from_mean = log_x.array() - log_x.mean();
  return from_mean.dot(log_y) / from_mean.squaredNorm();
}

/// Times of several works, measured in rounds that contain each of them. If the speed of the machine changes,
/// the ratio of times within a round is more reliable than the ratio of medians.
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
