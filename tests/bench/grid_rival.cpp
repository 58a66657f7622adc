#include "bench/grid_rival.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "accuracy/grid_interpolant.hpp"
#include "accuracy/grid_loci.hpp"
#include "bench/shift_invert.hpp"
#include "bench/timing.hpp"

namespace eigentrail::test {
namespace {

double spline_error(const Recording& exact, const TraceOptions& range, const std::vector<double>& tests,
                    const ComplexMatrix& at_tests, int points) {
  const ComplexMatrix on_grid = sample(exact.path, parameters_on(range, points));
  const GridInterpolant spline(range.from, (range.to - range.from) / (points - 1),
                               {on_grid.rowwise().begin(), on_grid.rowwise().end()},
                               Interpolation::cubic_spline);
  ComplexMatrix values(at_tests.rows(), at_tests.cols());
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    values.row(i) = spline(tests[static_cast<std::size_t>(i)]).transpose();
  return largest_error(values, at_tests, exact.s_ref);
}

ReducedPencil pencil_at(const Setting& setting, double p) {
  const PathProblem problem = setting.problem();
  RunCounts counts;
  return reduce_at(problem, p, {setting.model->initial_guess(parameters_at(problem, p)), {}}, Matrix(),
                   counts)
      .pencil;
}

/// Whether every mode has an eigenvalue within the accuracy.
bool contain(const ComplexVector& found, const ComplexVector& modes, double accuracy) {
  return std::all_of(modes.begin(), modes.end(), [&](Complex mode) {
    return ((found.array() - mode).abs() <= accuracy * std::abs(mode)).any();
  });
}

int arnoldi_steps(const ReducedPencil& pencil, const ComplexVector& modes, double accuracy) {
  int steps = 10;
  const auto most = static_cast<int>(2 * pencil.size());
  while (
      steps < most &&
      !contain(eigenvalues_near(pencil.M[0], pencil.C[0], pencil.K[0], modes.mean(), steps), modes, accuracy))
    steps += 5;
  return steps;
}

}  // namespace

int points_for_spline(const Recording& exact, const TraceOptions& range, const std::vector<double>& tests,
                      double wanted) {
  const ComplexMatrix at_tests = sample(exact.path, tests);
  const auto enough = [&](int points) {
    return spline_error(exact, range, tests, at_tests, points) <= wanted;
  };
  int high = 16;
  for (; !enough(high); high *= 2) {
    if (high > 1'000'000) throw std::runtime_error("points_for_spline: not with a million points");
  }
  int low = std::max(4, high / 2);
  while (high - low > std::max(1.0, 0.03 * high)) {
    const int middle = (low + high) / 2;
    (enough(middle) ? high : low) = middle;
  }
  return high;
}

RivalTime time_grid(const Setting& setting, const TraceOptions& range, int points, int most) {
  const int measured = std::min(points, most);
  const double seconds = seconds_of([&] {
    const GridLoci loci = qz_grid(setting.problem(), parameters_on(range, measured), range.modes);
    const GridInterpolant spline(range.from, loci.p[1] - loci.p[0], loci.s, Interpolation::cubic_spline);
  });
  return {seconds * points / measured, measured};
}

ArnoldiTime time_arnoldi(const Setting& setting, const TraceOptions& range, const Recording& exact,
                         double accuracy, int points, int most) {
  ArnoldiTime time;
  time.measured = std::min(points, most);
  const std::vector<double> p = parameters_on(range, time.measured);
  const ComplexMatrix modes = sample(exact.path, p);
  time.steps = arnoldi_steps(pencil_at(setting, p[0]), modes.row(0).transpose(), accuracy);
  const double seconds = seconds_of([&] {
    for (int i = 0; i < time.measured; ++i) {
      const ReducedPencil pencil = pencil_at(setting, p[static_cast<std::size_t>(i)]);
      eigenvalues_near(pencil.M[0], pencil.C[0], pencil.K[0], modes.row(i).mean(), time.steps);
    }
  });
  time.seconds = seconds * points / time.measured;
  return time;
}

}  // namespace eigentrail::test
