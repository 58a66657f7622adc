// The pencils of a sparse family at places, with their symmetry, and its projection.
#pragma once

#include <span>
#include <vector>

#include "projection/nearest_modes.hpp"

namespace eigentrail {

class FamilyPencils {
 public:
  /// Finds the symmetry of each matrix of the family, once.
  explicit FamilyPencils(const SparseFamily& family);

  const SparseFamily& family() const { return family_; }

  /// The pencil at given parameters (declared units). Its matrices have the pattern of all their terms
  /// together whatever the factors are, so that it is analyzed once. It counts as symmetric where all terms
  /// are whose factor is not zero there; terms whose skew parts cancel in the sum do not.
  SparsePencil at(const Vector& parameters) const;

  /// The family on the space of the orthonormal columns of `basis`, n x k: basis^T A basis for each of its
  /// matrices; symmetric ones stay so exactly.
  AffinePencil<Matrix> projected(const Matrix& basis) const;

 private:
  struct Symmetry {
    bool symmetric = true, skew = true;
  };
  /// The terms of M, C or K.
  struct Terms {
    const std::vector<AffineTerm<SparseMatrix>>& terms;
    Eigen::Index n;
    std::vector<Symmetry> symmetries;

    Terms(const std::vector<AffineTerm<SparseMatrix>>& the_terms, Eigen::Index the_size);
    std::vector<AffineTerm<Matrix>> projected(const Matrix& basis) const;
  };
  struct Sum {
    SparseMatrix matrix;
    Symmetry symmetry;
  };
  static Sum sum_at(const Terms& terms, std::span<const Series<double, 0>> si);

  const SparseFamily& family_;
  Terms M_, C_, K_;
};

/// basis^T A basis, k x k, for an n x k basis.
Matrix projected(const SparseMatrix& A, const Matrix& basis);

}  // namespace eigentrail
