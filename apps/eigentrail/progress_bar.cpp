#include "progress_bar.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace eigentrail::app {
namespace {

constexpr auto redraw_interval = std::chrono::milliseconds(100);
constexpr int bar_width = 30;

std::string duration_text(double seconds) {
  const auto whole = std::lround(seconds);
  if (whole < 60) return std::to_string(whole) + " s";
  if (whole < 3600) return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
  return std::to_string(whole / 3600) + " h " + std::to_string(whole / 60 % 60) + " min";
}

}  // namespace

ProgressBar::ProgressBar(bool quiet)
    : active_(!quiet && isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()),
      last_(start_) {}

void ProgressBar::finish() {
  if (drawn_) std::fprintf(stderr, "\r\033[K");
  drawn_ = false;
}

void ProgressBar::update(double fraction, int count, const char* what) {
  if (!active_) return;
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < redraw_interval) return;
  last_ = now;
  drawn_ = true;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const std::string remaining =
      fraction > 0.01 ? duration_text(elapsed * (1.0 - fraction) / fraction) + " left" : "";
  const int filled = std::clamp(static_cast<int>(fraction * bar_width), 0, bar_width);
  std::fprintf(stderr, "\r\033[K[%s%s] %3.0f %%  %d %s  %s",
               std::string(static_cast<std::size_t>(filled), '#').c_str(),
               std::string(static_cast<std::size_t>(bar_width - filled), '.').c_str(), 100.0 * fraction,
               count, what, remaining.c_str());
  std::fflush(stderr);
}

}  // namespace eigentrail::app
