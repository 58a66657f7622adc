#include "projection/family_pencils.hpp"

#include <algorithm>

#include "core/products.hpp"
#include "core/transposition.hpp"
#include "model/affine_factor.hpp"
#include "model/series_sum.hpp"

namespace eigentrail {

FamilyPencils::FamilyPencils(const SparseFamily& family)
    : family_(family),
      M_(family.pencil().M, family.n_coordinates()),
      C_(family.pencil().C, family.n_coordinates()),
      K_(family.pencil().K, family.n_coordinates()) {}

FamilyPencils::Terms::Terms(const std::vector<AffineTerm<SparseMatrix>>& the_terms, Eigen::Index the_size)
    : terms(the_terms), n(the_size) {
  for (const AffineTerm<SparseMatrix>& term : terms)
    symmetries.push_back({equals_transpose(term.matrix, 1.0), equals_transpose(term.matrix, -1.0)});
}

FamilyPencils::Sum FamilyPencils::sum_at(const Terms& terms, std::span<const Series<double, 0>> si) {
  Sum sum{SparseMatrix(terms.n, terms.n), {}};
  for (std::size_t i = 0; i < terms.terms.size(); ++i) {
    const double factor = factor_of(terms.terms[i], si)[0];
    sum.matrix += factor * terms.terms[i].matrix;  // zeros stay entries
    if (factor == 0.0) continue;
    sum.symmetry.symmetric = sum.symmetry.symmetric && terms.symmetries[i].symmetric;
    sum.symmetry.skew = sum.symmetry.skew && terms.symmetries[i].skew;
  }
  return sum;
}

SparsePencil FamilyPencils::at(const Vector& parameters) const {
  const auto si = si_series<double, 0>(family_.description().parameters, {parameters, {}, {}});
  Sum M = sum_at(M_, si), C = sum_at(C_, si), K = sum_at(K_, si);
  SparsePencil pencil{std::move(M.matrix), std::move(C.matrix), std::move(K.matrix)};
  const bool conservative = M.symmetry.symmetric && K.symmetry.symmetric;
  pencil.symmetric = conservative && C.symmetry.symmetric;
  pencil.one_sided = pencil.symmetric || (conservative && C.symmetry.skew);
  return pencil;
}

Matrix projected(const SparseMatrix& A, const Matrix& basis) {
  constexpr Eigen::Index few = 16;  // columns at a time, so that little memory is taken
  Matrix result(basis.cols(), basis.cols());
  for (Eigen::Index first = 0; first < basis.cols(); first += few) {
    const Eigen::Index count = std::min(few, basis.cols() - first);
    const RowBlock columns = basis.middleCols(first, count);
    result.middleCols(first, count) = transposed_product(basis, Matrix(RowBlock(A * columns)));
  }
  return result;
}

std::vector<AffineTerm<Matrix>> FamilyPencils::Terms::projected(const Matrix& basis) const {
  std::vector<AffineTerm<Matrix>> result;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    Matrix reduced = eigentrail::projected(terms[i].matrix, basis);
    if (symmetries[i].symmetric || symmetries[i].skew) {
      const double sign = symmetries[i].symmetric ? 1.0 : -1.0;
      reduced = (0.5 * (reduced + sign * reduced.transpose())).eval();
    }
    result.emplace_back(terms[i].factor, std::move(reduced), terms[i].name);
    result.back().table = terms[i].table;
    result.back().scale = terms[i].scale;
  }
  return result;
}

AffinePencil<Matrix> FamilyPencils::projected(const Matrix& basis) const {
  return {M_.projected(basis), C_.projected(basis), K_.projected(basis)};
}

}  // namespace eigentrail
