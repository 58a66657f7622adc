// All pairs of an undamped symmetric pencil at once, by products of real matrices.
//
// Without velocity-dependent forces the pencil is lambda M + K with lambda = s^2. For symmetric M > 0 and
// symmetric K the eigenvectors are real and M-orthonormal,
//
//     K X + M X diag(lambda) = 0,     X^T M X = I,
//
// and in their coordinates the linearized equations decouple: the change X E removes the residual R = K X + M
// X diag(lambda) of approximate eigenvectors X, where
//
//     E_ab = (X^T R)_ab / (lambda_a - lambda_b)   (a and b of different blocks),
//
// This iteration converges quadratically without any factorization (Ogita & Aishima, Japan J. Indust. Appl.
// Math. 35, 2018, for M = I). The same division serves all orders of the series. All matrices are real and of
// size n; the state space (all_pairs.hpp) requires complex matrices of size 2n.
//
// Within a block of close modes there is no division. X spans the subspace of the block, in which lambda(h)
// becomes a matrix L(h). The pairs of the quadratic pencil follow from (X, L). For oscillations Lambda = i
// sqrt(-L), smooth as long as no lambda of the block is zero. A real block that contains both s and -s has Z
// = [X 0], Lambda = [0 I; L 0], which is always smooth.
#pragma once

#include <memory>
#include <vector>

#include "eigentrail/modes/invariant_pair.hpp"

namespace eigentrail {

/// Which square roots of its lambda a pair consists of.
enum class Root {
  imaginary,  ///< s = i omega, lambda < 0
  positive,   ///< s > 0, lambda > 0
  negative,   ///< s < 0, lambda > 0
  both        ///< s and -s
};

/// All pairs of a point.
struct SymmetricPairs {
  /// A single mode of the real pencil, or several close ones that are followed together: columns first ...
  /// first + size - 1 of X.
  struct Block {
    Eigen::Index first, size;
  };
  /// A pair of the quadratic pencil. A pair with the positive roots and the pair with the negative roots
  /// share a block.
  struct Pair {
    std::size_t block;
    Root root;
    ComplexMatrix W;  ///< normalization; 2n x size, or 2n x 2 size if the pair has both roots
  };

  std::vector<Block> blocks;
  std::vector<Pair> pairs;
  Matrix X;       ///< n x n, M-orthonormal
  Vector lambda;  ///< n; L of a block is diagonal at the point itself

  /// 1 / (lambda_a - lambda_b), n x n; zero within a block.
  Matrix divisors() const;
};

/// Refines all pairs of a pencil (finite chart), as correct_pair does for each; `corrected` gets the pairs.
/// Null if the iteration fails or the method does not apply: C is not zero, M or K is not symmetric, M is not
/// positive definite, the pairs are not all modes, a pair is in the reciprocal chart, or positive real roots
/// are grouped differently from the negative ones. Cost: four products of real matrices of size n per
/// iteration; two or three iterations usually suffice.
std::shared_ptr<const SymmetricPairs> correct_symmetric(const PencilAtPoint& pencil,
                                                        const std::vector<InvariantPair>& starts,
                                                        double reference, const CorrectorOptions& options,
                                                        ModeCounts& counts,
                                                        std::vector<InvariantPair>& corrected);

/// Power series of all pairs, as differentiate_pair for each. M and K must be symmetric and C zero along the
/// whole path. Cost: two products for each nonzero coefficient of M and K, one per order for the vectors, and
/// up to one per order and coefficient of M or K.
std::vector<PairSeries> differentiate_symmetric(const ReducedPencil& pencil, const SymmetricPairs& pairs,
                                                int order, ModeCounts& counts);

}  // namespace eigentrail
