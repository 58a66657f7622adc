#include "projection/family_pencils.hpp"

#include "core/transposition.hpp"
#include "model/affine_factor.hpp"

namespace eigentrail {

FamilyPencils::FamilyPencils(const SparseFamily& family)
    : family_(family),
      M_(symmetries(family.pencil().M)),
      C_(symmetries(family.pencil().C)),
      K_(symmetries(family.pencil().K)) {}

std::vector<FamilyPencils::Symmetry> FamilyPencils::symmetries(
    const std::vector<AffineTerm<SparseMatrix>>& terms) {
  std::vector<Symmetry> result;
  for (const AffineTerm<SparseMatrix>& term : terms)
    result.push_back({equals_transpose(term.matrix, 1.0), equals_transpose(term.matrix, -1.0)});
  return result;
}

SparsePencil FamilyPencils::at(const Vector& parameters) const {
  const AffinePencil<SparseMatrix> at = family_.at(parameters);
  const auto si = si_series<double, 0>(family_.description().parameters, {parameters, {}, {}});
  const auto sum = [&](const std::vector<AffineTerm<SparseMatrix>>& terms,
                       const std::vector<Symmetry>& symmetries) {
    Symmetry result;
    for (std::size_t i = 0; i < terms.size(); ++i) {
      if (factor_of(terms[i], std::span<const Series<double, 0>>(si))[0] == 0.0) continue;
      result.symmetric = result.symmetric && symmetries[i].symmetric;
      result.skew = result.skew && symmetries[i].skew;
    }
    return result;
  };
  const Symmetry M = sum(family_.pencil().M, M_), C = sum(family_.pencil().C, C_),
                 K = sum(family_.pencil().K, K_);
  SparsePencil pencil{at.M.front().matrix, at.C.front().matrix, at.K.front().matrix};
  const bool conservative = M.symmetric && K.symmetric;
  pencil.symmetric = conservative && C.symmetric;
  pencil.one_sided = pencil.symmetric || (conservative && C.skew);
  return pencil;
}

}  // namespace eigentrail
