#include "eigentrail/modes/spectrum.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "core/lapack.hpp"
#include "core/orthonormal.hpp"
#include "core/positive_or_one.hpp"
#include "core/reciprocal_condition.hpp"
#include "eigentrail/reduction/complex_blocks.hpp"

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

/// Eigenvector of the eigenvalue in column j of LAPACK's real storage, of [z; mu z] with the velocities of
/// all or some of the n coordinates: z, or with all velocities the larger half.
ComplexVector right_vector(const Matrix& vectors, Eigen::Index j, bool is_complex, Eigen::Index n) {
  const Eigen::Index size = vectors.rows();
  ComplexVector both(size);
  both.real() = vectors.col(j);
  both.imag() = is_complex ? Vector(vectors.col(j + 1)) : Vector(Vector::Zero(size));
  const bool upper = size < 2 * n || both.head(n).norm() >= both.tail(n).norm();
  return (upper ? both.head(n) : both.tail(n)).normalized();
}

/// Companion form: a y = mu b y with y = [z; mu z_m], z_m the coordinates with mass. Those without have no
/// velocity as a state: s C z stands on the right side for them.
template <class Values>
void linearize(const Values& M, const Values& C, const Values& K, Values& a, Values& b) {
  const Eigen::Index n = M.rows();
  std::vector<Eigen::Index> with_mass;
  for (Eigen::Index j = 0; j < n; ++j) {
    if (!M.col(j).isZero(0.0)) with_mass.push_back(j);
  }
  const auto m = static_cast<Eigen::Index>(with_mass.size());
  a = Values::Zero(m + n, n + m);
  b = a;
  a.topRightCorner(m, m).setIdentity();
  a.bottomLeftCorner(n, n) = -K;
  b.bottomLeftCorner(n, n) = C;
  for (Eigen::Index i = 0; i < m; ++i) {
    const Eigen::Index j = with_mass[static_cast<std::size_t>(i)];
    b(i, j) = 1.0;
    b.col(j).tail(n).setZero();
    a.col(n + i).tail(n) = -C.col(j);
    b.col(n + i).tail(n) = M.col(j);
  }
}

/// All eigenvalues mu = alpha / beta of a scaled pencil as LAPACK returns them; conjugates are neighbours.
struct Homogeneous {
  explicit Homogeneous(Eigen::Index count)
      : alpha_real(count), alpha_imag(count), beta(Vector::Ones(count)) {}

  bool converged = false;
  Eigen::Index left_out = 0;  ///< infinite eigenvalues of velocities that are no states
  Vector alpha_real, alpha_imag, beta;
  Matrix vectors = {};  ///< in LAPACK's real storage; empty if not requested
};

Homogeneous by_qz(const Matrix& M, const Matrix& C, const Matrix& K, bool with_vectors) {
  Matrix a, b;
  linearize(M, C, K, a, b);
  Homogeneous all(a.rows());
  all.left_out = 2 * M.rows() - a.rows();
  if (with_vectors) all.vectors.resize(a.rows(), a.rows());
  const auto size = static_cast<lapack_int>(a.rows());
  const lapack_int info =
      LAPACKE_dggev(LAPACK_COL_MAJOR, 'N', with_vectors ? 'V' : 'N', size, a.data(), size, b.data(), size,
                    all.alpha_real.data(), all.alpha_imag.data(), all.beta.data(), nullptr, 1,
                    with_vectors ? all.vectors.data() : nullptr, size);
  all.converged = info == 0;
  return all;
}

/// Eigenvalues only, by the QR algorithm on the companion form with M inverted.
Homogeneous by_qr(const Eigen::PartialPivLU<Matrix>& M, const Matrix& C, const Matrix& K) {
  const Eigen::Index n = C.rows();
  Matrix a = Matrix::Zero(2 * n, 2 * n);
  a.topRightCorner(n, n).setIdentity();
  a.bottomLeftCorner(n, n) = -M.solve(K);
  a.bottomRightCorner(n, n) = -M.solve(C);
  Homogeneous all(2 * n);
  const auto size = static_cast<lapack_int>(2 * n);
  all.converged = LAPACKE_dgeev(LAPACK_COL_MAJOR, 'N', 'N', size, a.data(), size, all.alpha_real.data(),
                                all.alpha_imag.data(), nullptr, 1, nullptr, 1) == 0;
  return all;
}

/// Eigenvalues only, without damping: mu = +-sqrt(-lambda) with the eigenvalues lambda of K z = lambda M z.
/// Those on the axes are exactly there.
Homogeneous by_squares(const Matrix& M, const Matrix& K) {
  const Eigen::Index n = M.rows();
  Matrix a = K, b = M;
  Vector real(n), imag(n), beta(n);
  const auto size = static_cast<lapack_int>(n);
  Homogeneous all(2 * n);
  all.converged = LAPACKE_dggev(LAPACK_COL_MAJOR, 'N', 'N', size, a.data(), size, b.data(), size, real.data(),
                                imag.data(), beta.data(), nullptr, 1, nullptr, 1) == 0;
  for (Eigen::Index j = 0; j < n; ++j) {
    const Complex alpha(real[j], imag[j]);
    const bool is_infinite = std::abs(beta[j]) <= infinite * std::abs(alpha);
    // Real numbers by themselves: those with a zero imaginary part have no sign of it that could be lost.
    const Complex mu = is_infinite             ? Complex(1.0)
                       : imag[j] != 0.0        ? std::sqrt(-alpha / beta[j])
                       : real[j] / beta[j] > 0 ? Complex(0.0, std::sqrt(real[j] / beta[j]))
                                               : Complex(std::sqrt(-real[j] / beta[j]));
    for (const Eigen::Index at : {2 * j, 2 * j + 1}) {
      const double sign = at == 2 * j ? 1.0 : -1.0;
      all.alpha_real[at] = sign * mu.real();
      all.alpha_imag[at] = sign * mu.imag();
      all.beta[at] = is_infinite ? 0.0 : 1.0;
    }
  }
  return all;
}

Homogeneous eigenvalues_of(const Matrix& M, const Matrix& C, const Matrix& K) {
  if (C.isZero(0.0)) return by_squares(M, K);
  const Equilibration<Matrix> equal(M);
  const Eigen::PartialPivLU<Matrix> lu(equal.of(M));
  return reciprocal_condition(lu) > well_conditioned ? by_qr(lu, equal.of(C), equal.of(K))
                                                     : by_qz(M, C, K, false);
}

/// By increasing |s|.
void sort(Spectrum& spectrum) {
  std::stable_sort(spectrum.modes.begin(), spectrum.modes.end(),
                   [](const StartingMode& p, const StartingMode& q) {
                     return std::tuple(std::abs(p.s), p.s.imag(), p.s.real()) <
                            std::tuple(std::abs(q.s), q.s.imag(), q.s.real());
                   });
}

/// Collects the finite modes in the order of increasing |s|.
void take_modes(const Homogeneous& all, Eigen::Index n, Spectrum& spectrum) {
  spectrum.n_infinite = static_cast<int>(all.left_out);
  for (Eigen::Index j = 0; j < all.beta.size(); ++j) {
    const Complex alpha(all.alpha_real[j], all.alpha_imag[j]);
    if (std::abs(all.beta[j]) <= infinite * std::abs(alpha)) {
      ++spectrum.n_infinite;
    } else if (alpha.imag() >= 0.0) {
      spectrum.modes.push_back({spectrum.scale * alpha / all.beta[j], {}});
      if (all.vectors.size() > 0)
        spectrum.modes.back().z = right_vector(all.vectors, j, alpha.imag() > 0.0, n);
    }
  }
  sort(spectrum);
}

Spectrum solve(const Matrix& M, const Matrix& C, const Matrix& K, bool with_vectors) {
  Spectrum spectrum;
  if (M.rows() == 0) {
    spectrum.status = SpectrumStatus::complete;
    return spectrum;
  }
  const Scaling scaling = fan_lin_van_dooren(M, C, K);
  spectrum.scale = scaling.gamma;
  const Matrix scaled_M = scaling.delta * scaling.gamma * scaling.gamma * M;
  const Matrix scaled_C = scaling.delta * scaling.gamma * C;
  const Matrix scaled_K = scaling.delta * K;
  if (is_singular(scaled_M, scaled_C, scaled_K)) {
    spectrum.status = SpectrumStatus::singular_pencil;
    return spectrum;
  }
  const Homogeneous all =
      with_vectors ? by_qz(scaled_M, scaled_C, scaled_K, true) : eigenvalues_of(scaled_M, scaled_C, scaled_K);
  if (!all.converged) return spectrum;
  take_modes(all, M.rows(), spectrum);
  spectrum.status = SpectrumStatus::complete;
  return spectrum;
}

}  // namespace

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

/// The eigenvector of a complex part from that of its companion form.
ComplexVector vector_of_complex_part(const ComplexVector& both, Eigen::Index m, int complex_sign) {
  const bool upper = both.size() < 2 * m || both.head(m).norm() >= both.tail(m).norm();
  return from_complex_coordinates(ComplexVector(upper ? both.head(m) : both.tail(m)).normalized(),
                                  complex_sign);
}

/// alpha and beta of all eigenvalues of a complex pencil, with the vectors of its companion form if those are
/// asked for (`vectors` then has its size). Empty if LAPACK does not converge.
std::optional<std::pair<ComplexVector, ComplexVector>> complex_qz(const ComplexMatrix& M,
                                                                  const ComplexMatrix& C,
                                                                  const ComplexMatrix& K,
                                                                  ComplexMatrix* vectors) {
  ComplexMatrix a, b;
  linearize(M, C, K, a, b);
  const auto size = static_cast<lapack_int>(a.rows());
  ComplexVector alpha(size), beta(size);
  if (vectors != nullptr) vectors->resize(size, size);
  const lapack_int info = LAPACKE_zggev(LAPACK_COL_MAJOR, 'N', vectors != nullptr ? 'V' : 'N', size, a.data(),
                                        size, b.data(), size, alpha.data(), beta.data(), nullptr, 1,
                                        vectors != nullptr ? vectors->data() : nullptr, size);
  if (info != 0) return std::nullopt;
  return std::pair(std::move(alpha), std::move(beta));
}

/// The same without vectors, by the QR algorithm on the companion form with M inverted.
std::optional<std::pair<ComplexVector, ComplexVector>> complex_qr(const Eigen::PartialPivLU<ComplexMatrix>& M,
                                                                  const ComplexMatrix& C,
                                                                  const ComplexMatrix& K) {
  const Eigen::Index m = C.rows();
  ComplexMatrix a = ComplexMatrix::Zero(2 * m, 2 * m);
  a.topRightCorner(m, m).setIdentity();
  a.bottomLeftCorner(m, m) = -M.solve(K);
  a.bottomRightCorner(m, m) = -M.solve(C);
  const auto size = static_cast<lapack_int>(2 * m);
  ComplexVector values(size);
  if (LAPACKE_zgeev(LAPACK_COL_MAJOR, 'N', 'N', size, a.data(), size, values.data(), nullptr, 1, nullptr,
                    1) != 0)
    return std::nullopt;
  return std::pair(std::move(values), ComplexVector(ComplexVector::Ones(size)));
}

/// The eigenvalues with Im s >= 0 of a complex part: those of its complex matrices.
Spectrum solve_complex_part(const ReducedPencil& pencil, bool with_vectors) {
  Spectrum spectrum;
  const Scaling scaling = fan_lin_van_dooren(pencil.M[0], pencil.C[0], pencil.K[0]);
  spectrum.scale = scaling.gamma;
  const auto block = [&](double factor, const Matrix& A) {
    return ComplexMatrix(scaling.delta * factor * complex_block(A, pencil.complex_sign));
  };
  const ComplexMatrix M = block(scaling.gamma * scaling.gamma, pencil.M[0]);
  const ComplexMatrix C = block(scaling.gamma, pencil.C[0]), K = block(1.0, pencil.K[0]);
  if (is_singular(M, C, K)) {
    spectrum.status = SpectrumStatus::singular_pencil;
    return spectrum;
  }
  const Equilibration<ComplexMatrix> equal(M);
  const Eigen::PartialPivLU<ComplexMatrix> lu(equal.of(M));
  ComplexMatrix vectors;
  const auto all = !with_vectors && lu.rcond() > well_conditioned
                       ? complex_qr(lu, equal.of(C), equal.of(K))
                       : complex_qz(M, C, K, with_vectors ? &vectors : nullptr);
  if (!all) return spectrum;
  const auto& [alpha, beta] = *all;
  spectrum.n_infinite = static_cast<int>(2 * M.rows() - alpha.size());
  for (Eigen::Index j = 0; j < alpha.size(); ++j) {
    if (std::abs(beta[j]) <= infinite * std::abs(alpha[j])) {
      ++spectrum.n_infinite;
      continue;
    }
    const Complex s = spectrum.scale * alpha[j] / beta[j];
    if (s.imag() < 0.0) continue;  // its conjugate is a mode of the conjugate part
    spectrum.modes.push_back({s, {}});
    if (with_vectors)
      spectrum.modes.back().z = vector_of_complex_part(vectors.col(j), M.rows(), pencil.complex_sign);
  }
  sort(spectrum);
  spectrum.status = SpectrumStatus::complete;
  return spectrum;
}

Spectrum solve_parts(const ReducedPencil& pencil, bool with_vectors) {
  if (pencil.parts.empty()) {
    Spectrum spectrum = pencil.complex_sign != 0 ? solve_complex_part(pencil, with_vectors)
                                                 : solve(pencil.M[0], pencil.C[0], pencil.K[0], with_vectors);
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
  sort(all);
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
  if (pencil.complex_sign == 0) return vector_near(pencil.M[0], pencil.C[0], pencil.K[0], s, s_ref);
  const auto block = [&](const Matrix& A) { return complex_block(A, pencil.complex_sign); };
  return from_complex_coordinates(
      vector_near(block(pencil.M[0]), block(pencil.C[0]), block(pencil.K[0]), s, s_ref), pencil.complex_sign);
}

namespace {

/// Both eigenvalues of a single freedom, without rounding where stiffness or damping is zero.
InvariantPair pair_of_one_freedom(double m, double c, double k) {
  InvariantPair pair;
  pair.is_real = true;
  pair.Z = ComplexMatrix::Identity(1, 2);
  pair.Lambda = ComplexMatrix::Zero(2, 2);
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
  Values a, b;
  linearize(Values(scaling.delta * scaling.gamma * scaling.gamma * M),
            Values(scaling.delta * scaling.gamma * C), Values(scaling.delta * K), a, b);
  const Complex mu = centre / scaling.gamma;
  const double size = std::max(std::abs(mu), 1e-3);
  const Complex shift = is_real ? Complex(mu.real() + offset * size) : mu + offset * size * Complex(0.6, 0.8);
  const ComplexMatrix complex_a = a.template cast<Complex>(), complex_b = b.template cast<Complex>();
  const Eigen::PartialPivLU<ComplexMatrix> lu(complex_a - shift * complex_b);
  ComplexMatrix X(a.rows(), k);
  for (Eigen::Index i = 0; i < X.size(); ++i) X(i) = std::sin(1.0 + 1.7 * static_cast<double>(i));
  for (int i = 0; i < iterations; ++i) {
    X = orthonormal(ComplexMatrix(lu.solve(complex_b * X)));
  }
  InvariantPair pair;
  pair.is_real = is_real;
  pair.Z = X.topRows(n);
  pair.Lambda = scaling.gamma * (complex_b * X).householderQr().solve(complex_a * X);
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
  const auto block = [&](const Matrix& A) { return complex_block(A, pencil.complex_sign); };
  InvariantPair pair =
      subspace_of(block(pencil.M[0]), block(pencil.C[0]), block(pencil.K[0]), centre, k, false, least_scale);
  pair.Z = from_complex_coordinates(pair.Z, pencil.complex_sign);
  return pair;
}

}  // namespace eigentrail
