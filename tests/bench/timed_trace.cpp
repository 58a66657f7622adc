#include "bench/timed_trace.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bench/timing.hpp"

namespace eigentrail::test {
namespace {

TraceResult completed(TraceResult result) {
  if (result.status != TraceStatus::completed) throw std::runtime_error("trace: " + result.message);
  return result;
}

}  // namespace

double TimedTrace::seconds_per_mode_step() const {
  return follow_seconds / static_cast<double>(std::max(1L, result.mode_steps));
}

TimedTrace time_trace(const Setting& setting, const TraceOptions& options) {
  const double begin = cpu_seconds();
  double first_point = begin;
  TraceObserver observer;
  observer.started = [&](const TraceStart&) { first_point = cpu_seconds(); };
  TimedTrace timed;
  timed.result = completed(trace(*setting.model, options, observer));
  const double end = cpu_seconds();
  timed.seconds = end - begin;
  timed.follow_seconds = end - first_point;
  return timed;
}

Recording record(const Setting& setting, const TraceOptions& options) {
  PathRecorder recorder;
  TraceObserver observer;
  observer.point = [&](const TracePoint& point) {
    recorder.append(point);
    return true;
  };
  const TraceResult result = completed(trace(*setting.model, options, observer));
  return {recorder.path(), result.s_ref};
}

Recording reference_of(const Setting& setting, const TraceOptions& judged) {
  TraceOptions options = judged;
  options.tolerance = std::max(1e-3 * judged.tolerance, 1e-12);
  options.order = 4;
  options.certify = true;
  return record(setting, options);
}

ComplexMatrix sample(const RecordedPath& path, const std::vector<double>& p) {
  ComplexMatrix values(static_cast<Eigen::Index>(p.size()), path.eigenvalues.cols());
  std::size_t step = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto length = [&] { return path.p[step + 1] - path.p[step]; };
    while (step + 1 < path.steps.size() && (p[i] - path.p[step + 1]) * length() > 0.0) ++step;
    const double t = std::clamp((p[i] - path.p[step]) / length(), 0.0, 1.0);
    values.row(static_cast<Eigen::Index>(i)) = path.eigenvalues_at({step, t}).transpose();
  }
  return values;
}

double largest_error(const ComplexMatrix& values, const ComplexMatrix& exact, double s_ref) {
  return ((values - exact).cwiseAbs().array() / exact.cwiseAbs().array().max(s_ref)).maxCoeff();
}

std::vector<double> parameters_on(const TraceOptions& options, int count, double shift) {
  std::vector<double> p;
  for (int i = 0; i < count; ++i) {
    const double part = (i + shift) / (count - 1 + 2.0 * shift);
    p.push_back(options.from + part * (options.to - options.from));
  }
  return p;
}

}  // namespace eigentrail::test
