// All pairs of an undamped symmetric pencil at once, by real matrix products.
//
// Without velocity-dependent forces the pencil is lambda M + K with lambda = s^2. Symmetric M > 0 and K have
// real vectors that are orthonormal in M,
//
//     K X + M X diag(lambda) = 0,     X^T M X = I,
//
// and in their coordinates the linearized equations fall apart: a residual R of approximate vectors is
// removed by the change X E,
//
//     E_ab = (X^T R)_ab / (lambda_a - lambda_b)   (a and b of different blocks),
//
// which converges quadratically without any factorization (Ogita & Aishima, Japan J. Indust. Appl. Math. 35,
// 2018, for M = I), and the same division serves every order of the series. All of it is real and of size n,
// where the state space (all_pairs.hpp) has complex matrices of size 2n.
//
// Within a block of close modes no difference divides: X spans its subspace, in which lambda(h) becomes a
// matrix L(h). The pairs of the quadratic pencil follow from (X, L): Lambda = i sqrt(-L) of oscillations,
// smooth as long as no lambda of the block vanishes; Z = [X 0], Lambda = [0 I; L 0] of a real block that
// keeps s and -s together, smooth wherever they are.
#pragma once

#include <memory>
#include <vector>

#include "eigentrail/modes/invariant_pair.hpp"

namespace eigentrail {

/// Which square roots of its lambda a pair follows.
enum class Root {
  imaginary,  ///< s = i omega, lambda < 0
  positive,   ///< s > 0, lambda > 0
  negative,   ///< s < 0, lambda > 0
  both        ///< s and -s
};

/// What a point keeps of all its pairs.
struct SymmetricPairs {
  /// Close modes of the real pencil that are followed together, or a single one: columns first ... first +
  /// size - 1.
  struct Block {
    Eigen::Index first, size;
  };
  /// A pair of the quadratic pencil; a positive root and its negative share a block.
  struct Pair {
    std::size_t block;
    Root root;
    ComplexMatrix W;  ///< 2n x size, or 2n x 2 size for both roots: normalization
  };

  std::vector<Block> blocks;
  std::vector<Pair> pairs;
  Matrix X;       ///< n x n, M-orthonormal
  Vector lambda;  ///< n; L of a block is diagonal at the point

  /// 1 / (lambda_a - lambda_b), n x n; zero within a block.
  Matrix divisors() const;
};

/// Refines all pairs of a pencil (chart finite), as correct_pair for each. Null when that did not
/// work or does not apply: C is there, M or K is not symmetric, M is not positive definite, the pairs are not
/// all modes, one is followed in the other chart, or real roots are grouped otherwise than their negatives.
/// Cost: four real products of matrices of size n per iteration, two or three of which do.
std::shared_ptr<const SymmetricPairs> correct_symmetric(const PencilAtPoint& pencil,
                                                        const std::vector<InvariantPair>& starts,
                                                        double reference, const CorrectorOptions& options,
                                                        ModeCounts& counts,
                                                        std::vector<InvariantPair>& corrected);

/// Power series of all of them, as differentiate_pair for each. M and K have to stay symmetric and C to
/// vanish along the path. Cost: two products for each coefficient of M and K that is not zero, one per order
/// for the vectors, and up to one per order and coefficient of M or K.
std::vector<PairSeries> differentiate_symmetric(const ReducedPencil& pencil, const SymmetricPairs& pairs,
                                                int order, ModeCounts& counts);

}  // namespace eigentrail
