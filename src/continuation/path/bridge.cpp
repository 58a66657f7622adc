#include "continuation/path/bridge.hpp"

#include <algorithm>
#include <cmath>

namespace eigentrail {
namespace {

/// Series of x, lambda and p - p0 as rows of one matrix. Positions that rest have no coefficients but the
/// first.
ComplexMatrix stacked(const Path& path, int traced, double p0) {
  const Eigen::Index count = std::max(path.x.cols(), path.lambda.cols());
  ComplexMatrix rows = ComplexMatrix::Zero(path.x.rows() + path.lambda.rows() + 1, count);
  rows.topLeftCorner(path.x.rows(), path.x.cols()) = path.x.cast<Complex>();
  rows.block(path.x.rows(), 0, path.lambda.rows(), path.lambda.cols()) = path.lambda.cast<Complex>();
  for (Eigen::Index k = 0; k < count; ++k) rows(rows.rows() - 1, k) = coefficient(path.parameters, traced, k);
  rows(rows.rows() - 1, 0) -= p0;
  return rows;
}

}  // namespace

Bridge::Bridge(double begin, double end, const Path& left, const Path& right, int traced, bool on_plane)
    : begin_(begin),
      end_(end),
      parameters_(left.parameters.col(0)),
      n_(left.x.rows()),
      traced_(traced),
      on_plane_(on_plane),
      interpolant_(end - begin, stacked(left, traced, parameters_[traced]),
                   stacked(right, traced, parameters_[traced])) {}

Path Bridge::path(double coordinate, int order) const {
  const double length = end_ - begin_;
  ComplexMatrix series = interpolant_.series((coordinate - begin_) / length, order);
  for (Eigen::Index k = 1; k <= order; ++k) series.col(k) /= std::pow(length, static_cast<double>(k));
  Path path;
  path.x = series.topRows(n_).real();
  path.lambda = series.middleRows(n_, series.rows() - n_ - 1).real();
  path.parameters = VectorSeries::Zero(parameters_.size(), order + 1);
  path.parameters.col(0) = parameters_;
  if (on_plane_) {
    path.parameters.row(traced_) += series.bottomRows(1).real();
  } else {
    path.parameters(traced_, 0) = coordinate;
    path.parameters(traced_, 1) = 1.0;
  }
  return path;
}

double Bridge::error(const Sizes& sizes) const {
  const Vector errors = interpolant_.error_without_last();
  const Eigen::Index m = errors.size() - n_ - 1;
  double worst = errors.head(n_).maxCoeff() / sizes.x;
  if (m > 0) worst = std::max(worst, errors.segment(n_, m).maxCoeff() / sizes.lambda);
  return on_plane_ ? std::max(worst, errors[n_ + m] / sizes.p) : worst;
}

}  // namespace eigentrail
