#include "watch.hpp"

#include <utility>

namespace py = pybind11;

// Defined only if LAPACK is OpenBLAS.
extern "C" void openblas_set_num_threads(int) __attribute__((weak));
extern "C" int openblas_get_num_threads() __attribute__((weak));

namespace eigentrail::python {
namespace {

/// Between two calls of `progress`, and two looks for signals.
constexpr auto interval = std::chrono::milliseconds(100);

void handle_signals() {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

/// Computations that run now. They share the number of threads within BLAS, which is one for all of the
/// process.
std::mutex blas_mutex;
int n_running = 0;
int threads_before = 0;

}  // namespace

Watch::Watch(py::object progress) : progress_(std::move(progress)) {}

bool Watch::operator()(double share, long count) {
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  if (!raised_ && std::this_thread::get_id() == thread_ && now >= next_look_) {
    next_look_ = now + interval;
    call(handle_signals);
  }
  if (!raised_ && !progress_.is_none() && now >= next_progress_) {
    next_progress_ = now + interval;
    call([&] { progress_(share, count); });
  }
  return !raised_;
}

void Watch::call(const std::function<void()>& python) {
  const py::gil_scoped_acquire acquired;
  try {
    python();
  } catch (const py::error_already_set& error) {
    raised_ = std::current_exception();
    interrupted_ = error.matches(PyExc_KeyboardInterrupt);
  }
}

void Watch::require(double share, long count) {
  if (!(*this)(share, count)) throw Stopped();
}

bool Watch::interrupted() {
  if (!raised_) call(handle_signals);
  return interrupted_;
}

void Watch::rethrow() const {
  if (raised_) std::rethrow_exception(raised_);
}

OneThreadWithinBlas::OneThreadWithinBlas() {
  if (openblas_set_num_threads == nullptr || openblas_get_num_threads == nullptr) return;
  const std::lock_guard lock(blas_mutex);
  if (n_running++ > 0) return;
  threads_before = openblas_get_num_threads();
  openblas_set_num_threads(1);
}

OneThreadWithinBlas::~OneThreadWithinBlas() {
  if (openblas_set_num_threads == nullptr || openblas_get_num_threads == nullptr) return;
  const std::lock_guard lock(blas_mutex);
  if (--n_running == 0) openblas_set_num_threads(threads_before);
}

}  // namespace eigentrail::python
