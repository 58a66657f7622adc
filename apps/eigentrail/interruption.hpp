// SIGINT and SIGTERM as a wish that long work asks for between its steps.
#pragma once

namespace eigentrail::app {

/// While one of these lives the first signal is noted; a second one ends the program at once.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// The signal that came; 0: none.
  int signal() const;
  explicit operator bool() const { return signal() != 0; }

  /// What a program that was ended by the signal exits with.
  int exit_code() const { return 128 + signal(); }
};

}  // namespace eigentrail::app
