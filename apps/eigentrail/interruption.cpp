#include "interruption.hpp"

#include <unistd.h>

#include <csignal>
#include <string_view>

namespace eigentrail::app {
namespace {

/// Seconds that the computation has to reach its next point. A whole spectrum of a large model, for example,
/// may take longer and cannot be interrupted.
constexpr unsigned grace = 1;

// Signal handlers may use only variables of this type.
volatile std::sig_atomic_t noted = 0;
volatile std::sig_atomic_t saved = 0;

extern "C" void end_within_step(int) {
  constexpr std::string_view before_first = "\neigentrail: interrupted before anything was saved\n";
  constexpr std::string_view later =
      "\neigentrail: interrupted within a step; the output holds the points up to its last save, and the "
      "same command with --resume goes on\n";
  const std::string_view message = saved == 0 ? before_first : later;
  // The program ends in any case.
  [[maybe_unused]] const auto written = write(STDERR_FILENO, message.data(), message.size());
  _exit(128 + noted);
}

extern "C" void note_signal(int signal) {
  noted = signal;
  alarm(grace);
}

void handle(int signal, void (*handler)(int), int flags) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = flags;
  sigaction(signal, &action, nullptr);
}

}  // namespace

Interruption::Interruption() {
  noted = 0;
  saved = 0;
  handle(SIGALRM, end_within_step, 0);
  for (const int signal : {SIGINT, SIGTERM}) handle(signal, note_signal, SA_RESETHAND | SA_RESTART);
}

Interruption::~Interruption() {
  alarm(0);
  for (const int signal : {SIGINT, SIGTERM, SIGALRM}) handle(signal, SIG_DFL, 0);
}

int Interruption::signal() const {
  return noted;
}

void Interruption::has_saved() {
  saved = 1;
}

void Interruption::save_in_peace() const {
  alarm(0);
}

}  // namespace eigentrail::app
