// A progress bar with the estimated remaining time, for terminals only.
#pragma once

#include <chrono>

namespace eigentrail::app {

class ProgressBar {
 public:
  /// Draws on stderr if that is a terminal and `quiet` is false.
  explicit ProgressBar(bool quiet);
  ~ProgressBar() { finish(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Draws the bar. `fraction`: share of the work that is done, 0 to 1; `count`: number of finished `what`.
  void update(double fraction, int count, const char* what = "points");

  /// Erases the bar, so that further output begins on an empty line.
  void finish();

 private:
  bool active_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point start_, last_;
};

}  // namespace eigentrail::app
