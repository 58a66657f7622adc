#include "eigentrail/modes/mode.hpp"

#include <algorithm>
#include <cmath>

namespace eigentrail {
namespace {

constexpr int max_refinements = 40;
constexpr double stagnation = 1e-11;
constexpr double rounding = 1e-15;

/// Real matrix times complex vector as one real product with two columns.
ComplexVector multiply(const Matrix& B, const ComplexVector& z) {
  Eigen::Matrix<double, Eigen::Dynamic, 2> parts(z.size(), 2);
  parts << z.real(), z.imag();
  const Eigen::Matrix<double, Eigen::Dynamic, 2> product = B * parts;
  ComplexVector result(z.size());
  result.real() = product.col(0);
  result.imag() = product.col(1);
  return result;
}

/// Corrects an approximate solution until its corrections stop shrinking or vanish; `correct` returns the
/// size of one correction relative to the solution.
template <class Correct>
void refine(Correct&& correct) {
  double last = INFINITY;
  for (int i = 0; i < max_refinements; ++i) {
    const double size = correct();
    // The first solution is a correction of relative size one, and with factors from a distant prediction the
    // next may not be much smaller: corrections that do not halve end the refinement only at the level of
    // rounding.
    if (!(size > rounding) || (size > 0.5 * last && size < stagnation)) return;
    last = size;
  }
}

}  // namespace

PencilAtPoint::PencilAtPoint(const ReducedPencil& pencil)
    : M(pencil.M[0]), C(pencil.C[0]), K(pencil.K[0]), norm_M(M.norm()), norm_C(C.norm()), norm_K(K.norm()) {}

ComplexMatrix PencilAtPoint::matrix(Complex s) const {
  ComplexMatrix P(M.rows(), M.cols());
  const Complex s2 = s * s;
  P.real() = s2.real() * M + s.real() * C + K;
  P.imag() = s2.imag() * M + s.imag() * C;
  return P;
}

ComplexVector PencilAtPoint::times(Complex s, const ComplexVector& z) const {
  return (s * s) * multiply(M, z) + s * multiply(C, z) + multiply(K, z);
}

ComplexVector PencilAtPoint::slope(Complex s, const ComplexVector& z) const {
  return (2.0 * s) * multiply(M, z) + multiply(C, z);
}

double PencilAtPoint::magnitude(Complex s) const {
  const double a = std::abs(s);
  return (a * norm_M + norm_C) * a + norm_K;
}

BorderedFactorization::BorderedFactorization(const PencilAtPoint& pencil, Complex s, const ComplexVector& z,
                                             const ComplexVector& c) {
  const Eigen::Index n = z.size();
  ComplexMatrix B(n + 1, n + 1);
  B.topLeftCorner(n, n) = pencil.matrix(s);
  const ComplexVector slope = pencil.slope(s, z);
  // The border gets the size of the terms of P, not of their sum, which vanishes at an eigenvalue when n = 1.
  const double size = std::max(pencil.magnitude(s) / std::sqrt(static_cast<double>(n)), 1e-300);
  const auto scale_to_size = [size](double norm) { return norm > 0.0 ? size / norm : size; };
  slope_scale_ = scale_to_size(slope.norm());
  border_scale_ = scale_to_size(c.norm());
  B.topRightCorner(n, 1) = slope_scale_ * slope;
  B.bottomLeftCorner(1, n) = border_scale_ * c.adjoint();
  B(n, n) = 0.0;
  lu_.compute(B);
}

void BorderedFactorization::solve(const ComplexVector& r, ComplexVector& dz, Complex& ds) const {
  const Eigen::Index n = r.size();
  ComplexVector right(n + 1);
  right << r, Complex(0.0);
  const ComplexVector solution = lu_.solve(right);
  dz = solution.head(n);
  ds = slope_scale_ * solution[n];
}

ComplexVector BorderedFactorization::solve_adjoint(const ComplexVector& r, Complex gamma) const {
  const Eigen::Index n = r.size();
  ComplexVector right(n + 1);
  right << r, slope_scale_ * gamma;
  const ComplexVector solution = lu_.adjoint().solve(right);
  return solution.head(n);
}

namespace {

/// Chord-Newton on (s, z); leaves factors at the last pair that was factored.
ModeStatus newton(const PencilAtPoint& pencil, double s_ref, const CorrectorOptions& options, Mode& mode,
                  ModeCounts& counts) {
  const auto factor = [&] {
    mode.factors.emplace(pencil, mode.s, mode.z, mode.c);
    ++counts.factorizations;
  };
  factor();
  double last = INFINITY;
  int refactorizations = 0;
  ComplexVector dz;
  Complex ds;
  for (int i = 0; i < options.max_iterations; ++i) {
    mode.factors->solve(-pencil.times(mode.s, mode.z), dz, ds);
    ++counts.solves;
    ++counts.iterations;
    mode.z += dz;
    mode.s += ds;
    const double size = std::max(dz.norm() / mode.z.norm(), std::abs(ds) / std::max(std::abs(mode.s), s_ref));
    if (!std::isfinite(size)) return ModeStatus::singular;
    if (size <= options.tolerance) return ModeStatus::converged;
    const double contraction = size / last;
    if (contraction > 0.5 && size < 1e-10) return ModeStatus::converged;  // rounding: no longer shrinking
    if (contraction > options.refactor_contraction) {
      if (std::isfinite(last) && contraction > 2.0) return ModeStatus::not_converged;
      if (++refactorizations > 6 && contraction > 0.9) return ModeStatus::not_converged;
      if (size > 1e-12) factor();
    }
    last = size;
  }
  return ModeStatus::not_converged;
}

/// Left vector from B^H [y; t] = [0; 1], refined with the exact P.
void left_vector(const PencilAtPoint& pencil, Mode& mode, ModeCounts& counts) {
  const ComplexMatrix P = pencil.matrix(mode.s);
  mode.y = mode.factors->solve_adjoint(ComplexVector::Zero(mode.z.size()), 1.0);
  ++counts.solves;
  refine([&] {
    const ComplexVector dy = mode.factors->solve_adjoint(-(P.adjoint() * mode.y), 0.0);
    ++counts.solves;
    mode.y += dy;
    return dy.norm() / mode.y.norm();
  });
  mode.y.normalize();
}

}  // namespace

Mode correct_mode(const PencilAtPoint& pencil, Complex s, const ComplexVector& z, double s_ref,
                  const CorrectorOptions& options, ModeCounts& counts) {
  Mode mode;
  mode.s = s;
  mode.z = z.normalized();
  mode.c = mode.z;
  mode.status = newton(pencil, s_ref, options, mode, counts);
  if (mode.status != ModeStatus::converged) return mode;
  left_vector(pencil, mode, counts);
  const Complex slope = mode.y.dot(pencil.slope(mode.s, mode.z));
  const Complex rest = mode.y.dot(pencil.times(mode.s, mode.z));
  if (std::abs(slope) > 0.0) mode.s -= rest / slope;
  const double magnitude = pencil.magnitude(mode.s);
  const double length = mode.z.norm();
  mode.backward_error = magnitude > 0.0 ? pencil.times(mode.s, mode.z).norm() / (magnitude * length) : 0.0;
  mode.condition = magnitude * length / (std::max(std::abs(mode.s), s_ref) * std::abs(slope));
  return mode;
}

ModeSeries differentiate_mode(const ReducedPencil& pencil, const Mode& mode, int order, ModeCounts& counts) {
  const Eigen::Index n = mode.z.size();
  const PencilAtPoint point(pencil);
  ModeSeries series{ComplexVector::Zero(order + 1), ComplexVectorSeries::Zero(n, order + 1)};
  series.s[0] = mode.s;
  series.z.col(0) = mode.z;
  const ComplexVector slope = point.slope(mode.s, mode.z);

  // Coefficient k of B(h) z(h) without the term B_0 z_k.
  const auto product = [&](const MatrixSeries& B, int k) {
    ComplexVector sum = ComplexVector::Zero(n);
    for (int j = 1; j <= k && j < static_cast<int>(B.size()); ++j) sum += multiply(B[j], series.z.col(k - j));
    return sum;
  };
  ComplexVectorSeries Mz(n, order + 1), Cz(n, order + 1);
  Mz.col(0) = multiply(pencil.M[0], mode.z);
  Cz.col(0) = multiply(pencil.C[0], mode.z);
  ComplexVector s2 = ComplexVector::Zero(order + 1);
  s2[0] = mode.s * mode.s;

  for (int k = 1; k <= order; ++k) {
    // Everything below treats s_k and z_k as zero: what remains is the right side of the bordered system.
    Mz.col(k) = product(pencil.M, k);
    Cz.col(k) = product(pencil.C, k);
    for (int i = 1; i < k; ++i) s2[k] += series.s[i] * series.s[k - i];
    ComplexVector rest = product(pencil.K, k);
    for (int i = 0; i <= k; ++i) rest += s2[i] * Mz.col(k - i) + series.s[i] * Cz.col(k - i);

    ComplexVector z_k = ComplexVector::Zero(n);
    Complex s_k = 0.0;
    refine([&] {
      ComplexVector dz;
      Complex ds;
      mode.factors->solve(-rest - point.times(mode.s, z_k) - s_k * slope, dz, ds);
      ++counts.solves;
      z_k += dz;
      s_k += ds;
      const double total = z_k.norm() * std::abs(mode.s) + std::abs(s_k);
      return total > 0.0 ? (dz.norm() * std::abs(mode.s) + std::abs(ds)) / total : 0.0;
    });
    series.s[k] = s_k;
    series.z.col(k) = z_k;
    s2[k] += 2.0 * mode.s * s_k;
    Mz.col(k) += multiply(pencil.M[0], z_k);
    Cz.col(k) += multiply(pencil.C[0], z_k);
  }
  return series;
}

}  // namespace eigentrail
