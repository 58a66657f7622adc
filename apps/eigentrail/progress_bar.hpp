// A progress bar with the remaining time, on a terminal only.
#pragma once

#include <chrono>

namespace eigentrail::app {

class ProgressBar {
 public:
  /// Draws on stderr when that is a terminal and `quiet` is false.
  explicit ProgressBar(bool quiet);
  ~ProgressBar() { finish(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `fraction` done, 0 to 1, and how many `what` there are so far.
  void update(double fraction, int count, const char* what = "points");

  /// Wipes the bar, so that what is printed next begins on a clean line.
  void finish();

 private:
  bool active_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point start_, last_;
};

}  // namespace eigentrail::app
