// Handles SIGINT and SIGTERM: a long computation checks between its steps whether one has arrived, and ends
// in order.
#pragma once

namespace eigentrail::app {

/// During the lifetime of an object the first signal is recorded. A second one ends the program at once. If
/// the computation does not notice the signal within a second, because a single step takes longer, the
/// program ends with a message, which says whether anything was saved.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// Number of the signal that has arrived; 0: none.
  int signal() const;
  explicit operator bool() const { return signal() != 0; }

  /// There is an output from which the computation can go on.
  static void has_saved();

  /// To be called when the signal has been noticed: gives the program the time to save.
  void save_in_peace() const;

  /// The conventional exit code of a program that was ended by the signal.
  int exit_code() const { return 128 + signal(); }
};

}  // namespace eigentrail::app
