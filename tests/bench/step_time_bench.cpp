// Time per mode and step against one complex LU of the same size, and how it grows.
#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "bench/benchmarks.hpp"
#include "bench/families.hpp"
#include "bench/text.hpp"
#include "bench/timed_trace.hpp"
#include "bench/timing.hpp"
#include "eigentrail/core/complex_lu.hpp"

namespace eigentrail::test {
namespace {

constexpr unsigned seed = 7;

TraceOptions few_modes_of(const Setting& setting, int modes, bool certify) {
  TraceOptions options = setting.options;
  options.tolerance = 1e-6;
  options.modes = modes;
  options.certify = certify;
  return options;
}

template <class Factor>
double lu_seconds(int n, Factor&& factor) {
  const ComplexMatrix matrix = ComplexMatrix::Random(n, n);
  const int inner = std::max(1, 20'000'000 / (n * n * n));
  double sink = 0.0;
  const double seconds = median_seconds(9, [&] {
    for (int i = 0; i < inner; ++i) sink += factor(matrix);
  });
  return sink > 0.0 ? seconds / inner : 0.0;
}

/// Median time of one complex LU as the engine does it.
double own_lu_seconds(int n) {
  return lu_seconds(n, [](const ComplexMatrix& matrix) {
    const ComplexLu lu(matrix);
    return static_cast<double>(lu.size());
  });
}

/// The same by Eigen, which the targets were written for.
double eigen_lu_seconds(int n) {
  return lu_seconds(n, [](const ComplexMatrix& matrix) {
    return std::abs(Eigen::PartialPivLU<ComplexMatrix>(matrix).matrixLU()(0, 0));
  });
}

std::string percent(double part, double whole) {
  return short_text(std::round(100.0 * part / whole)) + " %";
}

/// Where the time after the first point went.
std::string stages(const TimedTrace& timed) {
  const RunCounts& c = timed.result.counts;
  const double all = timed.result.seconds;
  return "modes " + percent(c.modes_seconds, all) + ", series " + percent(c.differentiation_seconds, all) +
         ", certificate " + percent(c.certificate_seconds, all) + ", events " +
         percent(c.events_seconds, all) + ", completeness " + percent(c.matching_seconds, all) +
         " of the run";
}

std::string account(const TimedTrace& timed) {
  return time_text(timed.seconds) + " on " + std::to_string(timed.result.nodes) + " points, " +
         std::to_string(timed.result.rejections.total()) + " tried again; " + stages(timed);
}

/// Time of points alone: equilibrium, reduction, correction, series; with the certificate when it is on.
double point_seconds(const TimedTrace& timed) {
  const RunCounts& c = timed.result.counts;
  const double stages = c.equilibrium_seconds + c.reduction_seconds + c.modes_seconds +
                        c.differentiation_seconds + c.certificate_seconds;
  // The engine's own clock is the wall's: only the share counts.
  return timed.seconds * stages / timed.result.seconds;
}

void add_step_figures(int n, int modes, bool certify, std::optional<Target> target,
                      const BenchOptions& options, Figures& figures) {
  const Setting setting = gyroscopic_family(n, seed, {});
  const TimedTrace timed = time_trace(setting, few_modes_of(setting, modes, certify), options.repeats);
  const double lu = own_lu_seconds(n);
  const std::string what = " per mode and step / complex LU, n = " + std::to_string(n) + ", certificate " +
                           (certify ? "on" : "off");
  const auto steps = static_cast<double>(std::max(1L, timed.result.mode_steps));
  figures.push_back({"time" + what, timed.seconds_per_mode_step() / lu, target,
                     std::to_string(timed.result.nodes - 1) + " steps of " + std::to_string(modes) +
                         " modes, " + std::to_string(timed.result.rejections.total()) + " tried again; LU " +
                         time_text(lu) + "; " + stages(timed)});
  const double eigen = eigen_lu_seconds(n);
  figures.push_back({"the same in LU by Eigen", timed.seconds_per_mode_step() / eigen, target,
                     "which takes " + time_text(eigen)});
  figures.push_back(
      {"of that, points" + std::string(certify ? " and certificate" : " alone"),
       point_seconds(timed) / steps / lu, target,
       short_text(static_cast<double>(timed.result.counts.modes.factorizations) / steps) + " LU, " +
           short_text(static_cast<double>(timed.result.counts.modes.solves) / steps) + " solves, " +
           short_text(static_cast<double>(timed.result.counts.certificate_factorizations) / steps) +
           " LU of the certificate"});
}

/// Least-squares slope of log y over log x.
double exponent(const std::vector<double>& x, const std::vector<double>& y) {
  Matrix A(static_cast<Eigen::Index>(x.size()), 2);
  Vector b(A.rows());
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    A.row(i) << 1.0, std::log(x[static_cast<std::size_t>(i)]);
    b[i] = std::log(y[static_cast<std::size_t>(i)]);
  }
  const Matrix normal = A.transpose() * A;
  return normal.inverse().row(1).dot(A.transpose() * b);
}

struct Growth {
  std::vector<double> x, whole, per_mode_step;
  std::string text;

  void add(double at, const TimedTrace& timed) {
    x.push_back(at);
    whole.push_back(timed.seconds);
    per_mode_step.push_back(timed.seconds_per_mode_step());
    text += (text.empty() ? "" : ", ") + short_text(at) + ": " + time_text(timed.seconds);
  }
};

}  // namespace

Figures step_time(const BenchOptions& options) {
  Figures figures;
  const int modes = 6;
  for (const bool certify : {false, true}) {
    for (const int n : options.smoke ? std::vector<int>{10, 20} : std::vector<int>{50, 200}) {
      std::optional<Target> target;
      if (!certify) target = at_most(n <= 50 ? 2.5 : 1.6);
      add_step_figures(n, modes, certify, target, options, figures);
    }
  }
  return figures;
}

Figures growth(const BenchOptions& options) {
  Growth with_size, with_modes;
  for (const int n : options.smoke ? std::vector<int>{8, 16} : std::vector<int>{25, 50, 100, 200}) {
    const Setting setting = gyroscopic_family(n, seed, {});
    with_size.add(n, time_trace(setting, few_modes_of(setting, 6, true), options.repeats));
  }
  const int n_fixed = options.smoke ? 8 : 50;
  const Setting setting = gyroscopic_family(n_fixed, seed, {});
  for (const int modes : options.smoke ? std::vector<int>{2, 4} : std::vector<int>{3, 6, 12, 25, 50})
    with_modes.add(modes, time_trace(setting, few_modes_of(setting, modes, true), options.repeats));
  return {
      {"exponent of whole time in n, 6 modes", exponent(with_size.x, with_size.whole), {}, with_size.text},
      {"exponent of time per mode and step in n", exponent(with_size.x, with_size.per_mode_step), {}},
      {"exponent of whole time in the number of modes, n = 50",
       exponent(with_modes.x, with_modes.whole),
       {},
       with_modes.text}};
}

Figures symmetric(const BenchOptions& options) {
  const int n = options.smoke ? 8 : 100;
  const Setting undamped = undamped_family(n, seed, {});
  const Setting general = gyroscopic_family(n, seed, {});
  Figures figures;
  for (const bool certify : {false, true}) {
    const auto time = [&](const Setting& setting) {
      TraceOptions all = setting.options;
      all.tolerance = 1e-6;
      all.certify = certify;
      return time_trace(setting, all, options.repeats);
    };
    const TimedTrace symmetric = time(undamped);
    const TimedTrace damped = time(general);
    const std::string what = std::string("time per mode and step, certificate ") + (certify ? "on" : "off");
    figures.push_back(
        {"damped gyroscopic / undamped symmetric, all modes, n = " + std::to_string(n) + ", " + what,
         damped.seconds_per_mode_step() / symmetric.seconds_per_mode_step(),
         certify ? std::nullopt : std::optional(at_least(4.0)),
         "undamped " + account(symmetric) + "; general " + account(damped)});
    figures.push_back({"of that, points" + std::string(certify ? " and certificate" : " alone"),
                       point_seconds(damped) / static_cast<double>(damped.result.mode_steps) /
                           (point_seconds(symmetric) / static_cast<double>(symmetric.result.mode_steps))});
  }
  return figures;
}

Figures threads(const BenchOptions& options) {
  const int n = options.smoke ? 40 : 100;
  const int modes = options.smoke ? 16 : 40;
  const Setting setting = gyroscopic_family(n, seed, {});
  // On the wall, one after the other: what else the machine does meets both.
  std::vector<double> one, two;
  TraceOptions with = few_modes_of(setting, modes, true);
  std::string account;
  for (int i = 0; i < options.repeats; ++i) {
    for (const int count : {1, 2}) {
      with.threads = count;
      const TimedTrace timed = time_trace(setting, with, 1);
      (count == 1 ? one : two).push_back(timed.result.seconds);
      account = std::to_string(timed.result.nodes) + " points";
    }
  }
  const double alone = median(one);
  const double together = median(two);
  return {{"speed-up by a second thread, " + std::to_string(modes) + " modes of n = " + std::to_string(n),
           alone / together, at_least(1.6),
           time_text(alone) + " / " + time_text(together) + " on the wall, " + account}};
}

}  // namespace eigentrail::test
