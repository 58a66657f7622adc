#include "model/sample_interpolation.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace eigentrail {
namespace {

/// Largest degree of a blended polynomial. Higher ones amplify errors of the samples near the ends (Floater &
/// Hormann, Sect. 5).
constexpr int highest_degree = 15;
/// The smallest degree is taken whose leave-one-out error is within this factor of the least one.
constexpr double as_good = 1.1;

/// Factors for rows and columns by which the mean magnitudes of the entries of all matrices come to about
/// one: states have units of their own.
struct EntryScale {
  Vector rows, columns;
  Vector matrices;  ///< per matrix of sampled_matrices(): one over its norm; zero if it is absent
};

EntryScale entry_scale(const SampledData& data) {
  const Eigen::Index n = data.size();
  EntryScale scale{Vector::Ones(n), Vector::Ones(n), Vector::Zero(sampled_matrices().size())};
  Matrix magnitudes = Matrix::Zero(n, n);
  Eigen::Index at = 0;
  for (const SampledMatrix& named : sampled_matrices()) {
    Matrix mean = Matrix::Zero(n, n);
    for (const Matrix& sample : data.*named.samples) mean += sample.cwiseAbs();
    const double norm = mean.norm();
    if (norm > 0.0) {
      scale.matrices[at] = static_cast<double>(data.count()) / norm;
      magnitudes += mean / norm;
    }
    ++at;
  }
  const auto factor = [](double largest) { return largest > 0.0 ? 1.0 / std::sqrt(largest) : 1.0; };
  constexpr int sweeps = 10;
  for (int i = 0; i < sweeps; ++i) {
    const Matrix scaled = scale.rows.asDiagonal() * magnitudes * scale.columns.asDiagonal();
    for (Eigen::Index k = 0; k < n; ++k) {
      scale.rows[k] *= factor(scaled.row(k).maxCoeff());
      scale.columns[k] *= factor(scaled.col(k).maxCoeff());
    }
  }
  return scale;
}

/// R of the QR decomposition of the rows of both matrices.
Matrix triangular_factor(const Matrix& above, const Matrix& below) {
  Matrix both(above.rows() + below.rows(), below.cols());
  both << above, below;
  const Eigen::Index rows = std::min(both.rows(), both.cols());
  Eigen::HouseholderQR<Eigen::Ref<Matrix>> qr(both);
  return qr.matrixQR().topRows(rows).triangularView<Eigen::Upper>();
}

/// See SamplePiece::reduced: one row per entry of the matrices, brought to as many rows as samples, column by
/// column of the matrices.
Matrix reduce(const SampledData& data, std::size_t first, std::size_t count) {
  const EntryScale scale = entry_scale(data);
  const Eigen::Index n = data.size();
  const auto samples = static_cast<Eigen::Index>(count);
  Matrix reduced(0, samples);
  Eigen::Index which = 0;
  for (const SampledMatrix& named : sampled_matrices()) {
    const std::vector<Matrix>& list = data.*named.samples;
    const double factor = scale.matrices[which++];
    if (list.empty()) continue;
    for (Eigen::Index column = 0; column < n; ++column) {
      Matrix rows(n, samples);
      for (Eigen::Index k = 0; k < samples; ++k)
        rows.col(k) = list[first + static_cast<std::size_t>(k)].col(column);
      rows.colwise() -= Vector(rows.rowwise().mean());
      if (rows.isZero(0.0)) continue;
      reduced =
          triangular_factor(reduced, Matrix(factor * scale.columns[column] * scale.rows.asDiagonal() * rows));
    }
  }
  return reduced;
}

int chosen_degree(const std::vector<double>& nodes, const Matrix& reduced) {
  const int count = static_cast<int>(nodes.size());
  if (count < 4) return std::max(0, std::min(1, count - 1));
  const std::vector<double> errors = leave_one_out_errors(nodes, reduced);
  const double least = *std::min_element(errors.begin(), errors.end());
  const auto found =
      std::find_if(errors.begin(), errors.end(), [least](double e) { return e <= as_good * least; });
  return 1 + static_cast<int>(found - errors.begin());
}

}  // namespace

Vector leave_one_out(const std::vector<double>& nodes, int degree, std::size_t left_out) {
  std::vector<double> others = nodes;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(left_out));
  const int highest = static_cast<int>(others.size()) - 1;
  const Vector values = RationalInterpolant(others, std::min(degree, highest)).values(nodes[left_out]);
  const auto at = static_cast<Eigen::Index>(left_out);
  Vector missed(values.size() + 1);
  missed << -values.head(at), 1.0, -values.tail(values.size() - at);
  return missed;
}

std::vector<double> leave_one_out_errors(const std::vector<double>& nodes, const Matrix& reduced) {
  const int highest = std::max(1, std::min(static_cast<int>(nodes.size()) - 3, highest_degree));
  std::vector<double> errors;
  for (int degree = 1; degree <= highest; ++degree) {
    double squares = 0.0;
    for (std::size_t i = 1; i + 1 < nodes.size(); ++i)
      squares += (reduced * leave_one_out(nodes, degree, i)).squaredNorm();
    errors.push_back(std::sqrt(squares));
  }
  return errors;
}

std::vector<SamplePiece> interpolate_samples(const SampledData& data, const std::vector<double>& values,
                                             const std::vector<std::size_t>& kinks,
                                             std::optional<int> degree) {
  std::vector<SamplePiece> pieces;
  std::vector<std::size_t> ends = kinks;
  ends.push_back(values.size() - 1);
  std::size_t first = 0;
  for (const std::size_t last : ends) {
    const std::vector<double> nodes(values.begin() + static_cast<std::ptrdiff_t>(first),
                                    values.begin() + static_cast<std::ptrdiff_t>(last) + 1);
    Matrix reduced = reduce(data, first, nodes.size());
    const int highest = static_cast<int>(nodes.size()) - 1;
    const int chosen = degree ? std::min(*degree, highest) : chosen_degree(nodes, reduced);
    pieces.push_back({first, RationalInterpolant(nodes, chosen), std::move(reduced)});
    first = last;
  }
  return pieces;
}

const SamplePiece& piece_at(const std::vector<SamplePiece>& pieces, double x) {
  for (const SamplePiece& piece : pieces) {
    if (x <= piece.interpolant.nodes().back()) return piece;
  }
  return pieces.back();
}

}  // namespace eigentrail
