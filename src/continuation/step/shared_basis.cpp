#include "continuation/step/shared_basis.hpp"

#include "core/matrix_series.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {

std::vector<ComplexMatrix> in_basis_of(const PathNode& node, const std::vector<ComplexMatrix>& physical,
                                       int part) {
  if (node.basis.is_identity) return physical;
  const Eigen::Index k = physical[0].cols();
  const auto count = static_cast<Eigen::Index>(physical.size());
  ComplexMatrix all(physical[0].rows(), k * count);
  for (Eigen::Index i = 0; i < count; ++i) all.middleCols(i * k, k) = physical[static_cast<std::size_t>(i)];
  const ComplexMatrix coordinates = node.basis.coordinates(all, part);
  std::vector<ComplexMatrix> result;
  result.reserve(physical.size());
  for (Eigen::Index i = 0; i < count; ++i) result.emplace_back(coordinates.middleCols(i * k, k));
  return result;
}

void fix_length(const ComplexVector& w, std::vector<ComplexMatrix>& Z) {
  const auto count = static_cast<Eigen::Index>(Z.size());
  ComplexVector length(count);
  for (Eigen::Index i = 0; i < count; ++i) length[i] = w.dot(Z[static_cast<std::size_t>(i)].col(0));
  const ComplexVector S = reciprocal_series(length);
  for (Eigen::Index j = count - 1; j >= 0; --j) {
    ComplexMatrix& sum = Z[static_cast<std::size_t>(j)];
    sum *= S[0];
    for (Eigen::Index i = 0; i < j; ++i) sum += S[j - i] * Z[static_cast<std::size_t>(i)];
  }
}

/// Replaces (Z, Lambda) by (Z S, S^-1 Lambda S) with S = (W0^H Z + W1^H Z Lambda)^-1.
void fix_basis(const ComplexMatrix& W, std::vector<ComplexMatrix>& Z, std::vector<ComplexMatrix>& Lambda) {
  const std::size_t count = Z.size();
  const Eigen::Index n = Z[0].rows();
  if (Z[0].cols() == 1) return fix_length(W.col(0).head(n), Z);
  const std::vector<ComplexMatrix> ZL = multiply_series(Z, Lambda, count);
  std::vector<ComplexMatrix> N(count);
  for (std::size_t i = 0; i < count; ++i) {
    N[i] = thin_product(W.topRows(n).adjoint(), Z[i]) + thin_product(W.bottomRows(n).adjoint(), ZL[i]);
  }
  const std::vector<ComplexMatrix> S = inverse_series(N);
  Z = multiply_series(Z, S, count);
  Lambda = multiply_series(N, multiply_series(Lambda, S, count), count);
}

DenseBlock block_on_step(const PathNode& left, const PathNode& right, std::size_t index) {
  const Track& a = left.tracks[index];
  const Track& b = right.tracks[index];
  DenseBlock block;
  block.chart = a.pair.chart;
  block.left = a.functions;
  block.right = b.functions;
  if (a.size() <= 2) return block;
  std::vector<ComplexMatrix> Z = in_basis_of(left, b.series.Z, b.pair.part);
  std::vector<ComplexMatrix> Lambda = b.series.Lambda;
  fix_basis(a.pair.W, Z, Lambda);
  block.right = block_functions(Lambda);
  return block;
}

HermiteInterpolant functions_on_step(const PathNode& left, const PathNode& right, std::size_t index,
                                     double length) {
  const Track& a = left.tracks[index];
  if (a.size() <= 2) return {length, a.functions, right.tracks[index].functions};
  const DenseBlock block = block_on_step(left, right, index);
  return {length, block.left, block.right};
}

}  // namespace eigentrail
