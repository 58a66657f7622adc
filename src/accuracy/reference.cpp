#include "eigentrail/accuracy/reference.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <span>

#include "accuracy/spectrum_distance.hpp"
#include "core/connected_groups.hpp"
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

/// Eigenvalues that differ by less than this, relative to their magnitude, are refined together as one block.
constexpr double same_cluster = 1e-3;

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

/// Groups of close eigenvalues, as indices into `s`, which contains both members of complex pairs.
Groups clusters(const std::vector<Complex>& s, double reference) {
  return connected_groups(static_cast<Eigen::Index>(s.size()), [&](Eigen::Index i, Eigen::Index j) {
    const Complex a = s[static_cast<std::size_t>(i)], b = s[static_cast<std::size_t>(j)];
    return std::abs(a - b) <= same_cluster * std::max({std::abs(a), std::abs(b), reference});
  });
}

/// The finite eigenvalues, with both members of complex pairs, and the index of the mode of each.
struct SpectrumMembers {
  std::vector<Complex> s;
  std::vector<std::size_t> mode;

  explicit SpectrumMembers(const Spectrum& spectrum) {
    for (std::size_t i = 0; i < spectrum.modes.size(); ++i) {
      const std::vector<Complex> own = with_conjugates({spectrum.modes[i].s});
      s.insert(s.end(), own.begin(), own.end());
      mode.insert(mode.end(), own.size(), i);
    }
  }

  /// Whether a group contains the conjugates of all its members, so that its block can be real.
  bool closed(const std::vector<std::size_t>& group) const {
    return std::all_of(group.begin(), group.end(), [&](std::size_t i) {
      return s[i].imag() == 0.0 || std::any_of(group.begin(), group.end(),
                                               [&](std::size_t j) { return j != i && mode[j] == mode[i]; });
    });
  }

  Complex mean(const std::vector<std::size_t>& group) const {
    Complex sum = 0.0;
    for (const std::size_t i : group) sum += s[i];
    return sum / static_cast<double>(group.size());
  }
};

InvariantPair starting_pair(const ReducedPencil& pencil, const Spectrum& spectrum,
                            const SpectrumMembers& members, const std::vector<std::size_t>& group,
                            double reference) {
  const bool real = members.closed(group);
  const Complex mean = members.mean(group);
  if (group.size() > 1) {
    return invariant_subspace(pencil.M[0], pencil.C[0], pencil.K[0], real ? mean.real() : mean,
                              static_cast<Eigen::Index>(group.size()), real, reference);
  }
  const StartingMode& mode = spectrum.modes[members.mode[group[0]]];
  InvariantPair pair;
  pair.is_real = real;
  pair.Z = mode.z;
  if (real) {
    // The eigenvector of a real eigenvalue is real except for a complex factor.
    Eigen::Index largest = 0;
    mode.z.cwiseAbs().maxCoeff(&largest);
    pair.Z = (mode.z / mode.z[largest]).real().cast<Complex>();
  }
  pair.Lambda = ComplexMatrix::Constant(1, 1, mode.s);
  return pair;
}

/// Which members are as near to one of the followed eigenvalues as the nearest one; all of them without any.
std::vector<bool> beside(const std::optional<ComplexVector>& followed, const std::vector<Complex>& s,
                         double reference) {
  std::vector<bool> result(s.size(), !followed);
  if (!followed) return result;
  for (const Complex value : *followed) {
    const auto distance = [value](const Complex& other) { return std::abs(other - value); };
    if (s.empty() || !std::isfinite(value.real())) continue;
    const double close = same_cluster * std::max(std::abs(value), reference);
    const double nearest = distance(*std::ranges::min_element(s, {}, distance));
    for (std::size_t i = 0; i < s.size(); ++i) result[i] = result[i] || distance(s[i]) <= nearest + close;
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
  const SpectrumMembers members(spectrum);
  const std::vector<bool> is_wanted = beside(followed, members.s, reference);
  ModeCounts counts;
  for (const auto& indices : clusters(members.s, reference)) {
    const std::vector<std::size_t> group(indices.begin(), indices.end());
    const bool real = members.closed(group);
    if (!real && members.mean(group).imag() < 0.0) continue;
    std::vector<ExtendedComplex> found;
    if (std::ranges::any_of(group, [&](std::size_t i) { return is_wanted[i]; })) {
      const InvariantPair pair = correct_pair(
          at_point, starting_pair(pencil, spectrum, members, group, reference), reference, {}, counts);
      if (pair.status != PairStatus::converged) return;
      ExtendedComplexMatrix Lambda;
      const double last = refine_pair(extended, pair, reference, Lambda);
      if (!(last <= reference_accuracy)) return;
      result.correction = std::max(result.correction, last);
      found = eigenvalues(Lambda, real);
    } else {
      for (const std::size_t i : group) found.emplace_back(members.s[i].real(), members.s[i].imag());
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
