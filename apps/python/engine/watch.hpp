// What a long computation does between two of its points when Python has called it: it shows its progress and
// notices that it shall end.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <exception>
#include <mutex>

namespace eigentrail::python {

/// Ctrl-C during the lifetime of an object is noted instead of handled by Python, which could not handle it
/// before the computation ends. Only in the main thread; elsewhere Python's own handler stays.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  explicit operator bool() const;

 private:
  bool installed_ = false;
  struct sigaction before_ {};
};

/// Called from any thread without the interpreter lock.
class Watch {
 public:
  /// `progress` is None or a function of the share that is done, 0 to 1, and a count. It is called ten times
  /// a second at most; an exception that it raises ends the computation.
  explicit Watch(pybind11::object progress);

  /// Whether the computation shall go on.
  bool operator()(double share, long count);
  /// The same; throws Stopped if it shall not.
  void require(double share, long count);

  bool interrupted() const { return static_cast<bool>(interruption_); }
  /// Rethrows what `progress` raised. With the interpreter lock.
  void rethrow() const;

 private:
  using Clock = std::chrono::steady_clock;

  Interruption interruption_;
  pybind11::object progress_;
  std::mutex mutex_;
  Clock::time_point next_ = Clock::now();
  std::exception_ptr raised_;
};

/// Thrown through a computation that cannot be asked to stop, to end it.
struct Stopped : std::exception {
  const char* what() const noexcept override { return "interrupted"; }
};

/// BLAS works with one thread during the lifetime of an object, as in the program: results would differ in
/// the last bits with the number of threads.
class OneThreadWithinBlas {
 public:
  OneThreadWithinBlas();
  ~OneThreadWithinBlas();
  OneThreadWithinBlas(const OneThreadWithinBlas&) = delete;
  OneThreadWithinBlas& operator=(const OneThreadWithinBlas&) = delete;
};

/// Runs `work` without the interpreter lock.
template <class Work>
auto unlocked(Work&& work) {
  const OneThreadWithinBlas blas;
  const pybind11::gil_scoped_release released;
  return work();
}

/// Runs `work`, which `watch` watches, without the interpreter lock. Where it was stopped, throws what
/// stopped it: an exception of `progress`, or KeyboardInterrupt.
template <class Work>
auto watched(const Watch& watch, Work&& work) {
  try {
    return unlocked(work);
  } catch (const Stopped&) {
    watch.rethrow();
    PyErr_SetNone(PyExc_KeyboardInterrupt);
    throw pybind11::error_already_set();
  }
}

}  // namespace eigentrail::python
