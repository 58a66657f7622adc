#include "eigentrail/continuation/certificate.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "continuation/step/jacobian_change.hpp"
#include "continuation/step/shared_basis.hpp"
#include "core/matrix_series.hpp"
#include "core/products.hpp"
#include "eigentrail/continuation/dense_output.hpp"

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
/// Factor on a norm estimate. With a larger value fewer steps are certified, with a smaller one the bounds
/// may be too small and the evidence weaker.
constexpr double norm_safety = 1.2;
/// Factor on Z2, which is evaluated at the middle of a piece only and may be larger beside it.
constexpr double curvature_safety = 1.5;
/// Number of interpolated pencils that are cached per step: many large ones would fill the memory.
constexpr std::size_t most_samples = 64;

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

  void apply(ComplexVector& v) const { lu_.solve_in_place(v); }
  void apply_adjoint(ComplexVector& v) const { lu_.solve_adjoint_in_place(v); }
  double scale() const { return scale_; }

  struct Change {
    ComplexMatrix matrix;

    ComplexVector times(const ComplexVector& v) const { return product(matrix, v); }
    ComplexVector adjoint_times(const ComplexVector& v) const { return adjoint_product(matrix, v); }
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
      : at_(at), W1_(W1), scale_(scale), factors_(at.pencil, at.Z, at.Lambda, W) {}

  void apply(ComplexVector& v) const {
    factors_.solve_in_place(v);
    v.tail(at_.Lambda.size()) *= 1.0 / scale_;  // the division of complex numbers might underflow
  }
  void apply_adjoint(ComplexVector& v) const {
    v.tail(at_.Lambda.size()) *= 1.0 / scale_;
    factors_.solve_adjoint_in_place(v);
  }
  double scale() const { return scale_; }

  JacobianChange change_to(const PairAtPlace& other) const { return {at_, other, W1_, scale_}; }

 private:
  PairAtPlace at_;
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

  bool closes() { return closes(0.0, 1.0, 0, INFINITY); }

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
    if (depth == max_depth || (Z1 >= 1.0 && Z1 > falling * last)) return false;
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
  /// Y + Z1 r + Z2 r^2/2 <= r.
  template <class Inverse>
  bool closes_about(const State& centre, const Inverse& B, const std::array<PlaceOnPiece, 4>& samples,
                    double& Z1) const {
    double Y = 0.0;
    const auto has_finite_defect = [&](const State& s) {
      const double size = size_of_solved(B, residual(s));
      Y = std::max(Y, size);
      return std::isfinite(size);
    };
    if (!has_finite_defect(centre)) return false;
    ComplexVector direction = start_vector(centre.Z.size() + centre.Lambda.size());
    for (const auto& [t, iterations] : samples) {
      const State s = state(t);
      Z1 = std::max(Z1, norm_of_solved(B, B.change_to(s.place()), iterations, direction));
      if (!(Z1 < 1.0) || !has_finite_defect(s)) return false;
    }
    const double Z2 = curvature_safety * curvature(centre, B);
    const double room = 1.0 - Z1;
    return room * room > 2.0 * Z2 * Y;
  }

  /// The ends come first, because they differ most from the middle. The direction that the operator magnifies
  /// most is about the same at all samples, so the later ones need fewer power iterations.
  static std::array<PlaceOnPiece, 4> samples_of(double begin, double middle, double end) {
    return {{{begin, power_iterations},
             {end, further_iterations},
             {0.5 * (begin + middle), further_iterations},
             {0.5 * (middle + end), further_iterations}}};
  }

  /// |B F|.
  template <class Inverse>
  static double size_of_solved(const Inverse& B, ComplexVector F) {
    B.apply(F);
    return F.norm();
  }

  /// Bound of |B F''|. F'' is bilinear in the changes of Z and Lambda; `equations` and `normalization` bound
  /// its coefficients in both parts of F.
  template <class Inverse>
  double curvature(const State& s, const Inverse& B) const {
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
    return norm_of_solved(B, weights, power_iterations, direction);
  }

  /// A real diagonal matrix.
  struct Diagonal {
    Vector entries;

    ComplexVector times(const ComplexVector& v) const { return entries.cwiseProduct(v); }
    ComplexVector adjoint_times(const ComplexVector& v) const { return times(v); }
  };

  /// Start of a power iteration: a vector without symmetry, so that it is not orthogonal to the wanted one.
  static ComplexVector start_vector(Eigen::Index size) {
    ComplexVector v(size);
    for (Eigen::Index i = 0; i < size; ++i) v[i] = {1.0, std::sin(1.0 + 2.3 * static_cast<double>(i))};
    return v;
  }

  /// Estimate of |B A|, times norm_safety, by power iteration from the direction v, which is overwritten with
  /// the last one.
  template <class Inverse, class Operator>
  static double norm_of_solved(const Inverse& B, const Operator& A, int iterations, ComplexVector& v) {
    double norm = 0.0;
    for (int i = 0; i < iterations; ++i) {
      v.normalize();
      ComplexVector w = A.times(v);
      B.apply(w);
      norm = std::max(norm, w.norm());
      B.apply_adjoint(w);
      ComplexVector next = A.adjoint_times(w);
      const double length = next.norm();
      if (!(length > 0.0)) return norm_safety * norm;
      norm = std::max(norm, std::sqrt(length));
      v = std::move(next);
    }
    return norm_safety * norm;
  }

  const StepPencil& pencil_;
  Chart chart_;
  ComplexMatrix W_, W1_;
  RunCounts& counts_;
  double gap_;
  std::vector<ComplexMatrix> left_Z_, left_Lambda_, right_Z_, right_Lambda_;
};

}  // namespace

namespace {

/// Series of G^T B G up to h^order, as `project` computes it, by products that use BLAS.
MatrixSeries congruence(const MatrixSeries& G, const MatrixSeries& B, int order) {
  const auto count = static_cast<std::size_t>(order) + 1;
  const MatrixSeries BG = product(B, G, std::min(count, B.size() + G.size() - 1));
  return transposed_product(G, BG, std::min(count, BG.size() + G.size() - 1));
}

}  // namespace

StepPencil::StepPencil(const PathNode& left, const PathNode& right, double length, int part)
    : left_(left),
      left_pencil_(left.pencil.of(part)),
      length_(length),
      count_(0),
      right_(right.pencil.of(part)) {
  for (const ReducedPencil* pencil : {&left_pencil_, &std::as_const(right_)}) {
    count_ =
        std::max({count_, static_cast<Eigen::Index>(pencil->M.size()),
                  static_cast<Eigen::Index>(pencil->C.size()), static_cast<Eigen::Index>(pencil->K.size())});
  }
  for (const Track& track : left.tracks) {
    count_ = std::max(count_, static_cast<Eigen::Index>(track.series.Z.size()));
  }
  if (left.basis.is_identity || left.basis.parts) return;  // both have the same basis
  // T_right(h) G(h) with G = (T_left(0)^T T_right(h))^-1 spans the same space as T_right(h), in the reduced
  // coordinates of the left point.
  MatrixSeries overlap;
  for (const Matrix& T : right.basis.T) overlap.push_back(left.basis.T[0].transpose() * T);
  if (overlap.size() > 1)
    overlap.resize(static_cast<std::size_t>(count_), Matrix::Zero(overlap[0].rows(), overlap[0].cols()));
  const TangentBasis change{inverse_series(overlap), false};
  const int order = static_cast<int>(count_) - 1;
  if (right.linearization.K[0].is_sparse()) {  // a large model
    right_ = {congruence(change.T, right.pencil.M, order), congruence(change.T, right.pencil.C, order),
              congruence(change.T, right.pencil.K, order)};
    return;
  }
  right_ = {project(change, right.pencil.M, order), project(change, right.pencil.C, order),
            project(change, right.pencil.K, order)};
}

bool StepPencil::has_constant_leading_matrix() const {
  const bool constant_M = left_pencil_.M.size() == 1 && right_.M.size() == 1;
  const bool constant_C = left_pencil_.C.size() == 1 && right_.C.size() == 1;
  return constant_M && (constant_C || state_size(left_pencil_.M[0]) == 2 * left_pencil_.size());
}

Matrix StepPencil::interpolate(const MatrixSeries& left, const MatrixSeries& right,
                               const Vector& weights) const {
  if (left.size() == 1 && right.size() == 1) return left[0];
  Matrix sum = Matrix::Zero(left[0].rows(), left[0].cols());
  const auto add = [&](const MatrixSeries& series, Eigen::Index first) {
    const auto weight = [&](std::size_t i) { return weights[first + static_cast<Eigen::Index>(i)]; };
    std::size_t i = 0;
    // Three at a time: large matrices are in no cache, and the sum is read and written less often.
    for (; i + 3 <= series.size(); i += 3)
      sum += weight(i) * series[i] + weight(i + 1) * series[i + 1] + weight(i + 2) * series[i + 2];
    for (; i < series.size(); ++i) sum += weight(i) * series[i];
  };
  add(left, 0);
  add(right, count_);
  return sum;
}

std::shared_ptr<const StepPencil::Sample> StepPencil::sample(double t) const {
  ComplexMatrix left = ComplexMatrix::Zero(2 * count_, count_);
  ComplexMatrix right = left;
  left.topRows(count_).setIdentity();
  right.bottomRows(count_).setIdentity();
  Vector weights = HermiteInterpolant(length_, left, right)(t).real();
  ReducedPencil pencil{{interpolate(left_pencil_.M, right_.M, weights)},
                       {interpolate(left_pencil_.C, right_.C, weights)},
                       {interpolate(left_pencil_.K, right_.K, weights)}};
  return std::make_shared<const Sample>(std::move(weights), std::move(pencil));
}

std::shared_ptr<const StepPencil::Sample> StepPencil::at(double t) const {
  const std::lock_guard lock(mutex_);
  const auto known = samples_.find(t);
  if (known != samples_.end()) return known->second;
  if (samples_.size() >= most_samples) samples_.clear();
  return samples_.emplace(t, sample(t)).first->second;
}

bool certify_step(const StepPencil& pencil, const Track& left, const Track& right, double gap,
                  RunCounts& counts) {
  return Tube(pencil, left, right, gap, counts).closes();
}

}  // namespace eigentrail
