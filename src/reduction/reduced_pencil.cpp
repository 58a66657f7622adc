#include "eigentrail/reduction/reduced_pencil.hpp"

#include <algorithm>

#include "core/matrix_series.hpp"

namespace eigentrail {

MatrixSeries project(const TangentBasis& basis, const MatrixSeries& B, int order) {
  const MatrixSeries& T = basis.T;
  const auto top = [order](std::size_t sum_of_sizes, std::size_t factors) {
    return std::min<std::size_t>(static_cast<std::size_t>(order), sum_of_sizes - factors);
  };
  if (basis.is_identity) return {B.begin(), B.begin() + static_cast<std::ptrdiff_t>(top(B.size(), 1)) + 1};

  const MatrixSeries BT = multiply_series(B, T, top(B.size() + T.size(), 2) + 1);
  MatrixSeries result(top(BT.size() + T.size(), 2) + 1, Matrix::Zero(T[0].cols(), T[0].cols()));
  for (std::size_t i = 0; i < T.size(); ++i) {
    for (std::size_t j = 0; j < BT.size() && i + j < result.size(); ++j) {
      result[i + j].noalias() += T[i].transpose() * BT[j];
    }
  }
  return result;
}

ReducedPencil reduce(const Linearization& linearization, const TangentBasis& basis, int order) {
  return {project(basis, linearization.M, order), project(basis, linearization.C, order),
          project(basis, linearization.K, order)};
}

}  // namespace eigentrail
