#include "eigentrail/continuation/certificate.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>

#include "continuation/step/adapted_norm.hpp"
#include "continuation/step/jacobian_change.hpp"
#include "continuation/step/shared_basis.hpp"
#include "core/products.hpp"

namespace eigentrail {
namespace {

/// A step is halved up to this often. More halvings certify longer steps at a higher cost; a shorter step, or
/// a block, is usually cheaper.
constexpr int max_depth = 6;
/// Halving is given up if Z1 >= 1 and Z1 of a half exceeds this share of Z1 of the whole piece. Z1 decreases
/// about with the length of a piece that is merely too long, and does not where eigenvalues coincide. A
/// larger value tries more hopeless halvings, a smaller one gives up on pieces that could be certified.
constexpr double falling = 0.75;
/// Power iterations of a norm estimate. Estimates are too small and grow with the iterations; norm_safety
/// makes up for the rest.
constexpr int power_iterations = 4;
constexpr int further_iterations = 2;  ///< if started from the direction that another sample ended with
/// Directions that the adapted norm scales: those of the largest singular values of I - B J. A larger number
/// costs more solutions, and closes more pieces of sensitive eigenvalues.
constexpr Eigen::Index least_directions = 3;
constexpr Eigen::Index most_directions = 12;
/// One direction for so many unknowns: in a small system the solutions for them would take longer than a few
/// more factorizations.
constexpr Eigen::Index unknowns_per_direction = 16;
/// Passes of the subspace iteration for them.
constexpr int subspace_iterations = 1;
/// Factor on a norm estimate. With a larger value fewer steps are certified, with a smaller one the bounds
/// may be too small and the evidence weaker.
constexpr double norm_safety = 1.2;
/// Factor on Z2, which is evaluated at the middle of a piece only and may be larger beside it.
constexpr double curvature_safety = 1.5;
/// Factor on an estimate of Z2 from a single vector.
constexpr double rough_safety = 30.0;

/// Multiplications for one tube, about 0.05 s: a large model has few halvings. With a larger value few tubes
/// use up what the certificate may cost of all.
constexpr double most_work = 4e7;
/// Solutions with each factorization, about: only the budget of the certificate depends on it.
constexpr double solutions = 30.0;

/// Number of unknowns n k + k^2 up to which one LU of the whole Jacobian takes less time than k systems of
/// size n + k. Affects only the time.
constexpr Eigen::Index largest_matrix = 80;

/// B = J^-1 of a pair, in the unknowns (vec Z, vec Lambda / scale), by an LU of J as one matrix.
class WholeInverse {
 public:
  WholeInverse(const PairAtPlace& at, const ComplexMatrix& W, double scale)
      : W_(W), scale_(scale), J_(jacobian_matrix(at, W, scale)), lu_(J_) {}

  /// B v and B^H v, of a vector or of the columns of a matrix.
  template <class Vectors>
  void apply(Vectors& v) const {
    lu_.solve_in_place(v);
  }
  template <class Vectors>
  void apply_adjoint(Vectors& v) const {
    lu_.solve_adjoint_in_place(v);
  }
  double scale() const { return scale_; }

  struct Change {
    ComplexMatrix matrix;

    template <class Vectors>
    Vectors times(const Vectors& v) const {
      return product(matrix, v);
    }
    template <class Vectors>
    Vectors adjoint_times(const Vectors& v) const {
      return adjoint_product(matrix, v);
    }
  };
  Change change_to(const PairAtPlace& other) const { return {jacobian_matrix(other, W_, scale_) - J_}; }

 private:
  const ComplexMatrix& W_;
  double scale_;
  ComplexMatrix J_;
  ComplexLu lu_;
};

/// The same by one LU of size n + k per column of the pair's Schur form.
class TriangularInverse {
 public:
  TriangularInverse(const PairAtPlace& at, const ComplexMatrix& W, const ComplexMatrix& W1, double scale)
      : at_(at), products_(at), W1_(W1), scale_(scale), factors_(at.pencil, at.Z, at.Lambda, W) {}

  template <class Vectors>
  void apply(Vectors& v) const {
    factors_.solve_in_place(v);
    v.bottomRows(at_.Lambda.size()) *= 1.0 / scale_;  // the division of complex numbers might underflow
  }
  template <class Vectors>
  void apply_adjoint(Vectors& v) const {
    v.bottomRows(at_.Lambda.size()) *= 1.0 / scale_;
    factors_.solve_adjoint_in_place(v);
  }
  double scale() const { return scale_; }

  JacobianChange change_to(const PairAtPlace& other) const { return {at_, products_, other, W1_, scale_}; }

 private:
  PairAtPlace at_;
  PairProducts products_;
  const ComplexMatrix& W1_;
  double scale_;
  PairFactorization factors_;
};

/// The certificate of one track on one step.
class Tube {
 public:
  Tube(const StepPencil& pencil, const Track& left, const Track& right, double gap, RunCounts& counts)
      : pencil_(pencil),
        chart_(left.pair.chart),
        W_(left.pair.W),
        W1_(W_.bottomRows(W_.rows() / 2)),
        counts_(counts),
        gap_(gap),
        left_Z_(in_basis_of(pencil.left(), left.series.Z, left.pair.part)),
        left_Lambda_(left.series.Lambda),
        right_Z_(in_basis_of(pencil.left(), right.series.Z, left.pair.part)),
        right_Lambda_(right.series.Lambda) {
    fix_basis(W_, left_Z_, left_Lambda_);
    fix_basis(W_, right_Z_, right_Lambda_);
  }

  bool closes() {
    before_ = counts_.certificate_work;
    return closes(0.0, 1.0, 0, INFINITY);
  }
  /// Whether it would have taken too much work.
  bool gave_up() const { return gave_up_; }

 private:
  /// The interpolated pair and pencil at one value of t.
  struct State {
    State(std::shared_ptr<const StepPencil::Sample> at, Chart chart, Eigen::Index n, Eigen::Index k)
        : sample(std::move(at)),
          pencil(sample->at, chart),
          Z(ComplexMatrix::Zero(n, k)),
          Lambda(ComplexMatrix::Zero(k, k)) {}

    PairAtPlace place() const { return {pencil, Z, Lambda}; }

    std::shared_ptr<const StepPencil::Sample> sample;
    PencilAtPoint pencil;  ///< of the sample
    ComplexMatrix Z, Lambda;
  };

  State state(double t) const {
    State state(pencil_.at(t), chart_, W_.rows() / 2, W_.cols());
    const Vector& w = state.sample->weights;
    const auto count = static_cast<Eigen::Index>(left_Z_.size());
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      state.Z += w[i] * left_Z_[at] + w[count + i] * right_Z_[at];
      state.Lambda += w[i] * left_Lambda_[at] + w[count + i] * right_Lambda_[at];
    }
    return state;
  }

  /// F(U): the residual of the pair's equation (n k), then that of the normalization (k^2).
  ComplexVector residual(const State& s) const {
    const Eigen::Index n = s.Z.rows();
    const Eigen::Index k = s.Z.cols();
    const ComplexMatrix R = s.pencil.residual(s.Z, s.Lambda);
    const ComplexMatrix N =
        W_.topRows(n).adjoint() * s.Z + W1_.adjoint() * (s.Z * s.Lambda) - ComplexMatrix::Identity(k, k);
    ComplexVector F(n * k + k * k);
    F << R.reshaped(), N.reshaped();
    return F;
  }

  /// Whether the tube closes between `begin` and `end`, after halvings where needed. `last` is Z1 of the
  /// piece that was halved into this one and another.
  bool closes(double begin, double end, int depth, double last) {
    const double middle = 0.5 * (begin + end);
    double Z1 = 0.0;
    if (piece_closes(begin, middle, end, Z1)) return true;
    // Z1 decreases at best in proportion to the length of the piece.
    if (!(Z1 < std::exp2(max_depth - depth)) || depth == max_depth || (Z1 >= 1.0 && Z1 > falling * last))
      return false;
    if (counts_.certificate_work - before_ > most_work) {
      gave_up_ = true;
      return false;
    }
    return closes(begin, middle, depth + 1, Z1) && closes(middle, end, depth + 1, Z1);
  }

  /// A sample point of a piece.
  struct PlaceOnPiece {
    double t;
    int iterations;  ///< power iterations of the norm estimate there
  };

  /// The same without halving. Sets Z1.
  bool piece_closes(double begin, double middle, double end, double& Z1) {
    const State centre = state(middle);
    const double scale = unknown_scale(gap_, centre.Lambda.norm());
    const auto samples = samples_of(begin, middle, end);
    if (centre.Z.size() + centre.Lambda.size() <= largest_matrix) {
      count(1, centre.Z.size() + centre.Lambda.size());
      return closes_about(centre, WholeInverse(centre.place(), W_, scale), samples, Z1);
    }
    count(W_.cols(), centre.Z.rows() + W_.cols());
    return closes_about(centre, TriangularInverse(centre.place(), W_, W1_, scale), samples, Z1);
  }

  /// Counts LUs of a size, with the solutions for the bounds.
  void count(Eigen::Index factorizations, Eigen::Index size) {
    const auto n = static_cast<double>(size);
    counts_.certificate_factorizations += static_cast<std::uint64_t>(factorizations);
    counts_.certificate_work += static_cast<double>(factorizations) * n * n * (n / 3.0 + solutions);
  }

  /// The same with B at the middle. The tube closes if (1 - Z1)^2 > 2 Z2 Y with Z1 < 1: then some r satisfies
  /// Y + Z1 r + Z2 r^2/2 <= r. Z1 is set to that of the begin.
  template <class Inverse>
  bool closes_about(const State& centre, const Inverse& B, const std::array<PlaceOnPiece, 4>& samples,
                    double& Z1) const {
    AdaptedNorm norm;
    double largest = 0.0;
    double Y = size_of_solved(B, residual(centre), norm);
    if (!std::isfinite(Y)) return false;
    ComplexVector direction = start_vector(centre.Z.size() + centre.Lambda.size());
    for (const auto& [t, iterations] : samples) {
      const State s = state(t);
      const auto change = B.change_to(s.place());
      double size = norm_of_solved(B, change, iterations, norm, direction);
      if (t == samples.front().t) {
        Z1 = size;
        if (size >= 1.0) {
          norm = adapted_norm(B, change, direction);
          direction = start_vector(direction.size());
          size = norm_of_solved(B, change, power_iterations, norm, direction);
          Z1 = size;
        }
      }
      largest = std::max(largest, size);
      if (!(largest < 1.0)) return false;
      Y = std::max(Y, size_of_solved(B, residual(s), norm));
    }
    const double stretched = norm.largest_factor();
    if (!norm.is_plain()) Y = std::max(Y, size_of_solved(B, residual(centre), norm));
    const double room = 1.0 - largest;
    return curvature_is_below(room * room / (2.0 * Y) / (stretched * stretched), centre, B, norm);
  }

  /// The norm in which B A is small, if that is possible by scaling few directions.
  template <class Inverse, class Operator>
  static AdaptedNorm adapted_norm(const Inverse& B, const Operator& A, const ComplexVector& direction) {
    const auto times = [&](const ComplexMatrix& X) {
      ComplexMatrix Y = A.times(X);
      B.apply(Y);
      return Y;
    };
    const auto adjoint_times = [&](ComplexMatrix X) {
      B.apply_adjoint(X);
      return ComplexMatrix(A.adjoint_times(X));
    };
    const Eigen::Index size = direction.size();
    const Eigen::Index wanted = std::clamp(size / unknowns_per_direction, least_directions, most_directions);
    ComplexMatrix Q(size, std::min(wanted, size));
    for (Eigen::Index j = 0; j < Q.cols(); ++j)
      Q.col(j) = j == 0 ? direction : start_vector(Q.rows(), static_cast<double>(j));
    ComplexMatrix adjoint;
    for (int i = 0; i < subspace_iterations; ++i) {
      Q = orthonormal(times(i == 0 ? Q : orthonormal(adjoint)));
      adjoint = adjoint_times(Q);
    }
    if (!adjoint.allFinite()) return {};
    // The left singular vectors.
    const Eigen::SelfAdjointEigenSolver<ComplexMatrix> squares(adjoint.adjoint() * adjoint);
    Q = Q * squares.eigenvectors();
    adjoint = adjoint * squares.eigenvectors();
    const ComplexMatrix TQ = times(Q);
    return TQ.allFinite() ? AdaptedNorm::balancing(std::move(Q), TQ, adjoint) : AdaptedNorm();
  }

  static ComplexMatrix orthonormal(const ComplexMatrix& X) {
    return X.householderQr().householderQ() * ComplexMatrix::Identity(X.rows(), X.cols());
  }

  /// The ends come first, because they differ most from the middle. The direction that the operator magnifies
  /// most is about the same at all samples, so the later ones need fewer power iterations.
  static std::array<PlaceOnPiece, 4> samples_of(double begin, double middle, double end) {
    return {{{begin, power_iterations},
             {end, further_iterations},
             {0.5 * (begin + middle), further_iterations},
             {0.5 * (middle + end), further_iterations}}};
  }

  /// |B F|; infinite if it is not a number.
  template <class Inverse>
  static double size_of_solved(const Inverse& B, ComplexVector F, const AdaptedNorm& norm) {
    B.apply(F);
    norm.apply_inverse(F);
    const double size = F.norm();
    return std::isfinite(size) ? size : INFINITY;
  }

  /// Whether Z2 >= |B F''|, of changes in the plain norm, is below a limit. F'' is bilinear in the changes of
  /// Z and Lambda; `equations` and `normalization` bound its coefficients in both parts of F.
  template <class Inverse>
  bool curvature_is_below(double limit, const State& s, const Inverse& B, const AdaptedNorm& norm) const {
    const double mu = s.Lambda.norm();
    const double M = s.pencil.norm_M;
    const double scale = B.scale();
    const double equations =
        2.0 * ((2.0 * M * mu + s.pencil.norm_C) * scale + M * s.Z.norm() * scale * scale);
    const double normalization = 2.0 * W1_.norm() * scale;
    Diagonal weights{Vector(s.Z.size() + s.Lambda.size())};
    weights.entries << Vector::Constant(s.Z.size(), equations),
        Vector::Constant(s.Lambda.size(), normalization);
    ComplexVector direction = start_vector(weights.entries.size());
    // Far below the limit, as nearly always, one solution tells: |A v| is about |A| / sqrt(n) or more.
    const auto n = static_cast<double>(direction.size());
    ComplexVector once = weights.times(direction.normalized());
    B.apply(once);
    norm.apply_inverse(once);
    if (rough_safety * std::sqrt(n) * once.norm() < limit) return true;
    return curvature_safety * norm_of_solved(B, weights, power_iterations, norm, direction, true) < limit;
  }

  /// A real diagonal matrix.
  struct Diagonal {
    Vector entries;

    ComplexVector times(const ComplexVector& v) const { return entries.cwiseProduct(v); }
    ComplexVector adjoint_times(const ComplexVector& v) const { return times(v); }
  };

  /// Start of a power iteration: a vector without symmetry, so that it is not orthogonal to the wanted one.
  static ComplexVector start_vector(Eigen::Index size, double number = 0.0) {
    ComplexVector v(size);
    for (Eigen::Index i = 0; i < size; ++i) {
      const auto place = static_cast<double>(i);
      v[i] = {std::cos(1.7 * number * place), std::sin(1.0 + (2.3 + number) * place)};
    }
    return v;
  }

  /// Estimate of |B A|, times norm_safety, by power iteration from the direction v, which is overwritten with
  /// the last one. `from_plain`: A maps from the plain norm.
  template <class Inverse, class Operator>
  static double norm_of_solved(const Inverse& B, const Operator& A, int iterations, const AdaptedNorm& norm,
                               ComplexVector& v, bool from_plain = false) {
    double size = 0.0;
    for (int i = 0; i < iterations; ++i) {
      v.normalize();
      if (!from_plain) norm.apply(v);
      ComplexVector w = A.times(v);
      B.apply(w);
      norm.apply_inverse(w);
      size = std::max(size, w.norm());
      norm.apply_inverse(w);  // S is Hermitian
      B.apply_adjoint(w);
      ComplexVector next = A.adjoint_times(w);
      if (!from_plain) norm.apply(next);
      const double length = next.norm();
      if (!(length > 0.0)) return norm_safety * size;
      size = std::max(size, std::sqrt(length));
      v = std::move(next);
    }
    return norm_safety * size;
  }

  const StepPencil& pencil_;
  Chart chart_;
  ComplexMatrix W_, W1_;
  RunCounts& counts_;
  double before_ = 0.0;  ///< work before this tube
  bool gave_up_ = false;
  double gap_;
  std::vector<ComplexMatrix> left_Z_, left_Lambda_, right_Z_, right_Lambda_;
};

}  // namespace

bool certify_step(const StepPencil& pencil, const Track& left, const Track& right, double gap,
                  RunCounts& counts, bool* gave_up) {
  Tube tube(pencil, left, right, gap, counts);
  const bool closes = tube.closes();
  if (gave_up != nullptr) *gave_up = tube.gave_up();
  return closes;
}

}  // namespace eigentrail
