#include "eigentrail/modes/regroup.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "core/orthonormal.hpp"
#include "eigentrail/modes/block_parts.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

bool closed_under_conjugation(const ComplexVector& eigenvalues, const std::vector<int>& part) {
  const auto contains = [&](Complex s) {
    return std::any_of(part.begin(), part.end(), [&](int i) { return eigenvalues[i] == s; });
  };
  return std::all_of(part.begin(), part.end(), [&](int i) { return contains(std::conj(eigenvalues[i])); });
}

}  // namespace

InvariantPair with_conjugate(const InvariantPair& upper) {
  InvariantPair pair{.chart = upper.chart, .part = upper.part, .is_real = true};
  const Eigen::Index n = upper.Z.rows();
  const Eigen::Index k = upper.size();
  ComplexMatrix Z = upper.Z;
  if (k == 1) {
    // The phase that maximizes |Re z| makes Re z and Im z orthogonal, so the two columns stay independent.
    const Complex square = (Z.transpose() * Z)(0, 0);
    if (std::abs(square) > 0.0) Z *= std::conj(std::sqrt(square / std::abs(square)));
  }
  // Real form of Z Lambda = (a + i b) (R + i S) = (a R - b S) + i (a S + b R).
  const Matrix R = upper.Lambda.real();
  const Matrix S = upper.Lambda.imag();
  pair.Z = ComplexMatrix::Zero(n, 2 * k);
  pair.Z.leftCols(k) = Z.real().cast<Complex>();
  pair.Z.rightCols(k) = Z.imag().cast<Complex>();
  pair.Lambda = ComplexMatrix::Zero(2 * k, 2 * k);
  pair.Lambda.topLeftCorner(k, k) = R.cast<Complex>();
  pair.Lambda.topRightCorner(k, k) = S.cast<Complex>();
  pair.Lambda.bottomLeftCorner(k, k) = -S.cast<Complex>();
  pair.Lambda.bottomRightCorner(k, k) = R.cast<Complex>();
  if (k > 1) return pair;
  // Near the real axis Im z is as small as Im s (and zero for a single freedom). Scaled up, it keeps the
  // columns of [Z; Z Lambda] independent.
  const double size =
      std::max(pair.Z.col(1).norm(), std::abs(S(0, 0)) / std::max(upper.Lambda.norm(), 1e-300));
  if (size > 0.0) {
    pair.Z.col(1) /= size;
    pair.Lambda(0, 1) /= size;
    pair.Lambda(1, 0) *= size;
  }
  return pair;
}

InvariantPair join_pairs(const std::vector<const InvariantPair*>& parts, bool make_real) {
  std::vector<InvariantPair> blocks;
  for (const InvariantPair* part : parts) {
    const bool expand = make_real && !part->is_real;
    blocks.push_back(expand ? with_conjugate(*part) : *part);
  }
  const InvariantPair& first = *parts.front();
  InvariantPair joined{.chart = first.chart, .part = first.part, .is_real = make_real};
  Eigen::Index k = 0;
  for (const InvariantPair& block : blocks) k += block.size();
  joined.Z.resize(first.Z.rows(), k);
  joined.Lambda = ComplexMatrix::Zero(k, k);
  Eigen::Index at = 0;
  for (const InvariantPair& block : blocks) {
    joined.Z.middleCols(at, block.size()) = block.Z;
    joined.Lambda.block(at, at, block.size(), block.size()) = block.Lambda;
    at += block.size();
  }
  return joined;
}

ComplexVector pair_eigenvalues(const InvariantPair& pair) {
  if (pair.size() == 1) return pair.Lambda.col(0);
  if (!pair.is_real) return Eigen::ComplexEigenSolver<ComplexMatrix>(pair.Lambda, false).eigenvalues();
  return Eigen::EigenSolver<Matrix>(Matrix(pair.Lambda.real()), false).eigenvalues();
}

InvariantPair part_of(const InvariantPair& pair, const ComplexVector& eigenvalues,
                      const std::vector<int>& part) {
  std::vector<Complex> leading;
  for (const int i : part) leading.push_back(eigenvalues[i]);
  const OrderedSchur schur = ordered_schur(pair.Lambda, leading);
  const Eigen::Index k = pair.size();
  const auto size = static_cast<Eigen::Index>(part.size());
  const bool is_real = pair.is_real && closed_under_conjugation(eigenvalues, part);
  InvariantPair result{.chart = pair.chart, .part = pair.part, .is_real = is_real};
  ComplexMatrix basis = schur.U.leftCols(size);
  result.Lambda = schur.T.topLeftCorner(size, size);
  if (is_real) {
    Matrix parts(k, 2 * size);
    parts << basis.real(), basis.imag();
    const Eigen::ColPivHouseholderQR<Matrix> qr(parts);
    const Matrix real_basis = columns_of_Q(qr, size);
    basis = real_basis.cast<Complex>();
    result.Lambda = (real_basis.transpose() * pair.Lambda.real() * real_basis).cast<Complex>();
  }
  result.Z = pair.Z * basis;
  return result;
}

InvariantPair in_other_chart(const InvariantPair& pair) {
  InvariantPair result = pair;
  result.chart = other(pair.chart);
  result.Lambda = pair.Lambda.inverse();
  result.factors.reset();
  return result;
}

Vector eigenvalue_rounding(const InvariantPair& pair, const ComplexVector& roots, double entries) {
  return root_errors(block_functions({pair.Lambda}).col(0), roots,
                     function_rounding(pair.Lambda, entries * pair.rounding));
}

InvariantPair conjugated(const InvariantPair& pair) {
  InvariantPair result = pair;
  result.Z = pair.Z.conjugate();
  result.Lambda = pair.Lambda.conjugate();
  result.W = pair.W.conjugate();
  result.factors.reset();
  return result;
}

}  // namespace eigentrail
