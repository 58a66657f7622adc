#include "projection/family_pencils.hpp"

#include <algorithm>

#include "core/products.hpp"
#include "core/transposition.hpp"
#include "model/affine_factor.hpp"
#include "model/series_sum.hpp"

namespace eigentrail {

SparseSum::SparseSum(const std::vector<AffineTerm<SparseMatrix>>& terms, Eigen::Index n)
    : terms_(terms), n_(n) {
  if (terms.size() < 2) return;
  SparseMatrix all(n, n);
  for (const AffineTerm<SparseMatrix>& term : terms) all += term.matrix.cwiseAbs();
  starts_.assign(all.outerIndexPtr(), all.outerIndexPtr() + n + 1);
  rows_.assign(all.innerIndexPtr(), all.innerIndexPtr() + all.nonZeros());
}

SparseMatrix SparseSum::with(std::span<const double> factors) const {
  if (terms_.empty()) return SparseMatrix(n_, n_);
  if (terms_.size() == 1) return factors[0] * terms_.front().matrix;
  const std::vector<double> zeros(rows_.size(), 0.0);
  SparseMatrix sum = Eigen::Map<const SparseMatrix>(n_, n_, static_cast<Eigen::Index>(rows_.size()),
                                                    starts_.data(), rows_.data(), zeros.data());
  std::vector<int> place(static_cast<std::size_t>(n_));  // of a row within the sum's column
  for (Eigen::Index j = 0; j < n_; ++j) {
    for (int k = starts_[static_cast<std::size_t>(j)]; k < starts_[static_cast<std::size_t>(j) + 1]; ++k)
      place[static_cast<std::size_t>(rows_[static_cast<std::size_t>(k)])] = k;
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      for (SparseMatrix::InnerIterator entry(terms_[i].matrix, j); entry; ++entry)
        sum.valuePtr()[place[static_cast<std::size_t>(entry.row())]] += factors[i] * entry.value();
    }
  }
  return sum;
}

FamilyPencils::FamilyPencils(const SparseFamily& family)
    : family_(family),
      M_(family.pencil().M, family.n_coordinates()),
      C_(family.pencil().C, family.n_coordinates()),
      K_(family.pencil().K, family.n_coordinates()) {}

FamilyPencils::Terms::Terms(const std::vector<AffineTerm<SparseMatrix>>& the_terms, Eigen::Index n)
    : terms(the_terms), sum(the_terms, n) {
  for (const AffineTerm<SparseMatrix>& term : terms)
    symmetries.push_back({equals_transpose(term.matrix, 1.0), equals_transpose(term.matrix, -1.0)});
}

FamilyPencils::Sum FamilyPencils::sum_at(const Terms& terms, std::span<const Series<double, 0>> si) {
  Symmetry symmetry;
  std::vector<double> factors;
  for (std::size_t i = 0; i < terms.terms.size(); ++i) {
    factors.push_back(factor_of(terms.terms[i], si)[0]);
    if (factors.back() == 0.0) continue;
    symmetry.symmetric = symmetry.symmetric && terms.symmetries[i].symmetric;
    symmetry.skew = symmetry.skew && terms.symmetries[i].skew;
  }
  return {terms.sum.with(factors), symmetry};
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
