// Constant coordinates in which the linearized equations fall apart into independent parts: axial motion,
// torsion and bending of a shaft, equal columns side by side, harmonics of a ring of blades.
//
// Matrices A_k fall apart in common coordinates when pairs (X, Y) of matrices with Y A_k = A_k X for all k
// exist besides multiples of (I, I). The eigenspaces of a random X of this kind are the parts (Murota, Kanno,
// Kojima & Kojima, Japan J. Indust. Appl. Math. 27, 2010; Eberly & Giesbrecht, J. Symb. Comput. 37, 2004).
//
// The coordinates are also balanced: rows and columns are scaled by powers of two, so that units (metres and
// radians, newtons and meganewtons) do not decide what is large.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "eigentrail/core/constraint_factorization.hpp"
#include "eigentrail/model/model.hpp"

namespace eigentrail {

/// A part that equals another one, in coordinates in which its M, C and K are the same matrices as those of
/// that one, up to rounding.
struct PartCopy {
  Matrix right;    ///< n x size
  Matrix left;     ///< n x size
  Matrix inverse;  ///< size x n, inverse * right = I
};

/// New coordinates y with x = right y, and equations multiplied from the left by left^T. In them M, C and K
/// are block diagonal. Of equal parts y has only the first; the others are its copies. y has n' <= n entries,
/// with the copies as many as the system has freedoms.
struct IndependentParts {
  /// Coordinates of one part.
  struct Range {
    Eigen::Index first = 0, size = 0;
    /// Index of the first part with the same eigenvalues throughout; its own if there is none before it.
    std::size_t like = 0;
    std::vector<PartCopy> copies = {};  ///< parts that this one stands for, besides itself
    /// +1 or -1 for the two halves of a conjugate pair of complex parts (complex_blocks.hpp), which have the
    /// same coordinates, canonical ones; -1 follows +1. 0 for a real part.
    int complex_sign = 0;
  };

  Matrix right;    ///< n x n'
  Matrix left;     ///< n x n'
  Matrix inverse;  ///< n' x n, inverse * right = I
  /// n' x n', one where an entry of M, C or K may differ from zero, else zero: between the parts, and where
  /// the entry is rounding throughout, as in the stiffness of a rigid-body motion.
  Matrix pattern_M, pattern_C, pattern_K;
  std::vector<Range> ranges;
  bool is_diagonal = false;  ///< `right` and `left` only scale coordinates and equations
  /// n x freedoms. Where the tangent space turns along the path: the orthonormal basis of it, at one place,
  /// in which the coordinates are constant (`turned`). Empty where `right` itself is constant.
  Matrix frame;

  std::size_t count() const { return ranges.size(); }
  /// Whether there is more than one part, copies included.
  bool falls_apart() const { return count() > 1 || !ranges.front().copies.empty(); }
  /// Number of freedoms of all parts, copies included. Those of a conjugate pair count once.
  Eigen::Index freedoms() const;
  /// Whether a part is a single freedom that no force holds: a rigid-body motion, an integrator.
  bool is_free(const Range& part) const { return part.size == 1 && pattern_K(part.first, part.first) == 0.0; }
  /// Columns of `right` that belong to a part, n x size.
  auto columns(std::size_t part) const { return right.middleCols(ranges[part].first, ranges[part].size); }
  /// Rows of `inverse` that belong to a part, size x n.
  auto coordinates(std::size_t part) const {
    return inverse.middleRows(ranges[part].first, ranges[part].size);
  }
};

/// The independent parts of M, C and K that are linear combinations of these matrices, all n x n. Null
/// where they neither fall apart nor need balancing. Parts whose coupling is not zero up to rounding are not
/// separated. Cost: a few eigenproblems of size n.
std::shared_ptr<const IndependentParts> find_independent_parts(const CoefficientMatrices& coefficients);

/// The same for equations with constant constraints: the parts of T^T A T for all matrices A, n x n, in
/// coordinates within the tangent space. T: its orthonormal basis, n x n'.
/// `changes`, n x n or empty: magnitudes that times the rounding unit are the errors of the entries of K;
/// what is below is no stiffness. Null where they do not fall apart.
std::shared_ptr<const IndependentParts> find_independent_parts(const CoefficientMatrices& coefficients,
                                                               const Matrix& T, const Matrix& changes = {});

/// The same parts, with canonical coordinates and two entries for each that is a conjugate pair of complex
/// parts: those of which all matrices commute, in suitable coordinates, with a real J, J^2 = -I. `parts` may
/// be null. Null where there is no such pair. Structure that does not hold up to rounding is not used. Cost:
/// two eigenproblems of the size of every part.
std::shared_ptr<const IndependentParts> find_conjugate_parts(const CoefficientMatrices& coefficients,
                                                             const IndependentParts* parts);

/// The same coordinates with one real part in the place of a conjugate pair, for the pairs whose first entry
/// is marked in `which` (one value per part). Sets `numbers` to the new index of every part.
std::shared_ptr<const IndependentParts> joined_pairs(const IndependentParts& parts,
                                                     const std::vector<bool>& which,
                                                     std::vector<int>& numbers);

/// Mass, damping and stiffness at a place of the path, n x n, and the tangent space there; `changes` as
/// above.
struct PlaceOnPath {
  Matrix M, C, K;
  ConstraintFactorization constraints;
  Matrix changes = {};
};

/// The same for equations whose tangent space turns: the parts of T^T A T at all places, T = turned_frame at
/// each of them. The frame is the tangent space of the place from which the others have turned least. Null
/// where they do not fall apart in these coordinates, or where the tangent space turns by more than 80
/// degrees.
std::shared_ptr<const IndependentParts> find_turning_parts(const std::vector<PlaceOnPath>& places);

/// The orthonormal basis of the tangent space that is closest to `frame`, n x n': the polar factor of P =
/// (I - A+ A) frame. Orthogonal maps that leave the tangent spaces as they are commute with it: a symmetry of
/// the structure is the same matrix in the coordinates of all frames, and so are its parts. Empty if the
/// tangent space has turned by more than 80 degrees.
std::optional<Matrix> turned_frame(const ConstraintFactorization& constraints, const Matrix& frame);

/// Parts in the coordinates of another place: T' (T^T right) and so forth, T the frame and T' that of the
/// place. The parts themselves where they have no frame; null if the tangent space has turned too far.
std::shared_ptr<const IndependentParts> turned(const std::shared_ptr<const IndependentParts>& parts,
                                               const ConstraintFactorization& constraints);

}  // namespace eigentrail
