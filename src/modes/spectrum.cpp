#include "eigentrail/modes/spectrum.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>

#include "core/lapack.hpp"
#include "core/orthonormal.hpp"
#include "core/positive_or_one.hpp"
#include "core/reciprocal_condition.hpp"
#include "eigentrail/reduction/complex_blocks.hpp"
#include "modes/companion_form.hpp"

namespace eigentrail {
namespace {

/// An eigenvalue of the scaled pencil with |beta| below this fraction of |alpha| is infinite. Rounding times
/// the condition of infinite eigenvalues: that of a rotor with six annuli of inflow has 1.4e-13. With a
/// larger value eigenvalues that are finite are left out, but at 1e12 times the scale of the system rounding
/// of its matrices is as large as what they are computed from.
constexpr double infinite = 1e-12;
/// A matrix with a pivot below this fraction of the largest one is singular to working precision.
constexpr double singular_pivot = 1e-15;
/// Reciprocal condition of an equilibrated M above which M is inverted: the digits that the eigenvalues lose
/// do not matter, because they are corrected later.
constexpr double well_conditioned = 1e-4;

struct Scaling {
  double gamma = 1.0;  ///< s = gamma mu, mu the eigenvalue of the scaled pencil
  double delta = 1.0;  ///< common factor of the scaled matrices
};

template <class Values>
Scaling fan_lin_van_dooren(const Values& M, const Values& C, const Values& K) {
  const double m = M.norm();
  const double c = C.norm();
  const double k = K.norm();
  Scaling scaling;
  if (m > 0.0 && k > 0.0) {
    scaling.gamma = std::sqrt(k / m);
  } else if (m > 0.0 && c > 0.0) {
    scaling.gamma = c / m;
  } else if (c > 0.0 && k > 0.0) {
    scaling.gamma = k / c;
  }
  const double sum = k + c * scaling.gamma;
  if (sum > 0.0) scaling.delta = 2.0 / sum;
  return scaling;
}

/// Factors of the rows and columns of a matrix that make the largest entry of each column one, and that of
/// each row at least one: entries of very different magnitude, as of other units, then do not make it
/// singular.
template <class Values>
struct Equilibration {
  Vector rows, columns;

  explicit Equilibration(const Values& A)
      : rows(A.cwiseAbs().rowwise().maxCoeff().unaryExpr(&positive_or_one).cwiseInverse()),
        columns((rows.asDiagonal() * A)
                    .cwiseAbs()
                    .colwise()
                    .maxCoeff()
                    .transpose()
                    .unaryExpr(&positive_or_one)
                    .cwiseInverse()) {}
  Values of(const Values& A) const { return rows.asDiagonal() * A * columns.asDiagonal(); }
};

/// Whether P is singular to working precision.
bool is_singular_matrix(const ComplexMatrix& P) {
  const Eigen::PartialPivLU<ComplexMatrix> lu(Equilibration<ComplexMatrix>(P).of(P));
  const Vector pivots = lu.matrixLU().diagonal().cwiseAbs();
  return !(pivots.minCoeff() > singular_pivot * pivots.maxCoeff());
}

/// A pencil is singular if det P(mu) is zero for all mu. It is tested at three values of mu that have no
/// special position.
template <class Values>
bool is_singular(const Values& M, const Values& C, const Values& K) {
  for (const Complex mu : {Complex(0.8, 0.6), Complex(-0.28, 0.96), Complex(1.9, -0.7)}) {
    if (!is_singular_matrix((mu * mu) * M.template cast<Complex>() + mu * C.template cast<Complex>() +
                            K.template cast<Complex>()))
      return false;
  }
  return true;
}

/// The eigenvector z of [z; mu z] with the velocities of all or some of the n coordinates: z, or with all
/// velocities the larger half.
ComplexVector right_vector(const ComplexVector& both, Eigen::Index n) {
  const bool upper = both.size() < 2 * n || both.head(n).norm() >= both.tail(n).norm();
  return (upper ? both.head(n) : both.tail(n)).normalized();
}

/// All eigenvalues mu = alpha / beta of a pencil whose entries are such numbers; conjugates of a real pencil
/// are neighbours, that with Im mu > 0 first.
template <class Scalar>
struct Homogeneous {
  explicit Homogeneous(Eigen::Index count) : alpha(count), beta(count) { beta.setOnes(); }

  ComplexVector alpha;
  Eigen::Vector<Scalar, Eigen::Dynamic> beta;
  ComplexMatrix vectors = {};  ///< in columns, as far as Im mu >= 0; empty if not requested
};

template <class Scalar>
using Eigenvalues = std::optional<Homogeneous<Scalar>>;  ///< empty if LAPACK does not converge

/// Of a y = mu b y, by the QZ algorithm, which overwrites a and b.
Eigenvalues<double> qz(Matrix& a, Matrix& b, bool with_vectors) {
  const auto size = static_cast<lapack_int>(a.rows());
  Homogeneous<double> all(size);
  Vector real(size), imag(size);
  Matrix V;  // of a conjugate pair, the real part of the vector and the imaginary part are neighbours
  if (with_vectors) V.resize(size, size);
  const lapack_int info = LAPACKE_dggev(LAPACK_COL_MAJOR, 'N', with_vectors ? 'V' : 'N', size, a.data(), size,
                                        b.data(), size, real.data(), imag.data(), all.beta.data(), nullptr, 1,
                                        with_vectors ? V.data() : nullptr, size);
  if (info != 0) return std::nullopt;
  all.alpha.real() = real;
  all.alpha.imag() = imag;
  all.vectors = V.cast<Complex>();
  for (Eigen::Index j = 0; j < V.cols(); ++j) {
    if (imag[j] > 0.0) all.vectors.col(j).imag() = V.col(j + 1);
  }
  return all;
}

Eigenvalues<Complex> qz(ComplexMatrix& a, ComplexMatrix& b, bool with_vectors) {
  const auto size = static_cast<lapack_int>(a.rows());
  Homogeneous<Complex> all(size);
  if (with_vectors) all.vectors.resize(size, size);
  const lapack_int info = LAPACKE_zggev(LAPACK_COL_MAJOR, 'N', with_vectors ? 'V' : 'N', size, a.data(), size,
                                        b.data(), size, all.alpha.data(), all.beta.data(), nullptr, 1,
                                        with_vectors ? all.vectors.data() : nullptr, size);
  return info == 0 ? std::optional(std::move(all)) : std::nullopt;
}

/// Of a y = mu y, by the QR algorithm, which overwrites a.
Eigenvalues<double> qr(Matrix& a) {
  const auto size = static_cast<lapack_int>(a.rows());
  Homogeneous<double> all(size);
  Vector real(size), imag(size);
  if (LAPACKE_dgeev(LAPACK_COL_MAJOR, 'N', 'N', size, a.data(), size, real.data(), imag.data(), nullptr, 1,
                    nullptr, 1) != 0)
    return std::nullopt;
  all.alpha.real() = real;
  all.alpha.imag() = imag;
  return all;
}

Eigenvalues<Complex> qr(ComplexMatrix& a) {
  const auto size = static_cast<lapack_int>(a.rows());
  Homogeneous<Complex> all(size);
  const lapack_int info = LAPACKE_zgeev(LAPACK_COL_MAJOR, 'N', 'N', size, a.data(), size, all.alpha.data(),
                                        nullptr, 1, nullptr, 1);
  return info == 0 ? std::optional(std::move(all)) : std::nullopt;
}

/// Coordinates T, x = T y, of which the last have no mass, where M is singular without having such
/// coordinates: those of a part are combinations of all. Empty where M is regular, or has them. Sets `rank`.
template <class Values>
std::optional<Values> massless_last(const Values& M, Eigen::Index& rank) {
  constexpr double no_mass = 1e-13;  // of the largest, in balanced units
  const Equilibration<Values> equal(M);
  Eigen::ColPivHouseholderQR<Values> qr(equal.of(M).adjoint());
  qr.setThreshold(no_mass);
  rank = qr.rank();
  const Eigen::Index with_mass = (M.cwiseAbs().colwise().maxCoeff().array() > 0.0).count();
  if (rank >= with_mass) return std::nullopt;
  return Values(equal.columns.asDiagonal() * whole_Q(qr));
}

template <class Values>
Eigenvalues<typename Values::Scalar> by_qz(const Values& M, const Values& C, const Values& K,
                                           bool with_vectors) {
  Eigen::Index rank = 0;
  const std::optional<Values> T = massless_last(M, rank);
  if (!T) {
    CompanionForm<Values> form(M, C, K);
    return qz(form.a, form.b, with_vectors);
  }
  const Eigen::Index n = M.rows();
  Values MT = M * *T;
  MT.rightCols(n - rank).setZero();
  CompanionForm<Values> form(MT, C * *T, K * *T);
  auto all = qz(form.a, form.b, with_vectors);
  if (all && with_vectors)
    all->vectors = (T->template cast<Complex>() * all->vectors.topRows(n)).eval();  // without velocities
  return all;
}

/// Eigenvalues only, by the QR algorithm on the companion form with M inverted.
template <class Values>
Eigenvalues<typename Values::Scalar> by_qr(const Eigen::PartialPivLU<Values>& M, const Values& C,
                                           const Values& K) {
  const Eigen::Index n = C.rows();
  Values a = Values::Zero(2 * n, 2 * n);
  a.topRightCorner(n, n).setIdentity();
  a.bottomLeftCorner(n, n) = -M.solve(K);
  a.bottomRightCorner(n, n) = -M.solve(C);
  return qr(a);
}

/// Eigenvalues only, without damping: mu = +-sqrt(-lambda) with the eigenvalues lambda of K z = lambda M z.
/// Those on the axes are exactly there.
Eigenvalues<double> by_squares(const Matrix& M, const Matrix& K) {
  Matrix a = K, b = M;
  const Eigenvalues<double> squares = qz(a, b, false);
  if (!squares) return std::nullopt;
  const Eigen::Index n = M.rows();
  Homogeneous<double> all(2 * n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const Complex alpha = squares->alpha[j];
    const double beta = squares->beta[j];
    const bool is_infinite = std::abs(beta) <= infinite * std::abs(alpha);
    // Real numbers by themselves: those with a zero imaginary part have no sign of it that could be lost.
    const double square = alpha.real() / beta;
    const Complex mu = is_infinite           ? Complex(1.0)
                       : alpha.imag() != 0.0 ? std::sqrt(-alpha / beta)
                       : square > 0.0        ? Complex(0.0, std::sqrt(square))
                                             : Complex(std::sqrt(-square));
    all.alpha[2 * j] = mu;
    all.alpha[2 * j + 1] = -mu;
    all.beta.segment(2 * j, 2).setConstant(is_infinite ? 0.0 : 1.0);
  }
  return all;
}

template <class Values>
Eigenvalues<typename Values::Scalar> eigenvalues_of(const Values& M, const Values& C, const Values& K) {
  if constexpr (std::is_same_v<Values, Matrix>) {
    if (C.isZero(0.0)) return by_squares(M, K);
  }
  const Equilibration<Values> equal(M);
  const Eigen::PartialPivLU<Values> lu(equal.of(M));
  return reciprocal_condition(lu) > well_conditioned ? by_qr<Values>(lu, equal.of(C), equal.of(K))
                                                     : by_qz(M, C, K, false);
}

/// Collects the finite modes with Im s >= 0 in the order of increasing |s|; the others are conjugates of
/// them, or in a complex part of modes of the conjugate part.
template <class Scalar>
void take_modes(const Homogeneous<Scalar>& all, Eigen::Index n, Spectrum& spectrum) {
  spectrum.n_infinite = static_cast<int>(2 * n - all.beta.size());  // velocities that are no states
  for (Eigen::Index j = 0; j < all.beta.size(); ++j) {
    if (std::abs(all.beta[j]) <= infinite * std::abs(all.alpha[j])) {
      ++spectrum.n_infinite;
      continue;
    }
    const Complex s = spectrum.scale * all.alpha[j] / all.beta[j];
    if (s.imag() < 0.0) continue;
    spectrum.modes.push_back({s, {}});
    if (all.vectors.size() > 0) spectrum.modes.back().z = right_vector(all.vectors.col(j), n);
  }
  std::stable_sort(spectrum.modes.begin(), spectrum.modes.end(), comes_before);
}

template <class Values>
Spectrum solve(const Values& M, const Values& C, const Values& K, bool with_vectors) {
  Spectrum spectrum;
  if (M.rows() == 0) {
    spectrum.status = SpectrumStatus::complete;
    return spectrum;
  }
  const Scaling scaling = fan_lin_van_dooren(M, C, K);
  spectrum.scale = scaling.gamma;
  const Values scaled_M = scaling.delta * scaling.gamma * scaling.gamma * M;
  const Values scaled_C = scaling.delta * scaling.gamma * C;
  const Values scaled_K = scaling.delta * K;
  if (is_singular(scaled_M, scaled_C, scaled_K)) {
    spectrum.status = SpectrumStatus::singular_pencil;
    return spectrum;
  }
  const auto all =
      with_vectors ? by_qz(scaled_M, scaled_C, scaled_K, true) : eigenvalues_of(scaled_M, scaled_C, scaled_K);
  if (!all) return spectrum;
  take_modes(*all, M.rows(), spectrum);
  spectrum.status = SpectrumStatus::complete;
  return spectrum;
}

}  // namespace

bool comes_before(const StartingMode& a, const StartingMode& b) {
  const auto key = [](Complex s) { return std::tuple(std::abs(s), s.imag(), s.real()); };
  return key(a.s) < key(b.s);
}

Spectrum compute_spectrum(const Matrix& M, const Matrix& C, const Matrix& K) {
  return solve(M, C, K, true);
}

Spectrum compute_eigenvalues(const Matrix& M, const Matrix& C, const Matrix& K) {
  return solve(M, C, K, false);
}

namespace {

/// Adds the modes of the copies of a part, each behind the mode that it equals.
void add_copies(int copies, Spectrum& spectrum) {
  if (copies == 0) return;
  std::vector<StartingMode> all;
  for (const StartingMode& mode : spectrum.modes) {
    for (int copy = 0; copy <= copies; ++copy) {
      all.push_back(mode);
      all.back().copy = copy;
    }
  }
  spectrum.modes = std::move(all);
  spectrum.n_infinite *= 1 + copies;
}

/// Calls `solve` with the matrices M, C and K of a pencil that does not fall apart, which are complex for a
/// complex part.
template <class Solve>
auto with_matrices(const ReducedPencil& pencil, const Solve& solve) {
  const auto block = [&](const Matrix& A) { return complex_block(A, pencil.complex_sign); };
  return pencil.complex_sign == 0 ? solve(pencil.M[0], pencil.C[0], pencil.K[0])
                                  : solve(block(pencil.M[0]), block(pencil.C[0]), block(pencil.K[0]));
}

/// Vectors of such matrices, n x k, in the coordinates of the pencil.
ComplexMatrix in_pencil(const ReducedPencil& pencil, const ComplexMatrix& Z) {
  return pencil.complex_sign == 0 ? Z : from_complex_coordinates(Z, pencil.complex_sign);
}

Spectrum solve_parts(const ReducedPencil& pencil, bool with_vectors) {
  if (pencil.parts.empty()) {
    Spectrum spectrum = with_matrices(
        pencil, [&](const auto& M, const auto& C, const auto& K) { return solve(M, C, K, with_vectors); });
    for (StartingMode& mode : spectrum.modes) mode.z = in_pencil(pencil, mode.z);
    add_copies(pencil.copies, spectrum);
    return spectrum;
  }
  Spectrum all;
  all.status = SpectrumStatus::complete;
  all.scale = 0.0;
  for (std::size_t i = 0; i < pencil.parts.size(); ++i) {
    Spectrum own = solve_parts(pencil.parts[i], with_vectors);
    if (own.status != SpectrumStatus::complete) return own;
    for (StartingMode& mode : own.modes) mode.part = static_cast<int>(i);
    std::move(own.modes.begin(), own.modes.end(), std::back_inserter(all.modes));
    all.n_infinite += own.n_infinite;
    all.scale = std::max(all.scale, own.scale);
  }
  std::stable_sort(all.modes.begin(), all.modes.end(), comes_before);
  return all;
}

}  // namespace

Spectrum compute_spectrum(const ReducedPencil& pencil) {
  return solve_parts(pencil, true);
}

Spectrum compute_eigenvalues(const ReducedPencil& pencil) {
  return solve_parts(pencil, false);
}

namespace {

template <class Values>
ComplexVector vector_near(const Values& M, const Values& C, const Values& K, Complex s, double s_ref) {
  constexpr int iterations = 4;
  constexpr double offset = 1e-9;  // relative to max(|s|, s_ref): the shift must not equal the eigenvalue
  const Complex sigma = s + offset * std::max(std::abs(s), s_ref);
  const Eigen::PartialPivLU<ComplexMatrix> lu((sigma * sigma) * M.template cast<Complex>() +
                                              sigma * C.template cast<Complex>() +
                                              K.template cast<Complex>());
  // Start vectors without special structure, equal in every run.
  ComplexVector z(M.rows());
  for (Eigen::Index i = 0; i < z.size(); ++i) z[i] = std::sin(1.0 + 1.7 * static_cast<double>(i));
  for (int i = 0; i < iterations; ++i) {
    const ComplexVector slope = 2.0 * sigma * (M * z) + C * z;
    z = lu.solve(slope).normalized();
  }
  return z;
}

}  // namespace

ComplexVector eigenvector_near(const Matrix& M, const Matrix& C, const Matrix& K, Complex s, double s_ref) {
  return vector_near(M, C, K, s, s_ref);
}

ComplexVector eigenvector_near(const ReducedPencil& pencil, Complex s, double s_ref) {
  return in_pencil(pencil, with_matrices(pencil, [&](const auto& M, const auto& C, const auto& K) {
                     return vector_near(M, C, K, s, s_ref);
                   }));
}

namespace {

/// Both eigenvalues of a single freedom, without rounding where stiffness or damping is zero.
InvariantPair pair_of_one_freedom(double m, double c, double k) {
  InvariantPair pair{
      .is_real = true, .Z = ComplexMatrix::Identity(1, 2), .Lambda = ComplexMatrix::Zero(2, 2)};
  pair.Lambda(0, 1) = 1.0;
  pair.Lambda(1, 0) = 0.0 - k / m;
  pair.Lambda(1, 1) = 0.0 - c / m;
  return pair;
}

template <class Values>
InvariantPair subspace_of(const Values& M, const Values& C, const Values& K, Complex centre, Eigen::Index k,
                          bool is_real, double least_scale) {
  constexpr int iterations = 6;
  constexpr double offset = 1e-5;  // relative to |mu|: the shift must not equal an eigenvalue
  const Eigen::Index n = M.rows();
  Scaling scaling = fan_lin_van_dooren(M, C, K);
  // A stiffness at the rounding level gives no scale.
  if (scaling.gamma < least_scale) {
    scaling.gamma = least_scale;
    scaling.delta = 2.0 / (M.norm() * least_scale * least_scale + C.norm() * least_scale);
  }
  const CompanionForm<Values> form(scaling.delta * scaling.gamma * scaling.gamma * M,
                                   scaling.delta * scaling.gamma * C, scaling.delta * K);
  const Complex mu = centre / scaling.gamma;
  const double size = std::max(std::abs(mu), 1e-3);
  const Complex shift = is_real ? Complex(mu.real() + offset * size) : mu + offset * size * Complex(0.6, 0.8);
  const ComplexMatrix complex_a = form.a.template cast<Complex>(),
                      complex_b = form.b.template cast<Complex>();
  const Eigen::PartialPivLU<ComplexMatrix> lu(complex_a - shift * complex_b);
  ComplexMatrix X(form.a.rows(), k);
  for (Eigen::Index i = 0; i < X.size(); ++i) X(i) = std::sin(1.0 + 1.7 * static_cast<double>(i));
  for (int i = 0; i < iterations; ++i) {
    X = orthonormal(ComplexMatrix(lu.solve(ComplexMatrix(complex_b * X))));
  }
  InvariantPair pair{.is_real = is_real, .Z = X.topRows(n)};
  pair.Lambda = scaling.gamma * least_squares(complex_b * X, complex_a * X);
  if (is_real) {
    // A real pencil and a real shift give a real subspace; the QR basis of it is real.
    pair.Z.imag().setZero();
    pair.Lambda.imag().setZero();
  }
  return pair;
}

}  // namespace

InvariantPair invariant_subspace(const Matrix& M, const Matrix& C, const Matrix& K, Complex centre,
                                 Eigen::Index k, bool is_real, double least_scale) {
  if (M.rows() == 1 && k == 2 && is_real && M(0, 0) != 0.0)
    return pair_of_one_freedom(M(0, 0), C(0, 0), K(0, 0));
  return subspace_of(M, C, K, centre, k, is_real, least_scale);
}

InvariantPair invariant_subspace(const ReducedPencil& pencil, Complex centre, Eigen::Index k, bool is_real,
                                 double least_scale) {
  if (pencil.complex_sign == 0)
    return invariant_subspace(pencil.M[0], pencil.C[0], pencil.K[0], centre, k, is_real, least_scale);
  InvariantPair pair = with_matrices(pencil, [&](const auto& M, const auto& C, const auto& K) {
    return subspace_of(M, C, K, centre, k, false, least_scale);
  });
  pair.Z = in_pencil(pencil, pair.Z);
  return pair;
}

}  // namespace eigentrail
