#include "bench/grid_rival.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "bench/shift_invert.hpp"
#include "bench/spline.hpp"
#include "bench/timing.hpp"
#include "core/lapack.hpp"
#include "hard_cases/rivals.hpp"

namespace eigentrail::test {
namespace {

ComplexMatrix to_matrix(const std::vector<std::vector<Complex>>& rows) {
  ComplexMatrix values(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(rows[0].size()));
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    const auto& row = rows[static_cast<std::size_t>(i)];
    values.row(i) = Eigen::Map<const ComplexVector>(row.data(), values.cols()).transpose();
  }
  return values;
}

double spline_error(const Recording& exact, const TraceOptions& range, const std::vector<double>& tests,
                    const ComplexMatrix& at_tests, int points) {
  const CubicSpline spline(sample(exact.path, parameters_on(range, points)));
  ComplexMatrix values(at_tests.rows(), at_tests.cols());
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    const double part = (tests[static_cast<std::size_t>(i)] - range.from) / (range.to - range.from);
    values.row(i) = spline(part * (points - 1)).transpose();
  }
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
    const GridSpectra spectra = spectra_on_grid(setting, range.from, range.to, measured);
    const LabelledLoci loci = carry_labels(spectra, Carrier::assurance);
    const CubicSpline spline(to_matrix(loci.s));
  });
  return {seconds * points / measured, measured};
}

double saved_by_qr(const Setting& setting, double p) {
  const ReducedPencil pencil = pencil_at(setting, p);
  const Eigen::Index n = pencil.size();
  const auto size = static_cast<lapack_int>(2 * n);
  Matrix right(2 * n, 2 * n);
  Vector real(2 * n), imag(2 * n), beta(2 * n);
  Matrix A = Matrix::Zero(2 * n, 2 * n), E = Matrix::Identity(2 * n, 2 * n);
  A.topRightCorner(n, n).setIdentity();
  A.bottomLeftCorner(n, n) = -pencil.K[0];
  A.bottomRightCorner(n, n) = -pencil.C[0];
  E.bottomRightCorner(n, n) = pencil.M[0];
  const double qz = median_seconds(1, [&] {
    Matrix a = A, e = E;
    LAPACKE_dggev(LAPACK_COL_MAJOR, 'N', 'V', size, a.data(), size, e.data(), size, real.data(), imag.data(),
                  beta.data(), nullptr, 1, right.data(), size);
  });
  const double qr = median_seconds(1, [&] {
    Matrix a = E.lu().solve(A);
    LAPACKE_dgeev(LAPACK_COL_MAJOR, 'N', 'V', size, a.data(), size, real.data(), imag.data(), nullptr, 1,
                  right.data(), size);
  });
  return qz - qr;
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
