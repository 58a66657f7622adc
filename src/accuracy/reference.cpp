#include "eigentrail/accuracy/reference.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <span>

#include "continuation/tracks/starting_tracks.hpp"
#include "eigentrail/modes/spectrum.hpp"

namespace eigentrail {
namespace {

// The first two stages: the reduced pencil at one point with 113 bits.

/// The pencil s^2 M + s C + K; all matrices are (n - rank A) x (n - rank A).
struct ExtendedPencil {
  ExtendedMatrix M, C, K;
  double correction = 0.0;  ///< largest last correction of the equilibrium and the basis, relative
};

/// Calls correct(), which applies a correction and returns its relative size, until the size no longer halves
/// or is at the rounding level of 113 bits (2^-113 = 1e-34). Returns the last size.
template <class Correct>
double refine_to_rounding(Correct&& correct) {
  constexpr int most_corrections = 60;
  constexpr double rounding = 1e-33;
  double last = INFINITY;
  for (int i = 0; i < most_corrections; ++i) {
    const double size = correct();
    if (!(size > rounding) || size > 0.5 * last) return size;
    last = size;
  }
  return last;
}

using ExtendedPath = BasicPath<Extended>;

double largest(const Vector& values) {
  return values.size() == 0 ? 0.0 : values.lpNorm<Eigen::Infinity>();
}

double relative(double change, double whole) {
  return whole > 0.0 ? change / whole : change;
}

/// Newton corrections of (x, lambda). The correction of the multipliers is measured by that of the reaction
/// A^T lambda, because lambda itself is not unique if constraints are redundant. Returns the last relative
/// correction; NaN if a residual cannot be evaluated.
double refine_equilibrium(const Model& model, const Equilibrium& equilibrium, ExtendedPath& path) {
  if (!equilibrium.kkt.can_solve()) return 0.0;  // the equilibrium is known exactly
  const SystemMatrix& A = equilibrium.linearization.A[0];
  const double length = largest(equilibrium.x);
  // The scale of forces is the reaction, or stiffness times length if the constraints carry no load.
  const Eigen::Index m = model.n_constraints();
  const double force = std::max(largest(A.transposed_times(equilibrium.lambda.head(m))),
                                equilibrium.linearization.K[0].largest_entry() * length);
  return refine_to_rounding([&]() -> double {
    BasicSteadyResidual<Extended> residual;
    if (model.extended_residual(path, residual)) return NAN;
    Vector dx, dl;
    equilibrium.kkt.solve(-to_double(residual.force.col(0)), -to_double(residual.constraint.col(0)), dx, dl);
    path.x.col(0) += dx.cast<Extended>();
    path.lambda.col(0) += dl.cast<Extended>();
    return std::max(relative(largest(dx), length), relative(largest(A.transposed_times(dl.head(m))), force));
  });
}

/// Repeats T <- T - A+ (A T), with the pseudo-inverse A+, until A T vanishes within rounding of 113 bits. T
/// is then a null-space basis that is orthonormal to double precision. Returns the last correction.
double refine_basis(const ConstraintFactorization& constraints, const BasicSystemMatrix<Extended>& A,
                    ExtendedMatrix& T) {
  if (constraints.rank() == 0 || T.size() == 0) return 0.0;
  return refine_to_rounding([&] {
    const Matrix change = constraints.pseudo_inverse_times(to_double(A * T));
    T -= change.cast<Extended>();
    return change.cwiseAbs().maxCoeff();
  });
}

/// Refines the equilibrium and the tangent basis of a point, and projects the linearization onto the basis.
/// Empty if the model cannot be evaluated in extended precision or a correction is not finite.
std::optional<ExtendedPencil> extended_pencil(const PathProblem& problem, const PathPoint& point) {
  ExtendedPath path{parameters_at(problem, point.p).cast<Extended>(), point.equilibrium.x.cast<Extended>(),
                    point.equilibrium.lambda.cast<Extended>()};
  ExtendedPencil pencil;
  const double moved = refine_equilibrium(problem.model, point.equilibrium, path);
  BasicLinearization<Extended> full;
  if (!std::isfinite(moved) || problem.model.extended_linearization(path, full)) return std::nullopt;
  ExtendedMatrix T = point.basis.T[0].cast<Extended>();
  const double turned = refine_basis(point.equilibrium.kkt.constraints(), full.A[0], T);
  // Most entries of the basis are zero where constraints hold a few coordinates each.
  const auto projected = [&T](const BasicSystemMatrix<Extended>& B) {
    const ExtendedMatrix BT = B * T;
    ExtendedMatrix result = ExtendedMatrix::Zero(T.cols(), T.cols());
    for (Eigen::Index i = 0; i < T.cols(); ++i) {
      for (Eigen::Index k = 0; k < T.rows(); ++k) {
        if (T(k, i) != Extended(0.0)) result.row(i) += T(k, i) * BT.row(k);
      }
    }
    return result;
  };
  pencil.M = projected(full.M[0]);
  pencil.C = projected(full.C[0]);
  pencil.K = projected(full.K[0]);
  pencil.correction = std::max(moved, turned);
  return pencil;
}

ExtendedComplexMatrix multiply(const ExtendedMatrix& B, const ExtendedComplexMatrix& Z) {
  const ExtendedMatrix real = B.lazyProduct(Z.real());
  const ExtendedMatrix imag = B.lazyProduct(Z.imag());
  ExtendedComplexMatrix product(B.rows(), Z.cols());
  product.real() = real;
  product.imag() = imag;
  return product;
}

ExtendedComplexMatrix to_extended(const ComplexMatrix& values) {
  return values.unaryExpr([](const Complex& c) { return ExtendedComplex(c.real(), c.imag()); });
}

ComplexMatrix rounded(const ExtendedComplexMatrix& values) {
  return values.unaryExpr([](const ExtendedComplex& c) { return to_double(c); });
}

/// Refines an invariant pair that has converged in double precision. Sets Lambda and returns its last
/// relative correction.
double refine_pair(const ExtendedPencil& pencil, const InvariantPair& pair, double reference,
                   ExtendedComplexMatrix& Lambda) {
  const Eigen::Index n = pair.Z.rows();
  const Eigen::Index k = pair.size();
  ExtendedComplexMatrix Z = to_extended(pair.Z);
  Lambda = to_extended(pair.Lambda);
  const ExtendedComplexMatrix W0 = to_extended(pair.W.topRows(n).adjoint());
  const ExtendedComplexMatrix W1 = to_extended(pair.W.bottomRows(n).adjoint());
  ComplexMatrix dZ, dLambda;
  return refine_to_rounding([&] {
    const ExtendedComplexMatrix slope = multiply(pencil.M, Z).lazyProduct(Lambda) + multiply(pencil.C, Z);
    const ExtendedComplexMatrix residual = slope.lazyProduct(Lambda) + multiply(pencil.K, Z);
    const ExtendedComplexMatrix W1Z = W1.lazyProduct(Z);
    const ExtendedComplexMatrix defect =
        W0.lazyProduct(Z) + W1Z.lazyProduct(Lambda) - ExtendedComplexMatrix::Identity(k, k);
    pair.factors->solve(-rounded(residual), -rounded(defect), dZ, dLambda);
    Z += to_extended(dZ);
    Lambda += to_extended(dLambda);
    return dLambda.norm() / std::max(pair.Lambda.norm(), reference);
  });
}

/// Makes values that are real or conjugate but for rounding exactly so.
void make_conjugate(std::vector<ExtendedComplex>& values) {
  const auto imag = [](const ExtendedComplex& s) { return abs(s.imag()); };
  std::ranges::sort(values, std::greater(), imag);
  for (std::span<ExtendedComplex> rest(values); !rest.empty();) {
    ExtendedComplex& one = rest.front();
    const auto distance = [&](const ExtendedComplex& other) {
      return std::abs(to_double(other - std::conj(one)));
    };
    ExtendedComplex& partner = *std::ranges::min_element(rest, {}, distance);  // itself if it is real
    if (&partner == &one) {
      one = one.real();
      rest = rest.subspan(1);
    } else {
      one = (one + std::conj(partner)) / ExtendedComplex(2.0);
      partner = std::conj(one);
      std::swap(rest[1], partner);
      rest = rest.subspan(2);
    }
  }
}

/// Eigenvalues of a block. Those of a real block are exactly real or conjugate.
std::vector<ExtendedComplex> eigenvalues(const ExtendedComplexMatrix& Lambda, bool real) {
  const Eigen::Index k = Lambda.rows();
  if (k == 1) return {Lambda(0, 0)};
  // The distances from the mean keep more digits.
  ExtendedComplex mean = Lambda.trace() / ExtendedComplex(static_cast<double>(k));
  if (real) mean = mean.real();
  // Other solvers of the library take the compiler half a minute with these numbers.
  const Eigen::ComplexSchur<ExtendedComplexMatrix> schur(
      Lambda - mean * ExtendedComplexMatrix::Identity(k, k), false);
  const auto distances = schur.matrixT().diagonal();
  std::vector<ExtendedComplex> result(distances.begin(), distances.end());
  if (real) make_conjugate(result);
  for (ExtendedComplex& s : result) s += mean;
  return result;
}

/// Eigenvalues that differ by less than this, relative to their magnitude, are refined together as one block.
constexpr double same_cluster = 1e-3;

/// Which modes are as near to one of the followed eigenvalues as the nearest one; all of them without any.
std::vector<bool> beside(const std::optional<ComplexVector>& followed, const std::vector<StartingMode>& modes,
                         double reference) {
  std::vector<bool> result(modes.size(), !followed);
  if (!followed || modes.empty()) return result;
  for (const Complex value : *followed) {
    if (!std::isfinite(value.real())) continue;
    const auto distance = [value](const StartingMode& mode) { return std::abs(mode.s - value); };
    const double close = same_cluster * std::max(std::abs(value), reference);
    const double nearest = distance(*std::ranges::min_element(modes, {}, distance));
    for (std::size_t i = 0; i < modes.size(); ++i)
      result[i] = result[i] || distance(modes[i]) <= nearest + close;
  }
  return result;
}

/// Refines the groups of eigenvalues with followed ones, and adds all those with Im s >= 0 to the result.
void refine_modes(const ExtendedPencil& extended, const std::optional<ComplexVector>& followed,
                  double reference, ReferenceSpectrum& result) {
  const ReducedPencil pencil{{to_double(extended.M)}, {to_double(extended.C)}, {to_double(extended.K)}};
  const Spectrum spectrum = compute_spectrum(pencil.M[0], pencil.C[0], pencil.K[0]);
  result.status = ReferenceStatus::no_spectrum;
  if (spectrum.status != SpectrumStatus::complete) return;
  result.status = ReferenceStatus::not_converged;
  const PencilAtPoint at_point(pencil);
  const std::vector<bool> is_beside = beside(followed, spectrum.modes, reference);
  const auto is_wanted = [&](int mode) { return mode >= 0 && is_beside[static_cast<std::size_t>(mode)]; };
  ModeCounts counts;
  for (const StartingGroup& group :
       starting_groups(pencil, spectrum.modes, static_cast<int>(spectrum.modes.size()), reference, reference,
                       same_cluster)) {
    const bool real = group.pair.is_real;
    std::vector<ExtendedComplex> found;
    if (std::ranges::any_of(group.modes, is_wanted)) {
      const InvariantPair pair = correct_pair(at_point, group.pair, reference, {}, counts);
      if (pair.status != PairStatus::converged) return;
      ExtendedComplexMatrix Lambda;
      const double last = refine_pair(extended, pair, reference, Lambda);
      if (!(last <= reference_accuracy)) return;
      result.correction = std::max(result.correction, last);
      found = eigenvalues(Lambda, real);
    } else {
      for (const Complex s : group.roots) found.emplace_back(s.real(), s.imag());
    }
    for (const ExtendedComplex& s : found) {
      if (!real || s.imag() >= Extended(0.0)) result.s.push_back(s);
    }
  }
  result.status = ReferenceStatus::converged;
}

}  // namespace

std::vector<Complex> ReferenceSpectrum::nearest_doubles() const {
  std::vector<Complex> doubles;
  for (const ExtendedComplex& value : s) doubles.push_back(to_double(value));
  return doubles;
}

ReferenceSpectrum reference_spectrum(const PathProblem& problem, double p, const EquilibriumGuess& guess,
                                     const std::optional<ComplexVector>& followed) {
  ReferenceSpectrum result;
  RunCounts counts;
  const PathPoint point = reduce_at(problem, p, guess, Matrix(), counts);
  result.status = ReferenceStatus::no_equilibrium;
  if (point.status != PointStatus::computed) return result;
  const std::optional<ExtendedPencil> pencil = extended_pencil(problem, point);
  result.status = ReferenceStatus::not_available;
  if (!pencil) return result;
  result.status = ReferenceStatus::no_equilibrium;
  if (pencil->correction > reference_accuracy) return result;
  result.correction = pencil->correction;
  refine_modes(*pencil, followed, problem.s_ref, result);
  return result;
}

}  // namespace eigentrail
