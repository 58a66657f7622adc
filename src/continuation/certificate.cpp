#include "eigentrail/continuation/certificate.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "continuation/shared_basis.hpp"
#include "core/matrix_series.hpp"
#include "core/products.hpp"
#include "eigentrail/continuation/dense_output.hpp"

namespace eigentrail {
namespace {

constexpr int max_depth = 6;  ///< a step is halved up to this often
/// Where the tube is only too long its bound falls with its length; where modes meet it does not.
constexpr double falling = 0.75;
constexpr int power_iterations = 4;       ///< of a norm estimate, which approaches from below:
constexpr int further_iterations = 2;     ///< from the direction that another sample found
constexpr double norm_safety = 1.2;       ///< factor on it
constexpr double curvature_safety = 1.5;  ///< the curvature is taken at the middle of a piece
constexpr std::size_t most_samples = 64;  ///< that are kept: large pencils must not fill the memory

/// One block on one step.
class Tube {
 public:
  Tube(const StepPencil& pencil, const Track& left, const Track& right, double gap, RunCounts& counts)
      : pencil_(pencil),
        chart_(left.pair.chart),
        W_(left.pair.W),
        counts_(counts),
        gap_(gap),
        left_Z_(in_basis_of(pencil.left(), left.series.Z)),
        left_Lambda_(left.series.Lambda),
        right_Z_(in_basis_of(pencil.left(), right.series.Z)),
        right_Lambda_(right.series.Lambda) {
    fix_basis(W_, left_Z_, left_Lambda_);
    fix_basis(W_, right_Z_, right_Lambda_);
  }

  bool closes() { return closes(0.0, 1.0, 0, INFINITY); }

 private:
  struct State {
    std::shared_ptr<const StepPencil::Sample> sample;
    const Matrix& M;  ///< of the chart
    const Matrix& C;
    const Matrix& K;
    ComplexMatrix Z, Lambda;
  };

  State state(double t) const {
    const auto sample = pencil_.at(t);
    const Vector& w = sample->weights;
    const auto count = static_cast<Eigen::Index>(left_Z_.size());
    const bool finite = chart_ == Chart::finite;
    State state{sample,
                finite ? sample->M : sample->K,
                sample->C,
                finite ? sample->K : sample->M,
                ComplexMatrix::Zero(W_.rows() / 2, W_.cols()),
                ComplexMatrix::Zero(W_.cols(), W_.cols())};
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      state.Z += w[i] * left_Z_[at] + w[count + i] * right_Z_[at];
      state.Lambda += w[i] * left_Lambda_[at] + w[count + i] * right_Lambda_[at];
    }
    return state;
  }

  /// Jacobian with respect to (vec Z, vec Lambda / scale).
  ComplexMatrix jacobian(const State& s, double scale) const {
    return W_.cols() == 1 ? jacobian_of_mode(s, scale) : jacobian_of_block(s, scale);
  }

  ComplexMatrix jacobian_of_mode(const State& s, double scale) const {
    const Eigen::Index n = s.Z.rows();
    const Complex mu = s.Lambda(0, 0);
    const Complex square = mu * mu;
    ComplexMatrix J(n + 1, n + 1);
    J.topLeftCorner(n, n).real() = square.real() * s.M + mu.real() * s.C + s.K;
    J.topLeftCorner(n, n).imag() = square.imag() * s.M + mu.imag() * s.C;
    J.topRightCorner(n, 1) = scale * (2.0 * mu * multiply(s.M, s.Z) + multiply(s.C, s.Z));
    J.bottomLeftCorner(1, n) = W_.topRows(n).adjoint();
    J(n, n) = 0.0;  // W1 = 0
    return J;
  }

  /// Block (i, j) of size n x n belongs to columns i of the residual and j of Z: it is Lambda^2(j, i) M +
  /// Lambda(j, i) C, and K where i is j; the others likewise.
  ComplexMatrix jacobian_of_block(const State& s, double scale) const {
    const Eigen::Index n = s.Z.rows();
    const Eigen::Index k = s.Z.cols();
    const ComplexMatrix L2 = s.Lambda * s.Lambda;
    const ComplexMatrix MZ = multiply(s.M, s.Z);
    const ComplexMatrix slope = MZ * s.Lambda + multiply(s.C, s.Z);
    const ComplexMatrix W0 = W_.topRows(n).adjoint();
    const ComplexMatrix W1 = W_.bottomRows(n).adjoint();
    const ComplexMatrix W1Z = W1 * s.Z;
    ComplexMatrix J(n * k + k * k, n * k + k * k);
    for (Eigen::Index j = 0; j < k; ++j) {
      for (Eigen::Index i = 0; i < k; ++i) {
        const Complex l = s.Lambda(j, i);
        const double own = i == j ? 1.0 : 0.0;
        auto P = J.block(i * n, j * n, n, n);
        P.real() = L2(j, i).real() * s.M + l.real() * s.C + own * s.K;
        P.imag() = L2(j, i).imag() * s.M + l.imag() * s.C;
        J.block(i * n, n * k + j * k, n, k) = scale * (l * MZ + own * slope);
        J.block(n * k + i * k, j * n, k, n) = own * W0 + l * W1;
        J.block(n * k + i * k, n * k + j * k, k, k) = scale * own * W1Z;
      }
    }
    return J;
  }

  ComplexVector residual(const State& s) const {
    const Eigen::Index n = s.Z.rows();
    const Eigen::Index k = s.Z.cols();
    const ComplexMatrix slope = multiply(s.M, s.Z) * s.Lambda + multiply(s.C, s.Z);
    const ComplexMatrix R = slope * s.Lambda + multiply(s.K, s.Z);
    const ComplexMatrix N = W_.topRows(n).adjoint() * s.Z + W_.bottomRows(n).adjoint() * (s.Z * s.Lambda) -
                            ComplexMatrix::Identity(k, k);
    ComplexVector F(n * k + k * k);
    F << R.reshaped(), N.reshaped();
    return F;
  }

  /// `last` is the bound Z1 of the piece that was halved.
  bool closes(double begin, double end, int depth, double last) {
    const double middle = 0.5 * (begin + end);
    double Z1 = 0.0;
    if (piece_closes(begin, middle, end, Z1)) return true;
    if (depth == max_depth || (Z1 >= 1.0 && Z1 > falling * last)) return false;
    return closes(begin, middle, depth + 1, Z1) && closes(middle, end, depth + 1, Z1);
  }

  bool piece_closes(double begin, double middle, double end, double& Z1) {
    const State centre = state(middle);
    const double size = std::max(centre.Lambda.norm(), 1e-300);
    const double scale = std::clamp(0.5 * gap_, 1e-6 * size, 2.0 * size);
    const ComplexMatrix J = jacobian(centre, scale);
    const ComplexLu lu(J);
    ++counts_.certificate_factorizations;
    // The ends differ most from the middle; the direction that grows most is about the same everywhere.
    const std::array<double, 4> samples{begin, end, 0.5 * (begin + middle), 0.5 * (middle + end)};
    ComplexMatrix F(J.rows(), 1 + static_cast<Eigen::Index>(samples.size()));
    F.col(0) = residual(centre);
    ComplexVector direction = start_vector(J.cols());
    int iterations = power_iterations;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const State s = state(samples[i]);
      F.col(1 + static_cast<Eigen::Index>(i)) = residual(s);
      const ComplexMatrix change = jacobian(s, scale) - J;
      Z1 = std::max(Z1, norm_of_solved(lu, change, iterations, direction));
      if (!(Z1 < 1.0)) return false;
      iterations = further_iterations;
    }
    lu.solve_in_place(F);
    const double Y = F.colwise().norm().maxCoeff();
    if (!std::isfinite(Y)) return false;
    const double Z2 = curvature_safety * curvature(centre, scale, lu);
    const double room = 1.0 - Z1;
    return room * room > 2.0 * Z2 * Y;
  }

  /// Bound of |B F''|: F'' is bilinear in the changes of Z and of Lambda, with coefficients of the size
  /// below.
  double curvature(const State& s, double scale, const ComplexLu& lu) const {
    const double mu = s.Lambda.norm();
    const double equations =
        2.0 * ((2.0 * s.M.norm() * mu + s.C.norm()) * scale + s.M.norm() * s.Z.norm() * scale * scale);
    const double normalization = 2.0 * W_.bottomRows(s.Z.rows()).norm() * scale;
    const Eigen::Index rows = s.Z.size();
    Vector weights(lu.size());
    weights.head(rows).setConstant(equations);
    weights.tail(lu.size() - rows).setConstant(normalization);
    ComplexVector direction = start_vector(lu.size());
    return norm_of_solved(lu, weights, power_iterations, direction);
  }

  static ComplexVector times(const ComplexMatrix& A, const ComplexVector& v) { return product(A, v); }
  static ComplexVector adjoint_times(const ComplexMatrix& A, const ComplexVector& v) {
    return adjoint_product(A, v);
  }
  /// Of a real diagonal matrix.
  static ComplexVector times(const Vector& entries, const ComplexVector& v) {
    return entries.cwiseProduct(v);
  }
  static ComplexVector adjoint_times(const Vector& entries, const ComplexVector& v) {
    return entries.cwiseProduct(v);
  }

  /// Without symmetry.
  static ComplexVector start_vector(Eigen::Index size) {
    ComplexVector v(size);
    for (Eigen::Index i = 0; i < size; ++i) v[i] = {1.0, std::sin(1.0 + 2.3 * static_cast<double>(i))};
    return v;
  }

  /// |J^-1 A| by power iteration from a direction v, which it improves.
  template <class Operator>
  static double norm_of_solved(const ComplexLu& lu, const Operator& A, int iterations, ComplexVector& v) {
    double norm = 0.0;
    ComplexVector w(v.size());
    for (int i = 0; i < iterations; ++i) {
      v.normalize();
      w = times(A, v);
      lu.solve_in_place(w);
      norm = std::max(norm, w.norm());
      lu.solve_adjoint_in_place(w);
      ComplexVector next = adjoint_times(A, w);
      const double length = next.norm();
      if (!(length > 0.0)) return norm_safety * norm;
      norm = std::max(norm, std::sqrt(length));
      v = std::move(next);
    }
    return norm_safety * norm;
  }

  const StepPencil& pencil_;
  Chart chart_;
  ComplexMatrix W_;
  RunCounts& counts_;
  double gap_;
  std::vector<ComplexMatrix> left_Z_, left_Lambda_, right_Z_, right_Lambda_;
};

}  // namespace

namespace {

/// G^T B G up to h^order as `project` has it, by BLAS.
MatrixSeries congruence(const MatrixSeries& G, const MatrixSeries& B, int order) {
  const auto count = static_cast<std::size_t>(order) + 1;
  const MatrixSeries BG = product(B, G, std::min(count, B.size() + G.size() - 1));
  return transposed_product(G, BG, std::min(count, BG.size() + G.size() - 1));
}

}  // namespace

StepPencil::StepPencil(const PathNode& left, const PathNode& right, double length)
    : left_(left), length_(length), count_(0), right_(right.pencil) {
  for (const ReducedPencil* pencil : {&left.pencil, &right.pencil}) {
    count_ =
        std::max({count_, static_cast<Eigen::Index>(pencil->M.size()),
                  static_cast<Eigen::Index>(pencil->C.size()), static_cast<Eigen::Index>(pencil->K.size())});
  }
  for (const Track& track : left.tracks) {
    count_ = std::max(count_, static_cast<Eigen::Index>(track.series.Z.size()));
  }
  if (left.basis.is_identity) return;
  // T_left(h) = T_right(h) G(h) with G = (T_left(0)^T T_right(h))^-1 spans the same space in the left chart.
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

Matrix StepPencil::interpolate(const MatrixSeries& left, const MatrixSeries& right,
                               const Vector& weights) const {
  if (left.size() == 1 && right.size() == 1) return left[0];
  Matrix sum = Matrix::Zero(left[0].rows(), left[0].cols());
  for (std::size_t i = 0; i < left.size(); ++i) sum += weights[static_cast<Eigen::Index>(i)] * left[i];
  for (std::size_t i = 0; i < right.size(); ++i)
    sum += weights[count_ + static_cast<Eigen::Index>(i)] * right[i];
  return sum;
}

StepPencil::Sample StepPencil::sample(double t) const {
  ComplexMatrix left = ComplexMatrix::Zero(2 * count_, count_);
  ComplexMatrix right = left;
  left.topRows(count_).setIdentity();
  right.bottomRows(count_).setIdentity();
  Vector weights = HermiteInterpolant(length_, left, right)(t).real();
  Matrix M = interpolate(left_.pencil.M, right_.M, weights);
  Matrix C = interpolate(left_.pencil.C, right_.C, weights);
  Matrix K = interpolate(left_.pencil.K, right_.K, weights);
  return {std::move(weights), std::move(M), std::move(C), std::move(K)};
}

std::shared_ptr<const StepPencil::Sample> StepPencil::at(double t) const {
  const std::lock_guard lock(mutex_);
  const auto known = samples_.find(t);
  if (known != samples_.end()) return known->second;
  if (samples_.size() >= most_samples) samples_.clear();
  return samples_.emplace(t, std::make_shared<const Sample>(sample(t))).first->second;
}

bool certify_step(const StepPencil& pencil, const Track& left, const Track& right, double gap,
                  RunCounts& counts) {
  return Tube(pencil, left, right, gap, counts).closes();
}

}  // namespace eigentrail
