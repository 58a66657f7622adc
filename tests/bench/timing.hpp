// Wall time of repeated work.
#pragma once

#include <algorithm>
#include <chrono>
#include <vector>

namespace eigentrail::test {

/// Value in the middle of the sorted list (the upper one of two); the list is not empty.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

template <class Work>
double seconds_of(Work&& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Median over `repeats` >= 1 calls of `work`, after one that warms up caches and libraries.
template <class Work>
double median_seconds(int repeats, Work&& work) {
  std::vector<double> times;
  work();
  for (int i = 0; i < repeats; ++i) times.push_back(seconds_of(work));
  return median(std::move(times));
}

}  // namespace eigentrail::test
