#include "watch.hpp"

#include <sys/syscall.h>
#include <unistd.h>

#include <utility>

namespace py = pybind11;

// Defined only if LAPACK is OpenBLAS.
extern "C" void openblas_set_num_threads(int) __attribute__((weak));
extern "C" int openblas_get_num_threads() __attribute__((weak));

namespace eigentrail::python {
namespace {

constexpr auto interval = std::chrono::milliseconds(100);  ///< between two calls of `progress`

volatile std::sig_atomic_t noted = 0;  // a signal handler may write only to a variable of this type

extern "C" void note_interrupt(int) {
  noted = 1;
}

bool in_main_thread() {
  return syscall(SYS_gettid) == getpid();
}

/// Computations that run now. They share the number of threads within BLAS, which is one for all of the
/// process.
std::mutex blas_mutex;
int n_running = 0;
int threads_before = 0;

}  // namespace

Interruption::Interruption() {
  if (!in_main_thread()) return;
  noted = 0;
  struct sigaction action {};
  action.sa_handler = note_interrupt;
  action.sa_flags = SA_RESTART;
  installed_ = sigaction(SIGINT, &action, &before_) == 0;
}

Interruption::~Interruption() {
  if (installed_) sigaction(SIGINT, &before_, nullptr);
}

Interruption::operator bool() const {
  return installed_ && noted != 0;
}

Watch::Watch(py::object progress) : progress_(std::move(progress)) {}

bool Watch::operator()(double share, long count) {
  const std::lock_guard lock(mutex_);
  if (raised_ || interruption_) return false;
  if (progress_.is_none() || Clock::now() < next_) return true;
  const py::gil_scoped_acquire acquired;
  try {
    progress_(share, count);
  } catch (py::error_already_set&) {
    raised_ = std::current_exception();
    return false;
  }
  next_ = Clock::now() + interval;
  return true;
}

void Watch::require(double share, long count) {
  if (!(*this)(share, count)) throw Stopped();
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
