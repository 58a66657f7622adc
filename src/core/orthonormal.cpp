#include "core/orthonormal.hpp"

namespace eigentrail {

Matrix columns_of_Q(const Eigen::ColPivHouseholderQR<Matrix>& qr, Eigen::Index count) {
  return qr.householderQ() * Matrix::Identity(qr.rows(), count);
}

ComplexMatrix columns_of_Q(const Eigen::HouseholderQR<ComplexMatrix>& qr, Eigen::Index count) {
  return qr.householderQ() * ComplexMatrix::Identity(qr.rows(), count);
}

Matrix whole_Q(const Eigen::HouseholderQR<Matrix>& qr) {
  return qr.householderQ();
}

Matrix whole_Q(const Eigen::ColPivHouseholderQR<Matrix>& qr) {
  return qr.householderQ();
}

ComplexMatrix whole_Q(const Eigen::ColPivHouseholderQR<ComplexMatrix>& qr) {
  return qr.householderQ();
}

ComplexMatrix least_squares(const ComplexMatrix& A, const ComplexMatrix& B) {
  return A.householderQr().solve(B);
}

Matrix orthonormal(const Matrix& A) {
  return Eigen::HouseholderQR<Matrix>(A).householderQ() * Matrix::Identity(A.rows(), A.cols());
}

ComplexMatrix orthonormal(const ComplexMatrix& A) {
  return columns_of_Q(Eigen::HouseholderQR<ComplexMatrix>(A), A.cols());
}

}  // namespace eigentrail
