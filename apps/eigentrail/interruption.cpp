#include "interruption.hpp"

#include <csignal>

namespace eigentrail::app {
namespace {

volatile std::sig_atomic_t noted = 0;  // a signal handler may write only to a variable of this type

extern "C" void note_signal(int signal) {
  noted = signal;
}

void handle(void (*handler)(int), int flags) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = flags;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

Interruption::Interruption() {
  noted = 0;
  handle(note_signal, SA_RESETHAND | SA_RESTART);
}

Interruption::~Interruption() {
  handle(SIG_DFL, 0);
}

int Interruption::signal() const {
  return noted;
}

}  // namespace eigentrail::app
