#include "hard_cases/rivals.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#define lapack_complex_float std::complex<float>
#define lapack_complex_double std::complex<double>
#include <lapacke.h>

#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/continuation/trace_options.hpp"
#include "eigentrail/modes/matching.hpp"
#include "support/spectra.hpp"

namespace eigentrail::test {
namespace {

struct EigenPairs {
  std::vector<Complex> s;
  ComplexMatrix z;  ///< upper halves of the companion's vectors
};

EigenPairs qz_pairs(const Matrix& M, const Matrix& C, const Matrix& K) {
  const Eigen::Index n = M.rows();
  auto [A, E] = companion_pencil(M, C, K);
  const auto size = static_cast<lapack_int>(2 * n);
  Vector real(2 * n), imag(2 * n), beta(2 * n);
  Matrix right(2 * n, 2 * n);
  const lapack_int info =
      LAPACKE_dggev(LAPACK_COL_MAJOR, 'N', 'V', size, A.data(), size, E.data(), size, real.data(),
                    imag.data(), beta.data(), nullptr, 1, right.data(), size);
  if (info != 0) throw std::runtime_error("dggev did not converge");
  EigenPairs result{{}, ComplexMatrix(n, 2 * n)};
  for (Eigen::Index i = 0; i < 2 * n; ++i) {
    result.s.push_back(Complex(real[i], imag[i]) / beta[i]);
    // A pair's vectors are stored as real and imaginary part of the member with Im s > 0, which comes first.
    const Eigen::Index first = imag[i] < 0.0 ? i - 1 : i;
    ComplexVector z = right.col(first).head(n).cast<Complex>();
    if (imag[i] != 0.0)
      z += Complex(0.0, imag[i] > 0.0 ? 1.0 : -1.0) * right.col(first + 1).head(n).cast<Complex>();
    result.z.col(i) = z;
  }
  return result;
}

GridSpectra::Point spectrum_at(const PathPoint& point) {
  const EigenPairs pairs = qz_pairs(point.pencil.M[0], point.pencil.C[0], point.pencil.K[0]);
  GridSpectra::Point result{point.p, pairs.s, point.basis.T[0].cast<Complex>() * pairs.z,
                            point.equilibrium.linearization.M[0].dense()};
  for (auto column : result.vectors.colwise()) {
    const double length = column.norm();
    if (length > 0.0) column /= length;
  }
  return result;
}

double distance(Complex a, Complex b) {
  const double value = std::abs(a - b);
  return std::isfinite(value) ? value : 1e150;  // to and from infinity
}

Matrix distances(const std::vector<Complex>& from, const std::vector<Complex>& to) {
  const auto n = static_cast<Eigen::Index>(from.size());
  return Matrix::NullaryExpr(n, n, [&](Eigen::Index i, Eigen::Index j) {
    return distance(from[static_cast<std::size_t>(i)], to[static_cast<std::size_t>(j)]);
  });
}

/// Cost of matching modes: 1 - MAC. An eigenvalue above the real axis is not matched with one below: the
/// conjugate of backward whirl has the same shape as forward whirl.
Matrix disagreement(const GridSpectra::Point& last, const GridSpectra::Point& next) {
  Matrix cost = 1.0 - modal_assurance(last.vectors, next.vectors, next.mass).array();
  for (Eigen::Index i = 0; i < cost.rows(); ++i) {
    for (Eigen::Index j = 0; j < cost.cols(); ++j) {
      const double sides =
          last.s[static_cast<std::size_t>(i)].imag() * next.s[static_cast<std::size_t>(j)].imag();
      if (sides < 0.0) cost(i, j) += 10.0;
    }
  }
  return cost;
}

/// For every label the eigenvalue of `next` that it goes on with; `labels` are the eigenvalues of `last` it
/// is at.
std::vector<int> successors(const GridSpectra::Point& last, const GridSpectra::Point& next,
                            const std::vector<int>& labels, Carrier carrier) {
  Matrix cost = carrier == Carrier::assurance ? disagreement(last, next) : distances(last.s, next.s);
  cost = cost.unaryExpr([](double value) { return std::isfinite(value) ? value : 1.0; });
  std::vector<int> to(last.s.size());
  if (carrier == Carrier::nearest) {
    for (std::size_t i = 0; i < to.size(); ++i) {
      Eigen::Index column = 0;
      cost.row(static_cast<Eigen::Index>(i)).minCoeff(&column);
      to[i] = static_cast<int>(column);
    }
  } else {
    to = optimal_assignment(cost);
  }
  std::vector<int> result;
  for (const int label : labels) result.push_back(to[static_cast<std::size_t>(label)]);
  return result;
}

/// Distance of a label from a mode, of which it may carry either member.
double distance_from_mode(Complex s, Complex mode) {
  return std::min(distance(s, mode), distance(s, std::conj(mode)));
}

bool on_another_mode(Complex s, std::size_t own, const std::vector<Complex>& modes) {
  const double from_own = distance_from_mode(s, modes[own]);
  double scale = 0.0;
  for (const Complex mode : modes) scale = std::max(scale, std::abs(mode));
  return std::any_of(modes.begin(), modes.end(), [&](Complex other) {
    const bool apart = distance_from_mode(other, modes[own]) > 1e-7 * scale;
    return apart && distance_from_mode(s, other) < 0.5 * from_own;
  });
}

/// For every mode a label that stands on it, each label once.
std::vector<std::size_t> labels_on(const std::vector<Complex>& modes, const std::vector<Complex>& s) {
  std::vector<std::size_t> result;
  std::vector<bool> used(s.size(), false);
  for (const Complex mode : modes) {
    std::size_t nearest = s.size();
    for (std::size_t i = 0; i < s.size(); ++i) {
      if (used[i]) continue;
      if (nearest == s.size() || distance(s[i], mode) < distance(s[nearest], mode)) nearest = i;
    }
    used[nearest] = true;
    result.push_back(nearest);
  }
  return result;
}

/// Number of different modes: at a coincidence fewer than beside it.
std::size_t n_distinct(const std::vector<Complex>& modes) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    count += std::none_of(modes.begin(), modes.begin() + static_cast<std::ptrdiff_t>(i), [&](Complex other) {
      return distance_from_mode(other, modes[i]) <= 1e-7 * std::abs(modes[i]);
    });
  }
  return count;
}

using ModesAt = std::function<std::vector<Complex>(double)>;

/// Follows the labels that stand on the modes at the first grid point within [low, high] through that
/// stretch; from the second one if modes coincide at the first. Counts those that are on another mode.
int wrong_tracks(const LabelledLoci& loci, double low, double high, const ModesAt& modes) {
  std::vector<std::size_t> points;
  for (std::size_t k = 0; k < loci.p.size(); ++k) {
    if (loci.p[k] >= low && loci.p[k] <= high) points.push_back(k);
  }
  if (points.size() < 2) return 0;
  const bool coincide = n_distinct(modes(loci.p[points[0]])) < n_distinct(modes(loci.p[points[1]]));
  const std::size_t start = coincide ? 1 : 0;
  const auto label_of = labels_on(modes(loci.p[points[start]]), loci.s[points[start]]);
  std::vector<bool> wrong(label_of.size(), false);
  for (std::size_t k = start + 1; k < points.size(); ++k) {
    const std::vector<Complex> reference = modes(loci.p[points[k]]);
    for (std::size_t i = 0; i < reference.size(); ++i) {
      if (on_another_mode(loci.s[points[k]][label_of[i]], i, reference)) wrong[i] = true;
    }
  }
  return static_cast<int>(std::count(wrong.begin(), wrong.end(), true));
}

}  // namespace

GridSpectra spectra_on_grid(const TraceSetup& setup, double from, double to, int n_points) {
  const PathProblem problem = problem_along(*setup.model, setup.options.parameter);
  RunCounts counts;
  GridSpectra result;
  EquilibriumGuess guess{setup.model->initial_guess(parameters_at(problem, from)), {}};
  for (int k = 0; k < n_points; ++k) {
    const double part = static_cast<double>(k) / (n_points - 1);
    const PathPoint point = reduce_at(problem, from + part * (to - from), guess, Matrix(), counts);
    if (point.status != PointStatus::computed) {
      result.complete = false;
      break;
    }
    guess = {point.equilibrium.x, point.equilibrium.lambda, true};
    result.points.push_back(spectrum_at(point));
  }
  return result;
}

GridSpectra spectra_on_grid(const HardCase& hard_case, int n_points) {
  const TraceSetup setup = prepare_trace(parse_scene(hard_case.scene, hard_case.name + ".toml"), {});
  return spectra_on_grid(setup, hard_case.from, hard_case.to, n_points);
}

LabelledLoci carry_labels(const GridSpectra& spectra, Carrier carrier) {
  LabelledLoci loci;
  loci.complete = spectra.complete;
  std::vector<int> labels;
  for (std::size_t k = 0; k < spectra.points.size(); ++k) {
    const GridSpectra::Point& point = spectra.points[k];
    if (k == 0) {
      for (std::size_t i = 0; i < point.s.size(); ++i) labels.push_back(static_cast<int>(i));
    } else {
      labels = successors(spectra.points[k - 1], point, labels, carrier);
    }
    loci.p.push_back(point.p);
    std::vector<Complex>& s = loci.s.emplace_back();
    for (const int label : labels) s.push_back(point.s[static_cast<std::size_t>(label)]);
  }
  return loci;
}

int count_wrong_tracks(const HardCase& hard_case, const LabelledLoci& loci) {
  if (hard_case.has_branches) {
    const auto [low, high] = std::minmax(hard_case.from, hard_case.to);
    return wrong_tracks(loci, low, high, [&](double p) {
      std::vector<Complex> modes;
      for (const auto& branch : hard_case.branches) modes.push_back(branch(p));
      return modes;
    });
  }
  int count = 0;
  for (const LabelledStretch& stretch : reference_labels(hard_case)) {
    // Loci on a grid of the parameter stay on the branch they started on.
    if (stretch.branch() == 0) count += wrong_tracks(loci, stretch.low(), stretch.high(), stretch);
  }
  return count;
}

}  // namespace eigentrail::test
