#include "projection/nearest_modes.hpp"
#include "core/orthonormal.hpp"

#include <Spectra/GenEigsSolver.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "steady/sparse_kkt.hpp"

namespace eigentrail {
namespace {

/// Two eigenvalues closer than this share of the shift's distance to the next ones: the shift lies on an
/// eigenvalue, and the solutions lose as many digits of the others.
constexpr double on_an_eigenvalue = 1e-5;

/// Solves with a shifted pencil: right sides and solutions are those of its coordinates, without multipliers.
class PencilSolver {
 public:
  PencilSolver(const SparseSolver& factors, const SparsePencil& pencil)
      : factors_(factors), n_(pencil.size()), m_(pencil.A.rows()) {}

  template <class Vectors>
  Vectors solve(const Vectors& B) const {
    return m_ == 0 ? factors_.solve(B) : Vectors(factors_.solve(padded(B)).topRows(n_));
  }
  template <class Vectors>
  Vectors solve_transposed(const Vectors& B) const {
    return m_ == 0 ? factors_.solve_transposed(B) : Vectors(factors_.solve_transposed(padded(B)).topRows(n_));
  }

 private:
  template <class Vectors>
  Vectors padded(const Vectors& B) const {
    Vectors result = Vectors::Zero(n_ + m_, B.cols());
    result.topRows(n_) = B;
    return result;
  }

  const SparseSolver& factors_;
  Eigen::Index n_, m_;
};

/// P with the constraints; P itself if there are none.
template <class Scalar>
Eigen::SparseMatrix<Scalar> bordered(Eigen::SparseMatrix<Scalar> P, const SparseMatrix& A) {
  P.makeCompressed();
  if (A.rows() == 0) return P;
  const double size = P.coeffs().cwiseAbs().maxCoeff();
  const Vector scale = SystemMatrix(A).row_norms().unaryExpr([size](double norm) { return size / norm; });
  const std::vector<Eigen::Triplet<Scalar>> entries = kkt_entries(P, A, scale);
  Eigen::SparseMatrix<Scalar> matrix(P.rows() + A.rows(), P.rows() + A.rows());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// The inverse of the shifted pencil, in the form that Spectra's solvers use. Three linearizations:
/// - without C: the square of s is the eigenvalue, size n;
/// - without M: first order, size n;
/// - else the positions and the velocities divided by `scale`, size 2 n.
class Inverse {
 public:
  using Scalar = double;
  enum class Form { undamped, first_order, quadratic };

  Inverse(const SparsePencil& pencil, const PencilSolver& factors, const Shift& shift, bool transposed,
          double scale, long& solutions)
      : pencil_(pencil),
        factors_(factors),
        shift_(shift.value()),
        transposed_(transposed),
        scale_(scale),
        solutions_(solutions) {}

  static Form form_of(const SparsePencil& pencil) {
    if (pencil.C.norm() == 0.0) return Form::undamped;
    return pencil.M.norm() == 0.0 ? Form::first_order : Form::quadratic;
  }

  Eigen::Index rows() const { return form_ == Form::quadratic ? 2 * pencil_.size() : pencil_.size(); }
  Eigen::Index cols() const { return rows(); }

  void perform_op(const double* in, double* out) const {
    ++solutions_;
    const Eigen::Index n = pencil_.size();
    const Eigen::Map<const Vector> x(in, n);
    Eigen::Map<Vector> result(out, n);
    switch (form_) {
      case Form::undamped:
        result = solve(times(pencil_.M, x));
        return;
      case Form::first_order:
        result = real_part_of_solution(times(pencil_.C, x).cast<Complex>()).real();
        return;
      case Form::quadratic: {
        const Eigen::Map<const Vector> v(in + n, n);
        ComplexVector right =
            (times(pencil_.M, scale_ * v + shift_.real() * x) + times(pencil_.C, x)).cast<Complex>();
        if (shift_.imag() != 0.0) right += Complex(0.0, shift_.imag()) * times(pencil_.M, x);
        const ComplexVector a = real_part_of_solution(right);
        result = a.real();
        Eigen::Map<Vector>(out + n, n) = (x.cast<Complex>() + shift_ * a).real() / scale_;
        return;
      }
    }
  }

  /// s of an eigenvector, with few digits.
  Complex rough_eigenvalue(const ComplexVector& vector) const {
    const Eigen::Index n = pencil_.size();
    const ComplexVector x = vector.head(n);
    if (form_ == Form::quadratic) return scale_ * x.dot(vector.tail(n)) / x.squaredNorm();
    if (transposed_) return -x.dot(pencil_.K.transpose() * x) / x.dot(pencil_.C.transpose() * x);
    return -x.dot(pencil_.K * x) / x.dot(pencil_.C * x);
  }

 private:
  Vector times(const SparseMatrix& A, const Vector& x) const {
    if (transposed_) return A.transpose() * x;
    return A * x;
  }
  Vector solve(const Vector& b) const {
    return transposed_ ? factors_.solve_transposed(Matrix(b)) : factors_.solve(Matrix(b));
  }
  /// -P(shift)^-1 b; only its real part where the shift is real.
  ComplexVector real_part_of_solution(const ComplexVector& b) const {
    if (shift_.imag() == 0.0) return -solve(b.real()).cast<Complex>();
    return -(transposed_ ? factors_.solve_transposed(b) : factors_.solve(b));
  }

  const SparsePencil& pencil_;
  const PencilSolver& factors_;
  Complex shift_;
  bool transposed_;
  double scale_;
  long& solutions_;
  Form form_ = form_of(pencil_);
};

/// Eigenvalues s, Im s >= 0, with vectors, of the pencil.
struct Found {
  std::vector<Complex> s;
  std::vector<ComplexVector> vectors;
  double least = 0.0;  ///< smallest magnitude of an eigenvalue of the inverse that was asked for
};

void keep(Found& found, Complex s, const ComplexVector& x) {
  if (!std::isfinite(s.real()) || !std::isfinite(s.imag()) || s.imag() < 0.0) return;
  found.s.push_back(s);
  found.vectors.push_back(x.normalized());
}

/// s from an eigenvalue of the inverse and its vector.
Complex eigenvalue(Complex nu, const Shift& shift, const Inverse& inverse, const ComplexVector& vector) {
  if (shift.frequency == 0.0) return shift.real + 1.0 / nu;
  // nu = s / (s^2 + w^2): of the two roots the one that fits the vector.
  const Complex rough = inverse.rough_eigenvalue(vector);
  const Complex half = 0.5 / nu;
  const Complex root = std::sqrt(half * half - shift.frequency * shift.frequency);
  const Complex large = std::abs(half + root) > std::abs(half - root) ? half + root : half - root;
  const Complex other = shift.frequency * shift.frequency / large;
  return std::abs(large - rough) < std::abs(other - rough) ? large : other;
}

/// Gives eigenvectors one by one: all of them together, with their conjugates, took as much memory as the
/// Krylov space.
class Arnoldi : public Spectra::GenEigsSolver<Inverse> {
 public:
  using Spectra::GenEigsSolver<Inverse>::GenEigsSolver;

  /// That of eigenvalue i, of the length of the operator; all have converged.
  eigentrail::ComplexVector eigenvector(Eigen::Index i) const {
    const auto& V = m_fac.matrix_V();
    eigentrail::ComplexVector vector(V.rows());
    vector.real() = V * m_ritz_vec.col(i).real();
    vector.imag() = V * m_ritz_vec.col(i).imag();
    return vector;
  }
};

std::optional<Found> arnoldi(Inverse& inverse, const SparsePencil& pencil, const Shift& shift, int wanted,
                             double tolerance) {
  const auto size = static_cast<int>(inverse.rows());
  const int nev = std::min(wanted, size - 2);
  // Orthogonalizing the vectors takes longer than the solutions: with 2 nev + 20 of them the run took a sixth
  // more time (a plate with 20 000 freedoms), with fewer as much.
  const int ncv = std::min(size, 3 * nev / 2 + 20);
  Arnoldi solver(inverse, nev, ncv);
  solver.init();
  solver.compute(Spectra::SortRule::LargestMagn, 50, tolerance, Spectra::SortRule::LargestMagn);
  if (solver.info() != Spectra::CompInfo::Successful) return std::nullopt;
  const ComplexVector nus = solver.eigenvalues();
  const Inverse::Form form = Inverse::form_of(pencil);
  Found found;
  found.least = nus.cwiseAbs().minCoeff();
  for (Eigen::Index i = 0; i < nus.size(); ++i) {
    const Complex nu = nus[i];
    const ComplexVector vector = solver.eigenvector(i);
    const ComplexVector x = vector.head(pencil.size());
    if (form != Inverse::Form::undamped) {
      keep(found, eigenvalue(nu, shift, inverse, vector), x);
      continue;
    }
    const double square = shift.real * shift.real - shift.frequency * shift.frequency;
    Complex mu = square - 1.0 / nu;  // s^2
    if (pencil.symmetric) mu = mu.real();
    const Complex s = std::sqrt(mu);
    keep(found, s, x);
    if (s != 0.0) keep(found, -s, x);
  }
  return found;
}

/// Distance from the shift within which every eigenvalue belongs to an eigenvalue of the inverse of at least
/// the magnitude `least`.
double complete_radius(const Shift& shift, Inverse::Form form, double least) {
  if (form == Inverse::Form::undamped) {
    // |s^2 - shift^2| = |s - shift| |s + shift| <= 1 / least
    const double w = std::abs(shift.value());
    return std::sqrt(w * w + 1.0 / least) - w;
  }
  if (shift.frequency == 0.0) return 1.0 / least;
  // |nu| >= (1/d - 1/(2 w - d)) / 2 for a distance d below w
  const double w = shift.frequency;
  const double a = 1.0 / (2.0 * least);
  return w + a - std::sqrt(w * w + a * a);
}

/// Frequency (rad/s) of the lowest modes, roughly: one step of inverse iteration. That of rigid-body motions
/// is rounding; then a shift beside them is a better measure.
double frequency_scale(const SparsePencil& pencil, const PencilSolver& factors, const Shift& shift) {
  const Vector start = Vector::Ones(pencil.size());
  const ComplexVector x = factors.solve(ComplexVector((pencil.M * start).cast<Complex>()));
  const double inertia = std::abs(x.dot(pencil.M * x)), stiffness = std::abs(x.dot(pencil.K * x));
  const double scale = std::max(std::sqrt(stiffness / inertia), std::abs(shift.value()));
  return std::isfinite(scale) && scale > 0.0 ? scale : 1.0;
}

/// A shift beside zero, for a pencil whose K is singular: far below the frequencies, far above rounding. With
/// it the rigid-body motions outweigh all other modes; it serves to find a better one.
Shift close_to_zero(const SparsePencil& pencil) {
  const double mass = pencil.M.norm();
  const double scale = mass > 0.0 ? std::sqrt(pencil.K.norm() / mass) : pencil.K.norm() / pencil.C.norm();
  return {1e-6 * scale, 0.0};
}

/// A shift between the rigid-body motions and the lowest other modes, by subspace iteration with factors at a
/// shift close to zero: 0.3 of the lowest frequency. Damping is left out of it.
Shift beside_rigid_motions(const SparsePencil& pencil, const PencilSolver& factors, const Shift& close) {
  constexpr Eigen::Index block = 12;    // six rigid-body motions and a few other modes
  constexpr int rounds = 3;             // a rough frequency is enough
  constexpr double rigid_share = 1e-8;  // of the largest eigenvalue of the block
  const bool first_order = pencil.M.norm() == 0.0;
  const SparseMatrix& inertia = first_order ? pencil.C : pencil.M;
  const Eigen::Index n = pencil.size();
  Matrix Q = Matrix::NullaryExpr(n, std::min(block, n), [](Eigen::Index i, Eigen::Index j) {
    return std::cos(static_cast<double>((i + 1) * (2 * j + 1)) * 0.7548776662466927);
  });
  for (int i = 0; i < rounds; ++i) {
    Q = orthonormal(factors.solve(Matrix(inertia * Q)));
  }
  const Matrix small =
      Matrix(Q.transpose() * (inertia * Q)).partialPivLu().solve(Matrix(Q.transpose() * (pencil.K * Q)));
  Vector values = Eigen::EigenSolver<Matrix>(small, false).eigenvalues().cwiseAbs();
  std::sort(values.begin(), values.end());
  const auto lowest = std::find_if(values.begin(), values.end(), [&](double value) {
    return value > rigid_share * values[values.size() - 1];
  });
  const double frequency = first_order ? *lowest : std::sqrt(*lowest);
  return {std::max(close.real, 0.3 * frequency), 0.0};
}

/// If the shift lies on an eigenvalue that was found: the distance of the nearest of the others. Zero if not.
double gap_beside(const Found& found, const Shift& shift) {
  std::vector<double> distances;
  for (const Complex s : found.s) distances.push_back(std::abs(s - shift.value()));
  std::sort(distances.begin(), distances.end());
  const auto other = std::find_if(distances.begin(), distances.end(),
                                  [&](double d) { return d > on_an_eigenvalue * distances.back(); });
  return other == distances.begin() ? 0.0 : *other;
}

ComplexMatrix columns(const std::vector<ComplexVector>& vectors, Eigen::Index n) {
  ComplexMatrix result(n, static_cast<Eigen::Index>(vectors.size()));
  for (std::size_t i = 0; i < vectors.size(); ++i) result.col(static_cast<Eigen::Index>(i)) = vectors[i];
  return result;
}

/// The modes by their distance from the shift.
NearestModes sorted(const Found& found, const Shift& shift, Eigen::Index n) {
  std::vector<std::size_t> by_distance(found.s.size());
  std::iota(by_distance.begin(), by_distance.end(), std::size_t{0});
  std::sort(by_distance.begin(), by_distance.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(found.s[a] - shift.value()) < std::abs(found.s[b] - shift.value());
  });
  NearestModes modes;
  modes.s.resize(static_cast<Eigen::Index>(by_distance.size()));
  std::vector<ComplexVector> vectors;
  for (const std::size_t i : by_distance) {
    modes.s[static_cast<Eigen::Index>(vectors.size())] = found.s[i];
    vectors.push_back(found.vectors[i]);
  }
  modes.right = columns(vectors, n);
  return modes;
}

}  // namespace

ComplexMatrix SparsePencil::allowed(const ComplexMatrix& vectors) const {
  if (!constraints) return vectors;
  return constraints->allowed_part(vectors.real()).cast<Complex>() +
         Complex(0.0, 1.0) * constraints->allowed_part(vectors.imag()).cast<Complex>();
}

ShiftedMatrix shifted_matrix(const SparsePencil& pencil, const Shift& shift) {
  const double square = shift.real * shift.real - shift.frequency * shift.frequency;
  // Zero factors keep the pattern of the sum, so that it is analyzed once.
  ShiftedMatrix shifted{bordered<double>(square * pencil.M + shift.real * pencil.C + pencil.K, pencil.A)};
  if (pencil.A.rows() > 0) return shifted;  // indefinite
  if (pencil.symmetric || (pencil.one_sided && shift.real == 0.0)) shifted.kind = SparseKind::symmetric;
  return shifted;
}

bool ModeFinder::factor(const SparsePencil& pencil, const Shift& shift) {
  ++factorizations_;
  bool regular = false;
  if (shift.frequency == 0.0 || Inverse::form_of(pencil) == Inverse::Form::undamped) {
    const ShiftedMatrix shifted = shifted_matrix(pencil, shift);
    regular = factors_->factor(shifted.matrix, shifted.kind);
  } else {
    const Complex s = shift.value();
    regular = factors_->factor(bordered<Complex>(
        s * s * pencil.M.cast<Complex>() + s * pencil.C.cast<Complex>() + pencil.K.cast<Complex>(),
        pencil.A));
  }
  peak_bytes_ = std::max(peak_bytes_, factors_->bytes());
  return regular;
}

std::optional<NearestModes> ModeFinder::find(const SparsePencil& pencil, const ModeRequest& request) {
  const double tolerance = request.tolerance.value_or(tolerance_);
  const Inverse::Form form = Inverse::form_of(pencil);
  const int per_mode = form == Inverse::Form::undamped ? 1 : 2;
  const PencilSolver solver(*factors_, pencil);
  Shift shift = request.shift;
  int count = request.count;
  bool moved = false;  ///< away from the requested shift, on which an eigenvalue lies here
  bool remembered = moved_ && moved_->requested == request.shift;
  if (remembered) shift = moved_->used;
  const auto forget = [&] {
    moved_.reset();
    remembered = false;
    shift = request.shift;
  };
  while (true) {
    if (!factor(pencil, shift)) {
      if (remembered) {
        forget();
        continue;
      }
      if (moved) return std::nullopt;
      const Shift close = close_to_zero(pencil);
      if (!factor(pencil, close)) return std::nullopt;
      shift = beside_rigid_motions(pencil, solver, close);
      moved = true;
      continue;
    }
    const double scale = form == Inverse::Form::quadratic ? frequency_scale(pencil, solver, shift) : 1.0;
    Inverse inverse(pencil, solver, shift, false, scale, solutions_);
    std::optional<Found> right = arnoldi(inverse, pencil, shift, per_mode * count, tolerance);
    if (!right || right->s.empty()) return std::nullopt;
    const bool beside_singular = remembered && moved_->beside_singular;
    if (const double gap = moved || beside_singular ? 0.0 : gap_beside(*right, shift)) {
      if (remembered) {
        forget();
        continue;
      }
      shift = shift.frequency > 0.0 ? Shift{0.0, shift.frequency - 0.3 * gap}
                                    : Shift{shift.real + 0.3 * gap, 0.0};
      moved = true;
      moved_ = MovedShift{request.shift, shift, false};
      continue;
    }
    // A matrix that cannot be factored stays so where rigid-body motions are the cause.
    if (moved && !moved_) moved_ = MovedShift{request.shift, shift, true};
    while (complete_radius(shift, form, right->least) < request.cover && count < request.most) {
      count = std::min(request.most, count + std::max(2, count / 2));
      right = arnoldi(inverse, pencil, shift, per_mode * count, tolerance);
      if (!right) return std::nullopt;
    }
    NearestModes modes = sorted(*right, shift, pencil.size());
    modes.radius = complete_radius(shift, form, right->least);
    last_ = {shift, per_mode * count, scale};
    if (!request.only_right && !add_left(pencil, tolerance, modes)) return std::nullopt;
    return modes;
  }
}

bool ModeFinder::add_left(const SparsePencil& pencil, double tolerance, NearestModes& modes) {
  if (pencil.one_sided) return true;
  const PencilSolver solver(*factors_, pencil);
  Inverse transposed(pencil, solver, last_.shift, true, last_.scale, solutions_);
  const std::optional<Found> left = arnoldi(transposed, pencil, last_.shift, last_.wanted, tolerance);
  if (left) modes.left = columns(left->vectors, pencil.size());
  return left.has_value();
}

}  // namespace eigentrail
