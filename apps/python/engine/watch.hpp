// What a long computation does between two of its points when Python has called it: it shows its progress and
// notices that it shall end.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace eigentrail::python {

/// Called from any thread without the interpreter lock. Signals are handled in the thread that has made it,
/// if that is the main thread of Python.
class Watch {
 public:
  /// `progress` is None or a function of the share that is done, 0 to 1, and a count. It is called ten times
  /// a second at most; an exception that it or the handler of a signal raises ends the computation.
  explicit Watch(pybind11::object progress);

  /// Whether the computation shall go on.
  bool operator()(double share, long count);
  /// The same; throws Stopped if it shall not.
  void require(double share, long count);

  /// Whether Ctrl-C has ended the computation, or has come since its last point. With the interpreter lock.
  bool interrupted();
  /// Rethrows what ended it. With the interpreter lock.
  void rethrow() const;

 private:
  using Clock = std::chrono::steady_clock;

  /// Calls it with the interpreter lock, and notes what it raises.
  void call(const std::function<void()>& python);

  std::thread::id thread_ = std::this_thread::get_id();
  pybind11::object progress_;
  std::mutex mutex_;
  Clock::time_point next_look_ = Clock::now(), next_progress_ = next_look_;
  std::exception_ptr raised_;
  bool interrupted_ = false;
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

}  // namespace eigentrail::python
