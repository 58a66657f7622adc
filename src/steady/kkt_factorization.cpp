#include "eigentrail/steady/kkt_factorization.hpp"

#include <algorithm>
#include <limits>

#include "steady/bordered_kkt.hpp"
#include "steady/sparse_kkt.hpp"

namespace eigentrail {
namespace {

/// Reciprocal condition of the tangent stiffness up to which it counts as singular: the rounding level.
constexpr double singular = 1e-14;

/// Reciprocal condition from which on a bordered system is regular beyond doubt. The kernel is looked for
/// below; a larger value costs factorizations beside folds.
constexpr double nearly_singular = 1e-9;

/// Larger systems are not solved through the null space, whose matrices are dense.
constexpr Eigen::Index largest_dense = 5000;

double one_norm(const Matrix& matrix) {
  return matrix.cwiseAbs().colwise().sum().maxCoeff();
}

}  // namespace

KktFactorization::KktFactorization(const SystemMatrix& K, const SystemMatrix& A) : constraints_(A) {
  if (K.is_sparse() && (constraints_.is_sparse() || A.rows() == 0))
    sparse_ = SparseKkt::factor(K.sparse(), A.sparse());
  if (sparse_) {
    reciprocal_condition_ = sparse_->reciprocal_condition();
    return;
  }
  if (K.rows() > largest_dense) {
    reciprocal_condition_ = 0.0;
    return;
  }
  K_ = K.dense();
  factor_tangent();
}

KktFactorization::KktFactorization(const SystemMatrix& K, const SystemMatrix& A, const TrimDerivatives& trim)
    : KktFactorization(trim.trim.rows() > 0 ? KktFactorization(A) : KktFactorization(K, A)) {
  if (trim.trim.rows() == 0) return;
  bordered_ = std::make_shared<BorderedKkt>(K, constraints_, KktBorder::of(trim));
  reciprocal_condition_ = bordered_->reciprocal_condition();
}

Matrix KktFactorization::undetermined() const {
  if (!bordered_) return {};
  // A regular system needs no search for its kernel.
  return reciprocal_condition_ > nearly_singular ? Matrix(Matrix::Zero(2, bordered_->n_unknowns()))
                                                 : bordered_->kernel_in_border();
}

int KktFactorization::orientation() const {
  return bordered_ ? bordered_->orientation() : 0;
}

void KktFactorization::factor_tangent() {
  const Matrix& Q2 = constraints_.null_basis();
  if (Q2.cols() == 0) return;
  const Matrix tangent = Q2.transpose() * K_ * Q2;
  tangent_.compute(tangent);
  // Relative to K, because the projection carries rounding errors of the size of K's: a tangent stiffness
  // that cancels to rounding counts as zero, even if it is a single number.
  const double scale = std::max(one_norm(K_), one_norm(tangent));
  reciprocal_condition_ = tangent.isZero(0.0) ? 0.0 : tangent_.rcond() * (one_norm(tangent) / scale);
  if (!(reciprocal_condition_ > singular)) {
    const double largest = tangent.colwise().norm().maxCoeff();
    singular_tangent_.setThreshold(largest > 0.0 ? singular * scale / largest : 1.0);
    singular_tangent_.compute(tangent);
  }
}

void KktFactorization::solve(const Vector& r, const Vector& g, Vector& dx, Vector& dl) const {
  Vector unknowns;
  if (sparse_) {
    sparse_->solve(r, g, Vector(0), dx, dl, unknowns);
    return;
  }
  if (bordered_) {
    const Eigen::Index m = bordered_->n_constraints();
    Vector reactions;
    bordered_->solve(r, g.head(m), g.tail(g.size() - m), dx, reactions, unknowns);
    dl.resize(g.size());
    dl << reactions, unknowns;
    return;
  }
  if (!can_solve()) {
    dx = Vector::Constant(r.size(), std::numeric_limits<double>::quiet_NaN());
    dl = Vector::Constant(g.size(), std::numeric_limits<double>::quiet_NaN());
    return;
  }
  const Matrix& Q2 = constraints_.null_basis();
  dx = constraints_.pseudo_inverse_times(g);
  if (Q2.cols() > 0) {
    const Vector tangential = Q2.transpose() * (r - K_ * dx);
    const bool regular = reciprocal_condition_ > singular;
    dx += Q2 *
          (regular ? tangent_.solve(tangential).eval() : Vector(singular_tangent_.solve(Matrix(tangential))));
  }
  dl = constraints_.transposed_pseudo_inverse_times(r - K_ * dx);
}

}  // namespace eigentrail
