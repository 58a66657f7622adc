// The pencils of a sparse family at places, with their symmetry.
#pragma once

#include "projection/nearest_modes.hpp"

namespace eigentrail {

class FamilyPencils {
 public:
  /// Finds the symmetry of each matrix of the family, once.
  explicit FamilyPencils(const SparseFamily& family);

  const SparseFamily& family() const { return family_; }

  /// The pencil at given parameters (declared units). It counts as symmetric where all matrices are whose
  /// factor is not zero there; matrices whose skew parts cancel in the sum do not.
  SparsePencil at(const Vector& parameters) const;

 private:
  struct Symmetry {
    bool symmetric = true, skew = true;
  };
  static std::vector<Symmetry> symmetries(const std::vector<AffineTerm<SparseMatrix>>& terms);

  const SparseFamily& family_;
  std::vector<Symmetry> M_, C_, K_;
};

}  // namespace eigentrail
