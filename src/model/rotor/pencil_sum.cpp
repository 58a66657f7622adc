#include "model/rotor/pencil_sum.hpp"

#include <algorithm>

namespace eigentrail {

MatrixSum::Part& MatrixSum::part(const Expression& factor,
                                 const std::shared_ptr<const TabulatedFactor>& table,
                                 const Expression& scale) {
  const auto found = std::find_if(parts_.begin(), parts_.end(), [&](const Part& one) {
    return one.table == table && one.factor == factor && one.scale == scale;
  });
  if (found != parts_.end()) return *found;
  return parts_.emplace_back(Part{factor, table, scale});
}

void MatrixSum::add(Eigen::Index row, Eigen::Index column, const Expression& factor, double value,
                    const std::shared_ptr<const TabulatedFactor>& table) {
  const bool fixed = !table && factor.is_constant();
  if (fixed) value *= factor.value();
  if (row < 0 || column < 0 || value == 0.0) return;
  part(fixed ? 1.0 : factor, table).entries[{row, column}] += value;
}

void MatrixSum::add_product(Eigen::Index row, Eigen::Index column, const Expression& factor,
                            const Expression& entry, double value) {
  if (entry.is_constant()) {
    add(row, column, factor, value * entry.value());
  } else {
    add(row, column, factor * entry, value);
  }
}

void MatrixSum::add(const MatrixSum& other, const Expression& strength) {
  for (const Part& one : other.parts_) {
    const bool whole = strength == Expression(1.0);
    Part& own = whole       ? part(one.factor, one.table, one.scale)
                : one.table ? part(one.factor, one.table, one.scale * strength)
                            : part(one.factor * strength, nullptr);
    for (const auto& [at, value] : one.entries) own.entries[at] += value;
  }
}

std::vector<AffineTerm<SparseMatrix>> MatrixSum::terms(Eigen::Index n) const {
  std::vector<AffineTerm<SparseMatrix>> result;
  for (const Part& one : parts_) {
    std::vector<Eigen::Triplet<double>> entries;
    for (const auto& [at, value] : one.entries) {
      if (value != 0.0) entries.emplace_back(at.first, at.second, value);
    }
    SparseMatrix matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    result.emplace_back(one.factor, std::move(matrix));
    result.back().table = one.table;
    result.back().scale = one.scale;
  }
  return result;
}

}  // namespace eigentrail
