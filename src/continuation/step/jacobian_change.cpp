#include "continuation/step/jacobian_change.hpp"

#include <algorithm>
#include <cmath>

#include "core/band_matrix.hpp"

namespace eigentrail {

double unknown_scale(double gap, double size) {
  // As a share of the size: keeps the equations well-conditioned where the distance is nearly zero.
  constexpr double least = 1e-6;
  constexpr double tiny = 1e-300;
  if (!std::isfinite(gap)) return std::max(size, tiny);
  return std::max({0.5 * gap, least * size, tiny});
}

PairAtPlace::PairAtPlace(const PencilAtPoint& its_pencil, const ComplexMatrix& its_Z,
                         const ComplexMatrix& its_Lambda)
    : pencil(its_pencil),
      Z(its_Z),
      Lambda(its_Lambda),
      MZ(multiply(pencil.M, pencil.bands.M, Z)),
      slope(MZ.lazyProduct(Lambda) + multiply(pencil.C, pencil.bands.C, Z)) {}

ComplexMatrix PairAtPlace::residual() const {
  return slope.lazyProduct(Lambda) + multiply(pencil.K, pencil.bands.K, Z);
}

/// The n x n block (i, j) maps column j of Z to column i of the residual. It is (Lambda^2)(j, i) M +
/// Lambda(j, i) C, plus K for i = j. The blocks of Lambda and of the normalization are arranged in the same
/// way.
ComplexMatrix jacobian_matrix(const PairAtPlace& at, const ComplexMatrix& W, double scale) {
  const auto& [pencil, Z, Lambda, MZ, slope] = at;
  const Eigen::Index n = Z.rows();
  const Eigen::Index k = Z.cols();
  const ComplexMatrix L2 = Lambda * Lambda;
  const ComplexMatrix W0 = W.topRows(n).adjoint();
  const ComplexMatrix W1 = W.bottomRows(n).adjoint();
  const ComplexMatrix W1Z = W1 * Z;
  ComplexMatrix J(n * k + k * k, n * k + k * k);
  for (Eigen::Index j = 0; j < k; ++j) {
    for (Eigen::Index i = 0; i < k; ++i) {
      const Complex l = Lambda(j, i);
      const double own = i == j ? 1.0 : 0.0;
      auto P = J.block(i * n, j * n, n, n);
      P.real() = L2(j, i).real() * pencil.M + l.real() * pencil.C + own * pencil.K;
      P.imag() = L2(j, i).imag() * pencil.M + l.imag() * pencil.C;
      J.block(i * n, n * k + j * k, n, k) = scale * (l * MZ + own * slope);
      J.block(n * k + i * k, j * n, k, n) = own * W0 + l * W1;
      J.block(n * k + i * k, n * k + j * k, k, k) = scale * own * W1Z;
    }
  }
  return J;
}

JacobianChange::JacobianChange(const PairAtPlace& from, const PairAtPlace& to, const ComplexMatrix& W1,
                               double scale)
    : from_(from),
      to_(to),
      W1_(W1),
      scale_(scale),
      Z_(to.Z - from.Z),
      Lambda_(to.Lambda - from.Lambda),
      slope_(to.slope - from.slope) {
  if (from.pencil.bands && to.pencil.bands) {
    set_bands();
  } else {
    set_terms();
  }
}

void JacobianChange::set_bands() {
  const Eigen::Index k = Z_.cols();
  const ComplexMatrix square_a = from_.Lambda * from_.Lambda;
  const ComplexMatrix square_b = to_.Lambda * to_.Lambda;
  for (Eigen::Index j = 0; j < k; ++j) {
    for (Eigen::Index i = 0; i < k; ++i) {
      const double own = i == j ? 1.0 : 0.0;
      bands_.push_back(to_.pencil.bands.sum(square_b(j, i), to_.Lambda(j, i), own) -
                       from_.pencil.bands.sum(square_a(j, i), from_.Lambda(j, i), own));
    }
  }
}

void JacobianChange::set_terms() {
  std::vector<const Matrix*> terms;
  const auto add = [&](const Matrix& B, ComplexMatrix L) {
    terms.push_back(&B);
    L_.push_back(std::move(L));
  };
  const auto add_change = [&](const Matrix& from, const ComplexMatrix& L_from, const Matrix& to,
                              const ComplexMatrix& L_to) {
    if (from == to) return add(to, L_to - L_from);
    add(to, L_to);
    add(from, -L_from);
  };
  add_change(from_.pencil.M, from_.Lambda * from_.Lambda, to_.pencil.M, to_.Lambda * to_.Lambda);
  add_change(from_.pencil.C, from_.Lambda, to_.pencil.C, to_.Lambda);
  const Matrix K = to_.pencil.K - from_.pencil.K;
  add(K, ComplexMatrix::Identity(Z_.cols(), Z_.cols()));
  const Eigen::Index n = Z_.rows();
  B_.resize(n * static_cast<Eigen::Index>(terms.size()), n);
  for (std::size_t i = 0; i < terms.size(); ++i)
    B_.middleRows(static_cast<Eigen::Index>(i) * n, n) = *terms[i];
}

ComplexMatrix JacobianChange::pencil_times(const ComplexMatrix& X) const {
  const Eigen::Index n = Z_.rows();
  const Eigen::Index k = Z_.cols();
  ComplexMatrix R = ComplexMatrix::Zero(n, X.cols());
  if (!bands_.empty()) {
    for (Eigen::Index first = 0; first < X.cols(); first += k)
      for (std::size_t at = 0; at < bands_.size(); ++at) {
        const auto entry = static_cast<Eigen::Index>(at);
        add_band_product(bands_[at], X.col(first + entry / k).data(), R.col(first + entry % k).data());
      }
    return R;
  }
  const ComplexMatrix BX = multiply(B_, X);
  for (Eigen::Index first = 0; first < X.cols(); first += k)
    for (std::size_t i = 0; i < L_.size(); ++i)
      R.middleCols(first, k) += BX.block(static_cast<Eigen::Index>(i) * n, first, n, k).lazyProduct(L_[i]);
  return R;
}

ComplexMatrix JacobianChange::pencil_adjoint_times(const ComplexMatrix& R) const {
  const Eigen::Index n = Z_.rows();
  const Eigen::Index k = Z_.cols();
  if (!bands_.empty()) {
    ComplexMatrix X = ComplexMatrix::Zero(n, R.cols());
    for (Eigen::Index first = 0; first < R.cols(); first += k)
      for (std::size_t at = 0; at < bands_.size(); ++at) {
        const auto entry = static_cast<Eigen::Index>(at);
        add_adjoint_band_product(bands_[at], R.col(first + entry % k).data(),
                                 X.col(first + entry / k).data());
      }
    return X;
  }
  ComplexMatrix RL(B_.rows(), R.cols());
  for (std::size_t i = 0; i < L_.size(); ++i) {
    for (Eigen::Index first = 0; first < R.cols(); first += k)
      RL.block(static_cast<Eigen::Index>(i) * n, first, n, k) =
          R.middleCols(first, k).lazyProduct(L_[i].adjoint());
  }
  return transposed_multiply(B_, RL);
}

ComplexMatrix JacobianChange::times(const ComplexMatrix& V) const {
  const Eigen::Index n = Z_.rows();
  const Eigen::Index k = Z_.cols();
  const Eigen::Index m = V.cols();
  const ComplexMatrix X = V.topRows(n * k).reshaped(n, k * m);
  const ComplexMatrix PX = pencil_times(X);
  ComplexMatrix result(V.rows(), m);
  for (Eigen::Index j = 0; j < m; ++j) {
    const ComplexMatrix Y = scale_ * V.col(j).tail(k * k).reshaped(k, k);
    const ComplexMatrix R = PX.middleCols(j * k, k) + to_.MZ.lazyProduct(Y * to_.Lambda) -
                            from_.MZ.lazyProduct(Y * from_.Lambda) + slope_.lazyProduct(Y);
    const ComplexMatrix N = W1_.adjoint() * (X.middleCols(j * k, k).lazyProduct(Lambda_) + Z_.lazyProduct(Y));
    result.col(j) << R.reshaped(), N.reshaped();
  }
  return result;
}

ComplexMatrix JacobianChange::adjoint_times(const ComplexMatrix& V) const {
  const Eigen::Index n = Z_.rows();
  const Eigen::Index k = Z_.cols();
  const Eigen::Index m = V.cols();
  const ComplexMatrix R = V.topRows(n * k).reshaped(n, k * m);
  const ComplexMatrix PR = pencil_adjoint_times(R);
  ComplexMatrix result(V.rows(), m);
  for (Eigen::Index j = 0; j < m; ++j) {
    const auto Rj = R.middleCols(j * k, k);
    const ComplexMatrix W1N = W1_.lazyProduct(V.col(j).tail(k * k).reshaped(k, k));
    const ComplexMatrix X = PR.middleCols(j * k, k) + W1N.lazyProduct(Lambda_.adjoint());
    const ComplexMatrix Y = (to_.MZ.adjoint() * Rj) * to_.Lambda.adjoint() -
                            (from_.MZ.adjoint() * Rj) * from_.Lambda.adjoint() + slope_.adjoint() * Rj +
                            Z_.adjoint() * W1N;
    result.col(j) << X.reshaped(), scale_ * Y.reshaped();
  }
  return result;
}

PairCurvature::PairCurvature(const PairAtPlace& at, const ComplexMatrix& W1, double scale, Eigen::Index i,
                             Eigen::Index j)
    : at_(at), W1_(W1), scale_(scale), E_(ComplexMatrix::Zero(at.Lambda.rows(), at.Lambda.cols())) {
  E_(i, j) = scale;
  EL_ = E_ * at.Lambda + at.Lambda * E_;
}

ComplexVector PairCurvature::times(const ComplexVector& v) const {
  const Eigen::Index n = at_.Z.rows();
  const Eigen::Index k = at_.Z.cols();
  const ComplexMatrix X = v.head(n * k).reshaped(n, k);
  const ComplexMatrix L = scale_ * v.tail(k * k).reshaped(k, k);
  const ComplexMatrix R = multiply(at_.pencil.M, at_.pencil.bands.M, X).lazyProduct(EL_) +
                          multiply(at_.pencil.C, at_.pencil.bands.C, X).lazyProduct(E_) +
                          at_.MZ.lazyProduct(0.5 * (L * E_ + E_ * L));
  const ComplexMatrix N = (W1_.adjoint() * X) * E_;
  ComplexVector result(v.size());
  result << R.reshaped(), N.reshaped();
  return result;
}

ComplexVector PairCurvature::adjoint_times(const ComplexVector& v) const {
  const Eigen::Index n = at_.Z.rows();
  const Eigen::Index k = at_.Z.cols();
  const ComplexMatrix R = v.head(n * k).reshaped(n, k);
  const ComplexMatrix N = v.tail(k * k).reshaped(k, k);
  const ComplexMatrix X =
      transposed_multiply(at_.pencil.M, at_.pencil.bands.M, R.lazyProduct(EL_.adjoint())) +
      transposed_multiply(at_.pencil.C, at_.pencil.bands.C, R.lazyProduct(E_.adjoint())) +
      W1_.lazyProduct(N * E_.adjoint());
  const ComplexMatrix of_R = 0.5 * (at_.MZ.adjoint() * R);
  const ComplexMatrix L = scale_ * (of_R * E_.adjoint() + E_.adjoint() * of_R);
  ComplexVector result(v.size());
  result << X.reshaped(), L.reshaped();
  return result;
}

}  // namespace eigentrail
