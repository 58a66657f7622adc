#include "modes/bordered_band.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>

#include "core/lapack.hpp"

extern "C" void ztbsv_(const char* triangle, const char* form, const char* diagonal, const int* n,
                       const int* width, const eigentrail::Complex* A, const int* stride,
                       eigentrail::Complex* b, const int* increment);

namespace eigentrail {
namespace {

/// Bound of the other components of the null vectors whose chosen ones are one. Errors grow by it; they are
/// about one at best. A larger value allows larger errors, a smaller one factors more matrices twice.
constexpr double largest_growth = 100.0;

/// Overwrites every column of B with what `map` makes of it in place.
template <class Map>
void for_each_column(ComplexMatrix& B, Map map) {
  for (Eigen::Index j = 0; j < B.cols(); ++j) {
    ComplexVector column = B.col(j);
    map(column);
    B.col(j) = column;
  }
}

/// The columns of P, of n rows, that are chosen.
ComplexMatrix columns_of_band(const ComplexMatrix& band, const std::vector<Eigen::Index>& chosen) {
  const Eigen::Index n = band.cols();
  const Eigen::Index width = band.rows() / 2;
  ComplexMatrix columns = ComplexMatrix::Zero(n, static_cast<Eigen::Index>(chosen.size()));
  for (Eigen::Index i = 0; i < columns.cols(); ++i) {
    const Eigen::Index j = chosen[static_cast<std::size_t>(i)];
    const Eigen::Index first = std::max<Eigen::Index>(j - width, 0);
    const Eigen::Index count = std::min(n, j + width + 1) - first;
    columns.col(i).segment(first, count) = band.col(j).segment(width + first - j, count);
  }
  return columns;
}

}  // namespace

BorderedBand::BorderedBand(const ComplexMatrix& band, const ComplexMatrix& Z, const ComplexMatrix& X,
                           const ComplexMatrix& Y, const ComplexMatrix& D)
    : n_(X.rows()), lower_(band.rows() / 2 + X.cols()), upper_(lower_ + band.rows() / 2) {
  const Eigen::Index k = X.cols();
  choose_columns(Z);
  factor(band);
  ComplexMatrix last = X;
  for_each_column(last, [this](ComplexVector& x) { eliminate(x); });
  last_ = last.topRows(n_ - k);
  last_inverse_ = last.bottomRows(k).inverse();
  ComplexMatrix rows(k, n_ + k);
  rows << Y, D;
  rows_ = rows(Eigen::all, kept_);
  null_ = -columns_of_band(band, chosen_);
  for_each_column(null_, [this](ComplexVector& v) { solve_within(v); });
  inverse_ = (rows(Eigen::all, chosen_) + rows_ * null_).inverse();
}

void BorderedBand::choose_columns(const ComplexMatrix& Z) {
  const Eigen::ColPivHouseholderQR<ComplexMatrix> qr(Z.adjoint());
  const auto& order = qr.colsPermutation().indices();
  chosen_.assign(order.data(), order.data() + Z.cols());
  std::sort(chosen_.begin(), chosen_.end());
  for (Eigen::Index j = 0; j < Z.rows() + Z.cols(); ++j) {
    if (!std::binary_search(chosen_.begin(), chosen_.end(), j)) kept_.push_back(j);
  }
}

// Columns behind those that are left out move to the left, and so reach further below the diagonal.
void BorderedBand::factor(const ComplexMatrix& band) {
  const Eigen::Index width = band.rows() / 2;
  const Eigen::Index columns = band.cols() - static_cast<Eigen::Index>(chosen_.size());
  factors_ = ComplexMatrix::Zero(upper_ + lower_ + 1, columns);
  for (Eigen::Index j = 0; j < columns; ++j) {
    const Eigen::Index from = kept_[static_cast<std::size_t>(j)];
    factors_.col(j).segment(upper_ - width + from - j, band.rows()) = band.col(from);
  }
  pivots_.resize(static_cast<std::size_t>(columns));
  LAPACKE_zgbtrf_work(LAPACK_COL_MAJOR, static_cast<lapack_int>(band.cols()),
                      static_cast<lapack_int>(columns), static_cast<lapack_int>(lower_),
                      static_cast<lapack_int>(width), factors_.data(),
                      static_cast<lapack_int>(factors_.rows()), pivots_.data());
}

bool BorderedBand::is_accurate() const {
  return null_.allFinite() && null_.cwiseAbs().maxCoeff() <= largest_growth;
}

void BorderedBand::solve_in_place(Eigen::Ref<ComplexMatrix> B) const {
  for (auto b : B.colwise()) {
    ComplexVector y = b.head(n_);
    solve_within(y);
    const ComplexVector open = b.tail(inverse_.rows()) - rows_ * y;
    const ComplexVector share = inverse_.lazyProduct(open);
    b(kept_) = y + null_.lazyProduct(share);
    b(chosen_) = share;
  }
}

void BorderedBand::solve_adjoint_in_place(Eigen::Ref<ComplexMatrix> B) const {
  for (auto b : B.colwise()) {
    ComplexVector y = b(kept_);
    const ComplexVector open = b(chosen_) + null_.adjoint() * y;
    const ComplexVector share = inverse_.adjoint().lazyProduct(open);
    y -= rows_.adjoint().lazyProduct(share);
    solve_adjoint_within(y);
    b << y, share;
  }
}

void BorderedBand::solve_within(ComplexVector& b) const {
  eliminate(b);
  const ComplexVector end = last_inverse_.lazyProduct(b.tail(last_.cols()));
  b.head(last_.rows()) -= last_.lazyProduct(end);
  b.tail(last_.cols()) = end;
  substitute('N', b);
}

void BorderedBand::solve_adjoint_within(ComplexVector& b) const {
  substitute('C', b);
  const ComplexVector end = b.tail(last_.cols()) - last_.adjoint() * b.head(last_.rows());
  b.tail(last_.cols()) = last_inverse_.adjoint().lazyProduct(end);
  eliminate_adjoint(b);
}

void BorderedBand::eliminate(ComplexVector& b) const {
  for (Eigen::Index j = 0; j < factors_.cols(); ++j) {
    std::swap(b[j], b[pivots_[static_cast<std::size_t>(j)] - 1]);
    b.segment(j + 1, reach(j)) -= b[j] * multipliers(j);
  }
}

void BorderedBand::eliminate_adjoint(ComplexVector& b) const {
  for (Eigen::Index j = factors_.cols() - 1; j >= 0; --j) {
    b[j] -= multipliers(j).dot(b.segment(j + 1, reach(j)));
    std::swap(b[j], b[pivots_[static_cast<std::size_t>(j)] - 1]);
  }
}

void BorderedBand::substitute(char form, ComplexVector& b) const {
  const auto columns = static_cast<int>(factors_.cols());
  const auto upper = static_cast<int>(upper_);
  const auto stride = static_cast<int>(factors_.rows());
  const int next = 1;
  ztbsv_("U", &form, "N", &columns, &upper, factors_.data(), &stride, b.data(), &next);
}

}  // namespace eigentrail
